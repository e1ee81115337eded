// SPDX-License-Identifier: BSD-3-Clause
#include "RefinementTesting.h"

#include "RealData.h"
#include "TemporaryFolder.h"

#include "Files/PagedMemory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;
using Reason = TriangleOutside::Reason;

constexpr double pi = 3.14159265358979323846;

LineGraph square()
{
  LineGraph graph;
  graph.addRectangle(0, 0, 1, 1);
  return graph;
}

/// Segments of different lengths from a point, at equal angles, in a square.
LineGraph fan(double degrees)
{
  LineGraph graph;
  graph.addPoint(0.013, 0.007);
  for (int i = 0; i * degrees < 350 && i < 8; ++i)
  {
    const double angle = (3.3 + i * degrees) * pi / 180;
    const double length = 1 + 0.37 * std::sin(7.1 * i);
    graph.addPoint(0.013 + length * std::cos(angle), 0.007 + length * std::sin(angle));
    graph.addSegment(0, graph.points() - 1);
  }
  graph.addRectangle(-2, -2, 2, 2);
  return graph;
}

/// Narrow teeth in a box, none of which touches it.
LineGraph comb()
{
  LineGraph graph;
  for (int i = 0; i < 40; ++i)
  {
    graph.addPoint(i * 0.05, 0);
    graph.addPoint(i * 0.05 + 0.001 * (i + 1) / 40, 1);
    graph.addSegment(2 * i, 2 * i + 1);
  }
  graph.addRectangle(-1, -1, 3, 2);
  return graph;
}

LineGraph spiral()
{
  LineGraph graph;
  for (int i = 0; i < 300; ++i)
  {
    const double angle = i * 0.1;
    graph.addPoint(0.02 * angle * std::cos(angle), 0.02 * angle * std::sin(angle));
    if (i > 0)
    {
      graph.addSegment(i - 1, i);
    }
  }
  graph.addRectangle(-1, -1, 1, 1);
  return graph;
}

/// Random points and segments between some of them, which cross.
LineGraph randomGraph(std::uint64_t seed, int points, int segments)
{
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(0, 1);
  LineGraph graph;
  for (int i = 0; i < points; ++i)
  {
    graph.addPoint(place(random), place(random));
  }
  for (int i = 0; i < segments; ++i)
  {
    graph.addSegment(
      PointId(random() % std::uint64_t(points)), PointId(random() % std::uint64_t(points)));
  }
  graph.addRectangle(-0.5, -0.5, 1.5, 1.5);
  return graph;
}

RefinementOptions withAngle(double angle, double area = std::numeric_limits<double>::infinity())
{
  RefinementOptions options;
  options.MinimumAngle = angle;
  options.LargestArea = area;
  options.IsEnclosed = true;
  options.Threads = 1;
  return options;
}

TEST(Refine, KeepsTheBoundOnAnglesAndAreas)
{
  const LineGraph graph = square();
  const Refined refined = refineGraph(graph, withAngle(30, 0.001));
  EXPECT_GT(refined.Mesh.triangleCount(), 1000U);
  EXPECT_LT(refined.Mesh.triangleCount(), 2500U);
  EXPECT_TRUE(refined.Mesh.Outside.empty());
  EXPECT_TRUE(isRight(graph, refined, "30", 0.001));
}

TEST(Refine, AddsNothingToAMeshThatIsGood)
{
  LineGraph graph;
  graph.addPoint(0, 0);
  graph.addPoint(1, 0);
  graph.addPoint(0.5, 0.8);
  graph.close(0);
  const Refined refined = refineGraph(graph, withAngle(30));
  EXPECT_EQ(refined.Mesh.AddedXY.size(), 0U);
  EXPECT_EQ(refined.Mesh.triangleCount(), 1U);
}

