// SPDX-License-Identifier: BSD-3-Clause
// vtkTIPPDelaunay2D with the global controller of several ranks.
#include "DistributedTesting.h"

#include "Output/FilterPipeline.h"

#include "vtkTIPPDelaunay2D.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <map>
#include <set>

namespace
{

using namespace tipp;
using namespace tipp::test;

/// This rank's share of the points, with z, an array and, if wanted, global ids.
vtkSmartPointer<vtkPolyData> shareAsData(const Coordinates& xy, bool withIds)
{
  const RankShare mine = shareOf(xy, withIds ? Share::RoundRobin : Share::Blocks, rank(), ranks());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> height;
  height->SetName("height");
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("ids");
  for (std::size_t i = 0; i < mine.GlobalIds.size(); ++i)
  {
    const double id = double(mine.GlobalIds[i]);
    points->InsertNextPoint(mine.XY[2 * i], mine.XY[2 * i + 1], id);
    height->InsertNextValue(3 * id);
    ids->InsertNextValue(mine.GlobalIds[i]);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->GetPointData()->AddArray(height);
  if (withIds)
  {
    data->GetPointData()->SetGlobalIds(ids);
  }
  return data;
}

/// Gives Data, or fails: early, when it is asked what it has, or when it is to give it.
class FailingSource : public vtkPolyDataAlgorithm
{
public:
  static FailingSource* New();
  vtkTypeMacro(FailingSource, vtkPolyDataAlgorithm)
  FailingSource() { this->SetNumberOfInputPorts(0); }

  bool Fails = false;
  bool Early = false;
  vtkSmartPointer<vtkPolyData> Data;

protected:
  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* output) override
  {
    output->GetInformationObject(0)->Set(CAN_HANDLE_PIECE_REQUEST(), 1);
    return !(this->Fails && this->Early);
  }
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* output) override
  {
    vtkPolyData::GetData(output)->ShallowCopy(this->Data);
    return !this->Fails;
  }
};
vtkStandardNewMacro(FailingSource);

class AbortOnProgress : public vtkCommand
{
public:
  static AbortOnProgress* New() { return new AbortOnProgress; }
  void Execute(vtkObject* caller, unsigned long, void*) override
  {
    static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
  }
};

void expectNoOutput(vtkTIPPDelaunay2D* filter)
{
  vtkObject::GlobalWarningDisplayOff();
  filter->Update();
  vtkObject::GlobalWarningDisplayOn();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
}

vtkIdType idAt(vtkDataArray* ids, vtkIdType i)
{
  return static_cast<vtkIdTypeArray*>(ids)->GetValue(i);
}

bool isGhost(vtkDataSetAttributes* data, vtkIdType i)
{
  auto* ghosts = vtkUnsignedCharArray::SafeDownCast(
    data->GetAbstractArray(vtkDataSetAttributes::GhostArrayName()));
  return ghosts && ghosts->GetValue(i) != 0;
}

Triangle cornersOf(vtkPolyData* mesh, vtkIdType cell)
{
  vtkDataArray* ids = mesh->GetPointData()->GetGlobalIds();
  vtkNew<vtkIdList> corners;
  mesh->GetCellPoints(cell, corners);
  return canonical(
    idAt(ids, corners->GetId(0)), idAt(ids, corners->GetId(1)), idAt(ids, corners->GetId(2)));
}

struct PieceCell
{
  Triangle Corners;
  std::int64_t Number;
  std::int64_t IsGhost;
};

std::vector<PieceCell> cellsOf(vtkPolyData* mesh)
{
  std::vector<PieceCell> cells;
  mesh->BuildCells();
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    cells.push_back({ cornersOf(mesh, i), idAt(mesh->GetCellData()->GetGlobalIds(), i),
      isGhost(mesh->GetCellData(), i) });
  }
  return cells;
}

/// All ranks' cells, on rank 0.
std::vector<std::vector<PieceCell>> gatherCells(vtkPolyData* mesh)
{
  Communicator box(vtkMultiProcessController::GetGlobalController());
  std::vector<std::vector<PieceCell>> all = box.gather(cellsOf(mesh));
  box.barrier();
  return all;
}

