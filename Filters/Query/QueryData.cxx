// SPDX-License-Identifier: BSD-3-Clause
#include "Query/QueryData.h"

#include "Parallel/ParallelFor.h"
#include "Sampling/SamplingRange.h"
#include "Sampling/SimplexParts.h"
#include "Vtk/CellArrays.h"
#include "Vtk/DataSets.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <cmath>
#include <cstring>
#include <memory>

namespace tipp
{
namespace
{

/// Owns everything that a MeshPart of a data set refers to.
struct OwnedMesh
{
  vtkSmartPointer<vtkPointSet> Mesh;
  SimplexParts Simplices;
  std::vector<vtkSmartPointer<vtkDataArray>> Arrays;
  std::vector<std::int64_t> CellIds; ///< global id of the cell that each simplex is a part of
};

/// Returns the array, or a copy if its tuples are not contiguous; `kept` holds a reference.
vtkDataArray* keep(vtkDataArray* array, OwnedMesh& kept)
{
  kept.Arrays.push_back(contiguous(array));
  return kept.Arrays.back();
}

void addArrays(vtkDataSetAttributes* data, bool ofPoints, OwnedMesh& kept, MeshPart& part)
{
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* const array = data->GetArray(i);
    if (!array || !array->GetName() || !scalarOf(array->GetDataType()) ||
      array == data->GetGlobalIds() ||
      std::strcmp(array->GetName(), vtkDataSetAttributes::GhostArrayName()) == 0)
    {
      continue;
    }
    StoredArray description;
    description.Name = array->GetName();
    description.OfPoints = ofPoints;
    description.Type = *scalarOf(array->GetDataType());
    description.Components = array->GetNumberOfComponents();
    part.Arrays.push_back({ description, keep(array, kept)->GetVoidPointer(0) });
  }
}

const std::int64_t* globalIds(vtkDataSetAttributes* data, OwnedMesh& kept)
{
  vtkDataArray* const ids = data->GetGlobalIds();
  static_assert(sizeof(vtkIdType) == sizeof(std::int64_t));
  return ids && scalarOf(ids->GetDataType()) == Scalar::Int64
    ? static_cast<const std::int64_t*>(keep(ids, kept)->GetVoidPointer(0))
    : nullptr;
}

vtkSmartPointer<vtkPoints> pointsOf(const std::vector<Point3>& positions)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(vtkIdType(positions.size()));
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    points->SetPoint(vtkIdType(i), positions[i].x, positions[i].y, positions[i].z);
  }
  return points;
}

/// Creates a line for each list of successive points, none of which is empty. VTK crashes on a line
/// of one point (vtkPolyData::GetCellType in 9.1), so such a line has its point twice.
vtkSmartPointer<vtkPolyData> linesOf(
  const std::vector<Point3>& positions, const std::vector<std::int64_t>& starts, bool isClosed)
{
  vtkNew<vtkCellArray> lines;
  for (std::size_t i = 0; i + 1 < starts.size(); ++i)
  {
    const std::int64_t count = starts[i + 1] - starts[i];
    const bool repeatsFirst = isClosed || count == 1;
    lines->InsertNextCell(int(count) + (repeatsFirst ? 1 : 0));
    for (std::int64_t at = starts[i]; at < starts[i + 1]; ++at)
    {
      lines->InsertCellPoint(at);
    }
    if (repeatsFirst)
    {
      lines->InsertCellPoint(starts[i]);
    }
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(pointsOf(positions));
  data->SetLines(lines);
  return data;
}

} // namespace

MeshPart partOf(vtkDataObject* data, int threads)
{
  const auto kept = std::make_shared<OwnedMesh>();
  for (vtkPointSet* const mesh : data ? meshesOf(data, threads) : std::vector<vtkPointSet*>())
  {
    if (mesh->GetNumberOfCells() > 0)
    {
      if (kept->Mesh)
      {
        throw std::runtime_error(
          "the mesh is made of several data sets; put them together first, as by vtkAppendFilter.");
      }
      kept->Mesh = mesh;
    }
  }
  MeshPart part;
  if (!kept->Mesh)
  {
    return part;
  }
  kept->Simplices = makeSimplices(kept->Mesh, { 0, 1 }, threadCount(threads));
  const bool inSpace = kept->Simplices.Tetrahedra.Mesh.Cells > 0;
  SimplexSet& set = inSpace ? kept->Simplices.Tetrahedra : kept->Simplices.Triangles;
  part.Mesh = set.Mesh;
  part.OwnedCells = part.Mesh.Cells;
  addArrays(kept->Mesh->GetPointData(), true, *kept, part);
  addArrays(kept->Mesh->GetCellData(), false, *kept, part);
  part.PointIds = globalIds(kept->Mesh->GetPointData(), *kept);
  part.CellIds = globalIds(kept->Mesh->GetCellData(), *kept);
  if (!set.Parents.empty())
  {
    part.Rows = set.Parents.data();
    if (part.CellIds)
    {
      for (const std::int64_t parent : set.Parents)
      {
        kept->CellIds.push_back(part.CellIds[parent]);
      }
    }
    part.CellIds = part.CellIds ? kept->CellIds.data() : part.Rows;
  }
  part.Keeps = kept;
  return part;
}