TEST(Refine, FansOfSharpAnglesAreListed)
{
  for (const double degrees : { 1., 5., 10., 20., 30., 45., 59. })
  {
    const LineGraph graph = fan(degrees);
    const Refined refined = refineGraph(graph, withAngle(30, 0.01));
    EXPECT_TRUE(isRight(graph, refined, "30", 0.01)) << degrees;
    for (const TriangleOutside& outside : refined.Mesh.Outside)
    {
      EXPECT_EQ(outside.Why, Reason::InputAngle) << degrees;
    }
    EXPECT_EQ(refined.Mesh.Outside.empty(), degrees > 40) << degrees;
  }
}

TEST(Refine, CombsAndSpiralsKeepTheirSegments)
{
  for (const double angle : { 20., 30., 33. })
  {
    for (const LineGraph& graph : { comb(), spiral() })
    {
      const Refined refined = refineGraph(graph, withAngle(angle));
      EXPECT_TRUE(isRight(graph, refined, std::to_string(int(angle)))) << angle;
    }
  }
}

TEST(Refine, SplitPointsAreInTheBoxOfTheirSegment)
{
  LineGraph graph; // the ends of segment 1 have neighbouring doubles as x
  graph.addPoint(0.32812500000000006, 1.0 / 12);
  graph.addPoint(13.0 / 48, 0.203125);
  graph.addPoint(0.328125, -1.0 / 12);
  graph.addPoint(0.33854166666666663, 0);
  graph.addSegment(0, 1);
  graph.addSegment(0, 2);
  RefinementOptions options;
  options.MinimumAngle = 9;
  options.LargestArea = 1.0 / 288;
  options.ShortestEdge = 1.0 / 96;
  options.KeepsBorder = true;
  const Refined refined = refineGraph(graph, options);
  for (const IdSegment& segment : refined.Mesh.Segments)
  {
    if (segment.Constraint == 1)
    {
      EXPECT_GE(refined.XY[2 * std::size_t(segment.A)], 0.328125);
      EXPECT_GE(refined.XY[2 * std::size_t(segment.B)], 0.328125);
    }
  }
  EXPECT_TRUE(isRight(graph, refined, "9"));
}

TEST(Refine, SegmentsAtTheDistanceOfRoundingAreChains)
{
  LineGraph graph; // points 1 and 4 are neighbouring doubles
  graph.XY = { 0.92307692307692313, -0.38461538461538475, 0.59999999999999987, -0.80000000000000016,
    0.96923076923076956, -0.2461538461538462, -0.60000000000000009, -0.80000000000000016,
    0.6000000000000002, -0.80000000000000016 };
  graph.Segments = { { 2, 4 }, { 1, 2 }, { 3, 0 }, { 1, 3 }, { 0, 2 }, { 0, 4 } };
  RefinementOptions options;
  options.MinimumAngle = 5;
  options.ShortestEdge = 0.03;
  options.IsEnclosed = true;
  const Refined refined = refineGraph(graph, options);
  EXPECT_LT(3u, refined.Mesh.triangleCount());
  EXPECT_TRUE(isRight(graph, refined, "5"));
}

TEST(Refine, ASegmentMayEndBesideTheBorder)
{
  LineGraph graph; // a segment is outside of another one, at the border, by less than rounding
  graph.XY = { 0.003001, 0.001001, 0.001001, 1e-06, 0.005001, 0.002001, 0.001001, 0.001001,
    0.005001, 0.003001, 1e-06, 1e-06, 0.002001, 1e-06, 0.002001, 0.002001, 0.004001, 0.002001,
    0.002001, 0.001001, 0.003001, 1e-06, 0.004001, 0.001001, 0.003001, 0.002001 };
  graph.Segments = { { 1, 6 }, { 4, 8 }, { 10, 4 }, { 5, 0 }, { 0, 4 }, { 7, 10 }, { 6, 0 },
    { 10, 6 }, { 6, 2 } };
  RefinementOptions options;
  options.MinimumAngle = 14;
  options.LargestArea = 7.03125e-8;
  options.ShortestEdge = 0.003 / 256;
  options.IsEnclosed = true;
  const Refined refined = refineGraph(graph, options);
  EXPECT_LT(20u, refined.Mesh.triangleCount());
  EXPECT_TRUE(isRight(graph, refined, "14"));
}

