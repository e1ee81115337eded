// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippQueryData_h
#define tippQueryData_h

#include "Predicates/Geometry.h"
#include "Query/Queries.h"
#include "Query/RankAnswer.h"
#include "Resident/MeshPart.h"
#include "vtkTIPPFiltersModule.h"

#include "vtkDataArray.h"
#include "vtkIdTypeArray.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

class vtkDataObject;
class vtkDataSetAttributes;

namespace tipp
{

/// The tetrahedra or, if there are none, the triangles of a vtkPointSet with its arrays, for
/// queries. Other cells are divided into these; cells that vtkGhostType hides are left out. The
/// result shares the data set's memory where possible, and holds a reference to the data set.
/// If the data set has global ids of cells or points, the result has them, too. A composite data
/// set may have only one vtkPointSet with cells. If `data` is null or has no cells, the mesh is
/// empty. Throws std::runtime_error, with one sentence, if the data cannot be used.
VTKTIPPFILTERS_EXPORT MeshPart partOf(vtkDataObject* data, int threads);

/// Returns `count` points. positionAt(i, p) writes x, y and z of point i to p; z is 0 unless
/// written.
template <typename PositionAt>
std::vector<Point3> collected(vtkIdType count, const PositionAt& positionAt)
{
  std::vector<Point3> points;
  points.reserve(std::size_t(count));
  for (vtkIdType i = 0; i < count; ++i)
  {
    double p[3] = { 0, 0, 0 };
    positionAt(i, p);
    points.push_back({ p[0], p[1], p[2] });
  }
  return points;
}

/// The points of an array of (x, y) or (x, y, z); z is 0 where it is missing. Throws
/// std::runtime_error for another number of components, or if the array is null.
inline std::vector<Point3> pointsOf(vtkDataArray* array)
{
  const int components = array ? array->GetNumberOfComponents() : 0;
  if (components != 2 && components != 3)
  {
    throw std::runtime_error("points have two or three coordinates, but the array has " +
      std::to_string(components) + " components.");
  }
  return collected(
    array->GetNumberOfTuples(), [array](vtkIdType i, double* p) { array->GetTuple(i, p); });
}

/// Replaces the array's content by the values, `components` per tuple. Does nothing if the array is
/// null.
template <typename Array, typename Value>
void copyTo(Array* array, const std::vector<Value>& values, int components = 1)
{
  if (array)
  {
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(vtkIdType(values.size()) / components);
    std::copy(values.begin(), values.end(), array->GetPointer(0));
    array->Modified();
  }
}

/// An array with a name and these values.
template <typename Array, typename Value>
vtkSmartPointer<Array> arrayOf(const char* name, const std::vector<Value>& values)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  copyTo(array.Get(), values);
  return array;
}

/// Copies both parts of the lists. A null array is left out.
inline void copyTo(vtkIdTypeArray* starts, vtkIdTypeArray* ids, const IdLists& lists)
{
  copyTo(starts, lists.Starts);
  copyTo(ids, lists.Ids);
}

/// The ids of an array, in order. Throws std::runtime_error if the array is null.
inline std::vector<std::int64_t> idsOf(vtkIdTypeArray* array)
{
  if (!array)
  {
    throw std::runtime_error("there is no array of ids.");
  }
  return { array->GetPointer(0), array->GetPointer(0) + array->GetNumberOfValues() };
}

/// Creates a closed polyline for each loop. The points have their ids as VTK's global ids, in the
/// array "GlobalPointIds".
VTKTIPPFILTERS_EXPORT vtkSmartPointer<vtkPolyData> polyDataOf(const BoundaryLoops& loops);

/// Creates a polyline for each contour line, with the cell array `name` of its level.
VTKTIPPFILTERS_EXPORT vtkSmartPointer<vtkPolyData> polyDataOf(
  const Contours& contours, const std::string& name);

/// Creates a polyline for each descent that has points. Cell arrays are "StartId", the descent's
/// index, and "PitId"; the point array `name` has the values.
VTKTIPPFILTERS_EXPORT vtkSmartPointer<vtkPolyData> polyDataOf(
  const Descents& descents, const std::string& name);

/// Creates one polyline with the point arrays "Distance", "CellId" and the arrays of the profile,
/// whose memory is moved into the result.
VTKTIPPFILTERS_EXPORT vtkSmartPointer<vtkPolyData> polyDataOf(Profile&& profile);

/// Creates a vertex for each point, with the arrays of the answer, "CellId", "AskingRank" and
/// "AskingId". The memory of the answer's arrays is moved into the result.
VTKTIPPFILTERS_EXPORT vtkSmartPointer<vtkPolyData> polyDataOf(StayingAnswer&& answer);

/// Adds the answer's arrays to `to`, which takes the ownership of their memory, without a copy.
/// Floating-point values of points outside of the mesh become `null`.
void moveArrays(MeshAnswer& answer, vtkDataSetAttributes* to,
  double null = std::numeric_limits<double>::quiet_NaN());

} // namespace tipp

#endif
