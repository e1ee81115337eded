// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstraintTable_h
#define tippConstraintTable_h

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Segments and polygons as a file gives them.
struct ConstraintTable
{
  std::vector<double> XY;     ///< the file's own points; none: ids are of the points to triangulate
  std::vector<double> Height; ///< of its own points, where the file has three coordinates
  std::vector<std::array<std::int64_t, 2>> Edges; ///< point ids
  std::size_t PolygonBegin = 0; ///< edges from here on are those of closed polygons
  std::vector<double> Holes;    ///< x and y of points in holes
};

} // namespace tipp

#endif