void expectWhole(const std::vector<std::vector<PieceCell>>& pieces, const Triangles& expected,
  const Coordinates& xy)
{
  Triangles all;
  std::set<std::int64_t> numbers;
  for (const auto& piece : pieces)
  {
    for (const PieceCell& cell : piece)
    {
      if (!cell.IsGhost)
      {
        all.push_back(cell.Corners);
        numbers.insert(cell.Number);
      }
    }
  }
  EXPECT_EQ(sorted(all), expected);
  ASSERT_EQ(numbers.size(), all.size());
  EXPECT_TRUE(
    all.empty() || (*numbers.begin() == 0 && *numbers.rbegin() + 1 == std::int64_t(all.size())));
  EXPECT_FALSE(xy.empty());
}

TEST(Delaunay2DRanks, PiecesAreTheWholeTriangulation)
{
  const Coordinates xy = makePointSet("duplicates", 6000);
  for (const bool withIds : { true, false })
  {
    vtkNew<vtkTIPPDelaunay2D> filter;
    filter->SetPointsPerPartition(150);
    filter->SetInputData(shareAsData(xy, withIds));
    filter->Update();
    const auto pieces = gatherCells(filter->GetOutput());
    const Reference expected = reference(xy);
    if (rank() == 0)
    {
      expectWhole(pieces, expected.Mesh, xy);
    }
    std::size_t duplicates = 0;
    for (std::size_t i = 0; i < expected.Representative.size(); ++i)
    {
      duplicates += expected.Representative[i] != std::int64_t(i);
    }
    EXPECT_EQ(filter->GetNumberOfDuplicatePoints(), vtkIdType(duplicates));
  }
}

TEST(Delaunay2DRanks, PointsKeepTheirDataAndThirdCoordinate)
{
  const Coordinates xy = makePointSet("uniform", 5000);
  vtkNew<vtkTIPPDelaunay2D> filter;
  filter->SetPointsPerPartition(200);
  filter->SetInputData(shareAsData(xy, true));
  filter->Update();
  if (ranks() == 1)
  {
    return; // the input's own points
  }
  vtkPolyData* mesh = filter->GetOutput();
  vtkDataArray* ids = mesh->GetPointData()->GetGlobalIds();
  vtkDataArray* height = mesh->GetPointData()->GetArray("height");
  ASSERT_NE(ids, nullptr);
  ASSERT_NE(height, nullptr);
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    const vtkIdType id = idAt(ids, i);
    ASSERT_EQ(height->GetTuple1(i), 3.0 * double(id));
    ASSERT_EQ(mesh->GetPoint(i)[0], xy[2 * std::size_t(id)]);
    ASSERT_EQ(mesh->GetPoint(i)[2], double(id));
  }
}

TEST(Delaunay2DRanks, GhostsAreTheOtherTrianglesAtAPiecesPoints)
{
  const Coordinates xy = makePointSet("clustered", 5000);
  vtkNew<vtkTIPPDelaunay2D> filter;
  filter->SetPointsPerPartition(150);
  filter->SetInputData(shareAsData(xy, true));
  filter->UpdatePiece(rank(), ranks(), 1);
  const auto pieces = gatherCells(filter->GetOutput());
  if (rank() != 0 || ranks() == 1)
  {
    return;
  }
  const Reference expected = reference(xy);
  expectWhole(pieces, expected.Mesh, xy);
  for (const auto& piece : pieces)
  {
    std::set<std::int64_t> points;
    Triangles own;
    Triangles ghosts;
    for (const PieceCell& cell : piece)
    {
      (cell.IsGhost ? ghosts : own).push_back(cell.Corners);
      if (!cell.IsGhost)
      {
        points.insert(cell.Corners.begin(), cell.Corners.end());
      }
    }
    own = sorted(own);
    Triangles around;
    for (const Triangle& triangle : expected.Mesh)
    {
      const bool touches = std::any_of(triangle.begin(), triangle.end(),
        [&points](std::int64_t id) { return points.count(id) > 0; });
      if (touches && !std::binary_search(own.begin(), own.end(), triangle))
      {
        around.push_back(triangle);
      }
    }
    EXPECT_EQ(sorted(ghosts), around);
  }
}

TEST(Delaunay2DRanks, EverythingCanBeGatheredOnTheFirstRank)
{
  const Coordinates xy = makePointSet("uniform", 5000);
  vtkNew<vtkTIPPDelaunay2D> filter;
  filter->SetPointsPerPartition(200);
  filter->GatherOnFirstRankOn();
  filter->SetInputData(shareAsData(xy, true));
  filter->Update();
  vtkPolyData* mesh = filter->GetOutput();
  if (rank() != 0)
  {
    EXPECT_EQ(mesh->GetNumberOfCells(), 0);
    return;
  }
  expectWhole({ cellsOf(mesh) }, reference(xy).Mesh, xy);
}

