// SPDX-License-Identifier: BSD-3-Clause
// vtkTIPPDelaunay2D with the global controller of several ranks.
#include "DistributedTesting.h"
#include "RankData.h"

#include "Pipeline/FilterPipeline.h"

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
#include <cmath>
#include <map>
#include <set>

namespace
{

using namespace tipp;
using namespace tipp::test;

/// A source that outputs `Data`, or fails: in RequestInformation if `Early`, otherwise in
/// RequestData.
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

/// Gathers the cells of all ranks on rank 0.
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
    return; // the output has the input's own points
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

TEST(Delaunay2DRanks, GhostsAreOtherRanksTrianglesAtOwnPoints)
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

TEST(Delaunay2DRanks, APropertyThatIsNotFiniteOnOneRankIsRefusedOnAll)
{
  vtkNew<vtkTIPPDelaunay2D> filter;
  filter->SetTolerance(rank() == ranks() - 1 ? NAN : 0);
  filter->SetInputData(shareAsData(makePointSet("uniform", 500), true));
  vtkObject::GlobalWarningDisplayOff();
  filter->Update();
  vtkObject::GlobalWarningDisplayOn();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_NE(filter->GetErrorCode(), 0u);
}

TEST(Delaunay2DRanks, AGhostLayerIsMadeOnTheRankThatRequestsIt)
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

TEST(Delaunay2DRanks, AnUpstreamFailureOnOneRankFailsOnAll)
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

TEST(CollectivePipeline, BelongsToTheFilterAndRunsAloneWithoutAController)
{
  vtkNew<FailingSource> source;
  source->Fails = rank() == 0; // other ranks do not wait for rank 0
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

TEST(Delaunay2DRanks, WithoutAControllerEachRankWorksAlone)
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

} // namespace
