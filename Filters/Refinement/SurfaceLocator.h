// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSurfaceLocator_h
#define tippSurfaceLocator_h

#include "Arrays/Buffer.h"
#include "Arrays/Scalar.h"
#include "Constraints/ConstraintEdges.h"
#include "Locate/BoxTree.h"
#include "Predicates/Geometry.h"
#include "Triangulation/PointsView.h"
#include "vtkTIPPFiltersModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// A mean of the values of up to three points. Unused places have the weight 0 and a valid id.
struct PointBlend
{
  std::array<PointId, 3> Ids;
  std::array<double, 3> Weights; ///< at least 0; their sum is 1, up to rounding

  /// The mean of valueOf(id). Equal values are kept exactly, and points of weight 0 do not count,
  /// even if their value is NaN.
  template <typename ValueOf>
  double valueOf(const ValueOf& valueOf) const
  {
    std::size_t main = 0; // has the largest weight
    main = this->Weights[1] > this->Weights[main] ? 1 : main;
    main = this->Weights[2] > this->Weights[main] ? 2 : main;
    const double base = valueOf(this->Ids[main]);
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i)
    {
      sum +=
        i == main || this->Weights[i] == 0 ? 0 : this->Weights[i] * (valueOf(this->Ids[i]) - base);
    }
    return base + sum;
  }
};

/// Sets the tuples of new points, which follow the first `points` tuples of an array, to means of
/// tuples before them. Integers are rounded.
VTKTIPPFILTERS_EXPORT void blendTuples(const Buffer<PointBlend>& blends, std::size_t points,
  Scalar type, std::size_t components, void* values);

/// Finds positions on a triangulated surface over the plane. The triangles may have either
/// orientation and any holes. Where several contain a position, the first one by its corners'
/// coordinates is used, so that results depend on neither ids nor order. Several threads may
/// search at once.
class VTKTIPPFILTERS_EXPORT SurfaceLocator
{
public:
  /// `corners` has three point ids per triangle. The arrays are referenced, not copied.
  SurfaceLocator(
    PointsView points, const std::int32_t* corners, std::int64_t triangles, int threads);

  /// Returns false if the position is in no triangle, else sets `blend`, which is linear in each
  /// triangle.
  bool find(Point2 position, PointBlend& blend) const;

  /// As find(), but a position outside is taken to be in a triangle near it. There must be one.
  PointBlend findNear(Point2 position) const;

private:
  std::array<Point2, 3> cornersOf(std::int64_t triangle) const;
  PointBlend blendAt(std::int64_t triangle, Point2 position) const;

  PointsView Points;
  const std::int32_t* Corners;
  BoxTree<2> Tree;
};

} // namespace tipp

#endif
