// SPDX-License-Identifier: BSD-3-Clause
#include "InitialScene.h"

#include "Triangulation/Dataflow.h"
#include "Triangulation/InitialMesh.h"

#include <algorithm>
#include <random>

namespace
{

using namespace tipp;
using namespace tipp::test;

/// The triangulation of all points and of a tiling's artificial points. The smaller the partitions,
/// the closer the artificial points are to the hull.
struct Enclosed
{
  Enclosed(const Coordinates& xy, int side)
    : Boxes(Tiling::grid(boundsOf(xy), side, side))
    , Artificial(makeArtificialPoints(this->Boxes))
  {
    std::vector<BoundaryVertex> vertices = this->Artificial;
    const std::vector<Point2> points = asPoints(xy);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      vertices.push_back({ points[i], std::int64_t(i), this->Boxes.locate(points[i]) });
    }
    this->Final = listOf(triangulateVertices<2>(this->Boxes, vertices, 1));
  }

  Tiling Boxes;
  std::vector<BoundaryVertex> Artificial;
  std::vector<BoundaryTriangle> Final;
};

/// The triangulation after the artificial points have been removed.
Triangles repaired(
  const std::vector<BoundaryTriangle>& final, const std::vector<BoundaryVertex>& artificial)
{
  FinalBoundary<std::int64_t> boundary;
  for (const BoundaryTriangle& triangle : final)
  {
    boundary.add(triangle);
  }
  repairHull(std::move(boundary.HullVertices), artificial, boundary);
  Triangles triangles;
  for (const auto& triangle : boundary.Triangles)
  {
    triangles.push_back(canonical(triangle.Ids[0], triangle.Ids[1], triangle.Ids[2]));
  }
  return sorted(std::move(triangles));
}

testing::AssertionResult isRepaired(const Coordinates& xy, int side)
{
  const Enclosed scene(xy, side);
  return sameTriangles(xy, repaired(scene.Final, scene.Artificial), reference(xy).Mesh);
}

class HullOf : public testing::TestWithParam<std::string>
{
};

TEST_P(HullOf, IsCgalsWithoutArtificialPoints)
{
  const Coordinates xy = makePointSet(GetParam(), 300);
  for (const int side : { 1, 3, 20, 100 })
  {
    EXPECT_TRUE(isRepaired(xy, side)) << side << " x " << side << " partitions";
  }
}

INSTANTIATE_TEST_SUITE_P(PointSets, HullOf,
  testing::Values("uniform", "clustered", "lattice-shuffled", "lattice-tenths", "cocircular",
    "collinear-and-one", "survey-lines", "steps-at-1e12", "one-far-away", "two-clusters",
    "parabola", "spiral"),
  [](const auto& info)
  {
    std::string name = info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
  });

TEST(HullRepair, ThreePointsKeepTheirTriangle)
{
  for (const int side : { 1, 4, 64 })
  {
    EXPECT_TRUE(isRepaired({ 0, 0, 1, 0, 0.5, 1e-6 }, side));
  }
}

/// As long as artificial points exist, none of these triangles does.
TEST(HullRepair, AFlatHullIsFilled)
{
  Coordinates xy{ 0, 0, 1, 0 };
  for (int i = 1; i < 50; ++i)
  {
    const double x = i / 50.0;
    xy.insert(xy.end(), { x, 1e-9 * x * (1 - x) });
  }
  EXPECT_TRUE(isRepaired(xy, 64));
}

/// A few points of a 5 x 5 lattice. The artificial points lie on the same lattice, so many circles
/// through true points contain artificial ones.
TEST(HullRepair, ArtificialPointsOnACircleAreDecidedByTheTieRule)
{
  std::mt19937_64 random(6);
  for (int draw = 0; draw < 100; ++draw)
  {
    Coordinates xy{ 0, 0, 4, double(random() % 5), double(random() % 5), 4 };
    for (int i = 0; i < 25; ++i)
    {
      if (random() % 4 == 0)
      {
        xy.insert(xy.end(), { double(i % 5), double(i / 5) });
      }
    }
    ASSERT_TRUE(isRepaired(xy, 4)) << "draw " << draw;
  }
}

TEST(HullRepair, CollinearPointsAreLeftWithoutTriangles)
{
  Coordinates xy;
  for (int i = 0; i < 20; ++i)
  {
    xy.insert(xy.end(), { double(i), 2.0 * i });
  }
  Enclosed scene(xy, 3);
  ASSERT_FALSE(scene.Final.empty());
  EXPECT_TRUE(repaired(scene.Final, scene.Artificial).empty());
}

TEST(HullRepair, TrianglesOfTruePointsStay)
{
  Enclosed scene(makePointSet("uniform", 300), 4);
  Triangles before;
  for (const BoundaryTriangle& t : scene.Final)
  {
    if (!t[0].isArtificial() && !t[1].isArtificial() && !t[2].isArtificial())
    {
      before.push_back(canonical(t[0].Id, t[1].Id, t[2].Id));
    }
  }
  std::sort(before.begin(), before.end());
  const Triangles after = repaired(scene.Final, scene.Artificial);
  EXPECT_TRUE(std::includes(after.begin(), after.end(), before.begin(), before.end()));
}

/// As in a run without triangles at artificial points.
TEST(HullRepair, WithoutTrianglesAtArtificialPointsNothingChanges)
{
  const std::vector<BoundaryTriangle> final{ boundaryTriangle(1, 0, 0, 0),
    boundaryTriangle(4, 0, 0, 0) };
  EXPECT_EQ(2U, repaired(final, { BoundaryVertex{ { 9, 9 }, -1, 0 } }).size());
}

} // namespace
