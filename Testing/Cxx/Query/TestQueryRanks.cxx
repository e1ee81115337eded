// SPDX-License-Identifier: BSD-3-Clause
#include "QueryTesting.h"

#include "Files/IOError.h"
#include "Query/Lines.h"
#include "Query/RankAnswer.h"
#include "Query/RankAround.h"
#include "Query/Zones.h"
#include "Ranks/Communicator.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkPartitionedMeshQuery.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <memory>

using namespace tipp;
using namespace tipp::test;

namespace
{

/// Each rank queries its own share of the points, the last rank none.
class QueryRanks : public testing::Test
{
protected:
  QueryRanks()
    : Ranks(vtkMultiProcessController::GetGlobalController())
  {
    std::string path;
    if (this->Ranks.isFirst())
    {
      this->Folder = std::make_unique<TemporaryFolder>();
      path = this->Folder->path("mesh.tipp");
    }
    this->Path = this->Ranks.broadcast(path);
  }
  ~QueryRanks() override { this->Ranks.barrier(); }

  bool isLast() const
  {
    return this->Ranks.size() > 1 && this->Ranks.rank() == this->Ranks.size() - 1;
  }

  std::vector<Point3> ownOf(const std::vector<Point3>& points) const
  {
    std::vector<Point3> own;
    const auto asking = std::size_t(std::max(1, this->Ranks.size() - 1));
    for (std::size_t i = std::size_t(this->Ranks.rank()); i < points.size() && !this->isLast();
         i += asking)
    {
      own.push_back(points[i]);
    }
    return own;
  }

  void store(const SourceMesh& source, const std::string& tiling)
  {
    if (this->Ranks.isFirst())
    {
      test::store(source, this->Path, tiling, false);
    }
    this->Ranks.barrier();
  }

  void expectAsAlone(const ResidentMesh& mesh, const SourceMesh& source)
  {
    const std::vector<Point3> points = this->ownOf(pointsAround(source, 400));
    const ResidentMesh whole(inMemory(source));
    AnswerOptions options;
    options.Arrays = { "value", "label" };
    options.Weights = true;
    MeshAnswer answer;
    this->Ranks.together(
      [&]
      {
        answer =
          answerOnRanks(this->Ranks, mesh, points.data(), std::int64_t(points.size()), options);
      });
    expectEqual(whole.answer(points.data(), std::int64_t(points.size()), options), answer);
  }

  /// This rank's share of the ids below `count`; the last rank has none.
  std::vector<std::int64_t> ownIds(std::size_t count) const
  {
    std::vector<std::int64_t> own;
    const auto asking = std::size_t(std::max(1, this->Ranks.size() - 1));
    for (auto i = std::size_t(this->Ranks.rank()); i < count && !this->isLast(); i += asking)
    {
      own.push_back(std::int64_t(i));
    }
    return own;
  }

  void expectAroundAsAlone(const ResidentMesh& mesh, const SourceMesh& source)
  {
    const ResidentMesh whole(inMemory(source));
    const std::vector<std::int64_t> cells = this->ownIds(source.cells());
    const std::vector<std::int64_t> points = this->ownIds(source.points());
    const auto expectEqualLists = [](const IdLists& expected, const IdLists& lists)
    {
      EXPECT_EQ(expected.Starts, lists.Starts);
      EXPECT_EQ(expected.Ids, lists.Ids);
    };
    this->Ranks.together(
      [&]
      {
        EXPECT_EQ(neighborsOf(whole, cells), neighborsOnRanks(this->Ranks, mesh, cells));
        expectEqualLists(starsOf(whole, points), starsOnRanks(this->Ranks, mesh, points));
        for (const int k : { 0, 1, 3 })
        {
          expectEqualLists(
            ringsOfPoints(whole, points, k), ringsOfPointsOnRanks(this->Ranks, mesh, points, k));
          expectEqualLists(
            ringsOfCells(whole, cells, k), ringsOfCellsOnRanks(this->Ranks, mesh, cells, k));
        }
        const Components expected = componentsOf(whole);
        const RankComponents components = componentsOnRanks(this->Ranks, mesh);
        EXPECT_EQ(expected.Sizes, components.Sizes);
        for (std::size_t i = 0; i < components.Cells.size(); ++i)
        {
          EXPECT_EQ(expected.OfCells[std::size_t(components.Cells[i])], components.OfCells[i]);
        }
        std::vector<std::int64_t> count = { std::int64_t(components.Cells.size()) };
        this->Ranks.sum(count);
        EXPECT_EQ(std::int64_t(source.cells()), count[0]);
        this->expectProfilesAsAlone(mesh, whole);
        source.CellSize == 3 ? this->expectLinesAsAlone(mesh, whole) : void();
      });
  }

