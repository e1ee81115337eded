// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippProjectedPoints_h
#define tippProjectedPoints_h

#include "InMemory/FiniteBounds.h"
#include "Triangulation/PointsView.h"

#include "vtkSmartPointer.h"

#include <array>
#include <vector>

class vtkAbstractTransform;
class vtkDataArray;
class vtkPoints;
class vtkTransform;

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

/// Returns the transform that moves the points' least-squares plane to the plane z = 0 and their
/// centroid to the origin. Points with a NaN or infinite coordinate are ignored; returns null if
/// there are no others.
vtkSmartPointer<vtkTransform> bestFittingPlane(vtkPoints* points);

FiniteBounds finiteBounds(vtkPoints* points);

/// Returns the points in double precision, followed by those of `added`.
vtkSmartPointer<vtkPoints> appendPoints(
  vtkPoints* points, const std::vector<std::array<double, 3>>& added);

/// Returns the points in double precision, followed by eight points on a circle around the centre
/// of their bounding box, at its middle height. The radius is `offset` times the box's diagonal.
vtkSmartPointer<vtkPoints> appendBoundingPoints(vtkPoints* points, double offset);

} // namespace tipp

#endif
