// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/ReadSizes.h"
#include "Refinement/SizeFunction.h"
#include "Refinement/SizeLattice.h"
#include "Refinement/SizeRules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace
{

using namespace tipp;
using Segments = std::vector<std::array<Point2, 2>>;

constexpr double pi = 3.14159265358979323846;
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr std::int64_t manyNodes = 1 << 20;
const Box2 domain{ { -2, 3 }, { 8, 10 } };
const Box2 coast{ { -76, 30 }, { -70, 42 } };

double uniform(std::mt19937& random, double low, double high)
{
  return std::uniform_real_distribution<double>(low, high)(random);
}

Point2 randomPlace(std::mt19937& random, const Box2& box)
{
  return { uniform(random, box.Min.x, box.Max.x), uniform(random, box.Min.y, box.Max.y) };
}

Segments randomSegments(std::size_t count, const Box2& box, unsigned seed)
{
  std::mt19937 random(seed);
  Segments segments;
  for (std::size_t i = 0; i < count; ++i)
  {
    segments.push_back({ randomPlace(random, box), randomPlace(random, box) });
  }
  segments.push_back({ segments[0][0], segments[0][0] }); // a point
  return segments;
}

/// The distance to the nearest segment by trying all, in lengths of these units.
double bruteDistance(Point2 p, const Segments& segments, double unitX, double unitY)
{
  double least = infinite;
  for (const auto& [from, to] : segments)
  {
    const Point2 a{ (from.x - p.x) * unitX, (from.y - p.y) * unitY };
    const Point2 b{ (to.x - p.x) * unitX, (to.y - p.y) * unitY };
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    const double squared = dx * dx + dy * dy;
    least = std::min({ least, std::hypot(a.x, a.y), std::hypot(b.x, b.y) });
    const double along = -(a.x * dx + a.y * dy);
    if (along > 0 && along < squared)
    {
      least = std::min(least, std::fabs(a.x * b.y - a.y * b.x) / std::sqrt(squared));
    }
  }
  return least;
}

/// Calls check(node, column, row) for all nodes.
template <typename Check>
void forNodes(const SizeLattice& lattice, const Check& check)
{
  for (int row = 0; row < lattice.rows(); ++row)
  {
    for (int column = 0; column < lattice.columns(); ++column)
    {
      check(lattice.index(column, row), column, row);
    }
  }
}

std::vector<double> randomSizes(const SizeLattice& lattice, double low, double high, unsigned seed)
{
  std::mt19937 random(seed);
  std::vector<double> sizes(lattice.nodes());
  for (double& size : sizes)
  {
    size = uniform(random, 0, 1) < 0.02 ? uniform(random, low, high) : high;
  }
  return sizes;
}

SizeArguments withDistance(double least, double dis)
{
  SizeArguments arguments;
  arguments.Least = least;
  arguments.Dis = dis;
  return arguments;
}

TEST(SizeFunction, ConstantIsTheSameEverywhere)
{
  SizeArguments arguments;
  arguments.Size = "2.5";
  const SizeFunction sizes = makeSizeFunction(arguments, {}, domain, 1, {});
  EXPECT_EQ(2.5, sizes.at({ 0, 5 }));
  EXPECT_EQ(2.5, sizes.at({ 1e300, -1e300 }));
  EXPECT_EQ(2.5, sizes.least());
  EXPECT_EQ(0, sizes.spacing());
}

TEST(SizeFunction, ConstantIsLimited)
{
  SizeArguments arguments;
  arguments.Size = "2.5";
  arguments.Largest = 2;
  EXPECT_EQ(2, makeSizeFunction(arguments, {}, domain, 1, {}).at({ 0, 5 }));
  arguments.Largest = 9;
  arguments.Least = 4;
  EXPECT_EQ(4, makeSizeFunction(arguments, {}, domain, 1, {}).least());
}

TEST(SizeFunction, MetresBecomeDegreesOfTheSameArea)
{
  SizeArguments arguments;
  arguments.Size = "5000";
  arguments.Geographic = true;
  const SizeFunction sizes = makeSizeFunction(arguments, {}, { { 0, 0 }, { 10, 60 } }, 1, {});
  EXPECT_NEAR(5000 / 111195.0, sizes.at({ 3, 0 }), 1e-12);
  EXPECT_NEAR(5000 / (111195 * std::sqrt(0.5)), sizes.at({ 3, 60 }), 1e-9);
  const double cosine = std::cos(33.3 * pi / 180);
  EXPECT_NEAR(5000 / (111195 * std::sqrt(cosine)), sizes.at({ 7, 33.3 }), 1e-6);
  EXPECT_NEAR(5000 / 111195.0, sizes.least(), 1e-12);
}

TEST(SizeFunction, BetweenNodesSizesAreBilinear)
{
  const SizeLattice lattice(domain, 0.5, manyNodes, PlaneKind::Projected);
  std::vector<double> sizes(lattice.nodes());
  const auto exact = [](Point2 p) { return 9 + p.x + 2 * p.y + 0.125 * p.x * p.y; };
  forNodes(lattice,
    [&](std::size_t node, int column, int row) { sizes[node] = exact(lattice.at(column, row)); });
  const SizeFunction function(lattice, sizes);
  std::mt19937 random(1);
  for (int i = 0; i < 1000; ++i)
  {
    const Point2 p = randomPlace(random, domain);
    EXPECT_NEAR(exact(p), function.at(p), 1e-12 * exact(p));
  }
}

TEST(SizeFunction, OutsideTheNearestPlaceOfTheLatticeCounts)
{
  const SizeFunction sizes =
    makeSizeFunction(withDistance(0.5, 0.2), randomSegments(5, domain, 2), domain, 1, {});
  EXPECT_EQ(sizes.at({ 8, 5 }), sizes.at({ 1e300, 5 }));
  EXPECT_EQ(sizes.at({ -2, 3 }), sizes.at({ -infinite, -infinite }));
  EXPECT_TRUE(std::isfinite(sizes.at({ std::nan(""), std::nan("") })));
}

TEST(SizeFunction, LeastIsTheLeastOfAll)
{
  const SizeFunction sizes =
    makeSizeFunction(withDistance(0.5, 0.2), randomSegments(5, domain, 3), domain, 1, {});
  std::mt19937 random(3);
  for (int i = 0; i < 10000; ++i)
  {
    EXPECT_GE(sizes.at(randomPlace(random, domain)), sizes.least());
  }
  EXPECT_GE(sizes.least(), 0.5);
}

TEST(SizeFunction, TrianglesDoNotMissASmallSizeAmidLargeOnes)
{
  const SizeLattice lattice(domain, 0.05, manyNodes, PlaneKind::Projected);
  std::vector<double> sizes(lattice.nodes(), 2);
  const Point2 spot = lattice.at(41, 70);
  sizes[lattice.index(41, 70)] = 0.01;
  const SizeFunction function(lattice, sizes);
  std::mt19937 random(5);
  for (int i = 0; i < 10000; ++i)
  {
    const Point2 p = randomPlace(random, domain);
    const double radius = std::exp2(uniform(random, -8, 3));
    const double away = std::max(std::fabs(p.x - spot.x), std::fabs(p.y - spot.y));
    const double size = function.forTriangle(p, radius);
    if (away <= radius)
    {
      ASSERT_LE(size, 0.02);
    }
    else if (away > 3 * radius + 0.2) // beyond the part that the search may reach
    {
      ASSERT_EQ(size, function.at(p));
    }
  }
}

TEST(SizeFunction, SlowlyChangingSizesOfTrianglesAreThoseAtTheirCentroids)
{
  const SizeLattice lattice(domain, 0.1, manyNodes, PlaneKind::Projected);
  std::vector<double> sizes;
  for (int row = 0; row < lattice.rows(); ++row)
  {
    for (int column = 0; column < lattice.columns(); ++column)
    {
      sizes.push_back(1 + 0.1 * (lattice.at(column, row).x - domain.Min.x));
    }
  }
  const SizeFunction function(lattice, sizes);
  std::mt19937 random(6);
  for (int i = 0; i < 1000; ++i)
  {
    const Point2 p = randomPlace(random, domain);
    ASSERT_EQ(function.forTriangle(p, 4), function.at(p));
  }
}

TEST(SizeFunction, NodesAreLimited)
{
  SizeArguments arguments = withDistance(0.001, 0.2);
  arguments.MostNodes = 1000;
  const SizeFunction sizes =
    makeSizeFunction(arguments, randomSegments(5, domain, 4), domain, 1, {});
  const SizeLattice lattice(domain, 0.0005, 1000, PlaneKind::Projected);
  EXPECT_LE(lattice.nodes(), 1000U);
  EXPECT_GE(lattice.nodes(), 900U);
  EXPECT_NEAR(sizes.spacing(), std::sqrt(70 / 1000.0), 0.02);
}

TEST(SizeFunction, FlatDomainsHaveALattice)
{
  const Segments line{ { Point2{ 0, 1 }, Point2{ 0, 1 } } };
  const Box2 flat{ { 0, 1 }, { 10, 1 } };
  const SizeFunction sizes = makeSizeFunction(withDistance(0.5, 0.1), line, flat, 1, {});
  EXPECT_NEAR(1.5, sizes.at({ 10, 1 }), 1e-12);
  const SizeFunction ofPoint =
    makeSizeFunction(withDistance(0.5, 0.1), line, Box2::of(Point2{ 3, 1 }), 1, {});
  EXPECT_NEAR(0.8, ofPoint.at({ 3, 1 }), 1e-12);
}

TEST(SizeRules, DistanceIsThatOfBruteForce)
{
  const Segments segments = randomSegments(40, domain, 5);
  const SizeFunction sizes = makeSizeFunction(withDistance(0.2, 0.15), segments, domain, 2, {});
  const SizeLattice lattice(domain, 0.1, manyNodes, PlaneKind::Projected);
  forNodes(lattice,
    [&](std::size_t, int column, int row)
    {
      const Point2 node = lattice.at(column, row);
      const double exact = 0.2 + 0.15 * bruteDistance(node, segments, 1, 1);
      EXPECT_NEAR(exact, sizes.at(node), 1e-12);
    });
}

TEST(SizeRules, HugeAndTinyCoordinatesHaveSizes)
{
  const Segments segments = randomSegments(10, domain, 18);
  SizeArguments arguments = withDistance(0.25, 0.15);
  arguments.Gradation = 0.1;
  const SizeFunction plain = makeSizeFunction(arguments, segments, domain, 1, {});
  for (const double scale : { 0x1p-500, 0x1p500 })
  {
    Segments scaledSegments = segments;
    for (auto& [from, to] : scaledSegments)
    {
      from = { from.x * scale, from.y * scale };
      to = { to.x * scale, to.y * scale };
    }
    arguments.Least = 0.25 * scale;
    const SizeFunction sizes =
      makeSizeFunction(arguments, scaledSegments, scaled(domain, scale), 1, {});
    EXPECT_NEAR(plain.at({ 1, 7 }), sizes.at({ scale, 7 * scale }) / scale, 1e-12);
    EXPECT_NEAR(plain.at({ 8, 3 }), sizes.at({ 8 * scale, 3 * scale }) / scale, 1e-12);
  }
}

TEST(SizeRules, DistanceInDegreesUsesTheCosine)
{
  for (const Box2& box : { coast, Box2{ { -5, -50 }, { 15, 75 } } })
  {
    const Segments segments = randomSegments(20, box, 6);
    const SizeLattice lattice(box, 50000, manyNodes, PlaneKind::Geographic);
    std::vector<double> sizes(lattice.nodes(), 900000);
    limitByDistance(lattice, segments, 1000, 0.5, 2, {}, sizes);
    forNodes(lattice,
      [&](std::size_t node, int column, int row)
      {
        const Point2 p = lattice.at(column, row);
        const double unitX = 111195 * std::cos(p.y * pi / 180);
        const double exact = 1000 + 0.5 * bruteDistance(p, segments, unitX, 111195);
        EXPECT_NEAR(std::min(exact, 900000.0), sizes[node], 1e-6);
      });
  }
}

TEST(SizeRules, InterpolatedDistanceIsWithinTheStatedError)
{
  const Segments segments = randomSegments(10, domain, 7);
  SizeArguments arguments = withDistance(0.2, 0.3);
  arguments.MostNodes = 2000;
  const SizeFunction sizes = makeSizeFunction(arguments, segments, domain, 1, {});
  std::mt19937 random(7);
  for (int i = 0; i < 5000; ++i)
  {
    const Point2 p = randomPlace(random, domain);
    const double exact = 0.2 + 0.3 * bruteDistance(p, segments, 1, 1);
    EXPECT_NEAR(exact, sizes.at(p), 0.3 * sizes.spacing() / std::sqrt(2.0));
  }
}

TEST(SizeRules, WavelengthIsThatOfTheTideOverItsElements)
{
  // M2 in 4,000 m of water: 44712 s * 198.09 m/s = 8,857 km.
  EXPECT_NEAR(8857.1e3 / 100, sizeByWavelength(4000, 100), 10);
  EXPECT_EQ(sizeByWavelength(1, 100), sizeByWavelength(-50, 100));
  const SizeLattice lattice(domain, 1, manyNodes, PlaneKind::Projected);
  std::vector<double> depths(lattice.nodes());
  std::mt19937 random(8);
  for (double& depth : depths)
  {
    depth = uniform(random, -10, 100);
  }
  std::vector<double> sizes(lattice.nodes(), 30000);
  limitByWavelength(lattice, depths, 30, 2, {}, sizes);
  for (std::size_t i = 0; i < sizes.size(); ++i)
  {
    const double exact = 44712 * std::sqrt(9.81 * std::max(depths[i], 1.0)) / 30;
    EXPECT_DOUBLE_EQ(std::min(exact, 30000.0), sizes[i]);
  }
}

TEST(SizeRules, SlopeIsThatOfThePlane)
{
  const SizeLattice lattice(domain, 0.25, manyNodes, PlaneKind::Projected);
  std::vector<double> depths(lattice.nodes());
  const auto depthAt = [](Point2 p) { return 20 + 0.3 * p.x - 0.4 * p.y; };
  forNodes(lattice,
    [&](std::size_t node, int column, int row)
    { depths[node] = depthAt(lattice.at(column, row)); });
  std::vector<double> sizes(lattice.nodes(), 1e9);
  limitBySlope(lattice, depths, 15, 2, {}, sizes);
  for (std::size_t i = 0; i < sizes.size(); ++i)
  {
    EXPECT_NEAR(2 * pi * depths[i] / (15 * 0.5), sizes[i], 1e-9);
  }
}

TEST(SizeRules, SlopeInDegreesIsPerMetre)
{
  const SizeLattice lattice(coast, 20000, manyNodes, PlaneKind::Geographic);
  std::vector<double> depths(lattice.nodes());
  forNodes(lattice,
    [&](std::size_t node, int column, int row)
    { depths[node] = 5000 + 50 * lattice.at(column, row).x; });
  std::vector<double> sizes(lattice.nodes(), infinite);
  limitBySlope(lattice, depths, 15, 1, {}, sizes);
  forNodes(lattice,
    [&](std::size_t node, int column, int row)
    {
      const double perMetre = 50 / (111195 * std::cos(lattice.at(column, row).y * pi / 180));
      EXPECT_NEAR(2 * pi * depths[node] / (15 * perMetre), sizes[node], 1e-6 * sizes[node]);
    });
}

TEST(SizeRules, LevelBottomHasNoLimit)
{
  const SizeLattice lattice(domain, 1, manyNodes, PlaneKind::Projected);
  std::vector<double> sizes(lattice.nodes(), 7);
  limitBySlope(lattice, std::vector<double>(lattice.nodes(), 100), 15, 1, {}, sizes);
  EXPECT_EQ(std::vector<double>(lattice.nodes(), 7), sizes);
}

TEST(Gradation, SizesAtNodesDifferByAtMostItsShareOfTheirDistance)
{
  const SizeLattice lattice({ { 0, 0 }, { 4, 3 } }, 0.1, manyNodes, PlaneKind::Projected);
  std::vector<double> sizes = randomSizes(lattice, 0.1, 5, 9);
  limitGradation(lattice, 0.3, {}, sizes);
  std::mt19937 random(9);
  std::uniform_int_distribution<int> columns(0, lattice.columns() - 1);
  std::uniform_int_distribution<int> rows(0, lattice.rows() - 1);
  for (int i = 0; i < 100000; ++i)
  {
    const std::array<int, 4> at{ columns(random), rows(random), columns(random), rows(random) };
    const Point2 apart = lattice.at(at[2], at[3]) - lattice.at(at[0], at[1]);
    const double difference =
      sizes[lattice.index(at[2], at[3])] - sizes[lattice.index(at[0], at[1])];
    ASSERT_LE(std::fabs(difference), 0.3 * std::hypot(apart.x, apart.y) + 1e-12);
  }
}

TEST(Gradation, SizesAreNoSmallerThanItAsks)
{
  const SizeLattice lattice({ { 0, 0 }, { 2, 1.5 } }, 0.1, manyNodes, PlaneKind::Projected);
  const std::vector<double> given = randomSizes(lattice, 0.1, 2, 10);
  std::vector<double> sizes = given;
  limitGradation(lattice, 0.4, {}, sizes);
  const double rate = 0.4 * std::cos(pi / 8); // steps on a lattice: see limitGradation()
  forNodes(lattice,
    [&](std::size_t node, int column, int row)
    {
      double least = infinite; // over straight lines with the lower rate, which are too short
      forNodes(lattice,
        [&](std::size_t other, int otherColumn, int otherRow)
        {
          const Point2 apart = lattice.at(otherColumn, otherRow) - lattice.at(column, row);
          least = std::min(least, given[other] + rate * std::hypot(apart.x, apart.y));
        });
      ASSERT_GE(sizes[node], least - 0.01); // the lattice's cells are not quite square
      ASSERT_LE(sizes[node], given[node]);
    });
}

TEST(Gradation, SizesAtAnyPlacesDifferByItsShareAndTheSpacing)
{
  const SizeLattice lattice(domain, 0.1, manyNodes, PlaneKind::Projected);
  std::vector<double> values = randomSizes(lattice, 0.1, 5, 11);
  limitGradation(lattice, 0.2, {}, values);
  const SizeFunction sizes(lattice, values);
  std::mt19937 random(11);
  for (int i = 0; i < 50000; ++i)
  {
    const Point2 p = randomPlace(random, domain);
    const Point2 q = i % 2 == 0 ? randomPlace(random, domain)
                                : Point2{ p.x + uniform(random, -0.3, 0.3), p.y + 0.1 };
    const double distance = std::hypot(p.x - q.x, p.y - q.y);
    ASSERT_LE(std::fabs(sizes.at(p) - sizes.at(q)),
      0.2 * distance + std::sqrt(2.0) * 0.2 * sizes.spacing() + 1e-12);
  }
}

TEST(Gradation, InDegreesItIsPerMetre)
{
  const SizeLattice lattice(coast, 20000, manyNodes, PlaneKind::Geographic);
  std::vector<double> sizes = randomSizes(lattice, 1000, 200000, 12);
  limitGradation(lattice, 0.25, {}, sizes);
  const auto requireNear = [&](std::size_t a, std::size_t b, double distance)
  { ASSERT_LE(std::fabs(sizes[a] - sizes[b]), 0.25 * distance + 1e-6); };
  forNodes(lattice,
    [&](std::size_t node, int column, int row)
    {
      const double x = lattice.at(1, 0).x - lattice.at(0, 0).x;
      const double y = (lattice.at(0, 1).y - lattice.at(0, 0).y) * 111195;
      if (column + 1 < lattice.columns())
      {
        const double unitX = 111195 * std::cos(lattice.at(0, row).y * pi / 180);
        requireNear(node, lattice.index(column + 1, row), x * unitX);
      }
      if (row + 1 < lattice.rows())
      {
        requireNear(node, lattice.index(column, row + 1), y);
      }
    });
}

TEST(Gradation, GradedSizesStay)
{
  const SizeLattice lattice(domain, 0.1, manyNodes, PlaneKind::Projected);
  std::vector<double> sizes = randomSizes(lattice, 0.1, 5, 13);
  limitGradation(lattice, 0.2, {}, sizes);
  const std::vector<double> once = sizes;
  limitGradation(lattice, 0.2, {}, sizes);
  EXPECT_EQ(once, sizes);
}

TEST(SizeRules, TheSmallestCountsWithinTheLimits)
{
  const Segments segments = randomSegments(10, domain, 14);
  SizeArguments arguments = withDistance(0.25, 0.5);
  arguments.Size = "0.9";
  arguments.Largest = 0.8;
  const SizeFunction limited = makeSizeFunction(arguments, segments, domain, 1, {});
  arguments.Largest.reset();
  const SizeFunction sizes = makeSizeFunction(arguments, segments, domain, 1, {});
  const SizeLattice lattice(domain, 0.125, manyNodes, PlaneKind::Projected);
  forNodes(lattice,
    [&](std::size_t, int column, int row)
    {
      const Point2 p = lattice.at(column, row);
      const double exact = std::min(0.9, 0.25 + 0.5 * bruteDistance(p, segments, 1, 1));
      EXPECT_NEAR(exact, sizes.at(p), 1e-12);
      EXPECT_NEAR(std::min(exact, 0.8), limited.at(p), 1e-12);
    });
}

TEST(SizeRules, GradationComesLast)
{
  SizeArguments arguments = withDistance(0.25, 2);
  const Segments point{ { Point2{ 3, 6 }, Point2{ 3, 6 } } };
  arguments.Gradation = 0.5;
  const SizeFunction sizes = makeSizeFunction(arguments, point, domain, 1, {});
  // Along an axis, by 0.92 of the gradation.
  EXPECT_NEAR(0.25 + 0.5 * std::cos(pi / 8) * 4, sizes.at({ 7, 6 }), 0.05);
}

TEST(SizeRules, ResultsAreTheSameForAnyThreads)
{
  const Segments segments = randomSegments(200, coast, 15);
  SizeArguments arguments = withDistance(2000, 0.4);
  arguments.Geographic = true;
  arguments.Gradation = 0.2;
  arguments.Largest = 90000;
  const SizeFunction one = makeSizeFunction(arguments, segments, coast, 1, {});
  const SizeFunction four = makeSizeFunction(arguments, segments, coast, 4, {});
  std::mt19937 random(15);
  for (int i = 0; i < 20000; ++i)
  {
    const Point2 p = randomPlace(random, coast);
    ASSERT_EQ(one.at(p), four.at(p));
  }
  EXPECT_EQ(one.least(), four.least());
}

TEST(SizeRules, ReportStopsTheWork)
{
  SizeArguments arguments = withDistance(0.1, 0.4);
  arguments.Gradation = 0.2;
  const Segments segments = randomSegments(10, domain, 16);
  for (const double end : { 0.0, 0.8, 0.95 })
  {
    EXPECT_THROW(
      makeSizeFunction(arguments, segments, domain, 2, [end](double done) { return done < end; }),
      WorkAborted);
  }
}

TEST(SizeRules, ReportedProgressGrows)
{
  SizeArguments arguments = withDistance(0.1, 0.4);
  arguments.Gradation = 0.2;
  double last = 0;
  makeSizeFunction(arguments, randomSegments(10, domain, 17), domain, 1,
    [&last](double done)
    {
      EXPECT_GE(done, last);
      last = done;
      return true;
    });
  EXPECT_GT(last, 0.9);
  EXPECT_LE(last, 1);
}

} // namespace
