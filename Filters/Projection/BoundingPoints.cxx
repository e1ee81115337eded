// SPDX-License-Identifier: BSD-3-Clause
#include "Projection/BoundingPoints.h"

#include "Projection/FiniteBounds.h"

#include "vtkDoubleArray.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPoints.h"

#include <cmath>

namespace tipp
{

vtkSmartPointer<vtkPoints> appendBoundingPoints(vtkPoints* points, double offset)
{
  constexpr int boundingPoints = 8;
  const FiniteBounds bounds = finiteBounds(points);
  const double radius = offset * bounds.diagonal();
  const vtkIdType count = points->GetNumberOfPoints();

  vtkNew<vtkDoubleArray> scalars;
  scalars->SetNumberOfComponents(3);
  scalars->SetNumberOfTuples(count + boundingPoints);
  scalars->InsertTuples(0, count, 0, points->GetData());
  for (int i = 0; i < boundingPoints; ++i)
  {
    const double angle = 2 * vtkMath::Pi() * i / boundingPoints;
    scalars->SetTuple3(count + i,
      bounds.center(0) + radius * std::cos(angle),
      bounds.center(1) + radius * std::sin(angle),
      bounds.center(2));
  }
  auto extended = vtkSmartPointer<vtkPoints>::New();
  extended->SetData(scalars);
  return extended;
}

} // namespace tipp
