// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDimension_h
#define tippDimension_h

#include "Kernel/DelaunayKernel.h"
#include "Kernel/DelaunayKernel3.h"
#include "Predicates/Circumball.h"
#include "Predicates/ExactPredicates.h"
#include "Predicates/ExactPredicates3.h"
#include "Predicates/Geometry.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

namespace tipp
{

/// What the dataflow needs to know of D dimensions: of triangles in the plane (2), or of tetrahedra
/// in space (3).
template <int D>
struct Dimension;

template <>
struct Dimension<2>
{
  using Kernel = DelaunayKernel;
  using Ball = Circumdisk; ///< through the corners of a cell

  /// Replaces the kernel's triangulation by that of `points`.
  static void triangulate(Kernel& kernel, const std::vector<Point2>& points)
  {
    kernel.clear();
    kernel.insert(points.data(), points.size());
  }
  /// Returns whether a cell with these corners cannot remain if p is added.
  static bool isInConflict(const std::array<Point2, 3>& corners, Point2 p)
  {
    return inCirclePerturbed(corners[0], corners[1], corners[2], p);
  }
  /// Returns whether a cell with these corners and a box share a point; both are closed.
  static bool meetsBox(const std::array<Point2, 3>& corners, const Box2& box)
  {
    return triangleMeetsBox(corners[0], corners[1], corners[2], inSpace(box));
  }
};

template <>
struct Dimension<3>
{
  using Kernel = DelaunayKernel3;
  using Ball = Circumball;

  static void triangulate(Kernel& kernel, const std::vector<Point3>& points)
  {
    kernel.triangulate(points.data(), points.size());
  }
  static bool isInConflict(const std::array<Point3, 4>& corners, const Point3& p)
  {
    return inSpherePerturbed(corners[0], corners[1], corners[2], corners[3], p);
  }
  static bool meetsBox(const std::array<Point3, 4>& corners, const Box3& box)
  {
    return tetrahedronMeetsBox(corners[0], corners[1], corners[2], corners[3], box);
  }
};

/// Returns the positions of a finite cell's corners.
template <int D>
std::array<Point<D>, D + 1> cornersOf(
  const typename Dimension<D>::Kernel& kernel, typename Dimension<D>::Kernel::Index cell)
{
  std::array<Point<D>, D + 1> corners;
  const auto vertices = kernel.corners(cell);
  std::transform(vertices.begin(), vertices.end(), corners.begin(),
    [&kernel](auto vertex) { return kernel.point(vertex); });
  return corners;
}

/// Returns the input indices of a finite cell's corners.
template <typename Kernel>
auto pointIndicesOf(const Kernel& kernel, typename Kernel::Index cell)
{
  const auto vertices = kernel.corners(cell);
  std::array<std::uint32_t, std::tuple_size_v<decltype(kernel.corners(cell))>> indices{};
  std::transform(vertices.begin(), vertices.end(), indices.begin(),
    [&kernel](auto vertex) { return kernel.pointIndex(vertex); });
  return indices;
}

/// Returns the disk or ball through corners in positive orientation.
template <int D>
typename Dimension<D>::Ball ballOf(const std::array<Point<D>, D + 1>& corners)
{
  return std::apply(
    [](const auto&... corner) { return typename Dimension<D>::Ball(corner...); }, corners);
}

} // namespace tipp

#endif
