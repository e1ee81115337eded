// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/ExactPredicates.h"

#include "ExactOracle.h"
#include "NearDegenerate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace
{

using tipp::CoordinateGrid;
using tipp::Exactness;
using tipp::Point2;

// Points with coordinates from 0 to 2^bits - 1 units of 2^exponent, among them the square's
// corners.
std::vector<Point2> pointsSpanning(int bits, int exponent, Point2 offset, unsigned seed)
{
  NearDegenerate draw(seed);
  const std::int64_t side = static_cast<std::int64_t>((std::uint64_t{ 1 } << bits) - 1);
  const auto place = [&](std::int64_t x, std::int64_t y) -> Point2
  {
    return { offset.x + std::ldexp(static_cast<double>(x), exponent),
      offset.y + std::ldexp(static_cast<double>(y), exponent) };
  };
  std::vector<Point2> points = { place(0, 0), place(side, 0), place(side, side), place(0, side),
    place(1, 0), place(side, 1), place(side - 1, side), place(side / 2, side / 2) };
  for (int i = 0; i < 40; ++i)
  {
    points.push_back(place(draw.bits(bits), draw.bits(bits)));
  }
  return points;
}

// Compares tuples of the first points, and random tuples of all points, with rational arithmetic.
void expectExact(const std::vector<Point2>& points, const CoordinateGrid& grid, int count)
{
  NearDegenerate draw(99);
  const int last = static_cast<int>(points.size()) - 1;
  for (int i = 0; i < count; ++i)
  {
    const int end = i % 2 == 0 ? 7 : last;
    NearDegenerate::Points q;
    for (Point2& point : q)
    {
      point = points[draw.integer(0, end)];
    }
    const int turn = oracle::orientation(q[0], q[1], q[2]);
    ASSERT_EQ(turn, grid.orientation(q[0], q[1], q[2])) << testing::PrintToString(q);
    if (turn < 0)
    {
      std::swap(q[0], q[1]);
    }
    ASSERT_EQ(oracle::inCircle(q[0], q[1], q[2], q[3]), grid.inCircle(q[0], q[1], q[2], q[3]))
      << testing::PrintToString(q);
  }
}

void expectModeAndExact(const std::vector<Point2>& points, Exactness mode, int count = 4000)
{
  CoordinateGrid grid;
  grid.analyse(points.data(), points.size());
  EXPECT_EQ(mode, grid.exactness());
  expectExact(points, grid, count);
}

// Integers from 0 to almost 2^bits, whose differences need more digits than a double has.
std::vector<Point2> withTails(int bits)
{
  const double far = std::ldexp(1.0, bits - 1);
  const double below = std::nextafter(std::ldexp(1.0, bits), 0);
  return { { 0, 0 }, { far, 1 }, { 1, far }, { below, below }, { 0, below }, { below, 0 }, { 3, 5 },
    { far, far }, { 1, 0 }, { 0, 1 }, { 7, below } };
}

} // namespace

TEST(CoordinateGrid, TwelveBitsAreExactInDoubles)
{
  expectModeAndExact(pointsSpanning(12, 0, { 0, 0 }, 1), Exactness::Doubles);
  expectModeAndExact(pointsSpanning(12, -20, { 1e6, -3e6 }, 2), Exactness::Doubles);
  expectModeAndExact(pointsSpanning(12, -255, { 0, 0 }, 3), Exactness::Doubles);
  expectModeAndExact(pointsSpanning(12, 230, { 0, 0 }, 4), Exactness::Doubles);
}

TEST(CoordinateGrid, ThirteenToThirtyOneBitsTakeInt128)
{
  expectModeAndExact(pointsSpanning(13, 0, { 0, 0 }, 1), Exactness::Int128);
  expectModeAndExact(pointsSpanning(30, -30, { 5, -7 }, 2), Exactness::Int128);
  expectModeAndExact(pointsSpanning(31, -100, { 0, 0 }, 3), Exactness::Int128);
}

TEST(CoordinateGrid, SmallSpansBeyondTheRangeOfDoublesTakeInt128)
{
  expectModeAndExact(pointsSpanning(12, -256, { 0, 0 }, 1), Exactness::Int128);
  expectModeAndExact(pointsSpanning(12, 231, { 0, 0 }, 2), Exactness::Int128);
}

TEST(CoordinateGrid, ThirtyTwoToSixtyThreeBitsTakeInt256)
{
  expectModeAndExact(pointsSpanning(32, 0, { 0, 0 }, 1), Exactness::Int256);
  expectModeAndExact(pointsSpanning(53, -60, { 0, 0 }, 2), Exactness::Int256);
  expectModeAndExact(withTails(62), Exactness::Int256);
  expectModeAndExact(withTails(63), Exactness::Int256);
}

TEST(CoordinateGrid, SixtyFourBitsAreGeneral)
{
  expectModeAndExact(withTails(64), Exactness::General, 1000);
}

TEST(CoordinateGrid, NegativeAndPositiveCoordinatesShareAUnit)
{
  std::vector<Point2> points = pointsSpanning(31, -40, { 0, 0 }, 1);
  for (Point2& point : points)
  {
    point = { point.x - std::ldexp(1.0, -10), point.y - std::ldexp(1.0, -10) };
  }
  expectModeAndExact(points, Exactness::Int128);
}

TEST(CoordinateGrid, ALatticeOfTenthsIsExact)
{
  std::vector<Point2> points;
  for (int i = 0; i < 20; ++i)
  {
    for (int j = 0; j < 20; ++j)
    {
      points.push_back({ 0.1 * i, 0.1 * j });
    }
  }
  expectModeAndExact(points, Exactness::Int256, 8000);
}

TEST(CoordinateGrid, DenormalsAndOverflowingDifferencesAreGeneral)
{
  const double tiny = std::numeric_limits<double>::denorm_min();
  const double huge = std::numeric_limits<double>::max();
  expectModeAndExact({ { 0, 0 }, { tiny, 0 }, { tiny, tiny }, { 0, tiny }, { 0, 3 * tiny },
                       { 5 * tiny, 0 }, { tiny, 2 * tiny }, { 0, 2 * tiny } },
    Exactness::General, 1000);
  expectModeAndExact({ { -huge, 0 }, { huge, 0 }, { 0, huge }, { 0, -huge }, { 0, 1 },
                       { huge, huge }, { -huge, huge }, { 1, 0 } },
    Exactness::General, 1000);
}

TEST(CoordinateGrid, OnePointAndEqualPointsAreDoubles)
{
  const std::vector<Point2> points(8, Point2{ 0.1, 1e300 });
  expectModeAndExact(points, Exactness::Doubles, 10);
  CoordinateGrid grid;
  grid.analyse(points.data(), 1);
  EXPECT_EQ(Exactness::Doubles, grid.exactness());
}

TEST(CoordinateGrid, ALateOddPointIsNotMissed)
{
  std::vector<Point2> points(1000, Point2{ 1, 1 });
  points.push_back({ 1 + std::ldexp(1.0, -40), 1 });
  points.push_back({ 4, 1 });
  CoordinateGrid grid;
  grid.analyse(points.data(), points.size());
  EXPECT_EQ(Exactness::Int256, grid.exactness());
}