TEST(Delaunay2DRanks, StatisticsAreTheSameOnAllRanks)
{
  const Coordinates xy = makePointSet("uniform", 20000);
  vtkNew<vtkTIPPDelaunay2D> filter;
  filter->SetMasters(vtkTIPPDelaunay2D::MULTI_MASTER);
  filter->SetNumberOfMajorPartitions(4, 4);
  filter->SetNumberOfPartitions(4, 4);
  filter->SetInputData(shareAsData(xy, true));
  filter->Update();
  vtkFieldData* totals = filter->GetStatistics()->GetFieldData();
  EXPECT_EQ(totals->GetArray("Partitions")->GetTuple1(0), 256);
  EXPECT_EQ(totals->GetArray("MajorPartitions")->GetTuple1(0), 16);
  EXPECT_EQ(totals->GetArray("RankOwnedPoints")->GetNumberOfTuples(), ranks());
  EXPECT_EQ(totals->GetArray("Points")->GetTuple1(0), 20000);
  EXPECT_GT(filter->GetStatistics()->GetNumberOfRows(), 0);
}

TEST(Delaunay2DRanks, WhatNeedsOneRankIsRefusedOnAll)
{
  for (const bool wantsAlpha : { true, false })
  {
    vtkNew<vtkTIPPDelaunay2D> filter;
    filter->SetAlpha(wantsAlpha ? 0.1 : 0);
    filter->SetGenerateNeighborIds(!wantsAlpha);
    filter->SetInputData(shareAsData(makePointSet("uniform", 500), true));
    vtkObject::GlobalWarningDisplayOff();
    filter->Update();
    vtkObject::GlobalWarningDisplayOn();
    EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
    EXPECT_NE(filter->GetErrorCode(), 0u);
  }
}

TEST(Delaunay2DRanks, AGhostLayerAskedForByOneRankComesThere)
{
  vtkNew<vtkTIPPDelaunay2D> filter;
  filter->SetPointsPerPartition(200);
  filter->SetInputData(shareAsData(makePointSet("uniform", 3000), true));
  filter->UpdatePiece(rank(), ranks(), rank() == 0 ? 1 : 0);
  vtkPolyData* mesh = filter->GetOutput();
  vtkIdType ghosts = 0;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    ghosts += isGhost(mesh->GetCellData(), cell);
  }
  EXPECT_EQ(ghosts > 0, rank() == 0);
}

TEST(Delaunay2DRanks, AbortingOnOneRankEmptiesTheOutputOfAll)
{
  vtkNew<vtkTIPPDelaunay2D> filter;
  filter->SetPointsPerPartition(200);
  filter->SetInputData(shareAsData(makePointSet("uniform", 20000), true));
  vtkNew<AbortOnProgress> abort;
  if (rank() == ranks() - 1)
  {
    filter->AddObserver(vtkCommand::ProgressEvent, abort);
  }
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(filter->GetErrorCode(), 0u);
}

TEST(Delaunay2DRanks, AMissingTransformFailsOnAll)
{
  vtkNew<vtkTIPPDelaunay2D> filter;
  filter->SetProjectionPlaneMode(VTK_SET_TRANSFORM_PLANE);
  filter->SetInputData(shareAsData(makePointSet("uniform", 500), true));
  expectNoOutput(filter);
}

TEST(Delaunay2DRanks, WhatFailsUpstreamOnOneRankFailsOnAll)
{
  for (const bool early : { true, false })
  {
    vtkNew<FailingSource> source;
    source->Early = early;
    source->Fails = rank() == ranks() - 1;
    source->Data = shareAsData(makePointSet("uniform", 500), true);
    vtkNew<vtkTIPPDelaunay2D> filter;
    filter->SetInputConnection(source->GetOutputPort());
    expectNoOutput(filter);
    source->Fails = false;
    source->Modified();
    filter->Update();
    EXPECT_GT(filter->GetStatistics()->GetFieldData()->GetArray("Triangles")->GetTuple1(0), 900);
  }
}

