// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippQueryArrays_h
#define tippQueryArrays_h

#include "Predicates/Points.h"
#include "Query/Around.h"

#include "vtkDataArray.h"
#include "vtkIdTypeArray.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace tipp
{

/// Returns `count` points. at(i, p) writes x, y and z of point i to p; z is 0 unless written.
template <typename At>
std::vector<Point3> collected(vtkIdType count, const At& at)
{
  std::vector<Point3> points;
  points.reserve(std::size_t(count));
  for (vtkIdType i = 0; i < count; ++i)
  {
    double p[3] = { 0, 0, 0 };
    at(i, p);
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

} // namespace tipp

#endif
