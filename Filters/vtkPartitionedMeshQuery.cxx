// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPartitionedMeshQuery.h"

#include "Parallel/ParallelFor.h"
#include "Pipeline/FilterPipeline.h"
#include "Query/Queries.h"
#include "Query/QueryData.h"
#include "Reading/PieceSource.h"
#include "Vtk/DataSets.h"

#include "vtkCellData.h"
#include "vtkCharArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <exception>
#include <numeric>
#include <stdexcept>

using tipp::arrayOf;
using tipp::copyTo;
using tipp::idsOf;
using tipp::pointsOf;

namespace
{

/// The polygons and closed lines of each zone.
std::vector<tipp::Zone> zonesOf(vtkPolyData* data)
{
  if (!data)
  {
    throw std::runtime_error("there are no polygons.");
  }
  tipp::checkDataSet(data, "the polygons");
  vtkDataArray* const ids = data->GetCellData()->GetArray("ZoneId");
  vtkDataArray* const holes = data->GetCellData()->GetArray("IsHole");
  const vtkIdType count = data->GetNumberOfCells();
  std::vector<tipp::Zone> zones;
  for (vtkIdType cell = 0; cell < count; ++cell)
  {
    const double id = ids ? ids->GetComponent(cell, 0) : double(cell);
    if (!(id >= 0 && id < double(count)))
    {
      throw std::runtime_error(
        "a ZoneId of the polygons is not from 0 to " + std::to_string(count - 1) + ".");
    }
    zones.resize(std::max(zones.size(), std::size_t(id) + 1));
    tipp::ZoneRing ring;
    ring.IsHole = holes && holes->GetComponent(cell, 0) != 0;
    vtkNew<vtkIdList> points;
    data->GetCellPoints(cell, points);
    for (vtkIdType i = 0; i < points->GetNumberOfIds(); ++i)
    {
      double p[3];
      data->GetPoint(points->GetId(i), p);
      ring.Corners.push_back({ p[0], p[1] });
    }
    zones[std::size_t(id)].push_back(ring);
  }
  return zones;
}

/// All polygons of a data set as one region.
tipp::Region regionOf(vtkPolyData* polygons)
{
  tipp::Region region;
  for (const tipp::Zone& zone : zonesOf(polygons))
  {
    region.Polygons.insert(region.Polygons.end(), zone.begin(), zone.end());
  }
  if (region.Polygons.empty())
  {
    throw std::runtime_error("there are no polygons.");
  }
  return region;
}

tipp::Region regionOf(const double* box)
{
  tipp::Region region;
  region.Box = tipp::boxOfVtkBounds<3>(box);
  return region;
}

} // namespace

vtkStandardNewMacro(vtkPartitionedMeshQuery);

vtkPartitionedMeshQuery::vtkPartitionedMeshQuery()
{
  this->SetNumberOfInputPorts(2);
  this->Controller = vtkMultiProcessController::GetGlobalController();
  tipp::useCollectivePipeline(this, [this] { return this->Controller; });
}

vtkDataObject* vtkPartitionedMeshQuery::GetSource()
{
  return this->GetNumberOfInputConnections(1) > 0 ? this->GetInputDataObject(1, 0) : nullptr;
}

int vtkPartitionedMeshQuery::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkDataSet" : "vtkPointSet");
  if (port == 1)
  {
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int vtkPartitionedMeshQuery::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (!this->Superclass::RequestUpdateExtent(request, inputs, outputs))
  {
    return 0;
  }
  if (inputs[1]->GetNumberOfInformationObjects() > 0)
  {
    const auto [rank, ranks] = this->GetRank();
    tipp::askForUpdatePiece(inputs[1]->GetInformationObject(0), rank, ranks);
  }
  return 1;
}

/// Returns this process's rank and the number of ranks.
std::pair<int, int> vtkPartitionedMeshQuery::GetRank() const
{
  return this->Controller ? std::make_pair(this->Controller->GetLocalProcessId(),
                              this->Controller->GetNumberOfProcesses())
                          : std::make_pair(0, 1);
}

