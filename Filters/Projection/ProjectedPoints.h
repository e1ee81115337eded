// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippProjectedPoints_h
#define tippProjectedPoints_h

#include "Triangulation/PointsView.h"

#include "vtkSmartPointer.h"

#include <array>
#include <cmath>
#include <cstddef>
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

/// The bounding box of the points whose three coordinates are finite, so that a single NaN or
/// infinity does not determine a tolerance or a bounding circle. All zero if there are no such
/// points.
struct FiniteBounds
{
  std::array<double, 3> Low{ 0, 0, 0 };
  std::array<double, 3> High{ 0, 0, 0 };

  double center(int axis) const
  {
    return 0.5 * this->Low[std::size_t(axis)] + 0.5 * this->High[std::size_t(axis)];
  }
  double diagonal() const
  {
    return std::hypot(
      this->High[0] - this->Low[0], this->High[1] - this->Low[1], this->High[2] - this->Low[2]);
  }
};

/// `points` may be null.
FiniteBounds finiteBounds(vtkPoints* points);

/// Returns the points in double precision, followed by those of `added`.
vtkSmartPointer<vtkPoints> appendPoints(
  vtkPoints* points, const std::vector<std::array<double, 3>>& added);

/// Returns the points in double precision, followed by eight points on a circle around the centre
/// of their bounding box, at its middle height. The radius is `offset` times the box's diagonal.
vtkSmartPointer<vtkPoints> appendBoundingPoints(vtkPoints* points, double offset);

} // namespace tipp

#endif
