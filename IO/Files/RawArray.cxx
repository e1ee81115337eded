// SPDX-License-Identifier: BSD-3-Clause
#include "Files/RawArray.h"

#include <iterator>

namespace tipp
{
namespace
{

struct ScalarInfo
{
  std::size_t Size;
  const char* Name;
  const char* Descr;
};

// In the order of the enumerators of Scalar.
constexpr ScalarInfo scalars[] = {
  { 1, "Int8", "|i1" },
  { 1, "UInt8", "|u1" },
  { 2, "Int16", "<i2" },
  { 2, "UInt16", "<u2" },
  { 4, "Int32", "<i4" },
  { 4, "UInt32", "<u4" },
  { 8, "Int64", "<i8" },
  { 8, "UInt64", "<u8" },
  { 4, "Float32", "<f4" },
  { 8, "Float64", "<f8" },
};

std::optional<Scalar> find(const char* ScalarInfo::*text, const std::string& wanted)
{
  for (std::size_t type = 0; type < std::size(scalars); ++type)
  {
    if (wanted == scalars[type].*text)
    {
      return Scalar(int(type));
    }
  }
  return std::nullopt;
}

} // namespace

std::size_t scalarSize(Scalar type)
{
  return scalars[int(type)].Size;
}

const char* scalarName(Scalar type)
{
  return scalars[int(type)].Name;
}

const char* scalarDescr(Scalar type)
{
  return scalars[int(type)].Descr;
}

std::optional<Scalar> scalarFromName(const std::string& name)
{
  return find(&ScalarInfo::Name, name);
}

std::optional<Scalar> scalarFromDescr(const std::string& descr)
{
  return find(&ScalarInfo::Descr, descr);
}

} // namespace tipp
