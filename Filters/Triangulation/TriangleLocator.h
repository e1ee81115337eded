// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangleLocator_h
#define tippTriangleLocator_h

#include "Triangulation/PointsView.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Finds the triangle of a Delaunay triangulation that contains a point, exactly: a grid knows a
/// triangle near by, and from there a walk crosses each edge that the point lies beyond. On
/// Delaunay triangulations such a walk ends.
template <typename Id>
class TriangleLocator
{
public:
  /// Three corners a triangle, and for each corner the neighbour over the opposite edge, or -1. All
  /// of it is referred to, not copied.
  TriangleLocator(PointsView points, const Id* corners, const Id* neighbors, std::size_t triangles);

  /// The triangle that the point is in or on, or -1 if it is outside or not finite.
  std::int64_t find(Point2 point) const;

  /// Of a triangle's corners, whose weighted sum the point is.
  void weights(std::int64_t triangle, Point2 point, double (&weights)[3]) const;

  const Id* corners(std::int64_t triangle) const { return this->Corners + 3 * triangle; }

private:
  std::size_t column(double x) const;
  std::size_t row(double y) const;

  PointsView Points;
  const Id* Corners;
  const Id* Neighbors;
  std::size_t Side = 1; ///< columns, and rows, of the grid
  Point2 Low{ 0, 0 };
  Point2 PerUnit{ 0, 0 }; ///< grid cells for a unit of length
  std::vector<Id> Nearby; ///< a triangle for each cell of the grid; empty without triangles
};

extern template class TriangleLocator<std::int32_t>;
extern template class TriangleLocator<std::int64_t>;

} // namespace tipp

#endif
