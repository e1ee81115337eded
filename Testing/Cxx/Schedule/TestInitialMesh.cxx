// SPDX-License-Identifier: BSD-3-Clause
#include "InitialScene.h"
#include "Triangulation/InitialMesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace
{

using namespace tipp;
using namespace tipp::test;

Box2 frameOf(const std::vector<BoundaryVertex>& vertices)
{
  Coordinates xy;
  for (const BoundaryVertex& v : vertices)
  {
    xy.insert(xy.end(), { v.Position.x, v.Position.y });
  }
  return test::boundsOf(xy);
}

const Box2 Domains[] = { { 0, 0, 1, 1 }, { -5, 3, 900, 4 },
  { 1e12, 1e12, 1e12 + 0x1p-12, 1e12 + 1 }, { 1e12, -1e12, 1e12 + 0x1p-13, -1e12 + 0x1p-13 },
  { 0, 0, 1e-300, 1e-300 }, { 0, 0, 0, 1 }, { -1e300, -1e300, 1e300, 1e300 },
  { 0, 0, 4.9406564584124654e-324, 4.9406564584124654e-324 } };

TEST(ArtificialPoints, EncloseTheDomainStrictly)
{
  for (const Box2& domain : Domains)
  {
    for (const int side : { 1, 2, 16 })
    {
      const Box2 frame = frameOf(makeArtificialPoints(Tiling::grid(domain, side, side)));
      EXPECT_LT(frame.Min.x, domain.Min.x);
      EXPECT_LT(frame.Min.y, domain.Min.y);
      EXPECT_GT(frame.Max.x, domain.Max.x);
      EXPECT_GT(frame.Max.y, domain.Max.y);
    }
  }
}

/// The rectangle is then the convex hull of the artificial points.
TEST(ArtificialPoints, StandAtTheRectanglesCorners)
{
  for (const Box2& domain : Domains)
  {
    const std::vector<BoundaryVertex> points = makeArtificialPoints(Tiling::grid(domain, 4, 4));
    const Box2 frame = frameOf(points);
    for (const Point2 corner :
      { Point2{ frame.Min.x, frame.Min.y }, Point2{ frame.Max.x, frame.Min.y },
        Point2{ frame.Min.x, frame.Max.y }, Point2{ frame.Max.x, frame.Max.y } })
    {
      EXPECT_TRUE(std::any_of(points.begin(), points.end(),
        [&](const BoundaryVertex& v) { return v.Position == corner; }));
    }
  }
}

TEST(ArtificialPoints, NoneIsInsideTheRectangle)
{
  for (const Box2& domain : Domains)
  {
    const std::vector<BoundaryVertex> points = makeArtificialPoints(Tiling::grid(domain, 4, 4));
    const Box2 frame = frameOf(points);
    for (const BoundaryVertex& v : points)
    {
      EXPECT_TRUE(v.Position.x == frame.Min.x || v.Position.x == frame.Max.x ||
        v.Position.y == frame.Min.y || v.Position.y == frame.Max.y);
    }
  }
}

TEST(ArtificialPoints, IdsAreNegativeAndUnique)
{
  for (const Box2& domain : Domains)
  {
    const std::vector<BoundaryVertex> points = makeArtificialPoints(Tiling::grid(domain, 8, 8));
    std::set<std::int64_t> ids;
    for (const BoundaryVertex& v : points)
    {
      EXPECT_TRUE(v.isArtificial());
      ids.insert(v.Id);
    }
    EXPECT_EQ(points.size(), ids.size());
    EXPECT_EQ(-1, *ids.rbegin());
  }
}

TEST(ArtificialPoints, StandAsFarApartAsPartitionsAreWide)
{
  const std::vector<BoundaryVertex> points =
    makeArtificialPoints(Tiling::grid({ 0, 0, 8, 8 }, 8, 8));
  // One point per unit of length around a square of side 10.
  EXPECT_EQ(40U, points.size());
}

TEST(ArtificialPoints, ThereAreNoneIfCoordinatesWouldOverflow)
{
  EXPECT_TRUE(
    makeArtificialPoints(Tiling::grid({ -1.7e308, -1.7e308, 1.7e308, 1.7e308 }, 4, 4)).empty());
}

template <typename Id>
class InitialPoints : public testing::Test
{
};

TYPED_TEST_SUITE(InitialPoints, IdTypes, IdNames);

/// 100 points in the left half, 3 in the upper right quarter, none in the lower right quarter.
Coordinates unevenPoints()
{
  Coordinates xy;
  for (int i = 0; i < 100; ++i)
  {
    xy.insert(xy.end(), { 0.01 + 0.004 * i, i % 2 ? 0.25 : 0.75 });
  }
  xy.insert(xy.end(), { 0.6, 0.6, 0.7, 0.9, 0.8, 0.7 });
  return xy;
}

TYPED_TEST(InitialPoints, AreEightPerPartitionOrAllIfThereAreFewer)
{
  const Coordinates xy = unevenPoints();
  const Tiling tiling = Tiling::grid({ 0, 0, 1, 1 }, 2, 2);
  auto buckets = bucketPoints<TypeParam>(view(xy), tiling, 1);
  std::vector<int> counts(4, 0);
  for (const BoundaryVertex& v : chooseInitialPoints(tiling, buckets, 8, 1))
  {
    ++counts[std::size_t(v.Partition)];
  }
  EXPECT_EQ(8, counts[std::size_t(tiling.locate({ 0.2, 0.25 }))]);
  EXPECT_EQ(8, counts[std::size_t(tiling.locate({ 0.2, 0.75 }))]);
  EXPECT_EQ(3, counts[std::size_t(tiling.locate({ 0.7, 0.7 }))]);
  EXPECT_EQ(0, counts[std::size_t(tiling.locate({ 0.7, 0.2 }))]);
}

TYPED_TEST(InitialPoints, AreInputPointsEachChosenOnce)
{
  const Coordinates xy = unevenPoints();
  const std::vector<Point2> points = asPoints(xy);
  const Tiling tiling = Tiling::grid({ 0, 0, 1, 1 }, 2, 2);
  auto buckets = bucketPoints<TypeParam>(view(xy), tiling, 1);
  for (const int perPartition : { 1, 7, 49, 50, 1000 })
  {
    std::set<std::int64_t> ids;
    for (const BoundaryVertex& v : chooseInitialPoints(tiling, buckets, perPartition, 1))
    {
      ASSERT_LE(0, v.Id);
      EXPECT_EQ(points[std::size_t(v.Id)], v.Position);
      EXPECT_EQ(tiling.locate(v.Position), v.Partition);
      EXPECT_TRUE(ids.insert(v.Id).second);
    }
    EXPECT_EQ(std::size_t(2 * std::min(perPartition, 50) + std::min(perPartition, 3)), ids.size());
  }
}

TYPED_TEST(InitialPoints, AreSpreadOverTheInputsOrder)
{
  const Coordinates xy = unevenPoints();
  const Tiling tiling = Tiling::grid({ 0, 0, 1, 1 }, 2, 1);
  auto buckets = bucketPoints<TypeParam>(view(xy), tiling, 1);
  const std::vector<BoundaryVertex> chosen = chooseInitialPoints(tiling, buckets, 4, 1);
  for (std::int64_t i = 0; i < 4; ++i)
  {
    EXPECT_EQ(12 + 25 * i, chosen[std::size_t(i)].Id);
  }
}

TYPED_TEST(InitialPoints, IncludeTheOutermostPointsOfEachPartition)
{
  const Coordinates xy = makePointSet("clustered", 2000);
  const Tiling tiling = Tiling::grid(test::boundsOf(xy), 3, 3);
  auto buckets = bucketPoints<TypeParam>(view(xy), tiling, 1);
  const Regions regions(tiling, buckets, 1);
  std::map<PartitionIndex, Box2> reached;
  for (const BoundaryVertex& v : chooseInitialPoints(tiling, buckets, 8, 2))
  {
    reached.emplace(v.Partition, Box2::empty()).first->second.extend(v.Position);
  }
  for (const auto& [partition, box] : reached)
  {
    const Box2& region = regions[partition];
    EXPECT_TRUE(box.Min == region.Min && box.Max == region.Max) << partition;
  }
}

TEST(InitialMesh, IsTheDelaunayTriangulationOfItsVertices)
{
  const InitialScene scene("clustered", 2000, 5, 5);
  Coordinates xy;
  Ids all;
  for (const BoundaryVertex& v : scene.Vertices)
  {
    all.push_back(std::int64_t(xy.size() / 2));
    xy.insert(xy.end(), { v.Position.x, v.Position.y });
  }
  std::vector<BoundaryVertex> numbered = scene.Vertices;
  for (std::size_t i = 0; i < numbered.size(); ++i)
  {
    numbered[i].Id = std::int64_t(i);
  }
  for (const int threads : { 1, 2, 5 })
  {
    EXPECT_TRUE(sameTriangles(xy,
      idsOf(listOf(triangulateVertices<2>(scene.Boxes, numbered, threads))), delaunay(xy, all)));
  }
}

TEST(InitialMesh, IsInTheSameOrderForAnyNumberOfThreads)
{
  const InitialScene scene("uniform", 1000, 4, 4);
  const BoundaryTriangles more = triangulateVertices<2>(scene.Boxes, scene.Vertices, 3);
  ASSERT_EQ(scene.Mesh.size(), more.size());
  for (std::size_t i = 0; i < more.size(); ++i)
  {
    EXPECT_EQ(scene.Mesh[i][0].Id, more[i][0].Id);
    EXPECT_TRUE(
      std::equal(scene.Mesh.metBegin(i), scene.Mesh.metEnd(i), more.metBegin(i), more.metEnd(i)));
  }
}

/// Without such triangles, a partition's worker would start without vertices around it.
TEST(InitialMesh, EveryPartitionHasTrianglesThatBelongToIt)
{
  const InitialScene scene("one-far-away", 500, 6, 6);
  for (PartitionIndex p = 0; p < scene.Boxes.size(); ++p)
  {
    bool isMet = false;
    for (std::size_t i = 0; i < scene.Mesh.size(); ++i)
    {
      isMet = isMet || std::count(scene.Mesh.metBegin(i), scene.Mesh.metEnd(i), p) > 0;
    }
    EXPECT_TRUE(isMet) << "partition " << p;
  }
}

TEST(InitialMesh, EqualInitialPointsAreOneVertex)
{
  const Tiling tiling = Tiling::grid({ 0, 0, 1, 1 }, 2, 2);
  std::vector<BoundaryVertex> vertices = makeArtificialPoints(tiling);
  const std::size_t artificial = vertices.size();
  for (std::int64_t id = 0; id < 5; ++id)
  {
    vertices.push_back({ { 0.2, 0.3 }, id, 0 });
  }
  std::set<std::int64_t> used;
  for (const BoundaryTriangle& t : listOf(triangulateVertices<2>(tiling, vertices, 1)))
  {
    used.insert({ t[0].Id, t[1].Id, t[2].Id });
  }
  EXPECT_EQ(artificial + 1, used.size());
}

/// The initial mesh of eight partitions with equal numbers of points.
BoundaryTriangles initialMeshOfEight(const std::string& set)
{
  const Coordinates xy = makePointSet(set, 40'000);
  const PointsView points = view(xy);
  const Tiling tiling = Tiling::balanced(test::boundsOf(xy), samplePoints(points, 8000), 8);
  std::vector<BoundaryVertex> vertices =
    chooseInitialPoints(tiling, bucketPoints<std::int32_t>(points, tiling, 1), 8, 1);
  const std::vector<BoundaryVertex> artificial = makeArtificialPoints(tiling);
  vertices.insert(vertices.end(), artificial.begin(), artificial.end());
  return triangulateVertices<2>(tiling, vertices, 1);
}

TEST(PartitionsPay, ForPointsSpreadOverAnArea)
{
  for (const char* set :
    { "uniform", "clustered", "coast", "kuzmin", "lattice", "two-clusters", "spiral" })
  {
    EXPECT_TRUE(partitionsPay(initialMeshOfEight(set))) << set;
  }
}

TEST(PartitionsPay, NotForPointsOnACurve)
{
  for (const char* set : { "circle", "parabola", "collinear-and-one" })
  {
    EXPECT_FALSE(partitionsPay(initialMeshOfEight(set))) << set;
  }
}

} // namespace
