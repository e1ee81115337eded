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

FiniteBounds finiteBounds(vtkPoints* points)
{
  double low[3] = { HUGE_VAL, HUGE_VAL, HUGE_VAL };
  double high[3] = { -HUGE_VAL, -HUGE_VAL, -HUGE_VAL };
  const vtkIdType count = points ? points->GetNumberOfPoints() : 0;
#pragma omp parallel for reduction(min : low[:3]) reduction(max : high[:3])
  for (vtkIdType i = 0; i < count; ++i)
  {
    double p[3];
    points->GetPoint(i, p);
    const int axes = isFinite(p) ? 3 : 0;
    for (int axis = 0; axis < axes; ++axis)
    {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  return low[0] <= high[0]
    ? FiniteBounds{ { low[0], low[1], low[2] }, { high[0], high[1], high[2] } }
    : FiniteBounds{};
}

vtkSmartPointer<vtkPoints> appendPoints(
  vtkPoints* points, const std::vector<std::array<double, 3>>& added)
{
  const vtkIdType count = points->GetNumberOfPoints();
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetNumberOfComponents(3);
  scalars->SetNumberOfTuples(count + vtkIdType(added.size()));
  scalars->InsertTuples(0, count, 0, points->GetData());
  for (std::size_t i = 0; i < added.size(); ++i)
  {
    scalars->SetTuple(count + vtkIdType(i), added[i].data());
  }
  auto extended = vtkSmartPointer<vtkPoints>::New();
  extended->SetData(scalars);
  return extended;
}

vtkSmartPointer<vtkPoints> appendBoundingPoints(vtkPoints* points, double offset)
{
  const FiniteBounds bounds = finiteBounds(points);
  const double radius = offset * bounds.diagonal();
  std::vector<std::array<double, 3>> circle(8);
  for (std::size_t i = 0; i < circle.size(); ++i)
  {
    const double angle = 2 * vtkMath::Pi() * double(i) / double(circle.size());
    circle[i] = { bounds.center(0) + radius * std::cos(angle),
      bounds.center(1) + radius * std::sin(angle), bounds.center(2) };
  }
  return appendPoints(points, circle);
}

} // namespace tipp
