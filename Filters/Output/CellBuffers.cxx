// SPDX-License-Identifier: BSD-3-Clause
#include "Output/CellBuffers.h"

#include "Meshes/MeshFiles.h"

#include "vtkCellArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"

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

vtkSmartPointer<vtkIdTypeArray> neighborArray(const Triangulation& triangulation)
{
  const std::size_t triangles = triangulation.triangleCount();
  auto array = vtkSmartPointer<vtkIdTypeArray>::New();
  array->SetName("NeighborIds");
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(vtkIdType(triangles));
  vtkIdType* const neighbors = array->GetPointer(0);
  triangulation.Ids64.empty() ? findNeighbors(triangulation.Ids32.data(), triangles, neighbors)
                              : findNeighbors(triangulation.Ids64.data(), triangles, neighbors);
  return array;
}

vtkSmartPointer<vtkIdTypeArray> representativeIds(
  const Triangulation& triangulation, std::int64_t points)
{
  Buffer<vtkIdType> ids{ std::size_t(points) };
#pragma omp parallel for
  for (std::int64_t i = 0; i < points; ++i)
  {
    ids[i] = i;
  }
  for (const Duplicate& duplicate : triangulation.Duplicates)
  {
    ids[duplicate.Point] = duplicate.Representative;
  }
  for (PointId rejected : triangulation.Rejected)
  {
    ids[rejected] = -1;
  }
  auto array = vtkSmartPointer<vtkIdTypeArray>::New();
  array->SetName("RepresentativePointId");
  array->SetArray(ids.release(), points, 0, vtkIdTypeArray::VTK_DATA_ARRAY_FREE);
  return array;
}

} // namespace tipp