/// Returns the mesh, opened again if it or the properties have changed.
std::shared_ptr<const tipp::ResidentMesh> vtkPartitionedMeshQuery::Open()
{
  const std::lock_guard<std::mutex> lock(this->Opening);
  const bool isStored = !this->FileName.empty();
  vtkDataObject* const source = isStored ? nullptr : this->GetSource();
  std::string key = this->FileName;
  for (const vtkTypeInt64 number : { vtkTypeInt64(this->MemoryLimit), vtkTypeInt64(this->Step),
         vtkTypeInt64(this->NumberOfThreads), source ? vtkTypeInt64(source->GetMTime()) : 0 })
  {
    key += "|" + std::to_string(number);
  }
  const bool isOther =
    this->Mesh && tipp::wasReplaced(this->Mesh->mesh()) && tipp::isPartitionedMesh(this->FileName);
  if (!this->Mesh || this->Opened != key || isOther)
  {
    this->Mesh.reset();
    tipp::ResidentOptions options;
    options.MemoryLimit = std::uint64_t(this->MemoryLimit);
    options.Threads = this->NumberOfThreads;
    options.Step = this->Step;
    this->Mesh = isStored ? std::make_shared<const tipp::ResidentMesh>(this->FileName, options)
                          : std::make_shared<const tipp::ResidentMesh>(
                              tipp::partOf(source, this->NumberOfThreads), options);
    this->Opened = key;
  }
  return this->Mesh;
}

/// The names of the arrays to evaluate. Collective if there are several ranks.
std::vector<std::string> vtkPartitionedMeshQuery::ArraysOf(
  tipp::Communicator* ranks, const tipp::ResidentMesh& mesh) const
{
  const bool hasCells = mesh.mesh().Cells > 0;
  std::vector<std::string> arrays = this->Arrays.empty() ? mesh.names() : this->Arrays;
  if (ranks)
  {
    // A rank without cells does not know the arrays' names.
    for (const std::vector<std::string>& names :
      ranks->allGather(hasCells ? arrays : std::vector<std::string>()))
    {
      arrays = hasCells || names.empty() ? arrays : names;
    }
  }
  return arrays;
}

/// Calls ask(ranks, mesh) with this process's mesh. `ranks` is null if there is only one rank.
void vtkPartitionedMeshQuery::AskMesh(const Question& ask)
{
  if (this->GetRank().second == 1)
  {
    ask(nullptr, *this->Open());
    return;
  }
  tipp::Communicator ranks(this->Controller);
  ranks.together(
    [&]
    {
      const auto mesh = this->Open();
      tipp::requireSameMesh(ranks, mesh->mesh());
      ask(&ranks, *mesh);
    });
}

/// Evaluates the mesh at points. Collective if there are several ranks.
tipp::MeshAnswer vtkPartitionedMeshQuery::Ask(
  const std::vector<tipp::Point3>& points, bool weights, bool arrays)
{
  tipp::MeshAnswer answer;
  this->AskMesh(
    [&](tipp::Communicator* ranks, const tipp::ResidentMesh& mesh)
    {
      tipp::AnswerOptions options;
      options.Weights = weights;
      options.Arrays = arrays ? this->ArraysOf(ranks, mesh) : std::vector<std::string>();
      answer = tipp::answerOf(mesh, points.data(), std::int64_t(points.size()), options, ranks);
    });
  return answer;
}

/// Runs `work` and reports its exceptions as errors. Returns 0 after an error, else 1.
int vtkPartitionedMeshQuery::Try(const std::function<void()>& work)
{
  try
  {
    work();
    return 1;
  }
  catch (const tipp::WorkAborted&)
  {
    return 0;
  }
  catch (const std::exception& error)
  {
    const auto* const failure = dynamic_cast<const tipp::RankFailure*>(&error);
    if (!failure || !failure->Aborted)
    {
      vtkErrorMacro("Query: " << error.what());
    }
    return 0;
  }
}

/// The same for calls outside of the pipeline: updates the source first.
int vtkPartitionedMeshQuery::Direct(const std::function<void()>& work)
{
  return this->Try(
    [&]
    {
      if (this->GetNumberOfInputConnections(1) > 0)
      {
        const std::lock_guard<std::mutex> lock(this->Opening);
        const auto [rank, ranks] = this->GetRank();
        this->GetInputAlgorithm(1, 0)->UpdatePiece(rank, ranks, 0);
      }
      work();
    });
}

