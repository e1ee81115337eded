// SPDX-License-Identifier: BSD-3-Clause
// vtkTIPPDelaunay3D with the global controller of several ranks.
#include "PointsInSpace.h"

#include "Ranks/Communicator.h"
#include "vtkTIPPDelaunay3D.h"

#include "vtkCell.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
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
#include "vtkSmartPointer.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

int rank()
{
  return vtkMultiProcessController::GetGlobalController()->GetLocalProcessId();
}

int ranks()
{
  return vtkMultiProcessController::GetGlobalController()->GetNumberOfProcesses();
}

vtkIdType idAt(vtkDataArray* ids, vtkIdType i)
{
  return static_cast<vtkIdTypeArray*>(ids)->GetValue(i);
}

/// This rank's share of the points, with a point array. With several ranks, the first has none.
vtkSmartPointer<vtkPolyData> shareOf(const std::vector<Point3>& points, bool withIds)
{
  vtkNew<vtkPoints> own;
  own->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> density;
  density->SetName("density");
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("ids");
  const int sharing = std::max(1, ranks() - 1);
  const auto count = std::size_t(points.size());
  for (std::size_t i = 0; i < count; ++i)
  {
    const int of = withIds ? int(i) % sharing : int(i * std::size_t(sharing) / count);
    if (of + (ranks() > 1 ? 1 : 0) == rank())
    {
      own->InsertNextPoint(points[i].x, points[i].y, points[i].z);
      density->InsertNextValue(3.0 * double(i));
      ids->InsertNextValue(vtkIdType(i));
    }
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(own);
  data->GetPointData()->AddArray(density);
  if (withIds)
  {
    data->GetPointData()->SetGlobalIds(ids);
  }
  return data;
}

struct PieceCell
{
  Tetrahedron Corners;
  std::int64_t Number;
  std::int64_t IsGhost;
};

/// Gathers the cells of all ranks on the first rank.
std::vector<PieceCell> gatherCells(vtkUnstructuredGrid* mesh)
{
  std::vector<PieceCell> cells;
  vtkDataArray* const ids = mesh->GetPointData()->GetGlobalIds();
  auto* const ghosts = vtkUnsignedCharArray::SafeDownCast(
    mesh->GetCellData()->GetAbstractArray(vtkDataSetAttributes::GhostArrayName()));
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    vtkIdType size = 0;
    const vtkIdType* corners = nullptr;
    mesh->GetCellPoints(i, size, corners);
    PieceCell cell{ {}, idAt(mesh->GetCellData()->GetGlobalIds(), i),
      ghosts && ghosts->GetValue(i) != 0 ? 1 : 0 };
    std::transform(corners, corners + 4, cell.Corners.begin(),
      [ids](vtkIdType corner) { return std::int64_t(idAt(ids, corner)); });
    std::sort(cell.Corners.begin(), cell.Corners.end());
    cells.push_back(cell);
  }
  Communicator box(vtkMultiProcessController::GetGlobalController());
  std::vector<PieceCell> all;
  for (const std::vector<PieceCell>& part : box.gather(cells))
  {
    all.insert(all.end(), part.begin(), part.end());
  }
  box.barrier();
  return all;
}

void expectWhole(vtkUnstructuredGrid* mesh, const std::vector<Point3>& points)
{
  std::vector<Tetrahedron> own;
  std::vector<std::int64_t> numbers;
  for (const PieceCell& cell : gatherCells(mesh))
  {
    if (cell.IsGhost == 0)
    {
      own.push_back(cell.Corners);
      numbers.push_back(cell.Number);
    }
  }
  if (rank() != 0)
  {
    return;
  }
  std::sort(own.begin(), own.end());
  EXPECT_EQ(sortedCells(tetrahedralize(points.data(), points.size())), own);
  std::sort(numbers.begin(), numbers.end());
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    ASSERT_EQ(std::int64_t(i), numbers[i]);
  }
}