TEST(Refine, PointsMayBeBesideACrossedBorder)
{
  LineGraph graph; // point 1 is outside of the segment from 2 to 4, which is bent at its crossings
  graph.XY = { 1.0 / 3 + 1.0 / 3000, 1.0 / 3000, 1.3336666666666666, 0.33366666666666667,
    0.66699999999999993, 0.00033333333333333332, 1.0003333333333333, 0.33366666666666667,
    3.3336666666666663, 1.3336666666666666, 3, 0.00033333333333333332, 2.3336666666666663,
    0.66699999999999993, 3.0003333333333333, 1.0003333333333333 };
  graph.Segments = { { 3, 5 }, { 5, 2 }, { 2, 6 }, { 0, 2 }, { 3, 7 }, { 2, 4 } };
  RefinementOptions options;
  options.MinimumAngle = 19;
  options.ShortestEdge = 0.0182292;
  options.IsEnclosed = true;
  const Refined refined = refineGraph(graph, options);
  EXPECT_LT(20u, refined.Mesh.triangleCount());
  EXPECT_TRUE(isRight(graph, refined, "19"));
}

TEST(Refine, CrossingSegmentsAreSplit)
{
  RefinementOptions options = withAngle(28);
  options.ShortestEdge = 1e-4; // crossings may be arbitrarily close together
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    const LineGraph graph = randomGraph(seed, 12, 8);
    EXPECT_TRUE(isRight(graph, refineGraph(graph, options), "28")) << seed;
  }
}

TEST(Refine, IsTheSameForAnyNumberOfThreads)
{
  for (const LineGraph& graph : { comb(), randomGraph(7, 30, 12) })
  {
    RefinementOptions options = withAngle(30, 0.00004); // several blocks and rounds
    options.ShortestEdge = 1e-4;
    const Refined one = refineGraph(graph, options);
    EXPECT_GT(one.Mesh.Statistics.Blocks, 10);
    for (const int threads : { 2, 3, 8 })
    {
      options.Threads = threads;
      EXPECT_TRUE(areSame(one, refineGraph(graph, options))) << threads;
    }
    EXPECT_TRUE(isRight(graph, one, "30", 0.00004));
  }
}

TEST(Refine, IsTheSameInPagedMemory)
{
  const TemporaryFolder folder;
  PagedMemory memory(folder.path("."), 1 << 20); // less than the program itself
  for (const LineGraph& graph : { comb(), spiral(), fan(20), randomGraph(7, 30, 12) })
  {
    RefinementOptions options = withAngle(30, 0.00004);
    options.ShortestEdge = 1e-4;
    const Refined inMemory = refineGraph(graph, options);
    options.Memory = &memory;
    for (const int threads : { 1, 2, 3, 4 })
    {
      options.Threads = threads;
      EXPECT_TRUE(areSame(inMemory, refineGraph(graph, options))) << threads;
    }
  }
}

TEST(Refine, HolesStayEmpty)
{
  LineGraph graph = square();
  graph.addRectangle(0.4, 0.4, 0.6, 0.6);
  const std::vector<Point2> holes{ { 0.5, 0.5 } };
  const Refined refined = refineGraph(graph, withAngle(30, 0.002), holes);
  EXPECT_TRUE(isRight(graph, refined, "30", 0.002, holes));
}

