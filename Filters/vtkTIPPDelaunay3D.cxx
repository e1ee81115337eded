// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTIPPDelaunay3D.h"

#include "Distributed/MergedRankPoints.h"
#include "Distributed3D/DistributedTetrahedralization.h"
#include "InMemory/AlphaShape.h"
#include "InMemory/TriangulatePoints.h"
#include "Parallel/Stopwatch.h"
#include "Pipeline/FilterPipeline.h"
#include "Pipeline/InputPoints.h"
#include "Pipeline/MeshOutput.h"
#include "Statistics/RunStatistics.h"
#include "Triangulation3D/Tetrahedralize.h"
#include "Vtk/DataSets.h"

#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkErrorCode.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkTIPPDelaunay3D);

namespace
{

constexpr const char* NoNeighborsWithAlpha =
  "No NeighborIds: with Alpha not all tetrahedra are output.";

/// Returns the corners of an octahedron around a box.
std::vector<tipp::Point3> octahedron(const tipp::Box3& bounds, double offset)
{
  const double distance = offset * tipp::diagonalOf(bounds);
  std::vector<tipp::Point3> corners(6, bounds.center());
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    corners[i][i / 2] += i % 2 == 0 ? -distance : distance;
  }
  return corners;
}

void checkProperties(vtkTIPPDelaunay3D* filter)
{
  tipp::requireFinite({ { "Alpha", filter->GetAlpha() }, { "Tolerance", filter->GetTolerance() },
    { "Offset", filter->GetOffset() } });
}

} // namespace

vtkTIPPDelaunay3D::vtkTIPPDelaunay3D()
{
  this->SetNumberOfOutputPorts(2);
  this->Controller = vtkMultiProcessController::GetGlobalController();
  tipp::useCollectivePipeline(this, [this] { return this->Controller; });
}

vtkTable* vtkTIPPDelaunay3D::GetStatistics()
{
  return vtkTable::SafeDownCast(this->GetOutputDataObject(1));
}

int vtkTIPPDelaunay3D::FillInputPortInformation(int, vtkInformation* info)
{
  return tipp::acceptInput(info, "vtkPointSet");
}

int vtkTIPPDelaunay3D::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkUnstructuredGrid" : "vtkTable");
  return 1;
}

int vtkTIPPDelaunay3D::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return tipp::askForUpdatePieces(this->Controller, inputVector, 1)
    ? 1
    : this->Superclass::RequestUpdateExtent(request, inputVector, outputVector);
}

int vtkTIPPDelaunay3D::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPointSet* input = vtkPointSet::GetData(inputVector[0]);
  this->NumberOfDuplicatePoints = 0;
  this->NumberOfRejectedPoints = 0;
  const int isDone = tipp::triangulateReported(
    this, this->Controller, this->NumberOfThreads, "Tetrahedralizing", input, outputVector,
    [&] { this->Execute(input, outputVector); },
    [&] { this->ExecuteOnRanks(input, outputVector); });
  if (!isDone && tipp::hasSeveralRanks(this->Controller))
  {
    this->SetErrorCode(vtkErrorCode::UserError); // not every rank reports the error
  }
  return isDone;
}

