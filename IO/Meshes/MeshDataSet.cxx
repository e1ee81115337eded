// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes/MeshDataSet.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnstructuredGrid.h"

namespace tipp
{
namespace
{

// Writers take non-const arrays, but only read them. std::int64_t and VTK's 64-bit integer differ
// only in name (long and long long).
template <typename Array, typename Value>
vtkSmartPointer<Array> borrow(const Value* values, std::size_t count)
{
  auto array = vtkSmartPointer<Array>::New();
  using Same = typename Array::ValueType;
  static_assert(sizeof(Same) == sizeof(Value));
  array->SetArray(reinterpret_cast<Same*>(const_cast<Value*>(values)), vtkIdType(count), 1);
  return array;
}

const PointTable::Column* findZ(const PointTable& points)
{
  for (const PointTable::Column& column : points.Columns)
  {
    if (column.Name == "z" || column.Name == "Z")
    {
      return &column;
    }
  }
  return nullptr;
}

void setIds(vtkFieldData* data, const char* name, const std::vector<std::int64_t>* ids, int each)
{
  if (ids && !ids->empty())
  {
    const auto array = borrow<vtkTypeInt64Array>(ids->data(), ids->size());
    array->SetNumberOfComponents(each);
    array->SetName(name);
    data->AddArray(array);
  }
}

void setPoints(const PointTable& table, vtkPointSet* data)
{
  const std::size_t count = table.size();
  const PointTable::Column* const z = findZ(table);
  vtkNew<vtkDoubleArray> xyz;
  xyz->SetNumberOfComponents(3);
  xyz->SetNumberOfTuples(vtkIdType(count));
  double* const to = xyz->GetPointer(0);
  for (std::size_t i = 0; i < count; ++i)
  {
    to[3 * i] = table.XY[2 * i];
    to[3 * i + 1] = table.XY[2 * i + 1];
    to[3 * i + 2] = z ? z->Values[i] : 0;
  }
  vtkNew<vtkPoints> points;
  points->SetData(xyz);
  data->SetPoints(points);
  for (const PointTable::Column& column : table.Columns)
  {
    if (&column != z)
    {
      const auto array = borrow<vtkDoubleArray>(column.Values.data(), count);
      array->SetName(column.Name.c_str());
      data->GetPointData()->AddArray(array);
    }
  }
}

void setData(const MeshData& more, vtkPointSet* data)
{
  setIds(data->GetPointData(), "RepresentativePointId", more.Representatives, 1);
  setIds(data->GetCellData(), "NeighborIds", more.Neighbors, 3);
}

template <typename Array, typename Id>
vtkSmartPointer<vtkCellArray> makeCells(const Id* ids, std::size_t triangles)
{
  vtkNew<Array> offsets;
  offsets->SetNumberOfValues(vtkIdType(triangles) + 1);
  for (std::size_t i = 0; i <= triangles; ++i)
  {
    offsets->SetValue(vtkIdType(i), Id(3 * i));
  }
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  const auto connectivity = borrow<Array>(ids, 3 * triangles);
  cells->SetData(offsets.Get(), connectivity.Get());
  return cells;
}

vtkSmartPointer<vtkCellArray> makeCells(TrianglesView triangles)
{
  // 32-bit offsets end at a third of the triangles that 32-bit ids allow.
  constexpr std::size_t limit = (std::size_t(1) << 31) / 3;
  if (triangles.ids32() && triangles.size() < limit)
  {
    return makeCells<vtkTypeInt32Array>(triangles.ids32(), triangles.size());
  }
  if (triangles.ids64())
  {
    return makeCells<vtkTypeInt64Array>(triangles.ids64(), triangles.size());
  }
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->Use64BitStorage();
  cells->AllocateExact(vtkIdType(triangles.size()), 3 * vtkIdType(triangles.size()));
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    cells->InsertNextCell({ triangles.id(i, 0), triangles.id(i, 1), triangles.id(i, 2) });
  }
  return cells;
}

} // namespace

vtkSmartPointer<vtkPolyData> makePolyData(
  const PointTable& points, TrianglesView triangles, const MeshData& more)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  setPoints(points, data);
  data->SetPolys(makeCells(triangles));
  setData(more, data);
  return data;
}

vtkSmartPointer<vtkUnstructuredGrid> makeUnstructuredGrid(
  const PointTable& points, TrianglesView triangles, const MeshData& more)
{
  auto data = vtkSmartPointer<vtkUnstructuredGrid>::New();
  setPoints(points, data);
  data->SetCells(VTK_TRIANGLE, makeCells(triangles));
  setData(more, data);
  return data;
}

} // namespace tipp
