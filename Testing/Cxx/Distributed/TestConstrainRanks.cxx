// SPDX-License-Identifier: BSD-3-Clause
// Constraints on several ranks give the triangles of one process.
#include "Constraints/ConstraintEdges.h"
#include "Constraints/Insertion/KeepInside.h"
#include "Constraints/ResolveCrossings.h"
#include "DistributedTesting.h"

#include "Comparison.h"
#include "Constraints/Insertion/TriangulateConstrained.h"

#include <cmath>
#include <random>

namespace
{

using namespace tipp;
using namespace tipp::test;

/// Points and segments without crossings: all end points and crossings are among the points.
struct Case
{
  Coordinates XY;
  std::vector<ConstraintSegment> Segments;
  Triangles Expected;
};

Case makeCase(Coordinates xy, const std::vector<Constraint>& constraints, std::size_t polygonBegin)
{
  Case result;
  const ConstrainedTriangulation whole =
    triangulateConstrained(view(xy), constraints, CrossingRule::Split, {},
      [&](ConstrainedTriangulation& all, PointsView)
      {
        const std::vector<IdSegment>& segments = all.Constraints.Segments;
        const auto polygons = segmentsOf(segments, polygonBegin, constraints.size());
        keepInside({}, all.Mesh, segments, { polygons, {}, {} });
      });
  result.Expected = trianglesOf(whole.Mesh);
  for (const CrossingPoint& crossing : whole.Constraints.Crossings)
  {
    xy.insert(xy.end(), { crossing.Position.x, crossing.Position.y });
  }
  const auto at = [&xy](std::int64_t id) {
    return Point2{ xy[2 * std::size_t(id)], xy[2 * std::size_t(id) + 1] };
  };
  for (const IdSegment& segment : whole.Constraints.Segments)
  {
    result.Segments.push_back({ at(segment.A), at(segment.B),
      std::size_t(segment.Constraint) >= polygonBegin ? SegmentRole::Polygon : SegmentRole::Line });
  }
  result.XY = std::move(xy);
  return result;
}

std::vector<Constraint> randomConstraints(std::size_t points, int count)
{
  std::mt19937_64 random(5);
  std::vector<Constraint> constraints;
  for (int i = 0; i < count; ++i)
  {
    constraints.push_back({ std::int64_t(random() % points), std::int64_t(random() % points) });
  }
  return constraints;
}

void expectSame(const Case& expected)
{
  const ConstraintSegments segments(expected.Segments);
  for (const Share share : { Share::Blocks, Share::RoundRobin, Share::Uneven })
  {
    for (const int threads : { 1, 3 })
    {
      DistributedOptions options;
      options.Threads = threads;
      options.Minor = { 5, 5 };
      options.MinorDivision = Division::Grid;
      const Gathered result = triangulateShares(expected.XY, share, options, &segments);
      if (rank() == 0)
      {
        EXPECT_TRUE(result.Faults.empty()) << result.Faults.front();
        EXPECT_TRUE(sameTriangles(expected.XY, result.Mesh, expected.Expected)) << nameOf(share);
      }
    }
  }
}

class ConstrainRanks : public testing::TestWithParam<std::string>
{
};

TEST_P(ConstrainRanks, MakesTheTrianglesOfOneProcess)
{
  const Coordinates xy = makePointSet(GetParam(), 1500);
  for (const int count : { 2, 40 })
  {
    const auto constraints = randomConstraints(xy.size() / 2, count);
    expectSame(makeCase(xy, constraints, constraints.size()));
  }
}

INSTANTIATE_TEST_SUITE_P(PointSets, ConstrainRanks,
  testing::Values("uniform", "clustered", "lattice", "duplicates", "cocircular", "tiny-1e-300",
    "one-far-away", "circle", "with-rejected"));

TEST(ConstrainRanksTo, PolygonsKeepTheTrianglesOfOneProcess)
{
  Coordinates xy = makePointSet("uniform", 2000);
  std::vector<Constraint> constraints = randomConstraints(2000, 5);
  const std::size_t polygonBegin = constraints.size();
  constexpr double pi = 3.14159265358979323846;
  for (const int corners : { 11, -7 })
  {
    const auto first = std::int64_t(xy.size() / 2);
    const int count = std::abs(corners); // negative for clockwise
    for (int i = 0; i < count; ++i)
    {
      const double angle = 2 * pi * i / corners;
      const double radius = corners > 0 ? 0.4 : 0.2;
      xy.insert(xy.end(), { 0.5 + radius * std::cos(angle), 0.5 + radius * std::sin(angle) });
      constraints.push_back({ first + i, first + (i + 1) % count });
    }
  }
  expectSame(makeCase(std::move(xy), constraints, polygonBegin));
}

} // namespace
