// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellLocation_h
#define tippCellLocation_h

#include <cstdint>

namespace tipp
{

/// Where a point lies in a mesh of triangles or tetrahedra.
struct CellLocation
{
  std::int64_t Cell = -1; ///< index of the cell; -1: outside
  /// Barycentric weights of the cell's corners; zeros outside. Up to rounding they sum to 1 and are
  /// not negative. Triangles use the first three.
  double Weights[4] = {};
};

} // namespace tipp

#endif