TEST(Refine, OnlyWhatSegmentsEncloseIsKept)
{
  LineGraph graph;
  graph.addPoint(0, 0);
  graph.addPoint(2, 0);
  graph.addPoint(2, 2);
  graph.addPoint(1, 0.5); // a dent
  graph.addPoint(0, 2);
  graph.close(0);
  const auto areaOf = [](const Refined& refined)
  {
    double area = 0;
    for (std::size_t t = 0; t < refined.Mesh.triangleCount(); ++t)
    {
      const std::int32_t* const v = refined.Mesh.Triangles.data() + 3 * t;
      const auto x = [&](int i) { return refined.XY[2 * std::size_t(v[i])]; };
      const auto y = [&](int i) { return refined.XY[2 * std::size_t(v[i]) + 1]; };
      area += ((x(1) - x(0)) * (y(2) - y(0)) - (x(2) - x(0)) * (y(1) - y(0))) / 2;
    }
    return area;
  };
  RefinementOptions options = withAngle(25);
  EXPECT_NEAR(areaOf(refineGraph(graph, options)), 2.5, 1e-12);
  options.IsEnclosed = false;
  EXPECT_NEAR(areaOf(refineGraph(graph, options)), 4, 1e-12);
}

TEST(Refine, RegionsHaveTheirAreas)
{
  LineGraph graph = square();
  graph.addPoint(0.5, 0);
  graph.addPoint(0.5, 1);
  graph.addSegment(4, 5);
  RefinementOptions options = withAngle(30, 0.01);
  options.Regions = { { { 0.25, 0.5 }, 0.0005 }, { { 0.75, 0.5 } } };
  const Refined refined = refineGraph(graph, options);
  ASSERT_EQ(refined.Mesh.RegionOf.size(), refined.Mesh.triangleCount());
  std::array<std::int64_t, 2> counts{};
  for (std::size_t t = 0; t < refined.Mesh.triangleCount(); ++t)
  {
    const std::int32_t* const v = refined.Mesh.Triangles.data() + 3 * t;
    double x = 0;
    for (int i = 0; i < 3; ++i)
    {
      x += refined.XY[2 * std::size_t(v[i])] / 3;
    }
    const std::int32_t region = refined.Mesh.RegionOf[t];
    ASSERT_EQ(region, x < 0.5 ? 0 : 1);
    ++counts[std::size_t(region)];
  }
  EXPECT_GT(counts[0], 1000);
  EXPECT_LT(counts[1], 400);
  EXPECT_TRUE(isRight(graph, refined, "30", 0.01));
}

TEST(Refine, AreasFollowAFunction)
{
  const LineGraph graph = square();
  RefinementOptions options = withAngle(30);
  const auto limit = [](double x) { return 0.0001 + 0.01 * x * x; };
  options.AreaAt = [&](Point2 p, double) { return limit(p.x); };
  options.LeastArea = 0.0001;
  const Refined refined = refineGraph(graph, options);
  EXPECT_TRUE(refined.Mesh.Outside.empty());
  EXPECT_TRUE(isRight(graph, refined, "30"));
  for (std::size_t t = 0; t < refined.Mesh.triangleCount(); ++t)
  {
    const std::int32_t* const v = refined.Mesh.Triangles.data() + 3 * t;
    const auto x = [&](int i) { return refined.XY[2 * std::size_t(v[i])]; };
    const auto y = [&](int i) { return refined.XY[2 * std::size_t(v[i]) + 1]; };
    const double area = ((x(1) - x(0)) * (y(2) - y(0)) - (x(2) - x(0)) * (y(1) - y(0))) / 2;
    ASSERT_LE(area, limit((x(0) + x(1) + x(2)) / 3) * (1 + 1e-9));
  }
}

