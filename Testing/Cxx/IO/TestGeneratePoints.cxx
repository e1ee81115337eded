// SPDX-License-Identifier: BSD-3-Clause
#include "Distributions/GeneratePoints.h"

#include <gtest/gtest.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>
#include <set>
#include <stdexcept>
#include <utility>

namespace
{

using tipp::Distribution;
using tipp::generatePoints;

std::set<std::pair<double, double>> distinct(const std::vector<double>& xy)
{
  std::set<std::pair<double, double>> points;
  for (std::size_t i = 0; i < xy.size(); i += 2)
  {
    points.insert({ xy[i], xy[i + 1] });
  }
  return points;
}

// The fraction of the points in the 100 fullest cells of a 100 x 100 grid.
double crowding(const std::vector<double>& xy)
{
  double low = xy[0];
  double high = xy[0];
  for (const double value : xy)
  {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  const auto cell = [&](double value) { return int(99.999 * (value - low) / (high - low)); };
  std::map<std::pair<int, int>, std::size_t> counts;
  for (std::size_t i = 0; i < xy.size(); i += 2)
  {
    ++counts[{ cell(xy[i]), cell(xy[i + 1]) }];
  }
  std::vector<std::size_t> sorted;
  for (const auto& [where, count] : counts)
  {
    sorted.push_back(count);
  }
  std::sort(sorted.rbegin(), sorted.rend());
  std::size_t sum = 0;
  for (std::size_t i = 0; i < std::min<std::size_t>(100, sorted.size()); ++i)
  {
    sum += sorted[i];
  }
  return double(sum) / double(xy.size() / 2);
}

struct Checksum
{
  const char* Name;
  XXH64_hash_t Value;
};

// CTest shows this name for the test.
std::ostream& operator<<(std::ostream& stream, const Checksum& checksum)
{
  return stream << checksum.Name;
}

class EveryDistribution : public testing::TestWithParam<Checksum>
{
protected:
  Distribution distribution() const { return *tipp::distributionFromName(GetParam().Name); }
};

} // namespace

TEST_P(EveryDistribution, FirstThousandPointsAreTheSameEverywhere)
{
  const std::vector<double> xy = generatePoints(this->distribution(), 1000, 42);
  ASSERT_EQ(2000U, xy.size());
  EXPECT_EQ(GetParam().Value, XXH64(xy.data(), xy.size() * sizeof(double), 0));
}

TEST_P(EveryDistribution, HasExactlyTheRequestedNumberOfFinitePoints)
{
  for (const std::int64_t count : { 0, 1, 2, 3, 10, 99, 12345 })
  {
    const std::vector<double> xy = generatePoints(this->distribution(), count, 7);
    EXPECT_EQ(2 * std::size_t(count), xy.size());
    EXPECT_TRUE(std::all_of(xy.begin(), xy.end(), [](double v) { return std::isfinite(v); }));
  }
}

TEST_P(EveryDistribution, AnotherSeedGivesOtherPointsUnlessItIsTheLattice)
{
  const std::vector<double> first = generatePoints(this->distribution(), 100, 1);
  const std::vector<double> second = generatePoints(this->distribution(), 100, 2);
  EXPECT_EQ(this->distribution() == Distribution::Lattice, first == second);
}

INSTANTIATE_TEST_SUITE_P(GeneratePoints, EveryDistribution,
  testing::Values(Checksum{ "uniform", 0xde25ea7aeb4185ae },
    Checksum{ "clustered", 0xeb7d3693abc3e7ee }, Checksum{ "kuzmin", 0x72ce177a413e5370 },
    Checksum{ "lattice", 0x2abe99114a35848d }, Checksum{ "coast", 0x23fc7f9049d8ba12 },
    Checksum{ "circle", 0xd29e196bac8980b6 }, Checksum{ "collinear", 0xd478fcba3f7273ad }),
  [](const auto& info) { return std::string(info.param.Name); });

TEST(GeneratePoints, UniformFillsTheUnitSquareEvenly)
{
  const std::vector<double> xy = generatePoints(Distribution::Uniform, 40000, 3);
  std::size_t counts[16] = {};
  for (std::size_t i = 0; i < xy.size(); i += 2)
  {
    ASSERT_TRUE(xy[i] >= 0 && xy[i] < 1 && xy[i + 1] >= 0 && xy[i + 1] < 1);
    ++counts[4 * int(4 * xy[i]) + int(4 * xy[i + 1])];
  }
  for (const std::size_t count : counts)
  {
    EXPECT_NEAR(2500, double(count), 250); // five standard deviations
  }
}

TEST(GeneratePoints, ClusteredCrowdsWhereUniformDoesNot)
{
  EXPECT_LT(crowding(generatePoints(Distribution::Uniform, 100000, 3)), 0.02);
  EXPECT_GT(crowding(generatePoints(Distribution::Clustered, 100000, 3)), 0.5);
}

TEST(GeneratePoints, KuzminHalfMassRadiusIsTheSquareRootOfThree)
{
  const std::vector<double> xy = generatePoints(Distribution::Kuzmin, 40000, 3);
  std::size_t inside = 0;
  for (std::size_t i = 0; i < xy.size(); i += 2)
  {
    inside += std::hypot(xy[i], xy[i + 1]) < std::sqrt(3.0) ? 1 : 0;
  }
  EXPECT_NEAR(20000, double(inside), 500); // five standard deviations
}

TEST(GeneratePoints, LatticeGoesRowByRowAndItsLastRowMayBeShort)
{
  const std::vector<double> xy = generatePoints(Distribution::Lattice, 7, 0);
  EXPECT_EQ((std::vector<double>{ 0, 0, 1, 0, 2, 0, 0, 1, 1, 1, 2, 1, 0, 2 }), xy);
}

TEST(GeneratePoints, LatticeOfASquareNumberIsSquare)
{
  const std::vector<double> xy = generatePoints(Distribution::Lattice, 10000, 0);
  EXPECT_EQ(99, *std::max_element(xy.begin(), xy.end()));
  EXPECT_EQ(10000U, distinct(xy).size());
}

TEST(GeneratePoints, CoastIsMoreUnevenThanClustersAtEveryLevel)
{
  const std::vector<double> xy = generatePoints(Distribution::Coast, 100000, 3);
  EXPECT_GT(crowding(xy), 0.4);
  // Distances between consecutive points of the shore differ by orders of magnitude.
  std::vector<double> steps;
  for (std::size_t i = 2; i < xy.size(); i += 2)
  {
    steps.push_back(std::hypot(xy[i] - xy[i - 2], xy[i + 1] - xy[i - 1]));
  }
  std::sort(steps.begin(), steps.end());
  EXPECT_GT(steps[steps.size() * 99 / 100], 50 * steps[steps.size() / 100]);
}

TEST(GeneratePoints, CoastHasSixDecimalsAndAFewDuplicates)
{
  const std::vector<double> xy = generatePoints(Distribution::Coast, 1000000, 1);
  for (const double value : xy)
  {
    ASSERT_EQ(value, std::round(value * 1e6) / 1e6);
  }
  const std::size_t duplicates = 1000000 - distinct(xy).size();
  EXPECT_GT(duplicates, 0U);
  EXPECT_LT(duplicates, 50000U);
}

TEST(GeneratePoints, CirclePointsLieOnItToRounding)
{
  const std::vector<double> xy = generatePoints(Distribution::Circle, 1000, 3);
  for (std::size_t i = 0; i < xy.size(); i += 2)
  {
    EXPECT_NEAR(1, xy[i] * xy[i] + xy[i + 1] * xy[i + 1], 1e-15);
  }
  EXPECT_EQ(1000U, distinct(xy).size());
}

TEST(GeneratePoints, CollinearIsExactAndDistinct)
{
  const std::vector<double> xy = generatePoints(Distribution::Collinear, 100000, 3);
  double dx = 0;
  double dy = 0;
  for (std::size_t i = 0; i < xy.size(); i += 2)
  {
    if (xy[i] > 0 && (dx == 0 || xy[i] < dx))
    {
      dx = xy[i];
      dy = xy[i + 1];
    }
  }
  for (std::size_t i = 0; i < xy.size(); i += 2)
  {
    ASSERT_EQ(std::floor(xy[i]), xy[i]);
    ASSERT_EQ(xy[i] * dy, xy[i + 1] * dx); // integers below 2^53
  }
  EXPECT_GT(dy, 0);
  EXPECT_EQ(100000U, distinct(xy).size());
}

TEST(GeneratePoints, NegativeAndAbsurdCountsAreRefused)
{
  EXPECT_THROW(generatePoints(Distribution::Uniform, -1, 0), std::invalid_argument);
  EXPECT_THROW(
    generatePoints(Distribution::Uniform, std::int64_t(1) << 41, 0), std::invalid_argument);
}

TEST(GeneratePoints, UnknownNameIsNoDistribution)
{
  EXPECT_FALSE(tipp::distributionFromName("gaussian"));
}