void vtkTIPPDelaunay3D::Execute(vtkPointSet* input, vtkInformationVector* outputs)
{
  vtkUnstructuredGrid* const output = vtkUnstructuredGrid::GetData(outputs, 0);
  checkProperties(this);
  tipp::checkPoints(input, "the input");
  vtkSmartPointer<vtkPoints> points = input->GetPoints();
  if (!points)
  {
    points = vtkSmartPointer<vtkPoints>::New();
  }
  else if (this->BoundingTriangulation)
  {
    points = tipp::appendPoints(points, octahedron(tipp::finiteBounds(points), this->Offset));
  }
  const vtkIdType count = points->GetNumberOfPoints();
  std::vector<tipp::Point3> copy;
  const tipp::Point3* const coordinates = tipp::coordinatesOf(points, copy);
  tipp::Triangulation triangles; // of coplanar points
  tipp::Tetrahedralization mesh = this->Triangulate(
    coordinates, count, tipp::toleratedDistance(this->Tolerance, points), triangles);
  if (mesh.Aborted)
  {
    return;
  }
  this->NumberOfDuplicatePoints = vtkIdType(mesh.Duplicates.size());
  this->NumberOfRejectedPoints = vtkIdType(mesh.Rejected.size());
  const tipp::Stopwatch watch;
  output->SetPoints(points);
  if (!this->BoundingTriangulation)
  {
    output->GetPointData()->PassData(input->GetPointData());
  }
  if (this->GenerateRepresentativeIds && (!mesh.Duplicates.empty() || !mesh.Rejected.empty()))
  {
    output->GetPointData()->AddArray(
      tipp::takeArray("RepresentativePointId", tipp::representativeIds(mesh, count), 1));
  }
  if (this->GenerateNeighborIds && this->Alpha == 0)
  {
    output->GetCellData()->AddArray(mesh.Dimension == 2
        ? tipp::takeArray("NeighborIds", tipp::neighborIds(triangles), 3)
        : tipp::takeArray("NeighborIds", tipp::neighborIds(mesh), 4));
  }
  else if (this->GenerateNeighborIds)
  {
    vtkWarningMacro(<< NoNeighborsWithAlpha);
  }
  const auto tetrahedra = std::int64_t(mesh.cellCount());
  mesh.Dimension == 2 ? this->SetCells(triangles.Ids32, 3, mesh, output)
                      : this->SetCells(mesh.Ids, 4, mesh, output);
  mesh.Statistics.Phases.push_back({ "VTK output", watch.seconds() });
  tipp::fillStatisticsTable(
    tipp::statisticsOf(mesh, count, tetrahedra), vtkTable::GetData(outputs, 1));
}

tipp::Tetrahedralization vtkTIPPDelaunay3D::Triangulate(
  const tipp::Point3* points, vtkIdType count, double distance, tipp::Triangulation& triangles)
{
  tipp::Monitor monitor(this);
  tipp::TetrahedralizationOptions options;
  options.Partitions = this->NumberOfPartitions;
  options.Threads = this->NumberOfThreads;
  options.Progress = [&monitor](double fraction) { return monitor(fraction); };
  tipp::Tetrahedralization mesh;
  mesh.Aborted = !monitor(0);
  if (mesh.Aborted)
  {
    return mesh;
  }
  mesh = tipp::tetrahedralizePoints(points, std::size_t(count), distance, options, triangles);
  mesh.Aborted = mesh.Aborted || !monitor(1);
  if (!mesh.Aborted)
  {
    tipp::warn(this, tipp::warningsOf(mesh, count));
  }
  return mesh;
}

void vtkTIPPDelaunay3D::SetCells(tipp::Buffer<int>& ids, int corners,
  const tipp::TriangulatedPoints& mesh, vtkUnstructuredGrid* output) const
{
  if (this->Alpha == 0)
  {
    output->SetCells(
      corners == 4 ? VTK_TETRA : VTK_TRIANGLE, tipp::takeCells(std::move(ids), corners));
    return;
  }
  const auto pointAt = [points = output->GetPoints()](tipp::PointId id, double* p)
  { points->GetPoint(vtkIdType(id), p); };
  std::vector<char> leftOut = tipp::findLeftOut(mesh, output->GetNumberOfPoints());
  auto shape = corners == 4 ? tipp::alphaShape<4>(ids, pointAt, this->Alpha, std::move(leftOut))
                            : tipp::alphaShape<3>(ids, pointAt, this->Alpha, std::move(leftOut));
  shape.Tetrahedra.truncate(this->AlphaTets ? shape.Tetrahedra.size() : 0);
  shape.Triangles.truncate(this->AlphaTris ? shape.Triangles.size() : 0);
  shape.Lines.truncate(this->AlphaLines ? shape.Lines.size() : 0);
  shape.Vertices.truncate(this->AlphaVerts ? shape.Vertices.size() : 0);
  tipp::setAlphaCells(std::move(shape), output);
}

