// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippProjectedPoints_h
#define tippProjectedPoints_h

#include "Triangulation/PointsView.h"

#include "vtkSmartPointer.h"

class vtkAbstractTransform;
class vtkDataArray;
class vtkPoints;

namespace tipp
{

/// A dataset's points projected to the plane of the triangulation. Float and double points stored
/// as x, y, z are viewed without a copy; others are converted to double.
class ProjectedPoints
{
public:
  /// A null transform drops z; null points are no points.
  ProjectedPoints(vtkPoints* points, vtkAbstractTransform* toPlane);

  /// The projected points; valid while this object exists.
  PointsView view() const { return this->View; }

private:
  vtkSmartPointer<vtkDataArray> Scalars;
  PointsView View;
};

} // namespace tipp

#endif