  /// Each rank queries its own polyline, the last rank none.
  void expectProfilesAsAlone(const ResidentMesh& mesh, const ResidentMesh& whole)
  {
    const double shift = 0.05 * this->Ranks.rank();
    std::vector<Point3> polyline = { { -0.2, 0.3 + shift, 0.4 }, { 0.7, 0.6, 0.5 + shift },
      { 0.4, 1.2, 0.3 } };
    this->isLast() ? polyline.clear() : void();
    const std::vector<std::string> arrays = { "value", "label" };
    for (const double spacing : { 0.0, 0.07 })
    {
      const Profile expected = profileOf(whole, polyline, spacing, arrays);
      const Profile profile = profileOnRanks(this->Ranks, mesh, polyline, spacing, arrays);
      EXPECT_EQ(expected.Distances, profile.Distances);
      EXPECT_EQ(expected.Points, profile.Points);
      expectEqual(expected.Answer, profile.Answer);
    }
  }

  /// Borders and contours, which the first rank gets.
  void expectLinesAsAlone(const ResidentMesh& mesh, const ResidentMesh& whole)
  {
    const BoundaryLoops border = boundaryOnRanks(this->Ranks, mesh);
    const std::vector<double> levels = { 0.3, -0.2, 0.7 };
    const Contours contours = contoursOnRanks(this->Ranks, mesh, "value", 1, levels);
    const bool isFirst = this->Ranks.isFirst();
    const BoundaryLoops expected = isFirst ? boundaryOf(whole) : BoundaryLoops();
    EXPECT_EQ(expected.Points.Starts, border.Points.Starts);
    EXPECT_EQ(expected.Points.Ids, border.Points.Ids);
    EXPECT_EQ(expected.Positions, border.Positions);
    const Contours lines = isFirst ? contoursOf(whole, "value", 1, levels) : Contours();
    EXPECT_EQ(lines.Starts, contours.Starts);
    EXPECT_EQ(lines.Levels, contours.Levels);
    EXPECT_EQ(lines.Points, contours.Points);
  }

