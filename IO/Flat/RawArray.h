// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRawArray_h
#define tippRawArray_h

#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace tipp
{

enum class Scalar
{
  Int8,
  UInt8,
  Int16,
  UInt16,
  Int32,
  UInt32,
  Int64,
  UInt64,
  Float32,
  Float64
};

/// In bytes.
VTKTIPPIO_EXPORT std::size_t scalarSize(Scalar type);
/// As VTK's XML files name it: "Int8" ... "Float64".
VTKTIPPIO_EXPORT const char* scalarName(Scalar type);
/// As NumPy names it: "|i1", "<f8".
VTKTIPPIO_EXPORT const char* scalarDescr(Scalar type);
/// Back from either; nothing for any other text.
std::optional<Scalar> scalarFromName(const std::string& name);
std::optional<Scalar> scalarFromDescr(const std::string& descr);

/// The tuples of one array where they lie in a file: little-endian, one after the other.
struct RawArray
{
  std::string Name;
  std::string Path;
  std::uint64_t Offset = 0; ///< of the first tuple in the file, in bytes
  Scalar Type = Scalar::Float64;
  int Components = 1;
  std::int64_t Tuples = 0;

  std::size_t tupleBytes() const { return std::size_t(this->Components) * scalarSize(this->Type); }
  std::uint64_t bytes() const { return std::uint64_t(this->Tuples) * this->tupleBytes(); }
};

} // namespace tipp

#endif
