// SPDX-License-Identifier: BSD-3-Clause
// The sweep makes the triangles of CGAL and of the kernel, and keeps only its front in memory.
#include "KernelTesting.h"

#include "SweepKernel.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace
{

using namespace tipp;
using namespace tipp::test;

struct Swept
{
  Triangles Made; ///< a triangle that was reported twice is here twice
  std::vector<SweepKernel::Duplicate> Duplicates;
  std::size_t Strips = 0;
  std::size_t Carried = 0;
};

Swept sweep(const std::vector<Point2>& points, std::size_t pointsInStrip)
{
  Swept swept;
  SweepKernel kernel(pointsInStrip);
  kernel.triangulate(points.data(), points.size(),
    [&](const std::vector<SweepKernel::Triangle>& triangles)
    {
      ++swept.Strips;
      for (const SweepKernel::Triangle& t : triangles)
      {
        swept.Made.push_back(canonical(t[0], t[1], t[2]));
      }
    });
  swept.Made = sorted(std::move(swept.Made));
  swept.Duplicates = kernel.duplicates();
  swept.Carried = kernel.carried();
  return swept;
}

/// For each distinct position, the first point there.
Ids firstOfPlaces(const std::vector<Point2>& points)
{
  std::map<std::pair<double, double>, std::int64_t> first;
  Ids ids;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (first.emplace(std::make_pair(points[i].x, points[i].y), std::int64_t(i)).second)
    {
      ids.push_back(std::int64_t(i));
    }
  }
  return ids;
}

class Sweep : public testing::TestWithParam<std::string>
{
};

TEST_P(Sweep, MakesCgalsTrianglesOnceForStripsOfAnySize)
{
  const std::vector<Point2> points = pointSet(GetParam(), 2000);
  const Coordinates xy = asCoordinates(points);
  const Triangles expected = delaunay(xy, firstOfPlaces(points));
  for (const std::size_t strip : { 1, 7, 60, 400, 5000 })
  {
    ASSERT_TRUE(sameTriangles(xy, sweep(points, strip).Made, expected)) << strip;
  }
}

INSTANTIATE_TEST_SUITE_P(PointSets, Sweep,
  testing::Values("uniform", "clustered", "kuzmin", "lattice", "lattice-shuffled", "coast",
    "lattice-tenths", "lattice-jittered", "circle", "cocircular", "collinear-and-one",
    "survey-lines", "duplicates", "duplicate-lattice", "tiny-1e-300", "denormal", "negative",
    "steps-at-1e12", "one-far-away", "two-clusters", "parabola", "spiral", "sorted"),
  [](const auto& info)
  {
    std::string name = info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
  });

TEST(SweepKernel, MakesTheKernelsTriangles)
{
  const std::vector<Point2> points = pointSet("uniform", 60000);
  DelaunayKernel kernel;
  insert(kernel, points);
  const Swept swept = sweep(points, 0);
  EXPECT_LT(3U, swept.Strips);
  EXPECT_TRUE(sameTriangles(asCoordinates(points), swept.Made, finiteTriangles(kernel)));
}

TEST(SweepKernel, TheFrontGrowsWithTheSquareRootOfThePoints)
{
  constexpr std::size_t count = 40000;
  const Swept swept = sweep(pointSet("uniform", count), 2000);
  EXPECT_LT(double(swept.Carried), 4 * std::sqrt(double(count)) * double(swept.Strips));
}

TEST(SweepKernel, ReportsTheFirstOfEqualPointsAsRepresentative)
{
  const std::vector<Point2> points = pointSet("duplicates", 3000);
  const Ids first = firstOfPlaces(points);
  const Swept swept = sweep(points, 100);
  EXPECT_EQ(points.size() - first.size(), swept.Duplicates.size());
  for (const SweepKernel::Duplicate& duplicate : swept.Duplicates)
  {
    ASSERT_TRUE(points[duplicate.Point] == points[duplicate.Representative]);
    ASSERT_TRUE(
      std::binary_search(first.begin(), first.end(), std::int64_t(duplicate.Representative)));
  }
}

TEST(SweepKernel, WaitsForAPointOffTheLine)
{
  for (const bool isVertical : { false, true })
  {
    std::vector<Point2> points;
    for (int i = 0; i < 100; ++i)
    {
      points.push_back(isVertical ? Point2{ 0, double(i) } : Point2{ double(i), double(i) });
    }
    EXPECT_TRUE(sweep(points, 10).Made.empty());
    points.push_back({ 200, 0 });
    EXPECT_EQ(99U, sweep(points, 10).Made.size());
  }
  EXPECT_TRUE(sweep({}, 10).Made.empty());
  EXPECT_TRUE(sweep({ { 1, 2 } }, 10).Made.empty());
}

TEST(SweepStrips, OrderPointsFromLeftToRight)
{
  const std::vector<Point2> points = pointSet("clustered", 5000);
  const SweepStrips strips(points.data(), points.size(), 300);
  EXPECT_LT(10U, strips.size());
  std::vector<std::uint32_t> all = strips.order();
  for (std::size_t strip = 0; strip < strips.size(); ++strip)
  {
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      const Point2 p = points[all[i]];
      const Box2 box = strips.boxFrom(strip);
      const bool isHeld =
        box.Min.x <= p.x && p.x <= box.Max.x && box.Min.y <= p.y && p.y <= box.Max.y;
      ASSERT_EQ(i >= strips.start(strip), isHeld);
    }
  }
  std::sort(all.begin(), all.end());
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    ASSERT_EQ(i, all[i]);
  }
}

TEST(SweepStrips, PointsWithEqualXAreInOneStrip)
{
  const std::vector<Point2> points = pointSet("lattice", 900);
  const SweepStrips strips(points.data(), points.size(), 10);
  EXPECT_EQ(31U, strips.size()); // the first one is empty: it ends at the least x
}

} // namespace
