// SPDX-License-Identifier: BSD-3-Clause
#include "GridMesh.h"
#include "Refinement/NodeOrder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace
{

using namespace tipp;
using tipp::test::GridMesh;

using Ids = std::vector<std::int64_t>;

Ids shuffled(std::size_t count)
{
  Ids ids(count);
  std::iota(ids.begin(), ids.end(), 0);
  std::shuffle(ids.begin(), ids.end(), std::mt19937(5)); // NOLINT(cert-msc51-cpp)
  return ids;
}

GridMesh withIds(GridMesh mesh, const Ids& newIds)
{
  for (std::int64_t& id : mesh.Triangles)
  {
    id = newIds[std::size_t(id)];
  }
  return mesh;
}

TEST(NodeOrder, BandwidthOfAShuffledGridFallsToThatOfItsShorterSide)
{
  const GridMesh mesh = withIds(GridMesh(60, 12), shuffled(61 * 13));
  const Ids order = reverseCuthillMcKee(mesh.nodes(), mesh.view());
  EXPECT_TRUE(std::is_permutation(order.begin(), order.end(), shuffled(mesh.nodes()).begin()));
  EXPECT_GT(bandwidthOf(mesh.view()), 600);
  // Two adjacent levels around a corner have up to three times the nodes of a shorter side.
  EXPECT_LE(bandwidthOf(mesh.view(), order), 3 * 13);
}

TEST(NodeOrder, BandwidthIsReportedAsItIsOnceApplied)
{
  const GridMesh mesh = withIds(GridMesh(9, 7), shuffled(80));
  const Ids order = reverseCuthillMcKee(mesh.nodes(), mesh.view());
  PointTable points;
  points.XY = mesh.XY;
  points.Columns = { { "x", {} } };
  for (std::size_t i = 0; i < mesh.nodes(); ++i)
  {
    points.Columns[0].Values.push_back(mesh.XY[2 * i]);
  }
  Buffer<std::int32_t> triangles(mesh.Triangles.size());
  std::copy(mesh.Triangles.begin(), mesh.Triangles.end(), triangles.begin());
  applyNodeOrder(order, points, triangles);
  const TrianglesView view(triangles.data(), triangles.size() / 3);
  EXPECT_EQ(bandwidthOf(mesh.view(), order), bandwidthOf(view));
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    const auto before = std::size_t(mesh.Triangles[i]);
    const auto after = std::size_t(triangles[i]);
    EXPECT_EQ(mesh.XY[2 * before], points.XY[2 * after]);
    EXPECT_EQ(mesh.XY[2 * before + 1], points.XY[2 * after + 1]);
    EXPECT_EQ(points.XY[2 * after], points.Columns[0].Values[after]);
  }
}

TEST(NodeOrder, EveryComponentAndUnusedNodeIsOrdered)
{
  // Two triangles apart, and node 3 without any.
  const Ids triangles{ 0, 2, 5, 1, 6, 4 };
  const Ids order = reverseCuthillMcKee(7, { triangles.data(), 2 });
  EXPECT_EQ((Ids{ 3, 6, 4, 1, 5, 2, 0 }), order);
  EXPECT_EQ(2, bandwidthOf({ triangles.data(), 2 }, order));
}

TEST(NodeOrder, InverseTellsTheNewIndex)
{
  EXPECT_EQ((Ids{ 2, 0, 1 }), inverseOrder({ 1, 2, 0 }));
}

TEST(NodeOrder, AMeshWithoutTrianglesHasNoBandwidth)
{
  EXPECT_EQ(0, bandwidthOf(TrianglesView()));
  EXPECT_TRUE(reverseCuthillMcKee(0, {}).empty());
}

TEST(NodeOrder, TrianglesWithNarrowIdsGiveTheSameOrder)
{
  const GridMesh mesh = withIds(GridMesh(20, 5), shuffled(21 * 6));
  const std::vector<std::int32_t> narrow(mesh.Triangles.begin(), mesh.Triangles.end());
  EXPECT_EQ(reverseCuthillMcKee(mesh.nodes(), mesh.view()),
    reverseCuthillMcKee(mesh.nodes(), { narrow.data(), narrow.size() / 3 }));
}

} // namespace
