// SPDX-License-Identifier: BSD-3-Clause
// tetrahedralizeDistributed() on the ranks of the global controller.
#include "PointsInSpace.h"

#include "Distributed3D/DistributedTetrahedralization.h"

#include "vtkMultiProcessController.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <set>

namespace
{

using namespace tipp;
using namespace tipp::test;

/// One rank's points with their global ids.
struct Part
{
  std::vector<Point3> Points;
  std::vector<PointId> Ids;

  RankPoints3 view() const
  {
    RankPoints3 points;
    points.Points = { this->Points.data(), this->Points.size() };
    points.GlobalIds = this->Ids.data();
    return points;
  }
};

using RankOf = std::function<int(std::size_t i, int ranks)>;

int roundRobin(std::size_t i, int ranks)
{
  return int(i % std::size_t(ranks));
}

Part partOf(const std::vector<Point3>& points, const Communicator& ranks, const RankOf& rankOf)
{
  Part part;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (rankOf(i, ranks.size()) == ranks.rank())
    {
      part.Points.push_back(points[i]);
      part.Ids.push_back(PointId(i));
    }
  }
  return part;
}

TetrahedralizationOptions with(int threads, int partitions)
{
  TetrahedralizationOptions options;
  options.Threads = threads;
  options.Partitions = partitions;
  return options;
}

void expectSame(
  const Tetrahedralization& expected, const Tetrahedralization& found, const std::string& what)
{
  EXPECT_EQ(expected.Dimension, found.Dimension) << what;
  EXPECT_EQ(expected.Rejected, found.Rejected) << what;
  EXPECT_TRUE(
    std::equal(expected.Ids.begin(), expected.Ids.end(), found.Ids.begin(), found.Ids.end()))
    << what << ": " << expected.cellCount() << " and " << found.cellCount() << " tetrahedra";
  const bool isSame = std::equal(expected.Duplicates.begin(), expected.Duplicates.end(),
    found.Duplicates.begin(), found.Duplicates.end(),
    [](const Duplicate& a, const Duplicate& b)
    { return a.Point == b.Point && a.Representative == b.Representative; });
  EXPECT_TRUE(isSame) << what;
}

/// Expects that the gathered results of all ranks equal the result of one process, byte for byte.
void expectThatOfOne(const std::vector<Point3>& points, const TetrahedralizationOptions& options,
  const std::string& what, const RankOf& rankOf = roundRobin)
{
  Communicator ranks(vtkMultiProcessController::GetGlobalController());
  const Part part = partOf(points, ranks, rankOf);
  const DistributedTetrahedralization mine = tetrahedralizeDistributed(ranks, part.view(), options);
  Triangulation triangles;
  const Tetrahedralization found = gatherTetrahedra(ranks, mine, 1, triangles);
  if (ranks.isFirst())
  {
    Tetrahedralization expected = tetrahedralize(points.data(), points.size(), with(1, 1));
    const Triangulation flat = expected.Dimension == 2
      ? triangulateCoplanar(points.data(), points.size(), with(1, 1), expected)
      : Triangulation();
    expectSame(expected, found, what);
    EXPECT_TRUE(std::equal(
      flat.Ids32.begin(), flat.Ids32.end(), triangles.Ids32.begin(), triangles.Ids32.end()))
      << what << ": " << flat.triangleCount() << " and " << triangles.triangleCount()
      << " triangles";
  }
  ranks.barrier();
}

std::size_t countFor(const std::string& kind)
{
  return kind == "lines" ? 150 : (kind == "of many sizes" ? 500 : 3000);
}

} // namespace

TEST(Distributed3D, IsTheResultOfOneProcessForAllKindsOfPoints)
{
  for (const std::string& kind : kindsOfPoints())
  {
    const auto points = pointsInSpace(kind, countFor(kind), 3);
    for (const int partitions : { 0, 9, 30 })
    {
      expectThatOfOne(
        points, with(1 + partitions % 2, partitions), kind + " " + std::to_string(partitions));
    }
  }
}

