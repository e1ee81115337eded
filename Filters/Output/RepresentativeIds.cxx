// SPDX-License-Identifier: BSD-3-Clause
#include "Output/RepresentativeIds.h"

#include "vtkIdTypeArray.h"

namespace tipp
{

vtkSmartPointer<vtkIdTypeArray> representativeIds(const Triangulation& triangulation,
  std::int64_t points)
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