void moveArrays(MeshAnswer& answer, vtkDataSetAttributes* to, double null)
{
  for (MeshAnswer::Array& values : answer.Arrays)
  {
    const auto array =
      vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(vtkTypeOf(values.Type)));
    const auto count = vtkIdType(values.Values.size() / scalarSize(values.Type));
    array->SetName(values.Name.c_str());
    array->SetNumberOfComponents(values.Components);
    array->SetVoidArray(values.Values.release(), count, 0, vtkAbstractArray::VTK_DATA_ARRAY_FREE);
    const bool isReplaced = (values.Type == Scalar::Float32 || values.Type == Scalar::Float64) &&
      !std::isnan(null); // the values are NaN already
    for (std::size_t i = 0; isReplaced && i < answer.Cells.size(); ++i)
    {
      for (int k = 0; answer.Cells[i] < 0 && k < values.Components; ++k)
      {
        array->SetComponent(vtkIdType(i), k, null);
      }
    }
    to->AddArray(array);
  }
}

vtkSmartPointer<vtkPolyData> polyDataOf(const BoundaryLoops& loops)
{
  vtkSmartPointer<vtkPolyData> data = linesOf(loops.Positions, loops.Points.Starts, true);
  data->GetPointData()->SetGlobalIds(arrayOf<vtkIdTypeArray>("GlobalPointIds", loops.Points.Ids));
  return data;
}

vtkSmartPointer<vtkPolyData> polyDataOf(const Contours& contours, const std::string& name)
{
  vtkSmartPointer<vtkPolyData> data = linesOf(contours.Points, contours.Starts, false);
  data->GetCellData()->SetScalars(arrayOf<vtkDoubleArray>(name.c_str(), contours.Levels));
  return data;
}

vtkSmartPointer<vtkPolyData> polyDataOf(const Descents& descents, const std::string& name)
{
  std::vector<std::int64_t> starts = { 0 };
  std::vector<std::int64_t> numbers;
  std::vector<std::int64_t> pits;
  for (std::size_t i = 0; i < descents.Pits.size(); ++i)
  {
    if (descents.Starts[i + 1] > descents.Starts[i])
    {
      starts.push_back(descents.Starts[i + 1]);
      numbers.push_back(std::int64_t(i));
      pits.push_back(descents.Pits[i]);
    }
  }
  vtkSmartPointer<vtkPolyData> data = linesOf(descents.Points, starts, false);
  data->GetCellData()->AddArray(arrayOf<vtkIdTypeArray>("StartId", numbers));
  data->GetCellData()->AddArray(arrayOf<vtkIdTypeArray>("PitId", pits));
  data->GetPointData()->SetScalars(arrayOf<vtkDoubleArray>(name.c_str(), descents.Values));
  return data;
}

vtkSmartPointer<vtkPolyData> polyDataOf(Profile&& profile)
{
  const auto count = std::int64_t(profile.Points.size());
  vtkSmartPointer<vtkPolyData> data = linesOf(profile.Points,
    count > 0 ? std::vector<std::int64_t>{ 0, count } : std::vector<std::int64_t>{ 0 }, false);
  vtkPointData* const values = data->GetPointData();
  values->AddArray(arrayOf<vtkDoubleArray>("Distance", profile.Distances));
  values->AddArray(arrayOf<vtkIdTypeArray>("CellId", profile.Answer.Cells));
  moveArrays(profile.Answer, values);
  return data;
}

vtkSmartPointer<vtkPolyData> polyDataOf(StayingAnswer&& answer)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(pointsOf(answer.Points));
  vtkNew<vtkCellArray> vertices;
  for (vtkIdType i = 0; i < vtkIdType(answer.Points.size()); ++i)
  {
    vertices->InsertNextCell(1, &i);
  }
  data->SetVerts(vertices);
  vtkPointData* const values = data->GetPointData();
  moveArrays(answer.Answer, values);
  values->AddArray(arrayOf<vtkIdTypeArray>("CellId", answer.Answer.Cells));
  values->AddArray(arrayOf<vtkIdTypeArray>("AskingRank", answer.Ranks));
  values->AddArray(arrayOf<vtkIdTypeArray>("AskingId", answer.Indices));
  return data;
}

} // namespace tipp
