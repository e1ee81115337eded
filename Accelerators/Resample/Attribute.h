// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippAttribute_h
#define tippAttribute_h

#include "Arrays/Scalar.h"

namespace tipp
{

/// An array of a mesh and the array of samples to fill from it.
struct Attribute
{
  /// Of the points, or the cells; Components a tuple. Null: all are NullValue.
  const void* Values = nullptr;
  void* Samples = nullptr; ///< as many Components for each sample
  Scalar Type = Scalar::Float64;
  int Components = 1;
  bool OfCells = false;
  double NullValue = 0; ///< what samples in no cell get
};

/// Whether it is interpolated: numbers of points that are not whole.
inline bool isInterpolated(const Attribute& attribute)
{
  return !attribute.OfCells &&
    (attribute.Type == Scalar::Float32 || attribute.Type == Scalar::Float64);
}

} // namespace tipp

#endif
