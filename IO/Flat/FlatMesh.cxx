// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/FlatMesh.h"

#include "Files/FileKind.h"
#include "Files/IOError.h"

#include <filesystem>
#include <iterator>

namespace tipp
{
namespace
{

struct ScalarFacts
{
  std::size_t Size;
  const char* Name;
  const char* Descr;
};

// In the order of the enumerators of Scalar.
constexpr ScalarFacts facts[] = {
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

std::optional<Scalar> find(const char* ScalarFacts::*text, const std::string& wanted)
{
  for (std::size_t type = 0; type < std::size(facts); ++type)
  {
    if (wanted == facts[type].*text)
    {
      return Scalar(int(type));
    }
  }
  return std::nullopt;
}

} // namespace

std::size_t scalarSize(Scalar type)
{
  return facts[int(type)].Size;
}

const char* scalarName(Scalar type)
{
  return facts[int(type)].Name;
}

const char* scalarDescr(Scalar type)
{
  return facts[int(type)].Descr;
}

std::optional<Scalar> scalarFromName(const std::string& name)
{
  return find(&ScalarFacts::Name, name);
}

std::optional<Scalar> scalarFromDescr(const std::string& descr)
{
  return find(&ScalarFacts::Descr, descr);
}

FlatMesh openFlatMesh(const std::string& path)
{
  std::error_code failure;
  if (std::filesystem::is_directory(path, failure))
  {
    return openFlatFolder(path);
  }
  if (extensionOf(path) == ".vtu")
  {
    return openFlatVtu(path);
  }
  throw IOError(path,
    "is neither a folder of .npy arrays nor a .vtu file; 'tipp flatten' makes such a folder of any "
    "VTK file.");
}

bool isFlatMesh(const std::string& path)
{
  std::error_code failure;
  return std::filesystem::is_directory(path, failure)
    ? isFlatFolder(path)
    : extensionOf(path) == ".vtu" && isFlatVtu(path);
}

} // namespace tipp
