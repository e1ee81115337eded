// SPDX-License-Identifier: BSD-3-Clause
// Many constraints among many points, compared with CGAL's constrained triangulation.
#include "Comparison.h"
#include "ConstrainedOracle.h"

#include "Predicates/ExactPredicates.h"
#include "Triangulation/TriangleSink.h"

#include <algorithm>
#include <random>
#include <set>

namespace
{

using namespace tipp;
using namespace tipp::test;

/// Returns each `every`-th edge of the Delaunay triangulation of each `step`-th point. These
/// segments do not cross, and many are long.
std::vector<Constraint> sparseEdges(const Coordinates& xy, std::size_t step, std::size_t every)
{
  Ids ids;
  const Reference all = reference(xy);
  for (std::size_t i = 0; i < xy.size() / 2; i += step)
  {
    if (all.Representative[i] == std::int64_t(i))
    {
      ids.push_back(std::int64_t(i));
    }
  }
  std::vector<Constraint> edges;
  std::size_t count = 0;
  for (const Triangle& t : delaunay(xy, ids))
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      if (t[i] < t[(i + 1) % 3] && count++ % every == 0)
      {
        edges.push_back({ t[i], t[(i + 1) % 3] });
      }
    }
  }
  return edges;
}

class ConstrainedSets : public testing::TestWithParam<std::string>
{
};

TEST_P(ConstrainedSets, EqualTheOracleForEveryDensity)
{
  const Coordinates xy = makePointSet(GetParam(), 3000);
  for (const std::size_t step : { 2, 7, 60, 500 })
  {
    const std::vector<Constraint> constraints = sparseEdges(xy, step, 1 + step % 3);
    EXPECT_TRUE(isConstrained(xy, constraints, triangulateConstrained(view(xy), constraints)))
      << step;
  }
}

TEST_P(ConstrainedSets, AreTheSameForPartitionsAndThreads)
{
  const Coordinates xy = makePointSet(GetParam(), 3000);
  std::vector<Constraint> constraints = sparseEdges(xy, 11, 2);
  const Triangles expected = trianglesOf(triangulateConstrained(view(xy), constraints).Mesh);
  std::mt19937_64 random(1);
  for (const int side : { 1, 2, 5, 9 })
  {
    for (const int threads : { 1, 2, 3 })
    {
      TriangulationOptions options;
      options.Columns = options.Rows = side;
      options.Threads = threads;
      std::shuffle(constraints.begin(), constraints.end(), random);
      const ConstrainedTriangulation result =
        triangulateConstrained(view(xy), constraints, CrossingRule::Split, options);
      EXPECT_TRUE(sameTriangles(xy, trianglesOf(result.Mesh), expected)) << describe(options);
    }
  }
}

TEST_P(ConstrainedSets, AreSplitAtCrossings)
{
  const Coordinates xy = makePointSet(GetParam(), 600);
  const std::size_t points = xy.size() / 2;
  std::mt19937_64 random(3);
  std::vector<Constraint> constraints;
  for (int i = 0; i < 40; ++i)
  {
    constraints.push_back({ std::int64_t(random() % points), std::int64_t(random() % points) });
  }
  EXPECT_TRUE(isConstrained(xy, constraints, triangulateConstrained(view(xy), constraints)));
}

INSTANTIATE_TEST_SUITE_P(PointSets, ConstrainedSets,
  testing::Values("uniform", "clustered", "lattice", "lattice-tenths", "cocircular", "denormal",
    "tiny-1e-300", "huge-1e300", "steps-at-1e12", "duplicates", "survey-lines", "one-far-away",
    "parabola"),
  [](const auto& info)
  {
    std::string name = info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
  });

