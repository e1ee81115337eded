// SPDX-License-Identifier: BSD-3-Clause
#include "PointsInSpace.h"

#include "Check/DelaunayChecker.h"
#include "InMemory/TriangulatePoints.h"
#include "Kernel/DelaunayKernel3.h"
#include "Statistics/RunStatistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <stdexcept>

namespace
{

using namespace tipp;
using namespace tipp::test;

Tetrahedralization meshOf(const std::vector<Point3>& points, int threads = 1, int partitions = 1)
{
  TetrahedralizationOptions options;
  options.Threads = threads;
  options.Partitions = partitions;
  return tetrahedralize(points.data(), points.size(), options);
}

std::string faultsOf(const std::vector<Point3>& points, const Tetrahedralization& mesh)
{
  std::string text;
  for (const std::string& fault :
    checkTetrahedra(coordinatesOf(points), idsOf(mesh), true).faults())
  {
    text += fault + "\n";
  }
  return text;
}

std::size_t countFor(const std::string& kind)
{
  // The number of tetrahedra of points on skew lines is quadratic.
  return kind == "lines" ? 150 : (kind == "of many sizes" ? 500 : 3000);
}

} // namespace

TEST(Tetrahedralize, EqualsCgal)
{
  for (const std::string& kind : kindsOfPoints())
  {
    for (unsigned seed = 1; seed <= 3; ++seed)
    {
      const auto points = pointsInSpace(kind, countFor(kind), seed);
      EXPECT_EQ(cellsOfCgal(points), sortedCells(meshOf(points))) << kind << " " << seed;
    }
  }
}

TEST(Tetrahedralize, SmallSetsEqualCgal)
{
  for (unsigned seed = 1; seed <= 400; ++seed)
  {
    const auto points = pointsInSpace(seed % 2 == 0 ? "coarse" : "uniform", 4 + seed % 40, seed);
    EXPECT_EQ(cellsOfCgal(points), sortedCells(meshOf(points))) << seed;
  }
}

TEST(Tetrahedralize, PassesTheExactCheckerWithItsTieRule)
{
  for (const std::string& kind : kindsOfPoints())
  {
    const auto points = pointsInSpace(kind, countFor(kind), 11);
    EXPECT_EQ("", faultsOf(points, meshOf(points))) << kind;
  }
}

TEST(Tetrahedralize, DeterminantsMayOverflow)
{
  for (unsigned seed = 1; seed <= 20; ++seed)
  {
    std::mt19937 random(seed);
    const auto coordinate = [&random](double unit) { return (double(random() % 19) - 9) * unit; };
    std::vector<Point3> points;
    for (int i = 0; i < 40; ++i)
    {
      const double unit = i % 2 == 0 ? 1e299 : 5e-324;
      points.push_back({ coordinate(unit), coordinate(unit), coordinate(unit) });
    }
    EXPECT_EQ("", faultsOf(points, meshOf(points))) << seed;
  }
}

TEST(Tetrahedralize, IsTheSameForAnyPartitionsAndThreads)
{
  for (const std::string& kind : kindsOfPoints())
  {
    const auto points = pointsInSpace(kind, countFor(kind), 5);
    const Tetrahedralization one = meshOf(points);
    for (const int partitions : { 2, 7, 24, 60 })
    {
      const Tetrahedralization other = meshOf(points, 1 + partitions % 3, partitions);
      EXPECT_TRUE(std::equal(one.Ids.begin(), one.Ids.end(), other.Ids.begin(), other.Ids.end()))
        << kind << " " << partitions;
      EXPECT_EQ(one.Duplicates.size(), other.Duplicates.size()) << kind << " " << partitions;
    }
  }
}

TEST(Tetrahedralize, IsTheSameForAnyOrderOfThePoints)
{
  auto points = pointsInSpace("body-centred", 2000);
  const auto before = cellsOfCgal(points);
  std::reverse(points.begin(), points.end());
  std::vector<Tetrahedron> after = sortedCells(meshOf(points));
  for (Tetrahedron& cell : after)
  {
    for (std::int64_t& id : cell)
    {
      id = std::int64_t(points.size()) - 1 - id;
    }
    std::sort(cell.begin(), cell.end());
  }
  std::sort(after.begin(), after.end());
  EXPECT_EQ(before, after);
}

TEST(Tetrahedralize, CellsAreInLexicographicOrder)
{
  const auto points = pointsInSpace("uniform", 2000);
  const Tetrahedralization mesh = meshOf(points, 2, 8);
  std::vector<Tetrahedron> cells;
  for (std::size_t i = 0; i < mesh.Ids.size(); i += 4)
  {
    Tetrahedron cell = { mesh.Ids[i], mesh.Ids[i + 1], mesh.Ids[i + 2], mesh.Ids[i + 3] };
    std::sort(cell.begin(), cell.end());
    cells.push_back(cell);
  }
  EXPECT_TRUE(std::is_sorted(cells.begin(), cells.end()));
}