  Communicator Ranks;
  std::unique_ptr<TemporaryFolder> Folder;
  std::string Path;
};

TEST_F(QueryRanks, ShareThePiecesOfAStoredMesh)
{
  const SourceMesh source = makeSource(latticeTriangles(20, 0));
  this->store(source, "grid:4x3");
  const ResidentMesh mesh(this->Path);
  this->expectAsAlone(mesh, source);
  if (this->Ranks.size() > 1)
  {
    EXPECT_GT(12, mesh.pieces().loads());
  }
}

TEST_F(QueryRanks, ShareTetrahedraOnDisk)
{
  const SourceMesh source = makeSource(latticeTetrahedra(5, 0.3));
  this->store(source, "grid:2x2x2");
  this->expectAsAlone(ResidentMesh(this->Path), source);
}

TEST_F(QueryRanks, CellsInTheMemoryOfAllRanksAnswerAsOneMesh)
{
  for (const SourceMesh& source :
    { makeSource(latticeTriangles(16, 0)), makeSource(latticeTetrahedra(4, 0.3)) })
  {
    this->expectAsAlone(
      ResidentMesh(inMemory(source, 0, this->Ranks.rank(), this->Ranks.size())), source);
  }
}

TEST_F(QueryRanks, ARankMayHaveNoCells)
{
  const SourceMesh source = makeSource(latticeTriangles(16, 0.3));
  const int holders = std::max(1, this->Ranks.size() - 1);
  this->expectAsAlone(
    ResidentMesh(this->isLast() ? MeshPart() : inMemory(source, 0, this->Ranks.rank(), holders)),
    source);
}

TEST_F(QueryRanks, CellsWithoutIdsAreNumberedRankByRank)
{
  const SourceMesh source = makeSource(latticeTriangles(8, 0.3));
  MeshPart part = inMemory(source, 0, this->Ranks.rank(), this->Ranks.size());
  const std::int64_t* const ids = part.CellIds;
  std::vector<std::int64_t> mine(ids, ids + (ids ? part.OwnedCells : 0));
  std::vector<std::int64_t> all;
  for (const std::vector<std::int64_t>& list : this->Ranks.allGather(mine))
  {
    all.insert(all.end(), list.begin(), list.end());
  }
  part.CellIds = nullptr;
  const ResidentMesh mesh(part);
  const ResidentMesh whole(inMemory(source));
  const std::vector<Point3> points = this->ownOf(pointsAround(source, 100));
  const auto count = std::int64_t(points.size());
  MeshAnswer answer;
  this->Ranks.together([&] { answer = answerOnRanks(this->Ranks, mesh, points.data(), count); });
  const MeshAnswer expected = whole.answer(points.data(), count);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const std::int64_t cell = answer.Cells[i];
    EXPECT_EQ(expected.Cells[i], cell < 0 || all.empty() ? cell : all[std::size_t(cell)]);
  }
}

TEST_F(QueryRanks, FindNeighborsInAStoredMesh)
{
  for (const SourceMesh& source : { makeSource(latticeTriangles(10, 0.3)),
         makeSource(latticeTriangles(8, 0)), makeSource(latticeTetrahedra(3, 0.3)) })
  {
    this->store(source, source.CellSize == 3 ? "grid:3x3" : "grid:2x2x2");
    this->expectAroundAsAlone(ResidentMesh(this->Path), source);
  }
}

TEST_F(QueryRanks, FindNeighborsInPartsInMemory)
{
  const int holders = std::max(1, this->Ranks.size() - 1);
  for (const SourceMesh& source : { makeSource(latticeTriangles(10, 0.3)),
         makeSource(latticeTriangles(8, 0)), makeSource(latticeTetrahedra(3, 0.3)) })
  {
    this->expectAroundAsAlone(
      ResidentMesh(inMemory(source, 0, this->Ranks.rank(), this->Ranks.size())), source);
    this->expectAroundAsAlone(
      ResidentMesh(this->isLast() ? MeshPart() : inMemory(source, 0, this->Ranks.rank(), holders)),
      source);
  }
}