int vtkPartitionedMeshQuery::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkDataSet* const input = vtkDataSet::GetData(inputs[0]);
  vtkDataSet* const output = vtkDataSet::GetData(outputs);
  output->CopyStructure(input);
  if (this->PassPointArrays)
  {
    output->GetPointData()->PassData(input->GetPointData());
  }
  if (this->PassCellArrays)
  {
    output->GetCellData()->PassData(input->GetCellData());
  }
  if (this->PassFieldArrays)
  {
    output->GetFieldData()->PassData(input->GetFieldData());
  }
  const int isDone = this->Try(
    [&]
    {
      tipp::Monitor monitor(this);
      const tipp::PollScope scope(
        [&]
        {
          if (!monitor(0.5) && this->Controller)
          {
            throw tipp::RankFailure(this->GetRank().first, true, "The run was stopped.");
          }
          return monitor(0.5);
        });
      tipp::MeshAnswer answer =
        this->Ask(tipp::collected(input->GetNumberOfPoints(),
                    [input](vtkIdType i, double* p) { input->GetPoint(i, p); }),
          false, true);
      vtkPointData* const values = output->GetPointData();
      tipp::moveArrays(answer, values, this->NullValue);
      values->AddArray(tipp::arrayOf<vtkIdTypeArray>("CellId", answer.Cells));
      vtkNew<vtkCharArray> mask;
      mask->SetName(this->ValidPointMaskArrayName.c_str());
      mask->SetNumberOfValues(vtkIdType(answer.Cells.size()));
      std::transform(answer.Cells.begin(), answer.Cells.end(), mask->GetPointer(0),
        [](std::int64_t cell) { return char(cell >= 0); });
      values->AddArray(mask);
    });
  if (!isDone)
  {
    output->Initialize();
  }
  return isDone || this->GetAbortExecute() ? 1 : 0;
}

int vtkPartitionedMeshQuery::Locate(
  vtkDataArray* points, vtkIdTypeArray* cells, vtkDoubleArray* weights)
{
  return this->Direct(
    [&]
    {
      const tipp::MeshAnswer answer = this->Ask(tipp::pointsOf(points), weights != nullptr, false);
      tipp::copyTo(cells, answer.Cells);
      const std::size_t count = answer.Cells.size();
      tipp::copyTo(
        weights, answer.Weights, answer.Weights.empty() ? 3 : int(answer.Weights.size() / count));
    });
}

int vtkPartitionedMeshQuery::Interpolate(
  vtkDataArray* points, vtkDataSetAttributes* values, vtkIdTypeArray* cells)
{
  return this->Direct(
    [&]
    {
      tipp::MeshAnswer answer = this->Ask(tipp::pointsOf(points), false, true);
      tipp::moveArrays(answer, values);
      tipp::copyTo(cells, answer.Cells);
    });
}

void vtkPartitionedMeshQuery::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  vtkTIPPPrintMacro(FileName);
  vtkTIPPPrintMacro(MemoryLimit);
  vtkTIPPPrintMacro(Step);
  vtkTIPPPrintMacro(NullValue);
  vtkTIPPPrintMacro(PassPointArrays);
  vtkTIPPPrintMacro(PassCellArrays);
  vtkTIPPPrintMacro(PassFieldArrays);
  vtkTIPPPrintMacro(ValidPointMaskArrayName);
  vtkTIPPPrintMacro(NumberOfThreads);
  os << indent << "Controller: " << this->Controller << "\n";
  vtkTIPPPrintMacro(Arrays);
}

/// Returns the mesh; throws unless all of it is accessible to this process.
std::shared_ptr<const tipp::ResidentMesh> vtkPartitionedMeshQuery::OpenWhole()
{
  auto mesh = this->Open();
  if (this->GetRank().second > 1 && !mesh->isStored())
  {
    throw std::runtime_error(
      "each rank has only a part of the source; store the mesh and give its FileName for this "
      "question.");
  }
  return mesh;
}

int vtkPartitionedMeshQuery::GetNamesOfArrays(vtkStringArray* names)
{
  return this->Direct(
    [&]
    {
      for (const std::string& name : this->Open()->names())
      {
        names->InsertNextValue(name);
      }
    });
}

int vtkPartitionedMeshQuery::GetMeshDimension()
{
  int dimension = 0;
  return this->Direct([&] { dimension = this->Open()->mesh().CellSize - 1; }) ? dimension : 0;
}

