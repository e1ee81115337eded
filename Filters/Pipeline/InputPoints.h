// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInputPoints_h
#define tippInputPoints_h

#include "Distributed/PointExchange.h"
#include "Predicates/Geometry.h"
#include "Ranks/Communicator.h"
#include "Triangulation/PointsView.h"

#include "vtkSmartPointer.h"

#include <cstddef>
#include <string>
#include <vector>

class vtkAbstractTransform;
class vtkDataArray;
class vtkPointSet;
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

// In the next three functions, `points` may be null. `ranks`: whose points are added to `points`;
// the call is collective then. Null: none.

/// Returns the transform that moves the points' least-squares plane to the plane z = 0 and their
/// centroid to the origin. Points with a NaN or infinite coordinate are ignored; returns null if
/// there are no others. Does not depend on how the points are divided among the ranks.
vtkSmartPointer<vtkTransform> bestFittingPlane(vtkPoints* points, Communicator* ranks = nullptr);

/// Returns the bounding box of the points whose three coordinates are finite, so that a single NaN
/// or infinity does not determine a tolerance or a bounding circle. All zero if there are no such
/// points.
Box3 finiteBounds(vtkPoints* points, Communicator* ranks = nullptr);

/// Returns the distance within which points are merged: `tolerance` times the length of the
/// diagonal of the points' bounding box, see finiteBounds().
double toleratedDistance(double tolerance, vtkPoints* points, Communicator* ranks = nullptr);

/// Returns the length of the box's diagonal.
double diagonalOf(const Box3& box);

/// Returns the points in double precision, followed by those of `added`.
vtkSmartPointer<vtkPoints> appendPoints(vtkPoints* points, const std::vector<Point3>& added);

/// Returns eight points on a circle around the centre of a box, at its middle height. The radius is
/// `offset` times the box's diagonal.
std::vector<Point3> boundingCircle(const Box3& bounds, double offset);

/// Returns this rank's points without their data. The last rank's are followed by those of `added`.
vtkSmartPointer<vtkPointSet> withPointsOnLast(
  Communicator& ranks, vtkPointSet* input, const std::vector<Point3>& added);

/// Returns the coordinates as doubles: the memory of `points`, or `copy` filled with them. Valid as
/// long as both exist.
const Point3* coordinatesOf(vtkPoints* points, std::vector<Point3>& copy);

/// The points and point data of a data set as rows of bytes, which are sent with the points. A row
/// has three doubles for the coordinates, and the values of the arrays that all ranks with points
/// have.
class PointRows
{
public:
  /// Chooses the arrays that all ranks with points have. Collective: all ranks must call it.
  PointRows(Communicator& ranks, vtkPointSet* input);

  struct Column
  {
    std::string Name;
    int Type = 0;
    int Components = 0;
    std::size_t Size = 0; ///< bytes
  };

  const std::vector<Column>& columns() const { return this->Columns; }
  bool areDoubles() const { return this->Doubles; }

  /// Sets the ids and rows of `points`. They refer to this object, which must outlive them.
  void describe(RankPointData& points) const;

private:
  std::vector<Column> Columns;
  std::vector<vtkSmartPointer<vtkDataArray>> Arrays; ///< empty on a rank without points
  std::vector<const char*> Values;
  vtkSmartPointer<vtkDataArray> Coordinates;
  std::vector<PointId> GlobalIds;
  bool Doubles = false;
};

} // namespace tipp

#endif
