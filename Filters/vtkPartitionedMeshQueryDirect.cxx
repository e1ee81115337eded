// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPartitionedMeshQuery.h"

#include "Query/Queries.h"
#include "Query/QueryData.h"
#include "Vtk/DataSets.h"

#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

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
  std::copy_n(box, 6, region.Box.begin());
  return region;
}

} // namespace

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