TEST(Refine, FewSmallTrianglesAmidLargeOnesAreNotMissed)
{
  const LineGraph graph = square();
  RefinementOptions options = withAngle(30);
  constexpr Point2 spot{ 0.3141, 0.2718 };
  constexpr double reach = 0.004;
  constexpr double small = 1e-7;
  constexpr double large = 0.01;
  // The limit is small in a square around the spot only, which is a thousandth of the domain.
  options.AreaAt = [&](Point2 p, double radius)
  {
    const double away = std::max(std::fabs(p.x - spot.x), std::fabs(p.y - spot.y));
    return away < reach ? small : away < reach + radius ? 4 * small : large;
  };
  options.LeastArea = small;
  const Refined refined = refineGraph(graph, options);
  EXPECT_TRUE(isRight(graph, refined, "30"));
  std::int64_t inside = 0;
  for (std::size_t i = 0; i < refined.Mesh.addedCount(); ++i)
  {
    inside += std::fabs(refined.Mesh.AddedXY[2 * i] - spot.x) < reach &&
      std::fabs(refined.Mesh.AddedXY[2 * i + 1] - spot.y) < reach;
  }
  EXPECT_GT(inside, 300); // 64e-6 / 1e-7 / 2, at least
  EXPECT_LT(refined.Mesh.addedCount(), 20000U);
}

TEST(Refine, SubsegmentsKnowTheirConstraints)
{
  LineGraph graph = square();
  graph.addPoint(0.2, 0.5);
  graph.addPoint(0.8, 0.5);
  graph.addSegment(4, 5); // the fifth constraint
  const Refined refined = refineGraph(graph, withAngle(30, 0.001));
  const auto chain = segmentsOf(refined.Mesh.Segments, 4, 5);
  EXPECT_GT(chain.size(), 5U);
  for (const IdSegment& segment : refined.Mesh.Segments)
  {
    const auto y = [&](PointId id) { return refined.XY[2 * std::size_t(id) + 1]; };
    EXPECT_EQ(segment.Constraint == 4, y(segment.A) == 0.5 && y(segment.B) == 0.5);
  }
}

TEST(Refine, BorderAndSegmentsCanBeKept)
{
  LineGraph graph;
  for (int i = 0; i < 40; ++i) // ten points on each side
  {
    const double along = i % 10 / 10.;
    const std::array<double, 4> x{ along, 1, 1 - along, 0 };
    const std::array<double, 4> y{ 0, along, 1, 1 - along };
    graph.addPoint(x[std::size_t(i / 10)], y[std::size_t(i / 10)]);
  }
  graph.close(0);
  graph.addPoint(0.2, 0.5);
  graph.addPoint(0.8, 0.52);
  graph.addSegment(40, 41);
  // A constraint with k points on it is a chain of k + 1 subsegments.
  const auto countOn = [](const Refined& refined, std::int64_t begin, std::int64_t end)
  {
    return std::count_if(refined.Mesh.Segments.begin(), refined.Mesh.Segments.end(),
             [&](const IdSegment& segment)
             { return segment.Constraint >= begin && segment.Constraint < end; }) -
      (end - begin);
  };
  RefinementOptions options = withAngle(30, 0.001);
  EXPECT_GT(countOn(refineGraph(graph, options), 0, 40), 0);
  options.KeepsBorder = true;
  const Refined border = refineGraph(graph, options);
  EXPECT_EQ(countOn(border, 0, 40), 0);
  EXPECT_GT(countOn(border, 40, 41), 0);
  ASSERT_FALSE(border.Mesh.Outside.empty());
  EXPECT_EQ(border.Mesh.Outside[0].Why, Reason::KeptSegments);
  options.KeepsSegments = true;
  EXPECT_EQ(countOn(refineGraph(graph, options), 0, 41), 0);
}

TEST(Refine, StopsAtTheLargestNumberOfPoints)
{
  const LineGraph graph = square();
  RefinementOptions options = withAngle(30, 0.0001);
  options.MostPoints = 1234;
  options.Threads = 4;
  const Refined refined = refineGraph(graph, options);
  EXPECT_EQ(refined.Mesh.addedCount(), 1234U);
  ASSERT_FALSE(refined.Mesh.Outside.empty());
  EXPECT_EQ(refined.Mesh.Outside[0].Why, Reason::MostPoints);
}

