// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippAttribute_h
#define tippAttribute_h

#include "Arrays/Scalar.h"

namespace tipp
{

/// An array of a mesh, and the array of samples to compute from it.
struct Attribute
{
  /// Values per point or per cell, Components per tuple; not owned. Null: all samples get
  /// NullValue.
  const void* Values = nullptr;
  void* Samples = nullptr;       ///< Components per sample; not owned
  Scalar Type = Scalar::Float64; ///< type of Values and of Samples
  int Components = 1;            ///< components per tuple
  bool OfCells = false;          ///< whether Values are per cell; otherwise per point
  double NullValue = 0;          ///< value of samples outside of all cells
};

} // namespace tipp

#endif
