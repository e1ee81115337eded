// SPDX-License-Identifier: BSD-3-Clause
// The regions of threads that insert points into one mesh.
#include "PointsInSpace.h"

#include "Kernel/VertexRegions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace
{

using namespace tipp;

/// Returns how many of the points each region has.
std::vector<std::size_t> countsOf(const std::vector<Point3>& points, int regions)
{
  std::vector<VertexRegions::Index> vertices(points.size());
  std::iota(vertices.begin(), vertices.end(), 0);
  const VertexRegions tree(points.data(), vertices, regions);
  std::vector<std::size_t> counts(std::size_t(regions), 0);
  for (const Point3& p : points)
  {
    ++counts.at(tree.of(p));
  }
  return counts;
}

} // namespace

TEST(VertexRegions, HaveAboutEqualNumbersOfVertices)
{
  for (const char* const kind : { "uniform", "clustered", "sphere" })
  {
    const auto points = test::pointsInSpace(kind, 20000, 1);
    for (const int regions : { 1, 2, 3, 7, 16 })
    {
      for (const std::size_t count : countsOf(points, regions))
      {
        EXPECT_NEAR(double(count), 20000.0 / regions, 4000.0 / regions) << kind << " " << regions;
      }
    }
  }
}

TEST(VertexRegions, PointsThatCoincideAreInOneRegion)
{
  const std::vector<std::size_t> counts = countsOf(std::vector<Point3>(5000, { 1, 2, 3 }), 4);
  EXPECT_EQ(*std::max_element(counts.begin(), counts.end()), 5000U);
}

TEST(VertexRegions, FewerVerticesThanRegionsAreDivided)
{
  const std::vector<std::size_t> counts = countsOf({ { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 } }, 8);
  EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), std::size_t(0)), 3U);
  EXPECT_EQ(*std::max_element(counts.begin(), counts.end()), 1U);
}