TEST_F(QueryRanks, ShareTheCellsOfZones)
{
  const SourceMesh source = makeSource(latticeTriangles(16, 0.3));
  const ResidentMesh whole(inMemory(source));
  const Zone square = { { { { 0.1, 0.1 }, { 0.8, 0.2 }, { 0.7, 0.9 }, { 0.1, 0.8 } }, false },
    { { { 0.3, 0.3 }, { 0.4, 0.3 }, { 0.3, 0.4 } }, true } };
  const Zone corner = { { { { -1, -1 }, { 2, -1 }, { -1, 2 } }, false } };
  const Zone outside = { { { { 5, 5 }, { 6, 5 }, { 5, 6 } }, false } };
  const std::vector<Zone> zones = { square, corner, outside };
  const auto expectAsAlone = [&](const ResidentMesh& mesh)
  {
    this->Ranks.together(
      [&]
      {
        for (const char* const array : { "value", "label" })
        {
          const ZoneStatistics expected = statisticsOf(whole, zones, array, 0, 0.25);
          // Zones of other ranks than the first are ignored.
          const ZoneStatistics found = statisticsOnRanks(
            this->Ranks, mesh, this->Ranks.isFirst() ? zones : std::vector<Zone>(), array, 0, 0.25);
          EXPECT_EQ(expected.Cells, found.Cells);
          EXPECT_EQ(expected.Area, found.Area);
          EXPECT_EQ(expected.Sum, found.Sum);
          EXPECT_EQ(expected.Above, found.Above);
          for (std::size_t i = 0; i < 2; ++i)
          {
            EXPECT_EQ(expected.Low[i], found.Low[i]);
            EXPECT_EQ(expected.High[i], found.High[i]);
            EXPECT_EQ(expected.Mean[i], found.Mean[i]);
          }
        }
      });
  };
  for (const char* const tiling : { "grid:3x3", "grid:1x1" })
  {
    this->store(source, tiling);
    expectAsAlone(ResidentMesh(this->Path));
  }
  expectAsAlone(ResidentMesh(inMemory(source, 0, this->Ranks.rank(), this->Ranks.size())));
  const int holders = std::max(1, this->Ranks.size() - 1);
  expectAsAlone(
    ResidentMesh(this->isLast() ? MeshPart() : inMemory(source, 0, this->Ranks.rank(), holders)));
}

TEST_F(QueryRanks, ShareTheCellsAndPointsOfRegions)
{
  const SourceMesh source = makeSource(latticeTriangles(12, 0));
  this->store(source, "grid:3x2");
  const ResidentMesh whole(inMemory(source));
  const ResidentMesh mesh(this->Path);
  const Region region = { { 0.2, 0.6, 0.3, 0.7, 0, 0 }, {} };
  this->Ranks.together(
    [&]
    {
      const bool isFirst = this->Ranks.isFirst();
      for (const bool inside : { false, true })
      {
        const std::vector<std::int64_t> cells = cellsOnRanks(this->Ranks, mesh, region, inside);
        EXPECT_EQ(isFirst ? cellsIn(whole, region, inside) : std::vector<std::int64_t>(), cells);
      }
      EXPECT_EQ(isFirst ? pointsIn(whole, region) : std::vector<std::int64_t>(),
        pointsOnRanks(this->Ranks, mesh, region));
    });
}

TEST_F(QueryRanks, FollowDescentsFromRankToRank)
{
  const SourceMesh source = makeSource(latticeTriangles(16, 0.3));
  const ResidentMesh whole(inMemory(source));
  const std::vector<Point3> points = this->ownOf(pointsAround(source, 60));
  for (const char* const tiling : { "grid:4x4", "grid:1x1" })
  {
    this->store(source, tiling);
    const ResidentMesh mesh(this->Path);
    for (int component = 0; component < 2; ++component)
    {
      const Descents expected = descentsOf(whole, points, "value", component);
      Descents found;
      this->Ranks.together(
        [&] { found = descentsOnRanks(this->Ranks, mesh, points, "value", component); });
      EXPECT_EQ(expected.Starts, found.Starts);
      EXPECT_EQ(expected.Points, found.Points);
      EXPECT_EQ(expected.Pits, found.Pits);
      ASSERT_EQ(expected.Values.size(), found.Values.size());
      EXPECT_TRUE(std::equal(expected.Values.begin(), expected.Values.end(), found.Values.begin()));
    }
  }
}

