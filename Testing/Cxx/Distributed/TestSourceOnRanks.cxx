// SPDX-License-Identifier: BSD-3-Clause
// vtkTIPPDelaunay2D with constraints from its source, on several ranks.
#include "DistributedTesting.h"
#include "RankData.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkMultiProcessController.h"
#include "vtkTable.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

/// How the source is distributed over the ranks.
enum class SourceShare
{
  Copies,
  OnFirst,
  Split
};

/// Crossing lines between points of the input and new points, and a polygon around them.
class TestSource
{
public:
  TestSource(const Coordinates& xy, bool hasPoints)
    : XY(xy)
    , HasPoints(hasPoints)
  {
  }

  /// Returns the lines [begin, end); after the last line also the polygon.
  vtkSmartPointer<vtkPolyData> part(int begin, int end) const
  {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkDoubleArray> height;
    height->SetName("height");
    vtkNew<vtkCellArray> lines;
    vtkNew<vtkCellArray> polygons;
    const auto add = [&](double x, double y)
    {
      height->InsertNextValue(x + y);
      return points->InsertNextPoint(x, y, 7);
    };
    const auto n = vtkIdType(this->XY.size() / 2);
    for (int i = begin; i < end; ++i)
    {
      const vtkIdType a = i * 37 % n;
      const vtkIdType b = (i * 911 + 13) % n;
      const auto at = [this](vtkIdType id, int axis)
      { return this->XY[std::size_t(2 * id + axis)]; };
      const bool isNew = i % 3 == 0;
      const vtkIdType ends[2] = { this->HasPoints ? add(at(a, 0), at(a, 1)) : a,
        this->HasPoints ? add(isNew ? (at(a, 0) + 2 * at(b, 0)) / 3 : at(b, 0), at(b, 1)) : b };
      lines->InsertNextCell(2, ends);
    }
    if (this->HasPoints && end == Lines)
    {
      const vtkIdType corners[4] = { add(0.1, 0.15), add(0.9, 0.1), add(0.85, 0.9), add(0.2, 0.8) };
      polygons->InsertNextCell(4, corners);
    }
    auto source = vtkSmartPointer<vtkPolyData>::New();
    if (this->HasPoints)
    {
      source->SetPoints(points);
      source->GetPointData()->AddArray(height);
    }
    source->SetLines(lines);
    source->SetPolys(polygons);
    return source;
  }

  vtkSmartPointer<vtkPolyData> of(SourceShare share) const
  {
    const int begin = share == SourceShare::Split ? Lines * rank() / ranks() : 0;
    const int end = share == SourceShare::Split ? Lines * (rank() + 1) / ranks() : Lines;
    return share == SourceShare::OnFirst && rank() > 0 ? nullptr : this->part(begin, end);
  }

  static constexpr int Lines = 20;

private:
  const Coordinates& XY;
  const bool HasPoints;
};

/// A vertex's coordinates and values; triangles with their marks.
/// The points and triangles of a mesh, for comparison.
struct ConstrainedCells
{
  std::map<std::int64_t, std::vector<double>> Points; ///< x, y, z and height by id
  std::set<std::vector<std::int64_t>> Cells; ///< id and mark of each corner, lowest id first
};

/// `ids` are the points' global ids. If null, a point's index is its id.
ConstrainedCells constrainedCells(vtkPolyData* mesh, vtkDataArray* ids)
{
  ConstrainedCells all;
  const auto id = [ids](vtkIdType point) { return ids ? idAt(ids, point) : point; };
  vtkDataArray* const marks = mesh->GetCellData()->GetArray("ConstraintEdges");
  vtkDataArray* const height = mesh->GetPointData()->GetArray("height");
  vtkNew<vtkIdList> corners;
  mesh->BuildCells();
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    mesh->GetCellPoints(cell, corners);
    std::vector<std::int64_t> its;
    vtkIdType low = 0;
    for (vtkIdType i = 0; i < 3; ++i)
    {
      const vtkIdType point = corners->GetId(i);
      low = id(point) < id(corners->GetId(low)) ? i : low;
      const double* const p = mesh->GetPoint(point);
      all.Points[id(point)] = { p[0], p[1], p[2], height ? height->GetTuple1(point) : -1 };
    }
    for (vtkIdType i = 0; i < 3; ++i)
    {
      its.push_back(id(corners->GetId((low + i) % 3)));
      its.push_back(marks ? std::int64_t(marks->GetComponent(cell, int((low + i) % 3))) : -1);
    }
    all.Cells.insert(its);
  }
  return all;
}

