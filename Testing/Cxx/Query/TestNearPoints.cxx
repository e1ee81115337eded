// SPDX-License-Identifier: BSD-3-Clause
#include "QueryTesting.h"

#include "Locate/CellLocator.h"
#include "Locate/PointGrid.h"
#include "Locate/PointsInBox.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

using namespace tipp;
using namespace tipp::test;

namespace
{

/// Points in a part of the mesh that is divided among several pieces.
std::vector<Point3> pointsInCorner(const SourceMesh& source, std::size_t most)
{
  std::vector<Point3> points;
  for (const Point3& p : pointsAround(source, 400))
  {
    if (p.x > 0.4 && p.x < 0.6 && p.y > 0.4 && p.y < 0.6 && points.size() < most)
    {
      points.push_back(p);
    }
  }
  return points;
}

AnswerOptions allArrays(const ResidentMesh& mesh)
{
  AnswerOptions options;
  options.Arrays = mesh.names();
  options.Weights = true;
  return options;
}

template <int D>
void expectGridFindsAll(const std::vector<Point<D>>& points, const std::vector<Point<D>>& corners)
{
  const PointGrid<D> grid(
    std::int64_t(points.size()), 1, [&](std::int64_t i) { return points[std::size_t(i)]; });
  int passedOver = 0;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i)
  {
    const Box<D> box = Box<D>::of(corners[i], corners[i + 1]);
    const auto low = grid.position(box.Min);
    const auto high = grid.position(box.Max);
    const bool mayHold = grid.mayHold(low, high);
    passedOver += mayHold ? 0 : 1;
    const bool holds = std::any_of(
      points.begin(), points.end(), [&box](const auto& point) { return box.contains(point); });
    EXPECT_TRUE(mayHold || !holds);
  }
  EXPECT_LT(0, passedOver);
}

NearCell triangle(std::int64_t id, const Point3 (&corners)[3], const Point3& from)
{
  NearCell cell;
  cell.Id = id;
  std::copy_n(corners, 3, cell.Corners);
  cell.measure(from);
  return cell;
}

/// Expects the same cells and weights from a locator and from a pass over the cells.
void expectAsByLocator(const MeshPart& part, const std::vector<Point3>& points)
{
  const AskedPoints asked = { points.data(), nullptr, std::int64_t(points.size()) };
  const auto located = [&](const std::function<void(const TakeLocations&)>& locate)
  {
    std::vector<CellLocation> found(points.size());
    locate(
      [&found](const std::int64_t* indices, const CellLocation* at, std::int64_t count)
      {
        for (std::int64_t i = 0; i < count; ++i)
        {
          found[std::size_t(indices[i])] = at[i];
        }
      });
    return found;
  };
  const CellLocator locator(part.Mesh, part.CellIds, 1);
  const std::vector<CellLocation> expected = located([&](const TakeLocations& take)
    { locatePoints(part.Mesh, part.CellIds, &locator, asked, 1, take); });
  for (const int threads : { 1, 3 })
  {
    const std::vector<CellLocation> found = located([&](const TakeLocations& take)
      { EXPECT_TRUE(locateInOnePass(part.Mesh, part.CellIds, asked, threads, take)); });
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      ASSERT_EQ(expected[i].Cell, found[i].Cell) << i;
      EXPECT_TRUE(std::equal(expected[i].Weights, expected[i].Weights + 4, found[i].Weights));
    }
  }
}

} // namespace

TEST(NearPoints, AreAnsweredWithoutKeepingThePieces)
{
  for (const SourceMesh& source :
    { makeSource(latticeTriangles(40, 0.3)), makeSource(latticeTetrahedra(6, 0)) })
  {
    const bool inSpace = source.CellSize == 4;
    const ResidentMesh whole(inMemory(source));
    const std::vector<Point3> points = pointsInCorner(source, 60);
    ASSERT_LT(10U, points.size());
    const auto count = std::int64_t(points.size());
    const MeshAnswer expected = whole.answer(points.data(), count, allArrays(whole));
    for (const bool duplicate : { false, true })
    {
      const TemporaryFolder folder;
      store(source, folder.path("mesh.tipp"), inSpace ? "grid:2x2x1" : "grid:2x2", duplicate);
      const ResidentMesh mesh(folder.path("mesh.tipp"));
      expectEqual(expected, mesh.answer(points.data(), count, allArrays(mesh)));
      EXPECT_EQ(0U, mesh.pieces().bytes());
      EXPECT_LT(0, mesh.pieces().loads());
    }
  }
}