/// A source that outputs `Data`, or fails.
class FailingSource : public vtkPolyDataAlgorithm
{
public:
  static FailingSource* New();
  vtkTypeMacro(FailingSource, vtkPolyDataAlgorithm)
  FailingSource() { this->SetNumberOfInputPorts(0); }

  bool Fails = false;
  vtkSmartPointer<vtkPolyData> Data;

protected:
  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* output) override
  {
    output->GetInformationObject(0)->Set(CAN_HANDLE_PIECE_REQUEST(), 1);
    return 1;
  }
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* output) override
  {
    vtkPolyData::GetData(output)->ShallowCopy(this->Data);
    return !this->Fails;
  }
};
vtkStandardNewMacro(FailingSource);

} // namespace

TEST(Delaunay3DRanks, PiecesAreTheWholeTetrahedralization)
{
  const auto points = pointsInSpace("coarse", 1500);
  for (const bool withIds : { true, false })
  {
    vtkNew<vtkTIPPDelaunay3D> filter;
    filter->SetNumberOfPartitions(20);
    filter->SetInputData(shareOf(points, withIds));
    filter->Update();
    expectWhole(filter->GetOutput(), points);
    EXPECT_EQ(filter->GetNumberOfDuplicatePoints(),
      vtkIdType(tetrahedralize(points.data(), points.size()).Duplicates.size()));
    vtkDataArray* const merged = filter->GetOutput()->GetFieldData()->GetArray("DuplicatePointIds");
    ASSERT_NE(merged, nullptr);
    Communicator box(vtkMultiProcessController::GetGlobalController());
    std::vector<std::int64_t> sum{ merged->GetNumberOfTuples() };
    box.sum(sum);
    EXPECT_EQ(filter->GetNumberOfDuplicatePoints(), sum[0]);
  }
}

TEST(Delaunay3DRanks, PointsKeepTheirDataAndPrecision)
{
  const auto points = pointsInSpace("huge", 2000);
  vtkNew<vtkTIPPDelaunay3D> filter;
  filter->SetNumberOfPartitions(12);
  filter->SetInputData(shareOf(points, true));
  filter->Update();
  vtkUnstructuredGrid* const mesh = filter->GetOutput();
  vtkDataArray* const ids = mesh->GetPointData()->GetGlobalIds();
  vtkDataArray* const density = mesh->GetPointData()->GetArray("density");
  ASSERT_NE(ids, nullptr);
  ASSERT_NE(density, nullptr);
  ASSERT_GT(mesh->GetNumberOfPoints(), 0);
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    const vtkIdType id = idAt(ids, i);
    ASSERT_EQ(density->GetTuple1(i), 3.0 * double(id));
    const Point3& p = points[std::size_t(id)];
    ASSERT_EQ(mesh->GetPoint(i)[0], p.x);
    ASSERT_EQ(mesh->GetPoint(i)[1], p.y);
    ASSERT_EQ(mesh->GetPoint(i)[2], p.z);
  }
}

TEST(Delaunay3DRanks, GhostsAreCopiesOfOtherRanksCells)
{
  const auto points = pointsInSpace("uniform", 3000);
  vtkNew<vtkTIPPDelaunay3D> filter;
  filter->SetNumberOfPartitions(12);
  filter->SetInputData(shareOf(points, true));
  filter->UpdatePiece(rank(), ranks(), 1);
  expectWhole(filter->GetOutput(), points);
  std::map<std::int64_t, Tetrahedron> own;
  const std::vector<PieceCell> all = gatherCells(filter->GetOutput());
  for (const PieceCell& cell : all)
  {
    if (cell.IsGhost == 0)
    {
      own.emplace(cell.Number, cell.Corners);
    }
  }
  std::size_t ghosts = 0;
  for (const PieceCell& cell : all)
  {
    ghosts += cell.IsGhost != 0 ? 1 : 0;
    EXPECT_EQ(own.at(cell.Number), cell.Corners);
  }
  EXPECT_EQ(rank() == 0, ghosts > 500);
}

