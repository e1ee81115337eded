// SPDX-License-Identifier: BSD-3-Clause
#include "Projection/ProjectedPoints.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkAbstractTransform.h"
#include "vtkDoubleArray.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPlane.h"
#include "vtkPoints.h"
#include "vtkTransform.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tipp
{

namespace
{

template <typename Scalar>
bool viewInPlace(vtkDataArray* array, PointsView& view)
{
  auto scalars = vtkAOSDataArrayTemplate<Scalar>::FastDownCast(array);
  if (scalars)
  {
    view = PointsView(scalars->GetPointer(0), std::size_t(scalars->GetNumberOfTuples()), 3);
  }
  return scalars != nullptr;
}

} // namespace

ProjectedPoints::ProjectedPoints(vtkPoints* points, vtkAbstractTransform* toPlane)
{
  if (!points || points->GetNumberOfPoints() == 0)
  {
    return;
  }
  this->Scalars = points->GetData();
  if (toPlane)
  {
    vtkNew<vtkPoints> inPlane;
    inPlane->SetDataTypeToDouble();
    toPlane->TransformPoints(points, inPlane);
    this->Scalars = inPlane->GetData();
  }
  if (viewInPlace<double>(this->Scalars, this->View) ||
    viewInPlace<float>(this->Scalars, this->View))
  {
    return;
  }
  vtkNew<vtkDoubleArray> converted;
  converted->DeepCopy(this->Scalars);
  this->Scalars = converted;
  viewInPlace<double>(this->Scalars, this->View);
}

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

double FiniteBounds::center(int axis) const
{
  return 0.5 * this->Low[axis] + 0.5 * this->High[axis];
}

double FiniteBounds::diagonal() const
{
  return std::hypot(
    this->High[0] - this->Low[0], this->High[1] - this->Low[1], this->High[2] - this->Low[2]);
}

FiniteBounds finiteBounds(vtkPoints* points)
{
  const double infinity = std::numeric_limits<double>::infinity();
  double low0 = infinity, low1 = infinity, low2 = infinity;
  double high0 = -infinity, high1 = -infinity, high2 = -infinity;
  const vtkIdType count = points ? points->GetNumberOfPoints() : 0;
#pragma omp parallel for reduction(min : low0, low1, low2) reduction(max : high0, high1, high2)
  for (vtkIdType i = 0; i < count; ++i)
  {
    double p[3];
    points->GetPoint(i, p);
    if (std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]))
    {
      low0 = std::min(low0, p[0]);
      low1 = std::min(low1, p[1]);
      low2 = std::min(low2, p[2]);
      high0 = std::max(high0, p[0]);
      high1 = std::max(high1, p[1]);
      high2 = std::max(high2, p[2]);
    }
  }
  return low0 <= high0 ? FiniteBounds{ { low0, low1, low2 }, { high0, high1, high2 } }
                       : FiniteBounds{};
}

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
    scalars->SetTuple3(count + i, bounds.center(0) + radius * std::cos(angle),
      bounds.center(1) + radius * std::sin(angle), bounds.center(2));
  }
  auto extended = vtkSmartPointer<vtkPoints>::New();
  extended->SetData(scalars);
  return extended;
}

} // namespace tipp