TEST_F(QueryRanks, AnswersMayStayWhereTheCellsAre)
{
  const SourceMesh source = makeSource(latticeTriangles(16, 0)); // points lie on common edges
  const std::vector<Point3> all = pointsAround(source, 200);
  const std::vector<Point3> own = this->ownOf(all);
  const ResidentMesh whole(inMemory(source));
  this->store(source, "grid:4x3");
  AnswerOptions options;
  options.Arrays = { "value", "label" };
  options.Weights = true;
  const auto expectAsAlone = [&](const ResidentMesh& mesh)
  {
    StayingAnswer found;
    this->Ranks.together(
      [&]
      {
        found =
          answerWhereCellsAre(this->Ranks, mesh, own.data(), std::int64_t(own.size()), options);
        std::vector<std::int64_t> count = { std::int64_t(found.Points.size()) };
        this->Ranks.sum(count);
        const std::vector<std::int64_t> cells =
          whole.answer(all.data(), std::int64_t(all.size())).Cells;
        EXPECT_EQ(
          std::count_if(cells.begin(), cells.end(), [](auto cell) { return cell >= 0; }), count[0]);
      });
    expectEqual(
      whole.answer(found.Points.data(), std::int64_t(found.Points.size()), options), found.Answer);
    const auto asking = std::size_t(std::max(1, this->Ranks.size() - 1));
    for (std::size_t i = 0; i < found.Points.size(); ++i)
    {
      const std::size_t index =
        std::size_t(found.Ranks[i]) + asking * std::size_t(found.Indices[i]);
      EXPECT_EQ(all[index], found.Points[i]);
    }
  };
  expectAsAlone(ResidentMesh(this->Path));
  expectAsAlone(ResidentMesh(inMemory(source, 0, this->Ranks.rank(), this->Ranks.size())));
}

TEST_F(QueryRanks, TheFilterLeavesValuesOnOwnersAndSharesZonesAndDescents)
{
  const SourceMesh source = makeSource(latticeTriangles(10, 0.3));
  this->store(source, "grid:3x3");
  vtkNew<vtkPartitionedMeshQuery> query;
  query->SetFileName(this->Path.c_str());
  vtkNew<vtkDoubleArray> asked;
  asked->SetNumberOfComponents(3);
  asked->InsertNextTuple3(0.31, 0.32, 0);
  asked->InsertNextTuple3(0.77, 0.81, 0);
  asked->InsertNextTuple3(9, 9, 0);
  vtkNew<vtkPolyData> values;
  ASSERT_EQ(1, query->InterpolateOnOwners(asked, values));
  EXPECT_TRUE(values->GetPointData()->GetArray("value"));
  EXPECT_TRUE(values->GetPointData()->GetArray("AskingRank"));
  std::vector<std::int64_t> count = { values->GetNumberOfPoints(), values->GetNumberOfVerts() };
  this->Ranks.together([&] { this->Ranks.sum(count); });
  EXPECT_EQ(2 * this->Ranks.size(), count[0]);
  EXPECT_EQ(count[0], count[1]);

  vtkNew<vtkPolyData> lines;
  ASSERT_EQ(1, query->Descend(asked, "value", 0, lines));
  EXPECT_EQ(2, lines->GetNumberOfLines());

  vtkNew<vtkPoints> corners;
  corners->InsertNextPoint(-1, -1, 0);
  corners->InsertNextPoint(2, -1, 0);
  corners->InsertNextPoint(2, 2, 0);
  corners->InsertNextPoint(-1, 2, 0);
  vtkNew<vtkCellArray> polygons;
  const vtkIdType ids[4] = { 0, 1, 2, 3 };
  polygons->InsertNextCell(4, ids);
  vtkNew<vtkPolyData> zone;
  zone->SetPoints(corners);
  zone->SetPolys(polygons);
  vtkNew<vtkPointData> statistics;
  ASSERT_EQ(1, query->ZoneStatistics(zone, "value", 0, 0, statistics));
  EXPECT_EQ(double(source.cells()), statistics->GetArray("Cells")->GetComponent(0, 0));
}