TEST(NearPoints, PiecesStayInMemoryIfTheyAreQueriedOften)
{
  const SourceMesh source = makeSource(latticeTriangles(40, 0.3));
  const TemporaryFolder folder;
  store(source, folder.path("mesh.tipp"), "grid:2x2", false);
  const ResidentMesh mesh(folder.path("mesh.tipp"));
  const std::vector<Point3> points = pointsInCorner(source, 5);
  const auto count = std::int64_t(points.size());
  const MeshAnswer expected = mesh.answer(points.data(), count, allArrays(mesh));
  for (int i = 0; i < 6; ++i)
  {
    expectEqual(expected, mesh.answer(points.data(), count, allArrays(mesh)));
  }
  EXPECT_LT(0U, mesh.pieces().bytes());
  const std::int64_t loads = mesh.pieces().loads();
  expectEqual(expected, mesh.answer(points.data(), count, allArrays(mesh)));
  EXPECT_EQ(loads, mesh.pieces().loads());
}

TEST(NearPoints, AnswersCountTowardsTheMemoryLimit)
{
  ResidentPieces pieces(
    1000, [](std::size_t, const PieceNeeds&) { return std::uint64_t(600); },
    [](std::size_t, const PieceNeeds&, const ResidentPiece&)
    {
      ResidentPiece piece;
      piece.Part = std::make_shared<const MeshPart>();
      return piece;
    },
    [](std::size_t, std::uint64_t) {});
  pieces.get(0, {});
  EXPECT_EQ(600U, pieces.bytes());
  {
    const ResidentPieces::Share answers = pieces.note(500);
    EXPECT_FALSE(pieces.take(1001));
    EXPECT_TRUE(pieces.take(300)); // makes room by removing the piece
    EXPECT_EQ(0U, pieces.bytes());
    pieces.get(1, {}); // exceeds the limit, since the piece is needed
    EXPECT_EQ(600U, pieces.bytes());
  }
  EXPECT_TRUE(pieces.take(300)); // fits beside the piece
  EXPECT_EQ(600U, pieces.bytes());
}

TEST(OnePass, LocatesLikeLocatorsEvenIfCellsOverlap)
{
  SourceMesh overlapping = makeSource(latticeTriangles(12, 0.3));
  const std::vector<std::int64_t> cells = overlapping.Cells;
  for (std::size_t i = 0; i + 4 < cells.size(); i += 9) // triangles of corners of two cells
  {
    overlapping.Cells.insert(overlapping.Cells.end(), { cells[i], cells[i + 4], cells[i + 2] });
    overlapping.Labels.push_back(7);
  }
  for (const SourceMesh& source : { makeSource(latticeTriangles(16, 0)), overlapping,
         makeSource(latticeTetrahedra(4, 0)), makeSource(latticeTetrahedra(4, 0.3)) })
  {
    std::vector<Point3> points = pointsAround(source, 2000);
    points.push_back({ std::numeric_limits<double>::quiet_NaN(), 0, 0 });
    expectAsByLocator(inMemory(source), points);
  }
}

TEST(OnePass, FindsPointsInRowsLikeOtherPoints)
{
  const std::vector<double> x = { -0.1, 0, 0.125, 0.3, 0.3125, 0.75, 1 };
  const std::vector<double> y = { 1.5, 1, 0.5, 0.4, 0.0625 };
  const std::vector<double> z = { 0.25, 0.5, 0.6 };
  for (const int fastest : { 0, 1, 2 })
  {
    std::vector<Point3> points;
    for (std::size_t i = 0; i < x.size() * y.size() * z.size(); ++i)
    {
      const std::size_t step[3] = { fastest == 0 ? 1 : z.size() * (fastest == 1 ? y.size() : 1),
        fastest == 1     ? 1
          : fastest == 0 ? x.size()
                         : x.size() * z.size(),
        fastest == 2     ? 1
          : fastest == 0 ? x.size() * y.size()
                         : y.size() };
      points.push_back(
        { x[i / step[0] % x.size()], y[i / step[1] % y.size()], z[i / step[2] % z.size()] });
    }
    const auto count = std::int64_t(points.size());
    const auto pointAt = [&](std::int64_t i) { return points[std::size_t(i)]; };
    EXPECT_EQ(points.size(), PointRows<3>(count, 1, pointAt).size());
    for (const double jitter : { 0.0, 0.3 })
    {
      expectAsByLocator(inMemory(makeSource(latticeTetrahedra(4, jitter))), points);
    }
    std::swap(points[3], points[20]);
    EXPECT_EQ(0U, PointRows<3>(count, 1, pointAt).size());
  }
  std::vector<Point3> plane;
  for (const double v : y)
  {
    for (const double u : x)
    {
      plane.push_back({ u, v, 0 });
    }
  }
  const auto planeAt = [&](std::int64_t i) { return projected<2>(plane[std::size_t(i)]); };
  for (const double jitter : { 0.0, 0.3 })
  {
    expectAsByLocator(inMemory(makeSource(latticeTriangles(16, jitter))), plane);
  }
  EXPECT_EQ(
    x.size(), PointRows<2>(std::int64_t(x.size()), 1, planeAt).size()); // all points are in one row
  plane[1 + 2 * x.size()].x = -0.0;
  EXPECT_EQ(0U, PointRows<2>(std::int64_t(plane.size()), 1, planeAt).size());
}