/// Queries this process's mesh or, with several ranks, those of all ranks.
int vtkPartitionedMeshQuery::Around(const Question& ask)
{
  return this->Direct([&] { this->AskMesh(ask); });
}

int vtkPartitionedMeshQuery::Neighbors(vtkIdTypeArray* cells, vtkIdTypeArray* neighbors)
{
  return this->Around(
    [&](tipp::Communicator* ranks, const tipp::ResidentMesh& mesh)
    {
      const std::vector<std::int64_t> asked = idsOf(cells);
      const std::vector<std::int64_t> found = tipp::neighborsOf(mesh, asked, ranks);
      // A rank without cells does not know how many corners cells have.
      copyTo(
        neighbors, found, asked.empty() ? mesh.mesh().CellSize : int(found.size() / asked.size()));
    });
}

int vtkPartitionedMeshQuery::Star(
  vtkIdTypeArray* points, vtkIdTypeArray* starts, vtkIdTypeArray* ids)
{
  return this->Around([&](tipp::Communicator* ranks, const tipp::ResidentMesh& mesh)
    { copyTo(starts, ids, tipp::starsOf(mesh, idsOf(points), ranks)); });
}

int vtkPartitionedMeshQuery::RingOfPoints(
  vtkIdTypeArray* points, int k, vtkIdTypeArray* starts, vtkIdTypeArray* ids)
{
  return this->Around([&](tipp::Communicator* ranks, const tipp::ResidentMesh& mesh)
    { copyTo(starts, ids, tipp::ringsOfPoints(mesh, idsOf(points), k, ranks)); });
}

int vtkPartitionedMeshQuery::RingOfCells(
  vtkIdTypeArray* cells, int k, vtkIdTypeArray* starts, vtkIdTypeArray* ids)
{
  return this->Around([&](tipp::Communicator* ranks, const tipp::ResidentMesh& mesh)
    { copyTo(starts, ids, tipp::ringsOfCells(mesh, idsOf(cells), k, ranks)); });
}

int vtkPartitionedMeshQuery::Boundary(vtkPolyData* loops)
{
  return this->Around([&](tipp::Communicator* ranks, const tipp::ResidentMesh& mesh)
    { loops->ShallowCopy(tipp::polyDataOf(tipp::boundaryOf(mesh, ranks))); });
}

int vtkPartitionedMeshQuery::Components(
  vtkIdTypeArray* ofCells, vtkIdTypeArray* sizes, vtkIdTypeArray* cells)
{
  return this->Around(
    [&](tipp::Communicator* ranks, const tipp::ResidentMesh& mesh)
    {
      tipp::Components components = tipp::componentsOf(mesh, ranks);
      copyTo(ofCells, components.OfCells);
      copyTo(sizes, components.Sizes);
      if (!ranks)
      {
        components.Cells.resize(components.OfCells.size());
        std::iota(components.Cells.begin(), components.Cells.end(), std::int64_t(0));
      }
      copyTo(cells, components.Cells);
    });
}

int vtkPartitionedMeshQuery::Contours(
  const char* array, int component, vtkDoubleArray* levels, vtkPolyData* lines)
{
  return this->Around(
    [&](tipp::Communicator* ranks, const tipp::ResidentMesh& mesh)
    {
      if (!levels)
      {
        throw std::runtime_error("there is no array of levels.");
      }
      const std::vector<double> values(
        levels->GetPointer(0), levels->GetPointer(0) + levels->GetNumberOfValues());
      const std::string name = array ? array : "";
      lines->ShallowCopy(
        tipp::polyDataOf(tipp::contoursOf(mesh, name, component, values, ranks), name));
    });
}

int vtkPartitionedMeshQuery::Profile(vtkDataArray* polyline, double spacing, vtkPolyData* line)
{
  return this->Around(
    [&](tipp::Communicator* ranks, const tipp::ResidentMesh& mesh)
    {
      const std::vector<std::string> arrays = this->ArraysOf(ranks, mesh);
      line->ShallowCopy(
        tipp::polyDataOf(tipp::profileOf(mesh, pointsOf(polyline), spacing, arrays, ranks)));
    });
}

