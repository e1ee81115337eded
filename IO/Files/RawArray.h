// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRawArray_h
#define tippRawArray_h

#include "Arrays/Scalar.h"
#include "vtkTIPPIOModule.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>

namespace tipp
{

/// The size of a value in bytes.
VTKTIPPIO_EXPORT std::size_t scalarSize(Scalar type);
/// The name in VTK's XML files: "Int8" ... "Float64".
VTKTIPPIO_EXPORT const char* scalarName(Scalar type);
/// The name in NumPy: "|i1", "<f8".
VTKTIPPIO_EXPORT const char* scalarDescr(Scalar type);
/// The inverse of scalarName() and scalarDescr(); nullopt for any other text.
std::optional<Scalar> scalarFromName(const std::string& name);
std::optional<Scalar> scalarFromDescr(const std::string& descr);

/// An array's tuples in a file: little-endian and contiguous.
struct RawArray
{
  std::string Name;
  std::string Path;         ///< the file
  std::uint64_t Offset = 0; ///< offset of the first tuple from the file's start, in bytes
  Scalar Type = Scalar::Float64;
  int Components = 1;      ///< components per tuple
  std::int64_t Tuples = 0; ///< number of tuples

  std::size_t tupleBytes() const { return std::size_t(this->Components) * scalarSize(this->Type); }
  std::uint64_t bytes() const { return std::uint64_t(this->Tuples) * this->tupleBytes(); }
};

/// Whether all ids are in [0, limit).
template <typename Id>
bool areBelow(const Id* ids, std::size_t count, std::int64_t limit)
{
  using Unsigned = std::make_unsigned_t<Id>; // in which negative ids are large
  Unsigned greatest = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    greatest = std::max(greatest, Unsigned(ids[i]));
  }
  return count == 0 || std::uint64_t(greatest) < std::uint64_t(limit);
}

} // namespace tipp

#endif
