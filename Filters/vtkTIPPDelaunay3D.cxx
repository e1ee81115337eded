// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTIPPDelaunay3D.h"

#include "InMemory/AlphaShape.h"
#include "InMemory/FiniteBounds.h"
#include "InMemory/TriangulatePoints.h"
#include "Output/FilterPipeline.h"
#include "Output/RunStatistics.h"
#include "Output/TetrahedronOutput.h"
#include "Output/TriangleOutput.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Stopwatch.h"
#include "Projection/ProjectedPoints.h"
#include "Triangulation3D/AlphaShape3.h"
#include "Triangulation3D/CoplanarPoints.h"
#include "Triangulation3D/MergeClosePoints3.h"
#include "Triangulation3D/Tetrahedralize.h"
#include "Vtk/ReadDataSet.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkErrorCode.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkTIPPDelaunay3D);
vtkCxxSetObjectMacro(vtkTIPPDelaunay3D, Controller, vtkMultiProcessController);

namespace
{

/// The points and the corners of an octahedron around them.
vtkSmartPointer<vtkPoints> withOctahedron(vtkPoints* points, double offset)
{
  const tipp::FiniteBounds bounds = tipp::finiteBounds(points);
  const double distance = offset * bounds.diagonal();
  std::vector<std::array<double, 3>> corners(
    6, { bounds.center(0), bounds.center(1), bounds.center(2) });
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    corners[i][i / 2] += i % 2 == 0 ? -distance : distance;
  }
  return tipp::appendPoints(points, corners);
}

/// Cells of several types.
class MixedCells
{
public:
  template <typename Ids>
  void add(const Ids& ids, int type, int corners)
  {
    for (std::size_t i = 0; i < ids.size(); i += std::size_t(corners))
    {
      this->Cells->InsertNextCell(corners);
      for (int k = 0; k < corners; ++k)
      {
        this->Cells->InsertCellPoint(ids[i + std::size_t(k)]);
      }
      this->Types.push_back(static_cast<unsigned char>(type));
    }
  }

  /// Adds what the filter wants of an alpha shape's triangles, lines and vertices.
  template <typename Shape>
  void addFaces(const Shape& shape, vtkTIPPDelaunay3D* filter)
  {
    filter->GetAlphaTris() ? this->add(shape.Triangles, VTK_TRIANGLE, 3) : void();
    filter->GetAlphaLines() ? this->add(shape.Lines, VTK_LINE, 2) : void();
    filter->GetAlphaVerts() ? this->add(shape.Vertices, VTK_VERTEX, 1) : void();
  }

  void setIn(vtkUnstructuredGrid* output) const
  {
    vtkNew<vtkUnsignedCharArray> types;
    types->SetNumberOfValues(vtkIdType(this->Types.size()));
    std::copy(this->Types.begin(), this->Types.end(), types->GetPointer(0));
    output->SetCells(types, this->Cells);
  }

private:
  vtkNew<vtkCellArray> Cells;
  std::vector<unsigned char> Types;
};

} // namespace

vtkTIPPDelaunay3D::vtkTIPPDelaunay3D()
{
  this->SetNumberOfOutputPorts(2);
  this->vtkTIPPDelaunay3D::SetController(vtkMultiProcessController::GetGlobalController());
  tipp::useCollectivePipeline(this, [this] { return this->Controller; });
}

vtkTIPPDelaunay3D::~vtkTIPPDelaunay3D()
{
  this->vtkTIPPDelaunay3D::SetController(nullptr);
}

vtkTable* vtkTIPPDelaunay3D::GetStatistics()
{
  return vtkTable::SafeDownCast(this->GetOutputDataObject(1));
}

int vtkTIPPDelaunay3D::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  return 1;
}

int vtkTIPPDelaunay3D::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkUnstructuredGrid" : "vtkTable");
  return 1;
}

int vtkTIPPDelaunay3D::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPointSet* input = vtkPointSet::GetData(inputVector[0]);
  vtkUnstructuredGrid* output = vtkUnstructuredGrid::GetData(outputVector, 0);
  vtkTable* statistics = vtkTable::GetData(outputVector, 1);
  const auto work = [&]
  {
    tipp::requireFinite(
      { { "Alpha", this->Alpha }, { "Tolerance", this->Tolerance }, { "Offset", this->Offset } });
    const tipp::ThreadLimit limit(this->NumberOfThreads);
    return tipp::hasSeveralRanks(this->Controller)
      ? this->ExecuteOnRanks(input, tipp::wantsGhosts(outputVector), output, statistics)
      : this->Execute(input, output, statistics);
  };
  const int isDone = tipp::runReported(
    this, this->Controller, "Tetrahedralizing", input, { output, statistics }, work);
  if (!isDone && tipp::hasSeveralRanks(this->Controller))
  {
    this->SetErrorCode(vtkErrorCode::UserError); // not every rank reports the error
  }
  return isDone;
}

