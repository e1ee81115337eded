// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangleLocator_h
#define tippTriangleLocator_h

#include "Triangulation/PointsView.h"
#include "vtkTIPPFiltersModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Finds the triangle of a Delaunay triangulation that contains a point, exactly: a grid gives a
/// triangle nearby, and a walk from there crosses each edge that the point lies beyond. In a
/// Delaunay triangulation this walk terminates.
class VTKTIPPFILTERS_EXPORT TriangleLocator
{
public:
  /// `corners` has three point indices per triangle; `neighbors` has for each corner the triangle
  /// across the opposite edge, or -1. The arrays are referenced, not copied.
  TriangleLocator(PointsView points, const std::int32_t* corners, const std::int32_t* neighbors,
    std::size_t triangles);

  /// Returns the index of a triangle that contains the point (closed), or -1 if the point is
  /// outside or not finite.
  std::int64_t find(Point2 point) const;

  /// Computes the point's barycentric coordinates in a triangle.
  void weights(std::int64_t triangle, Point2 point, double (&weights)[3]) const;

  const std::int32_t* corners(std::int64_t triangle) const { return this->Corners + 3 * triangle; }

private:
  std::size_t cellOf(Point2 point) const;
  std::array<Point2, 3> cornersOf(std::int64_t triangle) const;

  PointsView Points;
  const std::int32_t* Corners;
  const std::int32_t* Neighbors;
  std::size_t Side = 1; ///< the grid has Side x Side cells
  Point2 Low{ 0, 0 };
  Point2 PerUnit{ 0, 0 };           ///< grid cells per unit of length
  std::vector<std::int32_t> Nearby; ///< by grid cell: a triangle near it; empty without triangles
};

} // namespace tipp

#endif