int vtkPartitionedMeshQuery::Closest(
  vtkDataArray* points, vtkIdTypeArray* cells, vtkDoubleArray* locations, vtkDoubleArray* distances)
{
  return this->Around(
    [&](tipp::Communicator* ranks, const tipp::ResidentMesh& mesh)
    {
      const std::vector<tipp::Point3> asked = pointsOf(points);
      const tipp::ClosestLocations found =
        tipp::closestTo(mesh, asked.data(), std::int64_t(asked.size()), ranks);
      copyTo(cells, found.Cells);
      std::vector<double> coordinates;
      coordinates.reserve(locations ? 3 * found.Points.size() : 0);
      for (std::size_t i = 0; locations && i < found.Points.size(); ++i)
      {
        const tipp::Point3& p = found.Points[i];
        coordinates.insert(coordinates.end(), { p.x, p.y, p.z });
      }
      copyTo(locations, coordinates, 3);
      copyTo(distances, found.Distances);
    });
}

int vtkPartitionedMeshQuery::CellsInBox(const double box[6], bool whole, vtkIdTypeArray* cells)
{
  return this->Direct(
    [&] { copyTo(cells, tipp::cellsIn(*this->OpenWhole(), regionOf(box), whole)); });
}

int vtkPartitionedMeshQuery::CellsInPolygons(
  vtkPolyData* polygons, bool whole, vtkIdTypeArray* cells)
{
  return this->Direct(
    [&] { copyTo(cells, tipp::cellsIn(*this->OpenWhole(), regionOf(polygons), whole)); });
}

int vtkPartitionedMeshQuery::PointsInBox(const double box[6], vtkIdTypeArray* points)
{
  return this->Direct([&] { copyTo(points, tipp::pointsIn(*this->OpenWhole(), regionOf(box))); });
}

int vtkPartitionedMeshQuery::PointsInPolygons(vtkPolyData* polygons, vtkIdTypeArray* points)
{
  return this->Direct(
    [&] { copyTo(points, tipp::pointsIn(*this->OpenWhole(), regionOf(polygons))); });
}

int vtkPartitionedMeshQuery::ZoneStatistics(vtkPolyData* zones, const char* array, int component,
  double level, vtkDataSetAttributes* statistics)
{
  return this->Around(
    [&](tipp::Communicator* ranks, const tipp::ResidentMesh& mesh)
    {
      const std::vector<tipp::Zone> own =
        !ranks || ranks->isFirst() ? zonesOf(zones) : std::vector<tipp::Zone>();
      const tipp::ZoneStatistics found =
        tipp::statisticsOf(mesh, own, array ? array : "", component, level, ranks);
      statistics->AddArray(arrayOf<vtkIdTypeArray>("Cells", found.Cells));
      statistics->AddArray(arrayOf<vtkDoubleArray>("Area", found.Area));
      statistics->AddArray(arrayOf<vtkDoubleArray>("Minimum", found.Low));
      statistics->AddArray(arrayOf<vtkDoubleArray>("Maximum", found.High));
      statistics->AddArray(arrayOf<vtkDoubleArray>("Mean", found.Mean));
      statistics->AddArray(arrayOf<vtkDoubleArray>("Integral", found.Sum));
      statistics->AddArray(arrayOf<vtkDoubleArray>("VolumeAbove", found.Above));
    });
}

int vtkPartitionedMeshQuery::Descend(
  vtkDataArray* points, const char* array, int component, vtkPolyData* lines)
{
  return this->Around(
    [&](tipp::Communicator* ranks, const tipp::ResidentMesh& mesh)
    {
      const std::string name = array ? array : "";
      lines->ShallowCopy(
        tipp::polyDataOf(tipp::descentsOf(mesh, pointsOf(points), name, component, ranks), name));
    });
}

int vtkPartitionedMeshQuery::InterpolateOnOwners(vtkDataArray* points, vtkPolyData* values)
{
  return this->Around(
    [&](tipp::Communicator* ranks, const tipp::ResidentMesh& mesh)
    {
      const std::vector<tipp::Point3> asked = pointsOf(points);
      tipp::AnswerOptions options;
      options.Arrays = this->ArraysOf(ranks, mesh);
      tipp::Communicator alone(nullptr); // used if there are no other ranks
      values->ShallowCopy(tipp::polyDataOf(tipp::answerWhereCellsAre(
        ranks ? *ranks : alone, mesh, asked.data(), std::int64_t(asked.size()), options)));
    });
}
