// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippAttribute_h
#define tippAttribute_h

#include "Arrays/Scalar.h"

namespace tipp
{

/// An array of a mesh, and the array of samples to compute from it.
struct Attribute
{
  /// Values of the points, or the cells; Components per tuple. Null: all samples get NullValue.
  const void* Values = nullptr;
  void* Samples = nullptr; ///< Components per sample
  Scalar Type = Scalar::Float64;
  int Components = 1;
  bool OfCells = false;
  double NullValue = 0; ///< value of samples outside of all cells
};

/// Whether the array is interpolated linearly: a point array of floating-point numbers.
inline bool isInterpolated(const Attribute& attribute)
{
  return !attribute.OfCells &&
    (attribute.Type == Scalar::Float32 || attribute.Type == Scalar::Float64);
}

} // namespace tipp

#endif
