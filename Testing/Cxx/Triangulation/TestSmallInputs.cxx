// SPDX-License-Identifier: BSD-3-Clause
// Few points, almost collinear points, and points that are not finite.
#include "Comparison.h"

#include <cmath>
#include <random>

namespace
{

using namespace tipp;
using namespace tipp::test;

TriangulationOptions withGrid(int columns, int rows)
{
  TriangulationOptions options;
  options.Columns = columns;
  options.Rows = rows;
  options.Threads = 2;
  return options;
}

class FewPoints : public testing::TestWithParam<int>
{
};

TEST_P(FewPoints, AreTriangulatedAsByCgal)
{
  // Random points of a 4 x 4 lattice: duplicates, ties and collinear points.
  std::mt19937_64 random(static_cast<std::uint64_t>(GetParam()));
  for (int draw = 0; draw < 200; ++draw)
  {
    Coordinates xy;
    for (int i = 0; i < 2 * GetParam(); ++i)
    {
      xy.push_back(double(random() % 4));
    }
    const Reference expected = reference(xy);
    ASSERT_TRUE(matches(xy, triangulate(view(xy), withGrid(0, 0)), expected)) << "draw " << draw;
    ASSERT_TRUE(matches(xy, triangulate(view(xy), withGrid(3, 2)), expected)) << "draw " << draw;
  }
}

INSTANTIATE_TEST_SUITE_P(Points, FewPoints, testing::Range(0, 11),
  [](const auto& info) { return std::to_string(info.param); });

TEST(SmallInputs, AViewOfNothingHasNoTriangles)
{
  const Triangulation result = triangulate(PointsView());
  EXPECT_EQ(0u, result.triangleCount());
  EXPECT_TRUE(result.Duplicates.empty());
  EXPECT_TRUE(result.Rejected.empty());
}

TEST(SmallInputs, AFlatTriangleOfOneUlpIsFound)
{
  const double y = std::nextafter(0.5, 1);
  const Coordinates xy{ 0, 0, 1, 1, 0.5, y };
  const Triangulation result = triangulate(view(xy));
  ASSERT_EQ(1u, result.triangleCount());
  EXPECT_EQ(canonical(0, 1, 2), trianglesOf(result).front());
}

TEST(SmallInputs, TheSmallestPossibleTriangleIsFound)
{
  const double least = 4.9406564584124654e-324;
  const Coordinates xy{ 0, 0, least, 0, 0, least };
  ASSERT_TRUE(matches(xy, triangulate(view(xy)), reference(xy)));
  EXPECT_EQ(1u, triangulate(view(xy)).triangleCount());
}

TEST(SmallInputs, TheLargestPossibleTriangleIsFound)
{
  const double most = 1.7976931348623157e308;
  const Coordinates xy{ -most, -most, most, -most, 0, most };
  const Triangulation result = triangulate(view(xy));
  ASSERT_EQ(1u, result.triangleCount());
  EXPECT_EQ(canonical(0, 1, 2), trianglesOf(result).front());
}

TEST(SmallInputs, MixedExponentsAreTriangulatedAsByCgal)
{
  std::mt19937_64 random(5);
  Coordinates xy;
  for (int i = 0; i < 400; ++i)
  {
    const int exponent = int(random() % 600) - 300;
    xy.push_back(std::ldexp(double(random() % 1000) - 500, exponent));
  }
  const Reference expected = reference(xy);
  EXPECT_TRUE(matches(xy, triangulate(view(xy), withGrid(0, 0)), expected));
  EXPECT_TRUE(matches(xy, triangulate(view(xy), withGrid(4, 4)), expected));
}

/// Functions that draw the coordinates of a point, with exponents from the whole range of doubles.
struct WideCoordinate
{
  std::string Name;
  double (*X)(std::mt19937_64&);
  double (*Y)(std::mt19937_64&);
};

int anyExponent(std::mt19937_64& random)
{
  return int(random() % 2080) - 1060;
}

double moderate(std::mt19937_64& random)
{
  return double(random() >> 11) * 0x1p-53;
}

double wide(std::mt19937_64& random)
{
  const double mantissa = moderate(random);
  return std::ldexp(mantissa, anyExponent(random));
}

double wideOfBothSigns(std::mt19937_64& random)
{
  const double sign = random() % 2 == 0 ? 1 : -1;
  return sign * wide(random);
}

double wideInteger(std::mt19937_64& random)
{
  const double integer = double(random() % 9) - 4;
  return std::ldexp(integer, anyExponent(random));
}

class WideExponents : public testing::TestWithParam<WideCoordinate>
{
};

TEST_P(WideExponents, AreTriangulatedAsByCgal)
{
  std::mt19937_64 random(6);
  for (const int count : { 5, 30, 300 })
  {
    Coordinates xy;
    for (int i = 0; i < count; ++i)
    {
      xy.push_back(GetParam().X(random));
      xy.push_back(GetParam().Y(random));
    }
    const Reference expected = reference(xy);
    EXPECT_TRUE(matches(xy, triangulate(view(xy), withGrid(0, 0)), expected)) << count;
    EXPECT_TRUE(matches(xy, triangulate(view(xy), withGrid(3, 3)), expected)) << count;
  }
}

INSTANTIATE_TEST_SUITE_P(Points, WideExponents,
  testing::Values(WideCoordinate{ "Positive", wide, wide },
    WideCoordinate{ "OfBothSigns", wideOfBothSigns, wideOfBothSigns },
    WideCoordinate{ "InXAlone", wideOfBothSigns, moderate },
    WideCoordinate{ "OfIntegers", wideInteger, wideInteger }),
  [](const auto& info) { return info.param.Name; });

class Flat : public testing::TestWithParam<std::tuple<double, double>>
{
};

TEST_P(Flat, AHundredThousandCollinearPointsHaveNoTriangles)
{
  const auto [dx, dy] = GetParam();
  Coordinates xy;
  for (int i = 0; i < 100000; ++i)
  {
    xy.push_back(dx * i);
    xy.push_back(dy * i);
  }
  for (const auto& options : { withGrid(0, 0), withGrid(8, 8) })
  {
    const Triangulation result = triangulate(view(xy), options);
    EXPECT_EQ(0u, result.triangleCount());
    EXPECT_TRUE(result.Duplicates.empty());
    EXPECT_TRUE(result.Rejected.empty());
  }
}

INSTANTIATE_TEST_SUITE_P(Lines, Flat,
  testing::Values(std::make_tuple(1.0, 0.0), std::make_tuple(0.0, 1.0), std::make_tuple(1.0, 3.0),
    std::make_tuple(-0.5, 0.25), std::make_tuple(0.0, 4.9406564584124654e-324)),
  [](const auto& info) { return std::to_string(info.index); });

TEST(SmallInputs, CopiesOfOnePointAreAllDuplicatesOfTheFirst)
{
  const Coordinates xy = makePointSet("all-equal", 100000);
  const Triangulation result = triangulate(view(xy));
  EXPECT_EQ(0u, result.triangleCount());
  ASSERT_EQ(99999u, result.Duplicates.size());
  for (std::size_t i = 0; i < result.Duplicates.size(); ++i)
  {
    ASSERT_EQ(PointId(i + 1), result.Duplicates[i].Point);
    ASSERT_EQ(0, result.Duplicates[i].Representative);
  }
}

TEST(SmallInputs, CollinearDuplicatesAreReported)
{
  Coordinates xy = makePointSet("collinear-in-order", 100);
  const Coordinates first(xy);
  xy.insert(xy.end(), first.begin(), first.end());
  EXPECT_TRUE(matches(xy, triangulate(view(xy)), reference(xy)));
}

TEST(SmallInputs, ZerosOfEitherSignAreEqual)
{
  const Coordinates xy{ -0.0, 0.0, 1, 0, 0, 1, 0.0, -0.0, 1, -0.0 };
  const Triangulation result = triangulate(view(xy));
  ASSERT_EQ(2u, result.Duplicates.size());
  EXPECT_EQ(0, result.Duplicates[0].Representative);
  EXPECT_EQ(1, result.Duplicates[1].Representative);
  EXPECT_EQ(1u, result.triangleCount());
}

TEST(SmallInputs, EachPointThatIsNotFiniteIsRejected)
{
  const double nan = std::nan("");
  const Coordinates xy{ nan, 0, 0, 0, HUGE_VAL, 1, 1, 0, 3, -HUGE_VAL, 0, 1, nan, nan };
  const Triangulation result = triangulate(view(xy));
  EXPECT_EQ((std::vector<PointId>{ 0, 2, 4, 6 }), result.Rejected);
  ASSERT_EQ(1u, result.triangleCount());
  EXPECT_EQ(canonical(1, 3, 5), trianglesOf(result).front());
}

TEST(SmallInputs, RejectedPointsHaveNoTriangles)
{
  const Coordinates xy(2000, std::nan(""));
  const Triangulation result = triangulate(view(xy));
  EXPECT_EQ(1000u, result.Rejected.size());
  EXPECT_EQ(0u, result.triangleCount());
}

TEST(SmallInputs, AcceptsMorePartitionsThanPoints)
{
  const Coordinates xy = makePointSet("uniform", 20);
  EXPECT_TRUE(matches(xy, triangulate(view(xy), withGrid(32, 32)), reference(xy)));
}

} // namespace
