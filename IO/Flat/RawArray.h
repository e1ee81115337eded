// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRawArray_h
#define tippRawArray_h

#include "Arrays/Scalar.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace tipp
{

/// The size of a value in bytes.
VTKTIPPIO_EXPORT std::size_t scalarSize(Scalar type);
/// The name in VTK's XML files: "Int8" ... "Float64".
VTKTIPPIO_EXPORT const char* scalarName(Scalar type);
/// The name in NumPy: "|i1", "<f8".
VTKTIPPIO_EXPORT const char* scalarDescr(Scalar type);
/// The inverse of both; nullopt for any other text.
std::optional<Scalar> scalarFromName(const std::string& name);
std::optional<Scalar> scalarFromDescr(const std::string& descr);

/// An array's tuples in a file: little-endian and contiguous.
struct RawArray
{
  std::string Name;
  std::string Path;
  std::uint64_t Offset = 0; ///< of the first tuple from the file's start, in bytes
  Scalar Type = Scalar::Float64;
  int Components = 1;
  std::int64_t Tuples = 0;

  std::size_t tupleBytes() const { return std::size_t(this->Components) * scalarSize(this->Type); }
  std::uint64_t bytes() const { return std::uint64_t(this->Tuples) * this->tupleBytes(); }
};

} // namespace tipp

#endif