TEST(Tetrahedralize, ALargeCavityIsFilled)
{
  // The last point is the sphere's centre, so all tetrahedra conflict with it.
  auto points = pointsInSpace("sphere", 2000);
  points.push_back({ 0, 0, 0 });
  EXPECT_EQ(cellsOfCgal(points), sortedCells(meshOf(points)));
}

TEST(Tetrahedralize, DuplicatesAreMappedToTheLowestId)
{
  const auto points = pointsInSpace("coarse", 2000);
  for (const int partitions : { 1, 9 })
  {
    const Tetrahedralization mesh = meshOf(points, 2, partitions);
    ASSERT_GT(mesh.Duplicates.size(), 1000U);
    EXPECT_TRUE(std::is_sorted(mesh.Duplicates.begin(), mesh.Duplicates.end(),
      [](const Duplicate& a, const Duplicate& b) { return a.Point < b.Point; }));
    std::set<std::int64_t> merged;
    for (const Duplicate& d : mesh.Duplicates)
    {
      const auto first = std::find(points.begin(), points.end(), points[std::size_t(d.Point)]);
      EXPECT_EQ(first - points.begin(), d.Representative);
      merged.insert(d.Point);
    }
    for (const std::int32_t id : mesh.Ids)
    {
      EXPECT_EQ(0U, merged.count(id));
    }
  }
}

TEST(Tetrahedralize, PointsThatAreNotFiniteAreRejected)
{
  auto points = pointsInSpace("uniform", 500);
  points[3].y = std::nan("");
  points[77].z = std::numeric_limits<double>::infinity();
  points[499].x = -std::numeric_limits<double>::infinity();
  for (const int partitions : { 1, 6 })
  {
    const Tetrahedralization mesh = meshOf(points, 2, partitions);
    EXPECT_EQ((std::vector<PointId>{ 3, 77, 499 }), mesh.Rejected);
    EXPECT_EQ("", faultsOf(points, mesh));
    EXPECT_EQ(1U, warningsOf(mesh, 500).size());
  }
}