TEST(Distributed3D, ChoosesPartitionsForManyPoints)
{
  for (const char* const kind : { "uniform", "clustered", "lattice", "sphere" })
  {
    const auto points = pointsInSpace(kind, 60000);
    expectThatOfOne(points, with(1, 0), kind);
  }
}

TEST(Distributed3D, PiecesDoNotDependOnThreadsAndPartitions)
{
  Communicator ranks(vtkMultiProcessController::GetGlobalController());
  const auto points = pointsInSpace("body-centred", 40000);
  const Part part = partOf(points, ranks, roundRobin);
  const auto one = tetrahedralizeDistributed(ranks, part.view(), with(1, 0));
  for (const auto& options : { with(2, 0), with(3, 40), with(1, 2) })
  {
    const auto other = tetrahedralizeDistributed(ranks, part.view(), options);
    EXPECT_TRUE(std::equal(one.Ids.begin(), one.Ids.end(), other.Ids.begin(), other.Ids.end()));
    EXPECT_TRUE(std::equal(one.Owned.GlobalIds.begin(), one.Owned.GlobalIds.end(),
      other.Owned.GlobalIds.begin(), other.Owned.GlobalIds.end()));
    EXPECT_EQ(one.GhostIds, other.GhostIds);
    EXPECT_EQ(one.FirstCell, other.FirstCell);
  }
  EXPECT_GT(one.cellCount(), 6 * points.size() / std::size_t(ranks.size()) / 2);
}

TEST(Distributed3D, RanksWithoutPointsTakePart)
{
  const auto points = pointsInSpace("uniform", 40000);
  expectThatOfOne(
    points, with(1, 0), "all on the last", [](std::size_t, int ranks) { return ranks - 1; });
  expectThatOfOne(points, with(1, 0), "blocks",
    [&](std::size_t i, int ranks)
    { return ranks == 1 ? 0 : 1 + int(i * std::size_t(ranks - 1) / points.size()); });
}

TEST(Distributed3D, DuplicatesOnSeveralRanksAreMerged)
{
  Communicator ranks(vtkMultiProcessController::GetGlobalController());
  for (const int partitions : { 1, 20 })
  {
    const auto own = pointsInSpace("coarse", 700);
    auto more = pointsInSpace("uniform", 2000);
    more.insert(more.end(), own.begin(), own.end());
    RankPoints3 points; // the same on all ranks; ids are counted over ranks
    points.Points = { more.data(), more.size() };
    const auto mine = tetrahedralizeDistributed(ranks, points, with(1, partitions));
    Triangulation none;
    const Tetrahedralization found = gatherTetrahedra(ranks, mine, 1, none);
    EXPECT_GE(mine.AllDuplicates, std::int64_t(more.size()) * (ranks.size() - 1) + 484);
    std::vector<Point3> all;
    for (int rank = 0; rank < ranks.size(); ++rank)
    {
      all.insert(all.end(), more.begin(), more.end());
    }
    if (ranks.isFirst())
    {
      expectSame(tetrahedralize(all.data(), all.size()), found, std::to_string(partitions));
    }
    ranks.barrier();
  }
}

TEST(Distributed3D, TheLowestGlobalIdIsTheRepresentativeOnAnyRank)
{
  Communicator ranks(vtkMultiProcessController::GetGlobalController());
  auto points = pointsInSpace("coarse", 2500);
  Part part = partOf(points, ranks, roundRobin);
  for (PointId& id : part.Ids)
  {
    id = PointId(points.size()) - 1 - id;
  }
  std::reverse(points.begin(), points.end());
  const auto mine = tetrahedralizeDistributed(ranks, part.view(), with(1, 12));
  Triangulation none;
  const Tetrahedralization found = gatherTetrahedra(ranks, mine, 1, none);
  if (ranks.isFirst())
  {
    expectSame(tetrahedralize(points.data(), points.size()), found, "reversed");
  }
  ranks.barrier();
}