TEST(CollectivePipeline, IsTheFiltersAndRunsAloneWithoutRanks)
{
  vtkNew<FailingSource> source;
  source->Fails = rank() == 0; // of the others nobody waits for it
  source->Data = shareAsData(makePointSet("uniform", 500), true);
  vtkNew<vtkTIPPDelaunay2D> filter;
  auto* const executive = dynamic_cast<CollectivePipeline*>(filter->GetExecutive());
  ASSERT_NE(executive, nullptr);
  EXPECT_EQ(executive->Controller(), vtkMultiProcessController::GetGlobalController());
  filter->SetController(nullptr);
  EXPECT_EQ(executive->Controller(), nullptr);
  filter->SetInputConnection(source->GetOutputPort());
  vtkObject::GlobalWarningDisplayOff();
  filter->Update();
  vtkObject::GlobalWarningDisplayOn();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells() > 0, rank() != 0);
}

TEST(Delaunay2DRanks, GlobalIdsBeyondAllDoublesStayExact)
{
  constexpr vtkIdType large = (vtkIdType(1) << 53) + 1;
  vtkNew<vtkPoints> points;
  vtkNew<vtkIdTypeArray> ids;
  for (int i = 0; rank() == 0 && i < 4; ++i)
  {
    points->InsertNextPoint(i % 2, i / 2, 0);
    ids->InsertNextValue(large + i);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->GetPointData()->SetGlobalIds(ids);
  vtkNew<vtkTIPPDelaunay2D> filter;
  filter->GatherOnFirstRankOn();
  filter->SetInputData(data);
  filter->Update();
  if (rank() == 0)
  {
    vtkDataArray* got = filter->GetOutput()->GetPointData()->GetGlobalIds();
    std::set<vtkIdType> found;
    for (vtkIdType i = 0; i < got->GetNumberOfTuples(); ++i)
    {
      found.insert(idAt(got, i));
    }
    EXPECT_EQ(found, (std::set<vtkIdType>{ large, large + 1, large + 2, large + 3 }));
  }
}

TEST(Delaunay2DRanks, WithoutAControllerARankIsAlone)
{
  const Coordinates xy = makePointSet("uniform", 300, std::uint64_t(rank()) + 1);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (std::size_t i = 0; i < xy.size(); i += 2)
  {
    points->InsertNextPoint(xy[i], xy[i + 1], 0);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  vtkNew<vtkTIPPDelaunay2D> filter;
  filter->SetController(nullptr);
  filter->SetInputData(data);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), vtkIdType(reference(xy).Mesh.size()));
}

/// How ranks have the source.
enum class SourceShare
{
  Copies,
  OnFirst,
  Split
};

/// Lines that cross, between points of the input and others, and around them a polygon.
class TestSource
{
public:
  TestSource(const Coordinates& xy, bool hasPoints)
    : XY(xy)
    , HasPoints(hasPoints)
  {
  }

  /// Lines [begin, end) of Lines, and the polygon after the last.
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
struct ConstrainedCells
{
  std::map<std::int64_t, std::vector<double>> Points;
  std::set<std::vector<std::int64_t>> Cells; ///< corners from the lowest, and the marks of these
};

/// `ids`: null: points are numbered as they are.
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

TEST(Delaunay2DRanks, InsertASourceAsOneRankDoes)
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
      // One process with all points.
      if (rank() == 0)
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
        vtkNew<vtkPolyData> data;
        data->SetPoints(points);
        data->GetPointData()->AddArray(height);
        prepare(alone);
        alone->SetInputData(data);
        alone->SetSourceData(source.part(0, TestSource::Lines));
        alone->Update();
        const ConstrainedCells expected = constrainedCells(alone->GetOutput(), nullptr);
        const ConstrainedCells made = constrainedCells(
          filter->GetOutput(), filter->GetOutput()->GetPointData()->GetGlobalIds());
        EXPECT_TRUE(expected.Cells == made.Cells)
          << merges << int(share) << ": " << expected.Cells.size() << " " << made.Cells.size();
        EXPECT_TRUE(expected.Points == made.Points) << merges << int(share);
        EXPECT_GT(expected.Points.rbegin()->first, std::int64_t(xy.size() / 2)); // of crossings
      }
      box.barrier();
    }
  }
}

TEST(Delaunay2DRanks, MarksOfConstraintsComeWithGhosts)
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
  std::map<std::vector<std::int64_t>, std::vector<std::int64_t>> marksOf; // by corners
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

TEST(Delaunay2DRanks, SourceThatNamesNoPointFailsOnAll)
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