TEST(OnePass, GivesUpIfThinCellsWouldTestTooManyPoints)
{
  SourceMesh fan;
  fan.CellSize = 3;
  const int count = 400; // long triangles around the origin; each box is a quarter of the domain
  fan.Coordinates = { 0, 0 };
  for (int i = 0; i < count; ++i)
  {
    const double angle = 6.283185307179586 * i / count;
    fan.Coordinates.insert(fan.Coordinates.end(), { std::cos(angle), std::sin(angle) });
    fan.Cells.insert(fan.Cells.end(), { 0, i + 1, (i + 1) % count + 1 });
  }
  std::vector<double> spatial;
  for (std::size_t i = 0; i < fan.Coordinates.size(); i += 2)
  {
    spatial.insert(spatial.end(), { fan.Coordinates[i], fan.Coordinates[i + 1], 0 });
  }
  MeshPart part;
  part.Mesh.Points = spatial.data();
  part.Mesh.Ids = fan.Cells.data();
  part.Mesh.Wide = true;
  part.Mesh.Cells = count;
  part.Mesh.PointCount = count + 1;
  part.OwnedCells = count;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> at(-0.7, 0.7);
  std::vector<Point3> points(20000);
  for (Point3& p : points)
  {
    p = { at(random), at(random), 0 };
  }
  const AskedPoints asked = { points.data(), nullptr, std::int64_t(points.size()) };
  EXPECT_FALSE(locateInOnePass(
    part.Mesh, nullptr, asked, 1, [](const std::int64_t*, const CellLocation*, std::int64_t) {}));
  const ResidentMesh mesh(part);
  const MeshAnswer answer = mesh.answer(points.data(), std::int64_t(points.size()));
  EXPECT_EQ(0, std::count(answer.Cells.begin(), answer.Cells.end(), -1));
}

TEST(PointGrid, NeverMissesABoxThatContainsAPoint)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> at(0, 1);
  std::vector<Point2> corners = { { -infinity, 0.5 }, { 0.1, 0.1 }, { infinity, 0.2 }, { 2, 2 },
    { 3, 3 }, { -5, 0.5 }, { -4, 0.6 } };
  std::vector<Point3> inSpace = { { 2, 2, 2 }, { 3, 3, 3 } };
  for (int i = 0; i < 400; ++i)
  {
    corners.push_back({ 0.4 + 0.3 * at(random), 0.5 + 0.01 * at(random) });
    inSpace.push_back({ at(random), 0.1 * at(random), at(random) });
  }
  std::vector<Point2> points = { { 0.5, 0.5 } };
  expectGridFindsAll<2>(points, corners); // a single point
  points.push_back({ 0.5, 0.9 });         // points on a line
  expectGridFindsAll<2>(points, corners);
  points.insert(points.end(), corners.begin() + 20, corners.begin() + 60);
  expectGridFindsAll<2>(points, corners);
  expectGridFindsAll<3>({ { 0.5, 0.05, 0.5 }, { 0.6, 0.01, 0.2 } }, inSpace);
}

TEST(NearCell, IsNearestByExactDistanceAndThenByLowestId)
{
  const Point3 from{ 0.5, -1, 0 };
  const NearCell touching = triangle(7, { { 0, 0, 0 }, { 1, 0, 0 }, { 0.5, 1, 0 } }, from);
  const NearCell asNear = triangle(3, { { 0.25, 0, 0 }, { 2, 0, 0 }, { 1, 1, 0 } }, from);
  const double above = std::nextafter(0.0, 1.0);
  const NearCell farther = triangle(1, { { 0, above, 0 }, { 1, above, 0 }, { 0.5, 1, 0 } }, from);
  EXPECT_TRUE(asNear.isBetterThan(touching, from));
  EXPECT_FALSE(touching.isBetterThan(asNear, from));
  EXPECT_TRUE(touching.isBetterThan(farther, from)); // the difference is less than an ulp
  NearCell measured = touching;
  EXPECT_DOUBLE_EQ(1, measured.distance(from));
  EXPECT_DOUBLE_EQ(0.5, measured.At.x);
  EXPECT_DOUBLE_EQ(0, measured.At.y);
}
