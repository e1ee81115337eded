// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippScheduleTesting_h
#define tippScheduleTesting_h

#include "Comparison.h"

#include "Predicates/ExactPredicates.h"
#include "Triangulation/BoundaryCells.h"
#include "Triangulation/PointBuckets.h"
#include "Triangulation/PointsView.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{
namespace test
{

/// The two sizes of ids that typed tests run with.
using IdTypes = testing::Types<std::int32_t, std::int64_t>;
struct IdNames
{
  template <typename Id>
  static std::string GetName(int)
  {
    return "Int" + std::to_string(8 * sizeof(Id));
  }
};

inline std::vector<Point2> asPoints(const Coordinates& xy)
{
  std::vector<Point2> points;
  for (std::size_t i = 0; i + 1 < xy.size(); i += 2)
  {
    points.push_back({ xy[i], xy[i + 1] });
  }
  return points;
}

inline Box2 boundsOf(const Coordinates& xy)
{
  return surveyPoints(view(xy), 1).Bounds;
}

/// A boundary triangle with vertices in the partitions a, b and c.
inline BoundaryTriangle boundaryTriangle(
  std::int64_t id, PartitionIndex a, PartitionIndex b, PartitionIndex c)
{
  return { BoundaryVertex{ { 0, 0 }, id, a }, BoundaryVertex{ { 1, 0 }, id + 1, b },
    BoundaryVertex{ { 0, 1 }, id + 2, c } };
}

inline std::vector<BoundaryTriangle> listOf(const BoundaryTriangles& boundary)
{
  std::vector<BoundaryTriangle> list;
  for (std::size_t i = 0; i < boundary.size(); ++i)
  {
    list.push_back(boundary[i]);
  }
  return list;
}

inline Triangles idsOf(const std::vector<BoundaryTriangle>& boundary)
{
  Triangles triangles;
  for (const BoundaryTriangle& t : boundary)
  {
    triangles.push_back(canonical(t[0].Id, t[1].Id, t[2].Id));
  }
  return sorted(std::move(triangles));
}

} // namespace test
} // namespace tipp

#endif