TEST(Delaunay3DRanks, EverythingCanBeGatheredOnTheFirstRank)
{
  const auto points = pointsInSpace("clustered", 3000);
  vtkNew<vtkTIPPDelaunay3D> filter;
  filter->SetNumberOfPartitions(12);
  filter->GatherOnFirstRankOn();
  filter->SetInputData(shareOf(points, true));
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells() > 0, rank() == 0);
  expectWhole(filter->GetOutput(), points);
}

TEST(Delaunay3DRanks, CoplanarPointsMakeTriangles)
{
  auto points = pointsInSpace("uniform", 500);
  for (Point3& p : points)
  {
    p.y = 2 * p.x;
  }
  for (const bool isGathered : { false, true })
  {
    vtkNew<vtkTIPPDelaunay3D> filter;
    filter->SetGatherOnFirstRank(isGathered);
    filter->SetInputData(shareOf(points, true));
    vtkObject::GlobalWarningDisplayOff();
    filter->UpdatePiece(rank(), ranks(), 1);
    vtkObject::GlobalWarningDisplayOn();
    vtkUnstructuredGrid* const mesh = filter->GetOutput();
    auto* const ghosts = vtkUnsignedCharArray::SafeDownCast(
      mesh->GetCellData()->GetAbstractArray(vtkDataSetAttributes::GhostArrayName()));
    double area = 0;
    for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
    {
      ASSERT_EQ(VTK_TRIANGLE, mesh->GetCellType(i));
      double p[3][3];
      for (int k = 0; k < 3; ++k)
      {
        mesh->GetPoint(mesh->GetCell(i)->GetPointId(k), p[k]);
      }
      const double twice =
        (p[1][0] - p[0][0]) * (p[2][2] - p[0][2]) - (p[1][2] - p[0][2]) * (p[2][0] - p[0][0]);
      EXPECT_GT(twice, 0);
      area += ghosts->GetValue(i) != 0 ? 0 : twice / 2;
    }
    Communicator box(vtkMultiProcessController::GetGlobalController());
    double sum = 0;
    for (const std::vector<double>& part : box.allGather(std::vector<double>{ area }))
    {
      sum += part[0];
    }
    EXPECT_NEAR(sum, 0.97, 0.02); // of the hull, projected along y
    EXPECT_EQ(isGathered && rank() > 0, mesh->GetNumberOfCells() == 0);
  }
}

TEST(Delaunay3DRanks, StatisticsAreTheSameOnAllRanks)
{
  vtkNew<vtkTIPPDelaunay3D> filter;
  filter->SetNumberOfPartitions(30);
  filter->SetInputData(shareOf(pointsInSpace("uniform", 5000), true));
  filter->Update();
  vtkFieldData* const totals = filter->GetStatistics()->GetFieldData();
  EXPECT_EQ(totals->GetArray("Points")->GetTuple1(0), 5000);
  EXPECT_GE(totals->GetArray("Partitions")->GetTuple1(0), 30);
  EXPECT_EQ(totals->GetArray("RankOwnedPoints")->GetNumberOfTuples(), ranks());
  vtkDataArray* const cells = totals->GetArray("RankTetrahedra");
  double sum = 0;
  for (int i = 0; i < ranks(); ++i)
  {
    sum += cells->GetTuple1(i);
  }
  EXPECT_EQ(totals->GetArray("Tetrahedra")->GetTuple1(0), sum);
}

TEST(Delaunay3DRanks, APropertyThatIsNotFiniteOnOneRankIsRefusedOnAll)
{
  vtkNew<vtkTIPPDelaunay3D> filter;
  filter->SetTolerance(rank() == ranks() - 1 ? NAN : 0);
  filter->SetInputData(shareOf(pointsInSpace("uniform", 500), true));
  vtkObject::GlobalWarningDisplayOff();
  filter->Update();
  vtkObject::GlobalWarningDisplayOn();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_NE(filter->GetErrorCode(), 0U);
}

