// SPDX-License-Identifier: BSD-3-Clause
#include "Projection/ProjectedPoints.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkAbstractTransform.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"

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

} // namespace tipp