void vtkTIPPDelaunay3D::ExecuteOnRanks(vtkPointSet* given, vtkInformationVector* outputs)
{
  vtkUnstructuredGrid* const output = vtkUnstructuredGrid::GetData(outputs, 0);
  const bool wantsGhosts = tipp::wantsGhosts(outputs);
  tipp::Communicator ranks(this->Controller);
  tipp::DistributedTetrahedralization mine;
  bool noNeighbors = false;
  const auto run = [&]()
  {
    checkProperties(this);
    tipp::Monitor monitor(this);
    tipp::TetrahedralizationOptions options;
    options.Partitions = this->NumberOfPartitions;
    options.Threads = this->NumberOfThreads;
    options.Progress = [&monitor](double fraction) { return monitor(fraction); };
    tipp::checkPoints(given, "the input");
    // All ranks must take the same collective steps, even if their properties differ, so those of
    // the first rank count.
    const auto [alpha, tolerance, gathers, addsBounds, findsNeighbors] = ranks.broadcast(
      std::array<double, 5>{ this->Alpha, this->Tolerance, double(this->GatherOnFirstRank),
        double(this->BoundingTriangulation), double(this->GenerateNeighborIds) });
    vtkSmartPointer<vtkPointSet> input = given;
    if (addsBounds != 0)
    {
      const tipp::Box3 bounds = tipp::finiteBounds(given->GetPoints(), &ranks);
      input = tipp::withPointsOnLast(ranks, given, octahedron(bounds, this->Offset));
    }
    const tipp::PointRows rows(ranks, input);
    tipp::RankPoints3 points;
    std::vector<tipp::Point3> copy;
    if (input->GetNumberOfPoints() > 0)
    {
      points.Points = { tipp::coordinatesOf(input->GetPoints(), copy),
        std::size_t(input->GetNumberOfPoints()) };
    }
    rows.describe(points);
    mine = tipp::triangulateMerged(ranks, points,
      tipp::toleratedDistance(tolerance, input->GetPoints(), &ranks),
      [&](const tipp::RankPoints3& left)
      { return tipp::tetrahedralizeDistributed(ranks, left, options); });
    if (gathers != 0)
    {
      mine = tipp::gatherOnFirst(ranks, std::move(mine), options.Threads);
    }
    const bool fetchesGhosts = tipp::isTrueOnAny(ranks, wantsGhosts);
    const tipp::GhostTetrahedra ghosts = alpha != 0 || findsNeighbors != 0 || fetchesGhosts
      ? tipp::fetchGhosts(ranks, mine)
      : tipp::GhostTetrahedra();
    if (alpha != 0)
    {
      tipp::fillAlphaOutput(ranks, mine, rows, ghosts,
        { alpha, this->AlphaTets != 0, this->AlphaTris != 0, this->AlphaLines != 0,
          this->AlphaVerts != 0 },
        output);
      noNeighbors = findsNeighbors != 0;
    }
    else
    {
      tipp::fillOutput(mine, ranks.rank(), rows, wantsGhosts ? &ghosts : nullptr, output);
    }
    if (alpha == 0 && findsNeighbors != 0)
    {
      tipp::addNeighborIds(tipp::neighborIds(ranks, mine, ghosts), int(mine.cellSize()), output);
    }
    if (this->GenerateRepresentativeIds)
    {
      tipp::addDuplicatesAndRejected(mine.Duplicates, mine.Rejected, output);
    }
    tipp::fillStatisticsTable(tipp::statisticsOf(mine), vtkTable::GetData(outputs, 1));
  };
  ranks.together(run);
  this->NumberOfDuplicatePoints = mine.AllDuplicates;
  this->NumberOfRejectedPoints = mine.AllRejected;
  if (ranks.isFirst())
  {
    tipp::warn(this, tipp::warningsOf(mine));
    tipp::warn(this,
      noNeighbors ? std::vector<std::string>{ NoNeighborsWithAlpha } : std::vector<std::string>());
  }
}

void vtkTIPPDelaunay3D::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto onOff = [](vtkTypeBool flag) { return flag ? "On\n" : "Off\n"; };
  os << indent << "Alpha: " << this->Alpha << "\n";
  os << indent << "AlphaTets: " << onOff(this->AlphaTets);
  os << indent << "AlphaTris: " << onOff(this->AlphaTris);
  os << indent << "AlphaLines: " << onOff(this->AlphaLines);
  os << indent << "AlphaVerts: " << onOff(this->AlphaVerts);
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "Offset: " << this->Offset << "\n";
  os << indent << "BoundingTriangulation: " << onOff(this->BoundingTriangulation);
  os << indent << "GenerateRepresentativeIds: " << onOff(this->GenerateRepresentativeIds);
  os << indent << "GenerateNeighborIds: " << onOff(this->GenerateNeighborIds);
  os << indent << "NumberOfPartitions: " << this->NumberOfPartitions << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "Controller: " << this->Controller << "\n";
  os << indent << "GatherOnFirstRank: " << onOff(this->GatherOnFirstRank);
  os << indent << "NumberOfDuplicatePoints: " << this->NumberOfDuplicatePoints << "\n";
  os << indent << "NumberOfRejectedPoints: " << this->NumberOfRejectedPoints << "\n";
}
