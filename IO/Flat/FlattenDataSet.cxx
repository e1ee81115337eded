// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/FlattenDataSet.h"

#include "Arrays/Scalar.h"
#include "Flat/Simplices.h"
#include "Parallel/Poll.h"
#include "Vtk/CheckDataSet.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <cstring>

namespace tipp
{
namespace
{

constexpr const char* parentName = "vtkOriginalCellIds";

/// The array itself if its values are contiguous, else a contiguous copy; single bits become bytes.
vtkSmartPointer<vtkDataArray> plain(vtkDataArray* array)
{
  const bool bits = array->GetDataType() == VTK_BIT;
  if (!bits && array->HasStandardMemoryLayout())
  {
    return array;
  }
  auto copy = vtkSmartPointer<vtkDataArray>::Take(
    vtkDataArray::CreateDataArray(bits ? VTK_UNSIGNED_CHAR : array->GetDataType()));
  copy->DeepCopy(array);
  copy->SetName(array->GetName());
  return copy;
}

FlatArray flatArray(vtkDataArray* from)
{
  // Copies of the FlatArray share one reference to the VTK array.
  const auto kept = std::make_shared<vtkSmartPointer<vtkDataArray>>(plain(from));
  vtkDataArray* const array = *kept;
  FlatArray flat;
  flat.Name = array->GetName() ? array->GetName() : "";
  flat.Type = *scalarOf(array->GetDataType());
  flat.Components = array->GetNumberOfComponents();
  flat.Tuples = array->GetNumberOfTuples();
  flat.Values = array->GetVoidPointer(0);
  flat.Owner = kept;
  return flat;
}

/// Copies the tuples of the parent cells, in the order of `parents`.
FlatArray gathered(const FlatArray& all, const std::vector<std::int64_t>& parents)
{
  FlatArray some = all;
  const std::size_t bytes = std::size_t(all.Components) * scalarSize(all.Type);
  const auto values = std::make_shared<std::vector<char>>(parents.size() * bytes);
  const auto* const from = static_cast<const char*>(all.Values);
  for (std::size_t i = 0; i < parents.size(); ++i)
  {
    std::memcpy(values->data() + i * bytes, from + std::size_t(parents[i]) * bytes, bytes);
  }
  some.Tuples = std::int64_t(parents.size());
  some.Values = values->data();
  some.Owner = values;
  return some;
}

FlatArray coordinatesOf(vtkDataSet* data)
{
  auto* const set = vtkPointSet::SafeDownCast(data);
  if (set && set->GetPoints())
  {
    const int type = set->GetPoints()->GetDataType();
    if (type == VTK_FLOAT || type == VTK_DOUBLE)
    {
      return flatArray(set->GetPoints()->GetData());
    }
  }
  vtkNew<vtkDoubleArray> points;
  points->SetNumberOfComponents(3);
  points->SetNumberOfTuples(data->GetNumberOfPoints());
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    pollAt(i);
    data->GetPoint(i, points->GetPointer(3 * i));
  }
  return flatArray(points);
}

std::vector<FlatArray> arraysOf(vtkDataSetAttributes* attributes, std::vector<std::string>& leftOut)
{
  std::vector<FlatArray> arrays;
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* const array = attributes->GetArray(i);
    const char* const name = attributes->GetAbstractArray(i)->GetName();
    if (name && std::strcmp(name, vtkDataSetAttributes::GhostArrayName()) == 0)
    {
      continue; // the ghost cells have been removed
    }
    if (!array || array->GetNumberOfComponents() < 1)
    {
      leftOut.emplace_back(name ? name : "");
      continue;
    }
    arrays.push_back(flatArray(array));
    if (arrays.back().Name.empty())
    {
      arrays.back().Name = "array_" + std::to_string(i);
    }
  }
  return arrays;
}

FlatArray parentArray(std::vector<std::int64_t> parents)
{
  const auto values = std::make_shared<std::vector<std::int64_t>>(std::move(parents));
  const auto count = std::int64_t(values->size());
  return { parentName, Scalar::Int64, 1, count, 0, values->data(), values };
}

} // namespace

Flattened flattenDataSet(vtkDataSet* data, const std::string& path)
{
  checkDataSet(data, path);
  Simplices simplices = simplicesOf(data, path);
  Flattened flattened;
  flattened.Cut = std::move(simplices.Cut);
  flattened.LeftOut = std::move(simplices.LeftOut);
  FlatContent& content = flattened.Content;
  content.CellSize = simplices.CellSize;
  content.Cells = std::move(simplices.Ids);
  content.Points = coordinatesOf(data);
  content.PointData = arraysOf(data->GetPointData(), flattened.ArraysLeftOut);
  content.CellData = arraysOf(data->GetCellData(), flattened.ArraysLeftOut);
  const bool changed = !flattened.Cut.empty() || !flattened.LeftOut.empty();
  bool named = false;
  for (FlatArray& array : content.CellData)
  {
    array = changed ? gathered(array, simplices.Parents) : array;
    named = named || array.Name == parentName;
  }
  // "vtkOriginalCellIds" in the input come from an earlier cut and are kept.
  if (changed && !named)
  {
    content.CellData.push_back(parentArray(std::move(simplices.Parents)));
  }
  return flattened;
}

} // namespace tipp