TEST(Distributed3D, PointsThatAreNotFiniteAreRejected)
{
  for (const int partitions : { 0, 8 })
  {
    auto points = pointsInSpace("uniform", 1000);
    points[0].x = std::nan("");
    points[501].z = std::numeric_limits<double>::infinity();
    points[999].y = -std::numeric_limits<double>::infinity();
    expectThatOfOne(points, with(1, partitions), "not finite",
      [](std::size_t i, int ranks) { return int(i / 7 % std::size_t(ranks)); });
  }
}

TEST(Distributed3D, PointsWithoutTetrahedraReportTheirDimension)
{
  std::vector<Point3> line;
  std::vector<Point3> plane;
  for (int i = 0; i < 300; ++i)
  {
    line.push_back({ 1.0 * i, 2.0 * i, -3.0 * i });
    plane.push_back({ 1.0 * (i % 17), 1.0 * (i / 17), 1.0 * (i % 17) + 2.0 * (i / 17) });
  }
  const Point3 corner{ 0.1, 0.2, 0.3 };
  const std::vector<Point3> flat = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
  for (const int partitions : { 0, 6 })
  {
    for (const auto& points :
      { line, plane, flat, std::vector<Point3>{ corner, corner }, std::vector<Point3>{} })
    {
      expectThatOfOne(points, with(1, partitions), std::to_string(points.size()));
    }
  }
}

TEST(Distributed3D, CoplanarPointsMakeTheTrianglesOfOneProcess)
{
  auto tilted = pointsInSpace("uniform", 40000); // enough for several partitions
  for (Point3& p : tilted)
  {
    p.x = std::ldexp(std::round(std::ldexp(p.x, 20)), -20);
    p.y = std::ldexp(std::round(std::ldexp(p.y, 20)), -20);
    p.z = p.x - 2 * p.y;
  }
  auto lattice = pointsInSpace("coarse", 4000); // with duplicates on several ranks
  for (Point3& p : lattice)
  {
    p.y = 0x1p-300;
  }
  lattice[17].x = std::nan("");
  for (const int partitions : { 0, 8 })
  {
    expectThatOfOne(tilted, with(1, partitions), "tilted");
    expectThatOfOne(lattice, with(2, partitions), "lattice");
  }
}

TEST(Distributed3D, ATriangleIsOnOneRankAndAGhostOnOthers)
{
  Communicator ranks(vtkMultiProcessController::GetGlobalController());
  auto points = pointsInSpace("uniform", 2000);
  for (Point3& p : points)
  {
    p.z = 1;
  }
  const auto mine =
    tetrahedralizeDistributed(ranks, partOf(points, ranks, roundRobin).view(), with(1, 0));
  EXPECT_EQ(3U, mine.cellSize());
  std::vector<std::int64_t> cells{ std::int64_t(mine.cellCount()) };
  ranks.sum(cells);
  EXPECT_EQ(mine.AllCells, cells[0]);
  const GhostTetrahedra ghosts = fetchGhosts(ranks, mine);
  std::vector<std::int64_t> sum{ std::int64_t(ghosts.Cells.size()) };
  ranks.sum(sum);
  EXPECT_EQ(ranks.size() > 1, sum[0] > 0);
  EXPECT_LT(sum[0], mine.AllCells * ranks.size() / 2);
}

TEST(Distributed3D, RowsTravelWithTheirPoints)
{
  Communicator ranks(vtkMultiProcessController::GetGlobalController());
  const Part part = partOf(pointsInSpace("uniform", 3000), ranks, roundRobin);
  RankPoints3 points = part.view();
  points.RowSize = sizeof(PointId) + 1;
  points.PackRow = [&](std::size_t i, char* to)
  {
    const PointId value = 7 * part.Ids[i];
    std::memcpy(to, &value, sizeof(value));
    to[sizeof(value)] = 'x';
  };
  const auto mine = tetrahedralizeDistributed(ranks, points, with(1, 10));
  if (ranks.isFirst()) // the lowest ids are on the first rank
  {
    EXPECT_EQ(ranks.size() > 1, mine.Ghosts.size() > 0);
  }
  for (const PointTuples3* tuples : { &mine.Owned, &mine.Ghosts })
  {
    for (std::size_t i = 0; i < tuples->size(); ++i)
    {
      PointId value = 0;
      const char* row = tuples->Rows.data() + i * points.RowSize;
      std::memcpy(&value, row, sizeof(value));
      ASSERT_EQ(value, 7 * tuples->GlobalIds[i]);
      ASSERT_EQ(row[sizeof(value)], 'x');
    }
  }
}