TEST_F(QueryRanks, TheFilterQueriesAllRanksTogether)
{
  const SourceMesh source = makeSource(latticeTriangles(10, 0.3));
  this->store(source, "grid:3x3");
  const ResidentMesh whole(inMemory(source));
  const std::vector<std::int64_t> cells = this->ownIds(source.cells());
  vtkNew<vtkPartitionedMeshQuery> query;
  query->SetFileName(this->Path.c_str());
  vtkNew<vtkIdTypeArray> asked;
  for (const std::int64_t cell : cells)
  {
    asked->InsertNextValue(cell);
  }
  vtkNew<vtkIdTypeArray> found;
  ASSERT_EQ(1, query->Neighbors(asked, found));
  const std::vector<std::int64_t> expected = neighborsOf(whole, cells);
  ASSERT_EQ(std::int64_t(expected.size()), found->GetNumberOfValues());
  EXPECT_TRUE(std::equal(expected.begin(), expected.end(), found->GetPointer(0)));
  vtkNew<vtkIdTypeArray> ofCells;
  vtkNew<vtkIdTypeArray> sizes;
  vtkNew<vtkIdTypeArray> ids;
  ASSERT_EQ(1, query->Components(ofCells, sizes, ids));
  ASSERT_EQ(1, sizes->GetNumberOfValues());
  EXPECT_EQ(std::int64_t(source.cells()), sizes->GetValue(0));
  EXPECT_EQ(ids->GetNumberOfValues(), ofCells->GetNumberOfValues());
  vtkNew<vtkPolyData> border;
  ASSERT_EQ(1, query->Boundary(border));
  EXPECT_EQ(this->Ranks.isFirst() ? 40 : 0, border->GetNumberOfPoints());
}

TEST_F(QueryRanks, PartsWithoutIdsAndUnknownIdsAreRefused)
{
  const SourceMesh source = makeSource(latticeTriangles(6, 0.3));
  const auto expectFailure = [](const MeshPart& part, std::int64_t id, const char* message)
  {
    const ResidentMesh mesh(part);
    Communicator ranks(vtkMultiProcessController::GetGlobalController());
    try
    {
      ranks.together([&] { starsOnRanks(ranks, mesh, { id }); });
      ADD_FAILURE() << "not refused: " << message;
    }
    catch (const RankFailure& failure)
    {
      EXPECT_NE(std::string::npos, std::string(failure.what()).find(message)) << failure.what();
    }
  };
  MeshPart part = inMemory(source, 0, this->Ranks.rank(), this->Ranks.size());
  expectFailure(part, 1000, "has no point 1000");
  part.PointIds = nullptr;
  if (this->Ranks.size() > 1)
  {
    expectFailure(part, 0, "no global ids");
  }
}

TEST_F(QueryRanks, AFailureOfOneRankEndsAll)
{
  const SourceMesh source = makeSource(latticeTriangles(12, 0.3));
  this->store(source, "grid:4x4");
  const ResidentMesh mesh(this->Path);
  this->Ranks.barrier();
  if (this->Ranks.isFirst()) // the last piece is on the last rank
  {
    const std::string piece = mesh.mesh().piecePath(15);
    std::string content = contentOf(piece);
    content[content.size() / 2] = char(content[content.size() / 2] ^ 1);
    std::ofstream(piece, std::ios::binary) << content;
  }
  this->Ranks.barrier();
  const std::vector<Point3> points = this->ownOf(pointsAround(source, 100));
  try
  {
    this->Ranks.together(
      [&] { answerOnRanks(this->Ranks, mesh, points.data(), std::int64_t(points.size())); });
    ADD_FAILURE() << "the damage was not noticed";
  }
  catch (const RankFailure& failure)
  {
    EXPECT_NE(std::string::npos, std::string(failure.what()).find("000015.vtu")) << failure.what();
    EXPECT_EQ(this->Ranks.size() - 1, failure.Rank);
  }
}

} // namespace
