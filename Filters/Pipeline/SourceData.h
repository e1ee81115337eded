// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSourceData_h
#define tippSourceData_h

#include "InMemory/TriangulatePoints.h"
#include "Ranks/Communicator.h"

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

/// The lines and polygons of a data set. `ids` has, for each point of the source, the id of its
/// point in the triangulation; if it is empty, the ids are equal.
SourceConstraints readConstraints(vtkPolyData* source, const std::vector<PointId>& ids);

/// A data set with the points of a source.
struct JoinedPoints
{
  vtkSmartPointer<vtkPointSet> Data; ///< the input, or a new data set if there are new points
  std::vector<PointId> Ids;          ///< per point of the source: its id in Data
  std::size_t NewPoints = 0;         ///< number of new points, after those of the input
  std::size_t LostArrays = 0;        ///< number of the input's arrays that the source lacks
};

/// Merges points of the source with points of the input that have the same position in the plane
/// (the first of them). All other positions become new points. New points have the source's values
/// of point arrays. If there are new points, arrays that the source lacks are left out.
JoinedPoints joinPoints(vtkPointSet* input, vtkPolyData* source, vtkAbstractTransform* toPlane);

/// The points, followed by the crossings in double precision. If `isPlaneXY`, the crossings' x and
/// y are exact and z is interpolated; otherwise all coordinates are interpolated.
vtkSmartPointer<vtkPoints> appendCrossings(
  vtkPoints* points, const std::vector<CrossingPoint>& crossings, bool isPlaneXY);

/// Copies the point data, and appends the crossings' data, interpolated along the constraint of
/// lower index.
void interpolateCrossings(vtkPointData* from, vtkIdType points,
  const std::vector<CrossingPoint>& crossings, vtkPointData* to);

/// Adds the edges on constraints as lines, before the triangles, and the cell array "ConstraintId":
/// the cell of the source, or -1 for triangles.
void addConstraintLines(const ResolvedConstraints& constraints,
  const std::vector<std::int64_t>& sourceCells, vtkPolyData* output);

///@{
/// Packs a data set into a message, and unpacks one that is not empty. Throws std::runtime_error on
/// failure.
Bytes packDataSet(vtkPolyData* data);
vtkSmartPointer<vtkPolyData> unpackDataSet(const Bytes& bytes);
///@}

/// A point of one of several data sets.
struct DataSetRow
{
  std::size_t Set;
  vtkIdType Row;
};

/// Copies rows of data sets in the order of `rows`. The result has the point arrays of all data
/// sets that have a row here, without global ids, and coordinates in double precision.
vtkSmartPointer<vtkPolyData> copyRows(
  const std::vector<vtkSmartPointer<vtkPointSet>>& from, const std::vector<DataSetRow>& rows);

} // namespace tipp

#endif