TEST(Distributed3D, GhostsAreTheOtherTetrahedraAtOwnVertices)
{
  Communicator ranks(vtkMultiProcessController::GetGlobalController());
  const Part part = partOf(pointsInSpace("clustered", 3000), ranks, roundRobin);
  const auto mine = tetrahedralizeDistributed(ranks, part.view(), with(1, 10));
  const GhostTetrahedra ghosts = fetchGhosts(ranks, mine);
  std::vector<IdCell<4>> own;
  const std::int64_t first = mine.FirstIds[std::size_t(ranks.rank())];
  const auto owned = std::int64_t(mine.Owned.size());
  for (std::size_t i = 0; i < mine.Ids.size(); i += 4)
  {
    IdCell<4>& cell = own.emplace_back();
    std::transform(mine.Ids.begin() + i, mine.Ids.begin() + i + 4, cell.begin(),
      [&](std::int64_t index)
      { return index < owned ? first + index : mine.GhostIds[std::size_t(index - owned)]; });
  }
  std::set<std::int64_t> vertices;
  for (const IdCell<4>& cell : own)
  {
    vertices.insert(cell.begin(), cell.end());
  }
  std::set<std::int64_t> expected;
  std::int64_t number = 0;
  for (const std::vector<IdCell<4>>& cells : ranks.allGather(own))
  {
    for (const IdCell<4>& cell : cells)
    {
      const bool isOwn =
        number >= mine.FirstCell && number < mine.FirstCell + std::int64_t(own.size());
      const bool touches = std::any_of(
        cell.begin(), cell.end(), [&](std::int64_t id) { return vertices.count(id) > 0; });
      if (!isOwn && touches)
      {
        expected.insert(number);
      }
      ++number;
    }
  }
  EXPECT_EQ(expected.size(), ghosts.Numbers.size());
  EXPECT_EQ(expected, std::set<std::int64_t>(ghosts.Numbers.begin(), ghosts.Numbers.end()));
  EXPECT_EQ(expected.empty(), ranks.size() == 1);
}

TEST(Distributed3D, ARankThatFailsEndsAllWithItsReason)
{
  Communicator ranks(vtkMultiProcessController::GetGlobalController());
  const Part part = partOf(pointsInSpace("uniform", 3000), ranks, roundRobin);
  RankPoints3 points = part.view();
  points.RowSize = 1;
  points.PackRow = [&](std::size_t, char* to)
  {
    if (ranks.rank() == ranks.size() - 1)
    {
      throw std::runtime_error("This row is lost.");
    }
    *to = 'x';
  };
  try
  {
    tetrahedralizeDistributed(ranks, points, with(1, 8));
    ADD_FAILURE() << "it did not fail";
  }
  catch (const RankFailure& failure)
  {
    EXPECT_EQ(failure.Rank, ranks.size() - 1);
    EXPECT_STREQ(failure.what(), "This row is lost.");
    EXPECT_FALSE(failure.Aborted);
  }
  points.RowSize = 0; // after the failure, the next run must succeed
  EXPECT_GT(tetrahedralizeDistributed(ranks, points, with(1, 8)).AllCells, 15000);
}

TEST(Distributed3D, ARankThatIsStoppedEndsAll)
{
  Communicator ranks(vtkMultiProcessController::GetGlobalController());
  const Part part = partOf(pointsInSpace("uniform", 40000), ranks, roundRobin);
  for (const int partitions : { 0, 24 })
  {
    TetrahedralizationOptions options = with(1, partitions);
    options.Progress = [&](double) { return ranks.rank() != 0; };
    try
    {
      tetrahedralizeDistributed(ranks, part.view(), options);
      ADD_FAILURE() << "it did not stop";
    }
    catch (const RankFailure& failure)
    {
      EXPECT_TRUE(failure.Aborted);
    }
  }
}