TEST(Delaunay3DRanks, AnUpstreamFailureOnOneRankFailsOnAll)
{
  vtkNew<FailingSource> source;
  source->Fails = rank() == ranks() - 1;
  source->Data = shareOf(pointsInSpace("uniform", 500), true);
  vtkNew<vtkTIPPDelaunay3D> filter;
  filter->SetInputConnection(source->GetOutputPort());
  vtkObject::GlobalWarningDisplayOff();
  filter->Update();
  vtkObject::GlobalWarningDisplayOn();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  source->Fails = false;
  source->Modified();
  filter->Update();
  EXPECT_GT(filter->GetStatistics()->GetFieldData()->GetArray("Tetrahedra")->GetTuple1(0), 2500);
}

namespace
{

/// A cell by its corners, and for each corner the corners of the cell opposite to it. Triangles
/// have -1 in place of a fourth corner. All are global point ids; all -1: there is no cell.
using CellWithNeighbors = std::map<std::int64_t, Tetrahedron>;

struct NumberedCell
{
  std::int64_t Number;
  std::int64_t IsGhost;
  Tetrahedron Corners; ///< in the output's order
  Tetrahedron Neighbors;
};

std::vector<NumberedCell> numberedCells(vtkUnstructuredGrid* mesh)
{
  vtkDataArray* const points = mesh->GetPointData()->GetGlobalIds();
  vtkDataArray* const numbers = mesh->GetCellData()->GetGlobalIds();
  auto* const neighbors =
    vtkIdTypeArray::SafeDownCast(mesh->GetCellData()->GetArray("NeighborIds"));
  auto* const ghosts = vtkUnsignedCharArray::SafeDownCast(
    mesh->GetCellData()->GetAbstractArray(vtkDataSetAttributes::GhostArrayName()));
  std::vector<NumberedCell> cells;
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    vtkIdType size = 0;
    const vtkIdType* corners = nullptr;
    mesh->GetCellPoints(i, size, corners);
    NumberedCell cell{ numbers ? idAt(numbers, i) : i, ghosts && ghosts->GetValue(i) != 0 ? 1 : 0,
      { -1, -1, -1, -1 }, { -1, -1, -1, -1 } };
    for (int k = 0; k < int(size); ++k)
    {
      cell.Corners[std::size_t(k)] = points ? idAt(points, corners[k]) : corners[k];
      cell.Neighbors[std::size_t(k)] = neighbors ? neighbors->GetTypedComponent(i, k) : -1;
    }
    cells.push_back(cell);
  }
  return cells;
}

