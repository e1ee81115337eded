// SPDX-License-Identifier: BSD-3-Clause
#include "InMemory/TriangulatePoints.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace
{

using Pairs = std::vector<std::pair<tipp::PointId, tipp::PointId>>;

Pairs mergedPairs(const std::vector<double>& xy, double distance)
{
  Pairs pairs;
  const auto merged =
    tipp::triangulateMerged(tipp::PointsView(xy.data(), xy.size() / 2, 2), distance);
  for (const tipp::Duplicate& d : merged.Duplicates)
  {
    pairs.emplace_back(d.Point, d.Representative);
  }
  return pairs;
}

Pairs mergedByComparingAll(const std::vector<double>& xy, double distance)
{
  Pairs pairs;
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < xy.size() / 2; ++i)
  {
    bool merged = false;
    for (std::size_t k = 0; k < kept.size() && !merged; ++k)
    {
      const std::size_t j = kept[k];
      if (std::hypot(xy[2 * i] - xy[2 * j], xy[2 * i + 1] - xy[2 * j + 1]) <= distance)
      {
        pairs.emplace_back(i, j);
        merged = true;
      }
    }
    if (!merged)
    {
      kept.push_back(i);
    }
  }
  return pairs;
}

std::vector<double> randomCoordinates(int points, double scale, double shift)
{
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<double> xy(2 * std::size_t(points));
  for (double& x : xy)
  {
    x = shift + scale * uniform(generator);
  }
  return xy;
}

} // namespace

TEST(MergeClosePoints, ResultEqualsAComparisonOfAllPairs)
{
  const double scales[][2] = { { 1, 0 }, { 1, -1e3 }, { 1e-200, 0 }, { 1e200, 0 }, { 1, 1e13 } };
  for (const auto& [scale, shift] : scales)
  {
    const auto xy = randomCoordinates(1500, scale, shift);
    for (double fraction : { 1e-6, 0.01, 0.05, 0.3, 3.0 })
    {
      EXPECT_EQ(mergedByComparingAll(xy, fraction * scale), mergedPairs(xy, fraction * scale))
        << scale << " " << shift << " " << fraction;
    }
  }
}

TEST(MergeClosePoints, PointsExactlyAsFarAsTheDistanceAreMerged)
{
  // Points on a line at multiples of the distance: every second one is merged.
  std::vector<double> xy;
  for (int i = -20; i < 20; ++i)
  {
    xy.insert(xy.end(), { 0.375 * i, 0 });
  }
  EXPECT_EQ(20u, mergedPairs(xy, 0.375).size());
  EXPECT_EQ(0u, mergedPairs(xy, std::nextafter(0.375, 0)).size());
}

TEST(MergeClosePoints, DistanceZeroMergesEqualPointsOnly)
{
  EXPECT_EQ((Pairs{ { 2, 0 } }), mergedPairs({ 0, 0, 5e-324, 0, 0, -0.0 }, 0));
}

TEST(MergeClosePoints, ProgressCanStopIt)
{
  const auto xy = randomCoordinates(10, 1, 0);
  tipp::TriangulationOptions options;
  options.Progress = [](double) { return false; };
  const auto merged = tipp::triangulateMerged(tipp::PointsView(xy.data(), 10, 2), 0.1, options);
  EXPECT_TRUE(merged.Aborted);
}