/// All points in one process, with the data that shareAsData() makes.
vtkSmartPointer<vtkPolyData> allAsData(const Coordinates& xy)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> height;
  height->SetName("height");
  for (std::size_t i = 0; i < xy.size() / 2; ++i)
  {
    points->InsertNextPoint(xy[2 * i], xy[2 * i + 1], double(i));
    height->InsertNextValue(3 * double(i));
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->GetPointData()->AddArray(height);
  return data;
}

TEST(SourceOnRanks, InsertTheSourceLikeOneRank)
{
  const Coordinates xy = makePointSet("duplicates", 3000);
  for (const bool merges : { true, false })
  {
    const TestSource source(xy, merges);
    vtkNew<vtkTIPPDelaunay2D> alone;
    alone->SetController(nullptr);
    alone->SetInputData(shareAsData(xy, false));
    Communicator box(vtkMultiProcessController::GetGlobalController());
    const auto prepare = [merges](vtkTIPPDelaunay2D* filter)
    {
      filter->SetMergeSourcePoints(merges);
      filter->SetConstraintMarks(vtkTIPPDelaunay2D::EDGE_FLAGS);
      filter->SetPointsPerPartition(150);
    };
    for (const auto share : { SourceShare::Copies, SourceShare::OnFirst, SourceShare::Split })
    {
      vtkNew<vtkTIPPDelaunay2D> filter;
      prepare(filter);
      filter->SetInputData(shareAsData(xy, share == SourceShare::OnFirst));
      if (const auto own = source.of(share))
      {
        filter->SetSourceData(own);
      }
      filter->SetGatherOnFirstRank(true);
      filter->Update();
      ASSERT_EQ(0u, filter->GetErrorCode());
      EXPECT_GT(
        filter->GetStatistics()->GetFieldData()->GetArray("CrossingPoints")->GetTuple1(0), 0);
      // The expected result: one process triangulates all points.
      if (rank() == 0)
      {
        prepare(alone);
        alone->SetInputData(allAsData(xy));
        alone->SetSourceData(source.part(0, TestSource::Lines));
        alone->Update();
        const ConstrainedCells expected = constrainedCells(alone->GetOutput(), nullptr);
        const ConstrainedCells made = constrainedCells(
          filter->GetOutput(), filter->GetOutput()->GetPointData()->GetGlobalIds());
        EXPECT_TRUE(expected.Cells == made.Cells)
          << merges << int(share) << ": " << expected.Cells.size() << " " << made.Cells.size();
        EXPECT_TRUE(expected.Points == made.Points) << merges << int(share);
        EXPECT_GT(expected.Points.rbegin()->first, std::int64_t(xy.size() / 2)); // crossings
      }
      box.barrier();
    }
  }
}

/// A lattice, some of it twice: lines pass through its points, and cross there and elsewhere.
TEST(SourceOnRanks, KeepsPointsOnLinesAndCrossingsAtPoints)
{
  constexpr int side = 12;
  Coordinates xy;
  for (int i = 0; i < 2 * side * side; ++i)
  {
    const int place = i * 7 % (side * side);
    xy.insert(xy.end(), { double(place % side), double(place / side) });
  }
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkPoints> ends;
  ends->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> height;
  height->SetName("height");
  const auto addLine = [&](double x, double y, double toX, double toY)
  {
    const vtkIdType line[2] = { ends->InsertNextPoint(x, y, 1),
      ends->InsertNextPoint(toX, toY, 2) };
    height->InsertNextValue(100);
    height->InsertNextValue(200);
    lines->InsertNextCell(2, line);
  };
  addLine(0, 0, 11, 11);
  addLine(0, 11, 11, 0);
  addLine(0, 6, 11, 6);
  addLine(0.5, 4, 10, 9);
  addLine(4, 0, 4, 11);
  vtkNew<vtkPolyData> source;
  source->SetPoints(ends);
  source->GetPointData()->AddArray(height);
  source->SetLines(lines);
  const auto update = [&](vtkTIPPDelaunay2D* filter, vtkPolyData* input)
  {
    filter->SetMergeSourcePoints(true);
    filter->SetConstraintMarks(vtkTIPPDelaunay2D::EDGE_FLAGS);
    filter->SetPointsPerPartition(20);
    filter->SetInputData(input);
    filter->SetSourceData(source);
    filter->SetGatherOnFirstRank(true);
    filter->Update();
    ASSERT_EQ(0u, filter->GetErrorCode());
  };
  const auto crossings = [](vtkTIPPDelaunay2D* filter)
  { return filter->GetStatistics()->GetFieldData()->GetArray("CrossingPoints")->GetTuple1(0); };
  for (const bool withIds : { true, false })
  {
    vtkNew<vtkTIPPDelaunay2D> filter;
    update(filter, shareAsData(xy, withIds));
    if (rank() == 0)
    {
      vtkNew<vtkTIPPDelaunay2D> alone;
      alone->SetController(nullptr);
      update(alone, allAsData(xy));
      const ConstrainedCells expected = constrainedCells(alone->GetOutput(), nullptr);
      const ConstrainedCells made =
        constrainedCells(filter->GetOutput(), filter->GetOutput()->GetPointData()->GetGlobalIds());
      EXPECT_EQ(expected.Cells, made.Cells);
      EXPECT_EQ(expected.Points, made.Points);
      EXPECT_EQ(crossings(alone), crossings(filter));
      EXPECT_GT(crossings(alone), 0);
    }
    Communicator(vtkMultiProcessController::GetGlobalController()).barrier();
  }
}

