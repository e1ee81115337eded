// SPDX-License-Identifier: BSD-3-Clause
#include "Projection/BestFittingPlane.h"

#include "vtkMath.h"
#include "vtkPlane.h"
#include "vtkPoints.h"
#include "vtkTransform.h"

#include <algorithm>
#include <cmath>

namespace tipp
{

namespace
{

bool isFinite(const double p[3])
{
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

bool isFinite(vtkPoints* points)
{
  bool finite = true;
  const vtkIdType count = points->GetNumberOfPoints();
#pragma omp parallel for reduction(&& : finite)
  for (vtkIdType i = 0; i < count; ++i)
  {
    double p[3];
    points->GetPoint(i, p);
    finite = finite && isFinite(p);
  }
  return finite;
}

vtkSmartPointer<vtkPoints> finitePoints(vtkPoints* points)
{
  auto finite = vtkSmartPointer<vtkPoints>::New();
  finite->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    double p[3];
    points->GetPoint(i, p);
    if (isFinite(p))
    {
      finite->InsertNextPoint(p);
    }
  }
  return finite;
}

} // namespace

vtkSmartPointer<vtkTransform> bestFittingPlane(vtkPoints* points)
{
  if (!points || points->GetNumberOfPoints() == 0)
  {
    return nullptr;
  }
  vtkSmartPointer<vtkPoints> finite = points;
  if (!isFinite(points))
  {
    finite = finitePoints(points);
  }
  if (finite->GetNumberOfPoints() == 0)
  {
    return nullptr;
  }
  double origin[3];
  double normal[3];
  vtkPlane::ComputeBestFittingPlane(finite, origin, normal);

  const double up[3] = { 0, 0, 1 };
  double axis[3];
  vtkMath::Cross(normal, up, axis);
  const double angle = std::acos(std::clamp(vtkMath::Dot(up, normal), -1.0, 1.0));

  auto transform = vtkSmartPointer<vtkTransform>::New();
  transform->RotateWXYZ(vtkMath::DegreesFromRadians(angle), axis);
  transform->Translate(-origin[0], -origin[1], -origin[2]);
  return transform;
}

} // namespace tipp