TEST(Constrain, InsertsLongSegmentsAcrossTheDomain)
{
  Coordinates xy = makePointSet("uniform", 30000);
  xy.insert(xy.end(), { -0.1, 0.3, 1.1, 0.7, -0.1, 0.31, 1.1, 0.72, -0.1, 0.9, 1.1, 0.9 });
  const std::int64_t n = 30000;
  const std::vector<Constraint> constraints{ { n, n + 1 }, { n + 2, n + 3 }, { n + 4, n + 5 } };
  TriangulationOptions options;
  options.Columns = options.Rows = 6;
  EXPECT_TRUE(isConstrained(
    xy, constraints, triangulateConstrained(view(xy), constraints, CrossingRule::Split, options)));
}

/// Long triangles are removed after the constraints have been inserted, not before.
TEST(Constrain, RemovesLongTrianglesAfterInsertingConstraints)
{
  Coordinates xy = makePointSet("uniform", 2000);
  xy.insert(xy.end(), { -0.1, 0.3, 1.1, 0.7 });
  const std::vector<Constraint> constraints{ { 2000, 2001 } };
  TriangulationOptions options;
  options.Columns = options.Rows = 3;
  const auto all = triangulateConstrained(view(xy), constraints, CrossingRule::Split, options).Mesh;
  constexpr double longest = 0.04;
  const auto isLong = [&xy](const Triangle& t)
  {
    const auto at = [&xy](std::int64_t id) {
      return Point2{ xy[2 * std::size_t(id)], xy[2 * std::size_t(id) + 1] };
    };
    return hasLongEdge(at(t[0]), at(t[1]), at(t[2]), longest);
  };
  Triangles expected = trianglesOf(all);
  expected.erase(std::remove_if(expected.begin(), expected.end(), isLong), expected.end());
  options.MaximumEdge = longest;
  const auto some =
    triangulateConstrained(view(xy), constraints, CrossingRule::Split, options).Mesh;
  ASSERT_LT(expected.size(), all.triangleCount());
  EXPECT_TRUE(sameTriangles(xy, trianglesOf(some), expected));
}

/// The ids must be equal byte for byte, including the order of triangles.
TEST(Constrain, OrdersTrianglesTheSameForAllThreads)
{
  const Coordinates xy = makePointSet("clustered", 20000);
  const std::vector<Constraint> constraints = sparseEdges(xy, 9, 1);
  TriangulationOptions options;
  options.Columns = options.Rows = 4;
  options.Threads = 1;
  const auto one = triangulateConstrained(view(xy), constraints, CrossingRule::Split, options);
  options.Threads = 4;
  const auto four = triangulateConstrained(view(xy), constraints, CrossingRule::Split, options);
  EXPECT_TRUE(std::equal(
    one.Mesh.Ids32.begin(), one.Mesh.Ids32.end(), four.Mesh.Ids32.begin(), four.Mesh.Ids32.end()));
}

TEST(Constrain, NestedPolygonsMayTouchAtPoints)
{
  Coordinates xy = makePointSet("uniform", 4000);
  std::vector<Constraint> constraints;
  const std::int64_t first = 4000;
  // Nested squares: the corners of each lie at the middles of the sides of the next larger one.
  double corners[4][2] = { { 0.1, 0.1 }, { 0.9, 0.1 }, { 0.9, 0.9 }, { 0.1, 0.9 } };
  for (std::int64_t depth = 0; depth < 6; ++depth)
  {
    double middles[4][2];
    for (int i = 0; i < 4; ++i)
    {
      xy.insert(xy.end(), { corners[i][0], corners[i][1] });
      constraints.push_back({ first + 4 * depth + i, first + 4 * depth + (i + 1) % 4 });
      for (int axis = 0; axis < 2; ++axis)
      {
        middles[i][axis] = (corners[i][axis] + corners[(i + 1) % 4][axis]) / 2;
      }
    }
    std::copy(&middles[0][0], &middles[0][0] + 8, &corners[0][0]);
  }
  EXPECT_TRUE(isConstrained(xy, constraints, triangulateConstrained(view(xy), constraints)));
}

} // namespace