bool vtkTIPPDelaunay3D::Execute(
  vtkPointSet* input, vtkUnstructuredGrid* output, vtkTable* statistics)
{
  this->NumberOfDuplicatePoints = 0;
  this->NumberOfRejectedPoints = 0;
  tipp::checkPoints(input, "the input");
  vtkSmartPointer<vtkPoints> points = input->GetPoints();
  if (!points)
  {
    points = vtkSmartPointer<vtkPoints>::New();
  }
  else if (this->BoundingTriangulation)
  {
    points = withOctahedron(points, this->Offset);
  }
  const vtkIdType count = points->GetNumberOfPoints();
  std::vector<tipp::Point3> copy;
  const tipp::Point3* const coordinates = tipp::coordinatesOf(points, copy);
  tipp::Triangulation triangles; // of coplanar points
  tipp::Tetrahedralization mesh =
    this->Triangulate(coordinates, count, tipp::finiteBounds(points).diagonal(), triangles);
  if (mesh.Aborted)
  {
    return true;
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
    output->GetPointData()->AddArray(tipp::takeArray(
      "RepresentativePointId", tipp::representativeIds(mesh, std::size_t(count)), 1));
  }
  if (this->GenerateNeighborIds && this->Alpha == 0)
  {
    output->GetCellData()->AddArray(mesh.Dimension == 2
        ? tipp::takeArray("NeighborIds", tipp::neighborIds(triangles), 3)
        : tipp::takeArray("NeighborIds", tipp::neighborIds(mesh, std::size_t(count)), 4));
  }
  else if (this->GenerateNeighborIds)
  {
    vtkWarningMacro("No NeighborIds: with Alpha not all tetrahedra are output.");
  }
  const auto tetrahedra = std::int64_t(mesh.cellCount());
  if (mesh.Dimension == 2)
  {
    this->SetTriangles(triangles, output);
  }
  else
  {
    this->SetCells(mesh, coordinates, count, output);
  }
  mesh.Statistics.Phases.push_back({ "VTK output", watch.seconds() });
  tipp::fillStatisticsTable(tipp::statisticsOf(mesh, count, tetrahedra), statistics);
  return true;
}

tipp::Tetrahedralization vtkTIPPDelaunay3D::Triangulate(
  const tipp::Point3* points, vtkIdType count, double diagonal, tipp::Triangulation& triangles)
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
  const double distance = this->Tolerance * diagonal;
  mesh = distance > 0 ? tipp::tetrahedralizeMerged(points, std::size_t(count), distance, options)
                      : tipp::tetrahedralize(points, std::size_t(count), options);
  if (!mesh.Aborted && mesh.Dimension == 2)
  {
    triangles = tipp::triangulateCoplanar(points, std::size_t(count), options, mesh);
    mesh.Aborted = triangles.Aborted;
  }
  mesh.Aborted = mesh.Aborted || !monitor(1);
  if (!mesh.Aborted)
  {
    tipp::warn(this, tipp::warningsOf(mesh, count));
  }
  return mesh;
}

void vtkTIPPDelaunay3D::SetCells(tipp::Tetrahedralization& mesh, const tipp::Point3* points,
  vtkIdType count, vtkUnstructuredGrid* output)
{
  if (this->Alpha == 0)
  {
    output->SetCells(VTK_TETRA, tipp::takeCells(std::move(mesh.Ids), 4));
    return;
  }
  const tipp::AlphaShape3 shape = tipp::alphaShape(mesh, points, std::size_t(count), this->Alpha);
  MixedCells cells;
  this->AlphaTets ? cells.add(shape.Tetrahedra, VTK_TETRA, 4) : void();
  cells.addFaces(shape, this);
  cells.setIn(output);
}

void vtkTIPPDelaunay3D::SetTriangles(tipp::Triangulation& triangles, vtkUnstructuredGrid* output)
{
  if (this->Alpha == 0)
  {
    output->SetCells(VTK_TRIANGLE, tipp::takeCells(std::move(triangles.Ids32), 3));
    return;
  }
  const auto pointAt = [points = output->GetPoints()](tipp::PointId id, double* p)
  { points->GetPoint(vtkIdType(id), p); };
  const auto shape = tipp::alphaShape(triangles.Ids32, pointAt, this->Alpha,
    tipp::coveredPoints(triangles, output->GetNumberOfPoints()));
  MixedCells cells;
  cells.addFaces(shape, this);
  cells.setIn(output);
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
