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

/// A dataset's points as the plane of the triangulation sees them. Float and double points that
/// lie as x, y, z in memory are viewed there, all others are converted to double once.
class ProjectedPoints
{
public:
  /// A null transform drops z; a null vtkPoints is no points.
  ProjectedPoints(vtkPoints* points, vtkAbstractTransform* toPlane);

  /// Valid while this object lives.
  PointsView view() const { return this->View; }

private:
  vtkSmartPointer<vtkDataArray> Scalars;
  PointsView View;
};

} // namespace tipp

#endif
