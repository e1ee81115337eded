// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSourceConstraints_h
#define tippSourceConstraints_h

#include "InMemory/TriangulatePoints.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
#include <vector>

class vtkAbstractTransform;
class vtkPointData;
class vtkPoints;
class vtkPointSet;
class vtkPolyData;

namespace tipp
{

/// The lines and polygons of a data set. Ids: of each point of the source, the point that it is in
/// the triangulation. Empty: the same.
SourceConstraints readConstraints(vtkPolyData* source, const std::vector<PointId>& ids);

/// A data set with the points of a source.
struct JoinedPoints
{
  vtkSmartPointer<vtkPointSet> Data; ///< the input, or a new data set if there are new points
  std::vector<PointId> Ids;          ///< of the source's points: where they are
  std::size_t NewPoints = 0;         ///< after the input's
  std::size_t LostArrays = 0;        ///< of the input, that the source has no values of
};

/// A point of the source at the position, in the plane, of one of the input's is that one (the
/// first), each other position is a new point. New points have the source's values of point arrays;
/// arrays that the source lacks are left out if there are new points.
JoinedPoints joinPoints(vtkPointSet* input, vtkPolyData* source, vtkAbstractTransform* toPlane);

/// The points and, in double precision after them, the crossings. The plane is x and y, in which
/// they are exact, unless there is a transform; other coordinates are interpolated.
vtkSmartPointer<vtkPoints> appendCrossings(
  vtkPoints* points, const std::vector<CrossingPoint>& crossings, bool isPlaneXY);

/// Point data of the points and, interpolated along the constraint of lower number, of the
/// crossings.
void interpolateCrossings(vtkPointData* from, vtkIdType points,
  const std::vector<CrossingPoint>& crossings, vtkPointData* to);

/// Adds the edges of constraints as lines, before the triangles, with the cell array
/// "ConstraintId": the source's cell, and -1 of triangles.
void addConstraintLines(const ResolvedConstraints& constraints,
  const std::vector<std::int64_t>& sourceCells, vtkPolyData* output);

} // namespace tipp

#endif