TEST(Refine, NarrowGapsEndAtTheShortestEdge)
{
  LineGraph graph;
  for (const double y : { 0., 1e-6 })
  {
    graph.addPoint(0, y);
    graph.addPoint(1, y);
    graph.addSegment(graph.points() - 2, graph.points() - 1);
  }
  graph.addRectangle(-1, -1, 2, 2);
  RefinementOptions options = withAngle(30);
  options.ShortestEdge = 1e-3;
  const Refined refined = refineGraph(graph, options);
  EXPECT_TRUE(isRight(graph, refined, "30"));
  ASSERT_FALSE(refined.Mesh.Outside.empty());
  EXPECT_EQ(refined.Mesh.Outside[0].Why, Reason::ShortestEdge);
}

TEST(Refine, NoEdgeIsMadeThatIsTooShort)
{
  RefinementOptions options = withAngle(30, 0.001);
  options.ShortestEdge = 0.02;
  for (const LineGraph& graph : { comb(), spiral(), fan(5), randomGraph(3, 20, 10) })
  {
    const Refined refined = refineGraph(graph, options);
    const auto firstAdded = std::int64_t(refined.XY.size() - refined.Mesh.AddedXY.size()) / 2;
    for (std::size_t t = 0; t < refined.Mesh.triangleCount(); ++t)
    {
      for (std::size_t i = 0; i < 3; ++i)
      {
        const std::int32_t a = refined.Mesh.Triangles[3 * t + i];
        const std::int32_t b = refined.Mesh.Triangles[3 * t + (i + 1) % 3];
        const double x = refined.XY[2 * std::size_t(a)] - refined.XY[2 * std::size_t(b)];
        const double y = refined.XY[2 * std::size_t(a) + 1] - refined.XY[2 * std::size_t(b) + 1];
        if (std::max(a, b) >= firstAdded)
        {
          ASSERT_GE(std::hypot(x, y), options.ShortestEdge * (1 - 1e-12));
        }
      }
    }
  }
}

TEST(Refine, ANeedleIsListed)
{
  LineGraph graph;
  graph.addPoint(0, 0);
  graph.addPoint(1, 0);
  graph.addPoint(1, 1e-300);
  graph.close(0);
  const Refined refined = refineGraph(graph, withAngle(30));
  ASSERT_EQ(refined.Mesh.Outside.size(), refined.Mesh.triangleCount());
  EXPECT_LT(refined.Mesh.Outside[0].Angle, 1e-9);
}

TEST(Refine, MoreTrianglesThanFitAreRefusedAtOnce)
{
  for (const double area : { 1e-12, 1e-300, 5e-324 })
  {
    EXPECT_THROW(refineGraph(square(), withAngle(30, area)), std::length_error) << area;
    RefinementOptions options = withAngle(30, area);
    options.MostPoints = 10;
    EXPECT_EQ(refineGraph(square(), options).Mesh.addedCount(), 10U) << area;
  }
}

TEST(Refine, FarFromTheOriginRoundingEndsIt)
{
  LineGraph graph = fan(20);
  for (double& coordinate : graph.XY)
  {
    coordinate += 1e9;
  }
  const Refined refined = refineGraph(graph, withAngle(30, 0.01));
  EXPECT_TRUE(isRight(graph, refined, "30", 0.01));
}

TEST(Refine, HugeAndTinyDomainsAreRefinedAlike)
{
  const Refined usual = refineGraph(square(), withAngle(30, 0.01));
  for (const int exponent : { -100, 100 })
  {
    LineGraph graph = square();
    for (double& coordinate : graph.XY)
    {
      coordinate = std::ldexp(coordinate, exponent);
    }
    const Refined refined = refineGraph(graph, withAngle(30, std::ldexp(0.01, 2 * exponent)));
    EXPECT_EQ(refined.Mesh.triangleCount(), usual.Mesh.triangleCount()) << exponent;
  }
}

