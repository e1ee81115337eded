// SPDX-License-Identifier: BSD-3-Clause
#include "Output/NeighborArray.h"

#include "Meshes/FindNeighbors.h"

#include "vtkIdTypeArray.h"

namespace tipp
{

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

} // namespace tipp
