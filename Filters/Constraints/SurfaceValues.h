// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSurfaceValues_h
#define tippSurfaceValues_h

#include "Arrays/Scalar.h"
#include "Constraints/ResolveCrossings.h"
#include "Constraints/SegmentTree.h"
#include "Predicates/ExactPredicates.h"
#include "Triangulation/PointsView.h"
#include "Triangulation/Triangulation.h"
#include "vtkTIPPFiltersModule.h"

#include <array>
#include <cstddef>
#include <vector>

namespace tipp
{

/// Sets the tuples of new points, which follow the first `points` tuples of an array, to
/// valueOf(newPoint, valueAt) for each component; valueAt(id) is its value at an earlier point.
/// Integers are rounded.
template <typename NewPoints, typename ValueOf>
void appendTuples(const NewPoints& newPoints, std::size_t points, Scalar type,
  std::size_t components, void* values, const ValueOf& valueOf)
{
  withScalar(type,
    [&](auto kind)
    {
      using Value = decltype(kind);
      auto* const tuples = static_cast<Value*>(values);
      Value* to = tuples + points * components;
      for (const auto& point : newPoints)
      {
        for (std::size_t c = 0; c < components; ++c)
        {
          *to++ = roundedLikeVtk<Value>(valueOf(
            point, [&](PointId id) { return double(tuples[std::size_t(id) * components + c]); }));
        }
      }
    });
}

/// Sets the tuples of the crossings, which follow the first `points` tuples of an array. A
/// crossing's value is linear between the two points that it lies between. Integers are rounded.
void interpolateTuples(const std::vector<CrossingPoint>& crossings, std::size_t points, Scalar type,
  std::size_t components, void* values);

/// The positions of a triangle's corners. `ids` has three per triangle.
template <typename Id>
std::array<Point2, 3> cornersOf(PointsView points, const Id* ids, std::size_t triangle)
{
  const Id* const corners = ids + 3 * triangle;
  return { points[std::size_t(corners[0])], points[std::size_t(corners[1])],
    points[std::size_t(corners[2])] };
}

/// A triangle of a surface with its corners sorted by coordinates, so that values do not depend on
/// the order of corners.
struct SurfaceTriangle
{
  explicit SurfaceTriangle(const std::array<Point2, 3>& corners);

  std::array<Point2, 3> Corners;
  std::array<std::size_t, 3> Order{ 0, 1, 2 }; ///< index of each corner among the given ones

  /// If several triangles contain a position, the first one in this order gives the value.
  bool isBefore(const SurfaceTriangle& other) const;

  /// The value at a position, linear in the triangle. valueOf(i) is the value at the given corner
  /// i.
  template <typename ValueOf>
  double valueAt(Point2 position, const ValueOf& valueOf) const
  {
    const std::array<double, 3> weights = this->weightsAt(position);
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i)
    {
      // A corner with weight 0 may have the value NaN, which must not count.
      sum += weights[i] > 0 ? weights[i] * valueOf(this->Order[i]) : 0;
    }
    return sum;
  }

  /// The barycentric weights of the sorted corners at a position in the triangle.
  std::array<double, 3> weightsAt(Point2 position) const;
};

/// Positions on a triangulated surface whose values are requested.
class VTKTIPPFILTERS_EXPORT SurfacePositions
{
public:
  /// Positions that are not finite are in no triangle.
  explicit SurfacePositions(const std::vector<Point2>& positions);

  /// Calls visit(index, position) for the positions inside a counter-clockwise triangle or on its
  /// border.
  template <typename Visit>
  void visitInside(const std::array<Point2, 3>& p, const Visit& visit) const
  {
    Box2 box = Box2::of(p[0], p[1]);
    box.extend(p[2]);
    this->Tree.visitNear(box,
      [&](const SegmentTree::Item& item)
      {
        if (orientation(p[0], p[1], item.A) >= 0 && orientation(p[1], p[2], item.A) >= 0 &&
          orientation(p[2], p[0], item.A) >= 0)
        {
          visit(std::size_t(item.Id), item.A);
        }
        return true;
      });
  }

  /// Whether a position may be in the box.
  bool meets(const Box2& box) const;

private:
  SegmentTree Tree;
};

/// The values of each column at positions on the surface of `points`; NaN outside it. `columns` has
/// the values of each column at the points.
std::vector<std::vector<double>> valuesOnSurface(const std::vector<Point2>& positions,
  PointsView points, const Triangulation& triangles, const std::vector<const double*>& columns,
  int threads);

} // namespace tipp

#endif