TEST(SourceOnRanks, GhostsHaveMarksOfConstraints)
{
  const Coordinates xy = makePointSet("uniform", 3000);
  const TestSource source(xy, true);
  vtkNew<vtkTIPPDelaunay2D> filter;
  filter->SetPointsPerPartition(150);
  filter->SetMergeSourcePoints(true);
  filter->SetConstraintMarks(vtkTIPPDelaunay2D::EDGE_FLAGS);
  filter->SetInputData(shareAsData(xy, false));
  filter->SetSourceData(source.of(SourceShare::Copies));
  filter->UpdateInformation();
  filter->UpdatePiece(rank(), ranks(), 1);
  vtkPolyData* const mesh = filter->GetOutput();
  vtkDataArray* const ids = mesh->GetPointData()->GetGlobalIds();
  ASSERT_TRUE(ids);
  const auto cells = constrainedCells(mesh, ids).Cells;
  Communicator box(vtkMultiProcessController::GetGlobalController());
  const std::vector<std::vector<std::int64_t>> own(cells.begin(), cells.end());
  std::map<std::vector<std::int64_t>, std::vector<std::int64_t>> marksOf; // marks by corners
  std::size_t shared = 0;
  for (const auto& rank : box.allGather(own))
  {
    for (const std::vector<std::int64_t>& cell : rank)
    {
      const std::vector<std::int64_t> marks{ cell[1], cell[3], cell[5] };
      const auto [known, isNew] = marksOf.emplace(std::vector{ cell[0], cell[2], cell[4] }, marks);
      shared += isNew ? 0 : 1;
      ASSERT_TRUE(known->second == marks);
    }
  }
  EXPECT_GT(shared, 10u);
  box.barrier();
}

/// The ends of each line, as global ids if `ids` is not null, and its ConstraintId.
std::vector<std::array<vtkIdType, 3>> linesOf(vtkPolyData* mesh, vtkDataArray* ids)
{
  std::vector<std::array<vtkIdType, 3>> lines;
  const auto id = [ids](vtkIdType point) { return ids ? idAt(ids, point) : point; };
  vtkDataArray* const cells = mesh->GetCellData()->GetArray("ConstraintId");
  vtkNew<vtkIdList> ends;
  for (vtkIdType line = 0; line < mesh->GetNumberOfLines(); ++line)
  {
    mesh->GetLines()->GetCellAtId(line, ends);
    lines.push_back({ id(ends->GetId(0)), id(ends->GetId(1)), idAt(cells, line) });
  }
  for (vtkIdType cell = mesh->GetNumberOfLines(); cell < mesh->GetNumberOfCells(); ++cell)
  {
    EXPECT_EQ(-1, idAt(cells, cell));
  }
  return lines;
}