/// Returns the cells with their neighbours, in an order that does not depend on numbers. Ghosts
/// must have the neighbours that their owners have, and are left out.
std::vector<CellWithNeighbors> withNeighbors(const std::vector<NumberedCell>& cells)
{
  std::map<std::int64_t, NumberedCell> byNumber;
  for (const NumberedCell& cell : cells)
  {
    if (cell.IsGhost == 0)
    {
      byNumber[cell.Number] = cell;
    }
  }
  std::vector<CellWithNeighbors> result;
  for (const NumberedCell& cell : cells)
  {
    if (cell.IsGhost != 0)
    {
      EXPECT_EQ(byNumber.at(cell.Number).Neighbors, cell.Neighbors);
      continue;
    }
    result.emplace_back();
    for (std::size_t k = 0; k < 4; ++k)
    {
      Tetrahedron other = { -1, -1, -1, -1 };
      other = cell.Neighbors[k] < 0 ? other : byNumber.at(cell.Neighbors[k]).Corners;
      std::sort(other.begin(), other.end());
      result.back()[cell.Corners[k]] = other;
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

template <typename Configure>
void expectSameAsOneRank(const std::vector<Point3>& points, const Configure& configure,
  int ghostLevels = 0, const std::vector<bool>& haveIds = { true, false })
{
  vtkNew<vtkPoints> all;
  all->SetDataTypeToDouble();
  for (const Point3& p : points)
  {
    all->InsertNextPoint(p.x, p.y, p.z);
  }
  vtkNew<vtkPolyData> whole;
  whole->SetPoints(all);
  vtkNew<vtkTIPPDelaunay3D> alone;
  alone->SetController(nullptr);
  alone->SetInputData(whole);
  configure(alone);
  vtkObject::GlobalWarningDisplayOff(); // coplanar points have no tetrahedra
  alone->Update();
  for (const bool withIds : haveIds)
  {
    vtkNew<vtkTIPPDelaunay3D> filter;
    filter->SetInputData(shareOf(points, withIds));
    configure(filter);
    filter->UpdatePiece(rank(), ranks(), ghostLevels);
    Communicator box(vtkMultiProcessController::GetGlobalController());
    std::vector<NumberedCell> cells;
    for (const auto& part : box.gather(numberedCells(filter->GetOutput())))
    {
      cells.insert(cells.end(), part.begin(), part.end());
    }
    box.barrier();
    EXPECT_EQ(alone->GetNumberOfDuplicatePoints(), filter->GetNumberOfDuplicatePoints());
    if (rank() == 0)
    {
      const auto expected = withNeighbors(numberedCells(alone->GetOutput()));
      EXPECT_FALSE(expected.empty());
      EXPECT_TRUE(expected == withNeighbors(cells));
    }
  }
  vtkObject::GlobalWarningDisplayOn();
}

} // namespace

TEST(Delaunay3DRanks, NeighborIdsAreTheCellsAcrossTheFacets)
{
  auto points = pointsInSpace("uniform", 1500);
  const auto configure = [](vtkTIPPDelaunay3D* filter)
  {
    filter->GenerateNeighborIdsOn();
    filter->SetNumberOfPartitions(10);
  };
  for (const int ghostLevels : { 0, 1 })
  {
    expectSameAsOneRank(points, configure, ghostLevels);
  }
  for (Point3& p : points) // triangles
  {
    p.y = 2 * p.x;
  }
  expectSameAsOneRank(points, configure, 1);
}

TEST(Delaunay3DRanks, ToleranceMergesTheSamePoints)
{
  for (const double tolerance : { 1e-9, 0.01, 0.05 })
  {
    expectSameAsOneRank(pointsInSpace("uniform", 1500),
      [tolerance](vtkTIPPDelaunay3D* filter) { filter->SetTolerance(tolerance); });
  }
}

TEST(Delaunay3DRanks, AlphaShapeIsThatOfOneRank)
{
  auto points = pointsInSpace("uniform", 1200);
  for (const double alpha : { 0.04, 0.07, 0.1 })
  {
    expectSameAsOneRank(points,
      [alpha](vtkTIPPDelaunay3D* filter)
      {
        filter->SetAlpha(alpha);
        filter->SetNumberOfPartitions(10);
      });
  }
  for (Point3& p : points) // triangles
  {
    p.y = 2 * p.x;
  }
  expectSameAsOneRank(points, [](vtkTIPPDelaunay3D* filter) { filter->SetAlpha(0.03); });
}

TEST(Delaunay3DRanks, BoundingTriangulationHasTheSamePoints)
{
  expectSameAsOneRank(pointsInSpace("uniform", 1000),
    [](vtkTIPPDelaunay3D* filter)
    {
      filter->BoundingTriangulationOn();
      filter->SetTolerance(0.005);
    },
    0, { false }); // the points are numbered afresh
}

TEST(Delaunay3DRanks, WithoutAControllerEachRankWorksAlone)
{
  const auto points = pointsInSpace("uniform", 300, unsigned(rank()) + 1);
  vtkNew<vtkPoints> own;
  for (const Point3& p : points)
  {
    own->InsertNextPoint(p.x, p.y, p.z);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(own);
  vtkNew<vtkTIPPDelaunay3D> filter;
  filter->SetController(nullptr);
  filter->SetInputData(data);
  filter->Update();
  EXPECT_GT(filter->GetOutput()->GetNumberOfCells(), 1500);
  EXPECT_EQ(filter->GetOutput()->GetPoints(), own.Get());
}
