// SPDX-License-Identifier: BSD-3-Clause
#include "Series/ChosenTriangles.h"
#include "Series/PointCounts.h"
#include "Series/SampleBoxes.h"

#include "Resample/ClaimSamples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace
{

using namespace tipp;

/// A strip of squares of side 1 along x, each of two triangles, whose cells are the squares.
class Strip : public MeshSeries
{
public:
  explicit Strip(std::int64_t squares)
    : Squares(squares)
  {
    this->Path = "strip";
  }

  SeriesMesh readMesh() override { return {}; }
  void read(std::size_t, std::size_t, std::vector<double>&) override {}

  SeriesNodes readTriangles(const TakeTriangles& take) override
  {
    SeriesNodes nodes;
    for (std::int64_t i = 0; i <= this->Squares; ++i)
    {
      nodes.add({ double(i), 0, double(i), 1 });
    }
    for (std::int64_t i = 0; i < this->Squares; ++i)
    {
      const std::int64_t a = 2 * i;
      take(nodes, { { a, a + 2, a + 1, a + 2, a + 3, a + 1 }, i, { i, i } });
    }
    return nodes;
  }

  const std::int64_t Squares;
};

Box2 boxOf(const double (&points)[9])
{
  Box2 box = Box2::empty();
  for (std::size_t i = 0; i < 9; i += 3)
  {
    box.extend(Point2{ points[i], points[i + 1] });
  }
  return box;
}

} // namespace

TEST(SampleBoxes, HoldTheSamplesThatTrianglesClaim)
{
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> any(0, 1);
  const std::int32_t ids[3] = { 0, 1, 2 };
  int claiming = 0;
  for (int round = 0; round < 20000; ++round)
  {
    const double origin = round % 3 == 0 ? 5e6 : 0;
    const double size = round % 2 == 0 ? 0.4 : 0.05;
    Lattice lattice;
    lattice.Min = { origin, origin, 0 };
    lattice.Delta = { 0.1, round % 5 == 0 ? 0.03 : 0.1, 1 };
    lattice.Extent = { 0, 10, 2, 12, 0, 0 };
    lattice.Slack = { round % 4 == 0 ? 0.01 : 0, round % 8 == 0 ? 0.02 : 0, 0 };
    double points[9] = {};
    const double x = any(generator);
    const double y = any(generator);
    for (std::size_t i = 0; i < 9; i += 3)
    {
      points[i] = origin + x + size * any(generator);
      points[i + 1] = origin + y + size * any(generator);
    }
    SimplexMesh mesh;
    mesh.Points = points;
    mesh.PointCount = 3;
    mesh.Ids = ids;
    mesh.Cells = 1;
    const Claims claims = claimSamples(mesh, lattice, 1);
    const std::int32_t* const cells = claims.Cells.get();
    if (std::any_of(cells, cells + lattice.samples(), [](std::int32_t cell) { return cell >= 0; }))
    {
      ++claiming;
      ASSERT_TRUE(SampleBoxes(lattice).mayHoldSamples(boxOf(points))) << round;
    }
  }
  EXPECT_GT(claiming, 1000);
}

TEST(SampleBoxes, HoldNoSampleBetweenThem)
{
  Lattice lattice;
  lattice.Extent = { 0, 9, 0, 9, 0, 0 };
  const SampleBoxes boxes(lattice);
  EXPECT_FALSE(boxes.mayHoldSamples({ { 2.1, 2.1 }, { 2.9, 3.5 } }));
  EXPECT_FALSE(boxes.mayHoldSamples({ { 1.5, 2.1 }, { 2.5, 2.9 } }));
  EXPECT_FALSE(boxes.mayHoldSamples({ { -5, 2 }, { -1, 3 } }));
  EXPECT_FALSE(boxes.mayHoldSamples({ { 2, 9.5 }, { 3, 30 } }));
  EXPECT_TRUE(boxes.mayHoldSamples({ { 2, 2.5 }, { 2, 3 } }));
  EXPECT_TRUE(boxes.mayHoldSamples({ { -5, -5 }, { 50, 50 } }));
}

TEST(PointCounts, FindTheBoxesThatHoldPoints)
{
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> any(-100, 300);
  std::vector<Point3> points;
  for (int i = 0; i < 30; ++i)
  {
    points.push_back({ any(generator), any(generator), 0 });
  }
  points.push_back({ HUGE_VAL, 0, 0 });
  const PointCounts counts(points);
  int empty = 0;
  for (int round = 0; round < 5000; ++round)
  {
    Box2 box = Box2::empty();
    const Point2 corner{ any(generator), any(generator) };
    box.extend(corner);
    box.extend(Point2{ corner.x + 20, corner.y + 15 });
    const bool holds = std::any_of(points.begin(), points.end(),
      [&box](const Point3& p) {
        return box.contains(Point2{ p.x, p.y });
      });
    ASSERT_TRUE(counts.mayHold(box) || !holds);
    empty += !counts.mayHold(box);
  }
  EXPECT_GT(empty, 3000);
  EXPECT_FALSE(PointCounts({}).mayHold({ { 0, 0 }, { 1, 1 } }));
}

TEST(ChosenTriangles, HaveTheirOwnNodesAlone)
{
  Strip strip(1000);
  const ChosenTriangles chosen(
    strip,
    [](const SeriesNodes&) -> ChosenTriangles::Test
    { return [](const Box2& box) { return box.Min.x == 500 || box.Min.x == 700; }; },
    2);
  EXPECT_EQ(0, chosen.bounds().Min.x);
  EXPECT_EQ(1000, chosen.bounds().Max.x);
  const SimplexMesh mesh = chosen.mesh();
  ASSERT_EQ(4, mesh.Cells);
  ASSERT_EQ(8, mesh.PointCount);
  EXPECT_EQ(700, static_cast<const double*>(mesh.Points)[12]);
  EXPECT_EQ(1000, chosen.indexOf(0));
  EXPECT_EQ(1401, chosen.indexOf(3));
  EXPECT_EQ((std::vector<std::int32_t>{ 1000, 1400 }), chosen.storedNodes({ 0, 4 }).At);
  EXPECT_EQ((std::vector<std::int32_t>{ 500, 500, 700 }), chosen.storedCells({ 0, 1, 2 }));
}

TEST(ChosenTriangles, OfNoneHaveANode)
{
  Strip strip(3);
  const ChosenTriangles chosen(
    strip,
    [](const SeriesNodes&) -> ChosenTriangles::Test { return [](const Box2&) { return false; }; },
    1);
  EXPECT_EQ(0, chosen.mesh().Cells);
  EXPECT_EQ(1, chosen.mesh().PointCount);
}