TEST(SourceOnRanks, ListTheLinesThatOneRankLists)
{
  const Coordinates xy = makePointSet("duplicates", 3000);
  const TestSource source(xy, false);
  const auto prepare = [](vtkTIPPDelaunay2D* filter)
  {
    filter->SetConstraintMarks(vtkTIPPDelaunay2D::LINES);
    filter->SetPointsPerPartition(150);
  };
  vtkNew<vtkTIPPDelaunay2D> alone;
  alone->SetController(nullptr);
  prepare(alone);
  alone->SetInputData(allAsData(xy));
  alone->SetSourceData(source.part(0, TestSource::Lines));
  alone->Update();
  const auto expected = linesOf(alone->GetOutput(), nullptr);
  ASSERT_LT(std::size_t(TestSource::Lines), expected.size());
  Communicator box(vtkMultiProcessController::GetGlobalController());
  for (const bool gathers : { true, false })
  {
    vtkNew<vtkTIPPDelaunay2D> filter;
    prepare(filter);
    filter->SetGatherOnFirstRank(gathers);
    filter->SetInputData(shareAsData(xy, false));
    filter->SetSourceData(source.of(SourceShare::Copies));
    filter->UpdateInformation();
    filter->UpdatePiece(rank(), ranks(), gathers ? 0 : 1);
    vtkPolyData* const mesh = filter->GetOutput();
    const auto made = linesOf(mesh, mesh->GetPointData()->GetGlobalIds());
    std::vector<vtkIdType> numbers;
    for (vtkIdType line = 0; line < mesh->GetNumberOfLines(); ++line)
    {
      numbers.push_back(idAt(mesh->GetCellData()->GetGlobalIds(), line));
    }
    std::vector<std::array<vtkIdType, 3>> all;
    for (const auto& part : box.allGather(made))
    {
      all.insert(all.end(), part.begin(), part.end());
    }
    std::set<vtkIdType> different;
    for (const auto& part : box.allGather(numbers))
    {
      different.insert(part.begin(), part.end());
    }
    EXPECT_EQ(expected.size(), different.size()) << "numbers of cells";
    auto sorted = expected;
    if (!gathers)
    {
      EXPECT_LT(made.size(), all.size());
      std::sort(sorted.begin(), sorted.end());
      std::sort(all.begin(), all.end());
    }
    EXPECT_TRUE(sorted == all) << gathers << ' ' << sorted.size() << ' ' << all.size();
  }
}

TEST(SourceOnRanks, RanksMayHaveNoPointsOrNoSource)
{
  const Coordinates xy = makePointSet("uniform", 2000);
  const int last = ranks() - 1;
  // The only rank with points, and the only rank with a source.
  for (const auto& [points, lines] : { std::pair(0, last), std::pair(last, 0), std::pair(0, 0) })
  {
    for (const bool merges : { true, false })
    {
      const TestSource source(xy, merges);
      vtkNew<vtkTIPPDelaunay2D> filter;
      filter->SetMergeSourcePoints(merges);
      filter->SetConstraintMarks(vtkTIPPDelaunay2D::EDGE_FLAGS);
      filter->SetPointsPerPartition(150);
      filter->SetGatherOnFirstRank(true);
      filter->SetInputData(rank() == points ? allAsData(xy) : vtkSmartPointer<vtkPolyData>::New());
      if (rank() == lines)
      {
        filter->SetSourceData(source.part(0, TestSource::Lines));
      }
      filter->Update();
      ASSERT_EQ(0u, filter->GetErrorCode());
      if (rank() == 0)
      {
        vtkNew<vtkTIPPDelaunay2D> alone;
        alone->SetController(nullptr);
        alone->SetMergeSourcePoints(merges);
        alone->SetConstraintMarks(vtkTIPPDelaunay2D::EDGE_FLAGS);
        alone->SetInputData(allAsData(xy));
        alone->SetSourceData(source.part(0, TestSource::Lines));
        alone->Update();
        const ConstrainedCells expected = constrainedCells(alone->GetOutput(), nullptr);
        const ConstrainedCells made = constrainedCells(
          filter->GetOutput(), filter->GetOutput()->GetPointData()->GetGlobalIds());
        EXPECT_TRUE(expected.Cells == made.Cells) << points << lines << merges;
        EXPECT_TRUE(expected.Points == made.Points) << points << lines << merges;
      }
      Communicator(vtkMultiProcessController::GetGlobalController()).barrier();
    }
  }
}

TEST(SourceOnRanks, AnInvalidPointIdInTheSourceFailsOnAll)
{
  const Coordinates xy = makePointSet("uniform", 500);
  vtkNew<vtkCellArray> lines;
  const vtkIdType ends[2] = { 3, 500 };
  lines->InsertNextCell(2, ends);
  vtkNew<vtkPolyData> source;
  source->SetLines(lines);
  vtkNew<vtkTIPPDelaunay2D> filter;
  filter->SetInputData(shareAsData(xy, false));
  if (rank() == ranks() - 1)
  {
    filter->SetSourceData(source);
  }
  expectNoOutput(filter);
  EXPECT_NE(filter->GetErrorCode(), 0u);
}

} // namespace
