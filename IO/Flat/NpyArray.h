// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNpyArray_h
#define tippNpyArray_h

#include "Flat/RawArray.h"

#include <vector>

namespace tipp
{

/// An .npy file whose array is used in place.
struct NpyArray
{
  std::string Path;
  std::uint64_t Offset = 0;
  Scalar Type = Scalar::Float64;
  std::vector<std::int64_t> Shape;

  /// For messages, such as "3 x 4".
  std::string shapeText() const;
};

/// Reads the header and checks it against the file's size; throws IOError. Booleans are read as
/// UInt8.
NpyArray openNpyArray(const std::string& path);

} // namespace tipp

#endif