TEST(Tetrahedralize, PointsInAPlaneAreReported)
{
  const auto dimensionOf = [](const std::vector<Point3>& points, int partitions)
  {
    const Tetrahedralization mesh = meshOf(points, 2, partitions);
    EXPECT_EQ(0U, mesh.cellCount());
    EXPECT_EQ(1U, warningsOf(mesh, std::int64_t(points.size())).size());
    return mesh.Dimension;
  };
  const Point3 corner{ 0.1, 0.2, 0.3 };
  EXPECT_EQ(-1, dimensionOf({}, 1));
  EXPECT_EQ(0, dimensionOf({ corner, corner, corner }, 1));
  std::vector<Point3> line;
  std::vector<Point3> plane;
  for (int i = 0; i < 200; ++i)
  {
    line.push_back({ 1.0 * i, 2.0 * i, -3.0 * i });
    plane.push_back({ 1.0 * (i % 17), 1.0 * (i / 17), 1.0 * (i % 17) + 2.0 * (i / 17) });
  }
  for (const int partitions : { 1, 5 })
  {
    EXPECT_EQ(1, dimensionOf(line, partitions));
    EXPECT_EQ(2, dimensionOf(plane, partitions));
  }
  EXPECT_EQ(2, dimensionOf({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, 1));
}

/// The triangles of points in a plane.
std::vector<std::int32_t> trianglesOf(const std::vector<Point3>& points, int threads = 1)
{
  TetrahedralizationOptions options;
  options.Threads = threads;
  Tetrahedralization mesh = tetrahedralize(points.data(), points.size(), options);
  EXPECT_EQ(2, mesh.Dimension);
  const Triangulation flat = triangulateCoplanar(points.data(), points.size(), options, mesh);
  EXPECT_EQ(mesh.Duplicates.size(), flat.Duplicates.size());
  return { flat.Ids32.begin(), flat.Ids32.end() };
}

TEST(CoplanarPoints, AreTriangulatedAsInTwoDimensions)
{
  auto uniform = pointsInSpace("uniform", 2000);
  for (Point3& p : uniform)
  {
    p.z = 7;
  }
  uniform.push_back(uniform[3]);
  Triangulation flat = triangulate(PointsView(&uniform[0].x, uniform.size(), 3));
  std::vector<std::array<std::int32_t, 3>> expected;
  for (std::size_t i = 0; i < flat.Ids32.size(); i += 3)
  {
    std::array<std::int32_t, 3> t = { flat.Ids32[i], flat.Ids32[i + 1], flat.Ids32[i + 2] };
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    expected.push_back(t);
  }
  std::sort(expected.begin(), expected.end());
  const std::vector<std::int32_t> found = trianglesOf(uniform);
  ASSERT_EQ(3 * expected.size(), found.size());
  EXPECT_TRUE(std::equal(found.begin(), found.end(), expected.front().begin()));
  EXPECT_TRUE(found == trianglesOf(uniform, 2));
  // Points in the other two coordinate planes must give the same triangles. The cyclic exchange of
  // axes keeps the orientation.
  auto turned = uniform;
  for (int turn = 0; turn < 2; ++turn)
  {
    for (Point3& p : turned)
    {
      p = { p.z, p.x, p.y };
    }
    EXPECT_TRUE(found == trianglesOf(turned)) << turn;
  }
}

TEST(CoplanarPoints, OfATiltedPlaneAreFilled)
{
  // In the plane z = x + 3 y, the normal is longest in y, so the points are projected to x and z.
  std::vector<Point3> points;
  for (int i = 0; i < 20 * 30; ++i)
  {
    points.push_back({ double(i % 20), double(i / 20), double(i % 20 + 3 * (i / 20)) });
  }
  const std::vector<std::int32_t> ids = trianglesOf(points);
  double area = 0;
  for (std::size_t i = 0; i < ids.size(); i += 3)
  {
    const Point3 u = points[std::size_t(ids[i + 1])] - points[std::size_t(ids[i])];
    const Point3 v = points[std::size_t(ids[i + 2])] - points[std::size_t(ids[i])];
    const double twice = u.z * v.x - u.x * v.z;
    EXPECT_GT(twice, 0);
    area += twice / 2;
  }
  EXPECT_EQ(19 * 29 * 3, area);
  std::reverse(points.begin(), points.end());
  EXPECT_EQ(ids.size(), trianglesOf(points).size());
}

TEST(CoplanarPoints, ThatAreNotFiniteAreLeftOut)
{
  std::vector<Point3> points = { { 0, 0, 1 }, { 1, 0, 1 }, { 0, 1, 1 },
    { 0.5, 0.5, std::numeric_limits<double>::infinity() }, { std::nan(""), 0, 1 } };
  EXPECT_EQ((std::vector<std::int32_t>{ 0, 1, 2 }), trianglesOf(points));
}

TEST(CoplanarPoints, ThatAreCloseAreMerged)
{
  const std::vector<Point3> points = { { 0, 2, 0 }, { 1, 2, 0 }, { 0, 2, 1 }, { 1e-9, 2, 0 } };
  Tetrahedralization mesh = tetrahedralizeMerged(points.data(), points.size(), 1e-6);
  const Triangulation flat = triangulateCoplanar(points.data(), points.size(), {}, mesh);
  ASSERT_EQ(1U, mesh.Duplicates.size());
  EXPECT_EQ(3, mesh.Duplicates[0].Point);
  EXPECT_EQ(1U, flat.triangleCount());
}

TEST(Tetrahedralize, StopsWhenProgressReturnsFalse)
{
  const auto points = pointsInSpace("uniform", 20000);
  for (const int partitions : { 1, 12 })
  {
    TetrahedralizationOptions options;
    options.Partitions = partitions;
    options.Threads = 2;
    options.Progress = [](double) { return false; };
    const Tetrahedralization mesh = tetrahedralize(points.data(), points.size(), options);
    EXPECT_TRUE(mesh.Aborted);
    EXPECT_EQ(0U, mesh.cellCount());
  }
}

TEST(Tetrahedralize, ClosePointsAreMerged)
{
  auto points = pointsInSpace("uniform", 500);
  const std::size_t given = points.size();
  for (std::size_t i = 0; i < given; i += 5)
  {
    points.push_back({ points[i].x + 1e-7, points[i].y, points[i].z - 1e-7 });
  }
  const Tetrahedralization mesh = tetrahedralizeMerged(points.data(), points.size(), 1e-6);
  ASSERT_EQ(given / 5, mesh.Duplicates.size());
  for (std::size_t i = 0; i < mesh.Duplicates.size(); ++i)
  {
    EXPECT_EQ(PointId(given + i), mesh.Duplicates[i].Point);
    EXPECT_EQ(PointId(5 * i), mesh.Duplicates[i].Representative);
  }
  points.resize(given);
  EXPECT_EQ(cellsOfCgal(points), sortedCells(mesh));
}

TEST(Tetrahedralize, RefusesToMergeMorePointsThanIdsOf32Bits)
{
  const std::size_t most = std::numeric_limits<std::int32_t>::max();
  EXPECT_THROW(tetrahedralizeMerged(nullptr, most + 1, 1e-6), std::length_error);
}

TEST(Tetrahedralize, MergingClosePointsReportsProgressAndCanBeStopped)
{
  const auto points = pointsInSpace("uniform", 500);
  std::vector<double> reported;
  TetrahedralizationOptions options;
  options.Progress = [&reported](double fraction)
  {
    reported.push_back(fraction);
    return false;
  };
  EXPECT_TRUE(tetrahedralizeMerged(points.data(), points.size(), 1e-6, options).Aborted);
  EXPECT_EQ((std::vector<double>{ 0 }), reported);
  const Tetrahedralization mesh = tetrahedralizeMerged(points.data(), points.size(), 1e-6);
  EXPECT_EQ("merging", mesh.Statistics.Phases.front().Name);
}

TEST(Tetrahedralize, PointsInTheMiddleOfAGridCellAreMerged)
{
  // Cells of the grid are 2 wide. The second point is in the middle of the first one's cell along
  // x, and both neighbouring cells are within its reach.
  const std::vector<Point3> points = { { 3.4, 0, 0 }, { 3, 0, 0 }, { 9, 0, 0 }, { 0, 9, 0 },
    { 0, 0, 9 } };
  const Tetrahedralization mesh = tetrahedralizeMerged(points.data(), points.size(), 1);
  ASSERT_EQ(1U, mesh.Duplicates.size());
  EXPECT_EQ(1, mesh.Duplicates[0].Point);
  EXPECT_EQ(0, mesh.Duplicates[0].Representative);
}

TEST(DelaunayKernel3, UsesAtMost45BytesPerTetrahedron)
{
  const auto points = pointsInSpace("uniform", 50000);
  DelaunayKernel3 kernel;
  kernel.triangulate(points.data(), points.size());
  std::size_t finite = 0;
  kernel.forEach([&](DelaunayKernel3::Index t) { finite += kernel.isInfinite(t) ? 0 : 1; });
  EXPECT_LE(kernel.bytes(), 45 * finite);
}

TEST(DelaunayKernel3, PointsAddedLaterMakeTheSameTetrahedra)
{
  for (const std::string& kind : kindsOfPoints())
  {
    // The upper half of the points is added later, with 20 duplicates of points of the lower half.
    auto points = pointsInSpace(kind, countFor(kind), 7);
    const auto [lowest, highest] = std::minmax_element(
      points.begin(), points.end(), [](const Point3& p, const Point3& q) { return p.z < q.z; });
    const double middle = lowest->z / 2 + highest->z / 2;
    const auto upper = std::partition(
      points.begin(), points.end(), [middle](const Point3& p) { return p.z < middle; });
    const auto first = std::size_t(upper - points.begin());
    const std::vector<Point3> again(points.begin(), points.begin() + 20);
    points.insert(points.end(), again.begin(), again.end());
    DelaunayKernel3 kernel;
    kernel.triangulate(points.data(), first, {}, 1, points.size() - first);
    ASSERT_EQ(3, kernel.dimension()) << kind;
    kernel.add(points.data() + first, 10);
    kernel.add(points.data() + first + 10, points.size() - first - 10);
    std::vector<Tetrahedron> cells;
    kernel.forEach(
      [&](DelaunayKernel3::Index t)
      {
        if (!kernel.isInfinite(t))
        {
          Tetrahedron& cell = cells.emplace_back();
          const auto corners = kernel.corners(t);
          std::transform(corners.begin(), corners.end(), cell.begin(),
            [&](DelaunayKernel3::Index v) { return kernel.pointIndex(v); });
          std::sort(cell.begin(), cell.end());
        }
      });
    std::sort(cells.begin(), cells.end());
    EXPECT_EQ(cellsOfCgal(points), cells) << kind;
    EXPECT_GE(kernel.duplicates().size(), 20U);
  }
}

TEST(DelaunayKernel3, NeighboursAreMutual)
{
  const auto points = pointsInSpace("coarse", 300);
  DelaunayKernel3 kernel;
  for (int turn = 0; turn < 2; ++turn) // the kernel can be used again
  {
    kernel.triangulate(points.data(), points.size());
    kernel.forEach(
      [&](DelaunayKernel3::Index t)
      {
        for (DelaunayKernel3::Index i = 0; i < 4; ++i)
        {
          const auto other = kernel.neighbour(t, i);
          bool isMutual = false;
          for (DelaunayKernel3::Index k = 0; k < 4; ++k)
          {
            isMutual = isMutual || kernel.neighbour(other, k) == t;
          }
          EXPECT_TRUE(isMutual);
        }
      });
  }
}
