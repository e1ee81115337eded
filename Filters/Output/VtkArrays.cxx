// SPDX-License-Identifier: BSD-3-Clause
#include "Output/VtkArrays.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkTypeUInt64Array.h"
#include "vtkUnsignedCharArray.h"

#include <utility>

namespace tipp
{

namespace
{

template <typename Array, typename Value>
vtkSmartPointer<Array> takeArray(Buffer<Value> buffer)
{
  auto array = vtkSmartPointer<Array>::New();
  if (!buffer.empty())
  {
    // If long and long long both have 64 bits, VTK's type may be the one that Value is not.
    static_assert(sizeof(Value) == sizeof(typename Array::ValueType), "same integers");
    const vtkIdType size = vtkIdType(buffer.size());
    void* memory = buffer.release();
    array->SetArray(
      static_cast<typename Array::ValueType*>(memory), size, 0, Array::VTK_DATA_ARRAY_FREE);
  }
  return array;
}

template <typename Value>
Buffer<Value> offsets(std::size_t cells, int cellSize)
{
  Buffer<Value> result(cells + 1);
  const std::int64_t count = std::int64_t(cells + 1);
#pragma omp parallel for
  for (std::int64_t i = 0; i < count; ++i)
  {
    result[i] = Value(i * cellSize);
  }
  return result;
}

Buffer<std::int64_t> widened(const Buffer<std::int32_t>& ids)
{
  Buffer<std::int64_t> result(ids.size());
  const std::int64_t count = std::int64_t(ids.size());
#pragma omp parallel for
  for (std::int64_t i = 0; i < count; ++i)
  {
    result[i] = ids[i];
  }
  return result;
}

template <typename Array, typename Value>
vtkSmartPointer<vtkCellArray> makeCells(Buffer<Value> ids, int cellSize)
{
  const auto starts = takeArray<Array>(offsets<Value>(ids.size() / cellSize, cellSize));
  const auto connectivity = takeArray<Array>(std::move(ids));
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(starts.Get(), connectivity.Get());
  return cells;
}

} // namespace

vtkSmartPointer<vtkCellArray> takeCells(
  Buffer<std::int32_t> ids, int cellSize, std::int64_t largestOffset32)
{
  return std::int64_t(ids.size()) > largestOffset32
    ? makeCells<vtkTypeInt64Array>(widened(ids), cellSize)
    : makeCells<vtkTypeInt32Array>(std::move(ids), cellSize);
}

vtkSmartPointer<vtkCellArray> takeCells(Buffer<std::int64_t> ids, int cellSize)
{
  return makeCells<vtkTypeInt64Array>(std::move(ids), cellSize);
}

vtkSmartPointer<vtkIdTypeArray> takeArray(
  const std::string& name, Buffer<std::int64_t> values, int components)
{
  const auto array = takeArray<vtkIdTypeArray>(std::move(values));
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  return array;
}

vtkSmartPointer<vtkUnsignedCharArray> takeArray(
  const std::string& name, Buffer<unsigned char> values, int components)
{
  const auto array = takeArray<vtkUnsignedCharArray>(std::move(values));
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  return array;
}

namespace
{

template <typename Array, typename Values>
vtkSmartPointer<Array> makeArray(const std::string& name, const Values& values)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name.c_str());
  for (const auto& value : values)
  {
    array->InsertNextValue(value);
  }
  return array;
}

vtkSmartPointer<vtkAbstractArray> arrayOf(const Figures& figures)
{
  return std::visit(
    [&](const auto& values) -> vtkSmartPointer<vtkAbstractArray>
    {
      using Value = typename std::decay_t<decltype(values)>::value_type;
      if constexpr (std::is_same_v<Value, std::string>)
      {
        return makeArray<vtkStringArray>(figures.Array, values);
      }
      else if constexpr (std::is_same_v<Value, double>)
      {
        return makeArray<vtkDoubleArray>(figures.Array, values);
      }
      else if constexpr (std::is_same_v<Value, std::uint64_t>)
      {
        return makeArray<vtkTypeUInt64Array>(figures.Array, values);
      }
      else
      {
        return makeArray<vtkIdTypeArray>(figures.Array, values);
      }
    },
    figures.Values);
}

} // namespace

void fillStatisticsTable(const RunStatistics& statistics, vtkTable* table)
{
  vtkFieldData* const totals = table->GetFieldData();
  const auto add = [&](const Figures& figures, bool isColumn)
  {
    if (figures.Array.empty())
    {
      return;
    }
    const vtkSmartPointer<vtkAbstractArray> array = arrayOf(figures);
    isColumn ? table->AddColumn(array) : void(totals->AddArray(array));
  };
  for (const Figures& total : statistics.Totals)
  {
    add(total, false);
  }
  for (const FigureList& list : statistics.Lists)
  {
    for (const Figures& column : list.Columns)
    {
      add(column, list.IsTable);
    }
  }
}

void addAccounts(const DistributedTriangulation& mine, vtkPolyData* output)
{
  std::vector<PointId> points;
  std::vector<PointId> representatives;
  for (const Duplicate& duplicate : mine.Duplicates)
  {
    points.push_back(duplicate.Point);
    representatives.push_back(duplicate.Representative);
  }
  vtkFieldData* const data = output->GetFieldData();
  data->AddArray(makeArray<vtkIdTypeArray>("DuplicatePointIds", points));
  data->AddArray(makeArray<vtkIdTypeArray>("DuplicateRepresentativeIds", representatives));
  data->AddArray(makeArray<vtkIdTypeArray>("RejectedPointIds", mine.Rejected));
}

} // namespace tipp