TEST(Refine, ProgressCanStopIt)
{
  RefinementOptions options = withAngle(30, 0.0001);
  options.Progress = [](double) { return false; };
  const Refined refined = refineGraph(square(), options);
  EXPECT_TRUE(refined.Mesh.Aborted);
  EXPECT_EQ(refined.Mesh.triangleCount(), 0U);
}

TEST(Refine, ProgressGrowsToOne)
{
  RefinementOptions options = withAngle(30, 0.0001);
  double last = 0;
  options.Progress = [&](double done)
  {
    EXPECT_GE(done, last);
    EXPECT_LE(done, 1);
    last = done;
    return true;
  };
  refineGraph(square(), options);
  EXPECT_GT(last, 0.8);
}

TEST(Refine, OptionsOutOfRangeAreRefused)
{
  const auto refusal = [](const RefinementOptions& options) -> std::string
  {
    try
    {
      refineGraph(square(), options);
    }
    catch (const std::invalid_argument& error)
    {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(
    refusal(withAngle(35)), "The smallest angle must be between 0 and 34 degrees; it is 35.");
  EXPECT_EQ(refusal(withAngle(30, -1)), "The largest area must be above 0; it is -1.");
  RefinementOptions options = withAngle(30);
  options.Regions = { { { 3, 3 } } };
  EXPECT_EQ(refusal(options), "The point (3, 3) of region 0 is in no triangle of the domain.");
  options = withAngle(30);
  options.ShortestEdge = -1;
  EXPECT_EQ(refusal(options), "The shortest edge must be at least 0; it is -1.");
}

TEST(Refine, NothingEnclosedGivesNoTriangles)
{
  LineGraph graph;
  graph.addPoint(0, 0);
  graph.addPoint(1, 0);
  graph.addPoint(0, 1);
  graph.addSegment(0, 1);
  EXPECT_EQ(refineGraph(graph, withAngle(30)).Mesh.triangleCount(), 0U);
}

/// The border of a mesh in ADCIRC's format.
LineGraph borderOf(const std::string& path)
{
  const AdcircMesh mesh = readAdcirc(path);
  std::map<std::pair<std::int64_t, std::int64_t>, int> edges;
  for (const auto& triangle : mesh.Elements)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      ++edges[std::minmax<std::int64_t>(triangle[i], triangle[(i + 1) % 3])];
    }
  }
  LineGraph graph;
  std::map<std::int64_t, PointId> ids;
  const auto idOf = [&](std::int64_t node)
  {
    const auto [found, isNew] = ids.emplace(node, graph.points());
    if (isNew)
    {
      graph.addPoint(mesh.Nodes[2 * std::size_t(node)], mesh.Nodes[2 * std::size_t(node) + 1]);
    }
    return found->second;
  };
  for (const auto& [ends, count] : edges)
  {
    if (count == 1)
    {
      const PointId a = idOf(ends.first);
      graph.addSegment(a, idOf(ends.second));
    }
  }
  return graph;
}

TEST(Refine, TheWesternAtlanticIsRefinedExactly)
{
  TIPP_REQUIRE_REAL_DATA(path, "adcirc/ec95d/ec95d.grd");
  const LineGraph graph = borderOf(path);
  RefinementOptions options = withAngle(30, 0.02);
  options.Threads = 2;
  const Refined refined = refineGraph(graph, options);
  EXPECT_GT(refined.Mesh.triangleCount(), 60000U);
  EXPECT_LT(refined.Mesh.triangleCount(), 80000U);
  EXPECT_TRUE(isRight(graph, refined, "30", 0.02));
  for (const TriangleOutside& outside : refined.Mesh.Outside)
  {
    EXPECT_EQ(outside.Why, Reason::InputAngle);
  }
}

} // namespace
