// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/FlatUgrid.h"

#include "Files/IOError.h"
#include "Series/VariableNames.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

namespace tipp
{
namespace
{

/// The values of an array at a step.
const char* valuesAt(const FlatArray& array, std::size_t step)
{
  if (array.StepValues)
  {
    return static_cast<const char*>(array.StepValues(std::int64_t(step)));
  }
  const std::size_t bytes =
    scalarSize(array.Type) * std::size_t(array.Tuples) * std::size_t(array.Components);
  return static_cast<const char*>(array.Values) + step * bytes;
}

/// Replaces a value that stands for none by NaN, if the numbers have one.
void removeMark(Scalar type, double mark, std::vector<char>& values)
{
  withScalar(type,
    [&](auto zero)
    {
      using T = decltype(zero);
      if constexpr (std::is_floating_point_v<T>)
      {
        auto* const begin = reinterpret_cast<T*>(values.data());
        std::replace(
          begin, begin + values.size() / sizeof(T), T(mark), std::numeric_limits<T>::quiet_NaN());
      }
    });
}

/// Copies one component of the values at a step; `missing` becomes NaN. The array must outlive the
/// result.
std::function<const void*(std::size_t)> readerOf(
  const FlatArray& array, int component, const std::optional<double>& missing = std::nullopt)
{
  if (array.Components == 1 && !missing)
  {
    return [&array](std::size_t step) { return valuesAt(array, step); };
  }
  const auto values = std::make_shared<std::vector<char>>();
  return [&array, component, values, missing](std::size_t step)
  {
    const std::size_t size = scalarSize(array.Type);
    const char* from = valuesAt(array, step) + std::size_t(component) * size;
    values->resize(std::size_t(array.Tuples) * size);
    for (std::size_t i = 0; i < std::size_t(array.Tuples); ++i)
    {
      std::memcpy(values->data() + i * size, from, size);
      from += std::size_t(array.Components) * size;
    }
    if (missing)
    {
      removeMark(array.Type, *missing, *values);
    }
    return static_cast<const void*>(values->data());
  };
}

void add(UgridContent& to, const FlatArray& array, bool onCells, const MeshDescription& description)
{
  const ArrayDescription described = description.arrayOf(array.Name, onCells);
  for (int i = 0; i < array.Components; ++i)
  {
    const std::string name = described.nameOf(array.Name, i, array.Components);
    to.Arrays.push_back(
      { freeName(to.Arrays, name), described.LongName, described.Units, array.Type, onCells,
        array.Steps > 0, readerOf(array, i, described.Missing), described.StandardName });
  }
}

/// Whether a point has a third coordinate other than 0.
bool haveHeights(const FlatArray& points)
{
  const auto read = readerOf(points, 2);
  bool isAny = false;
  withScalar(points.Type,
    [&](auto zero)
    {
      using T = decltype(zero);
      const auto* const heights = static_cast<const T*>(read(0));
      isAny = std::any_of(heights, heights + points.Tuples, [](T height) { return height != 0; });
    });
  return isAny;
}

} // namespace

UgridContent ugridOf(const FlatContent& content, const std::string& source)
{
  if (content.CellSize != 3)
  {
    throw IOError(source, "has tetrahedra, and UGRID files here are of triangles in the plane.");
  }
  UgridContent result;
  result.Source = source;
  result.Nodes = content.Points.Tuples;
  result.Triangles = std::int64_t(content.Cells.size() / 3);
  const FlatArray& points = content.Points;
  const char* const values = valuesAt(points, 0);
  const auto dimension = std::int64_t(points.Components);
  result.Node = [values, dimension, isFloat = points.Type == Scalar::Float32](std::int64_t node)
  {
    const auto at = [&](std::int64_t axis)
    {
      const std::int64_t index = node * dimension + axis;
      return isFloat ? double(reinterpret_cast<const float*>(values)[index])
                     : reinterpret_cast<const double*>(values)[index];
    };
    return Point2{ at(0), at(1) };
  };
  result.Corner = [&content](std::int64_t triangle, int corner)
  { return content.Cells[3 * std::size_t(triangle) + std::size_t(corner)]; };
  for (const FlatArray& array : content.PointData)
  {
    add(result, array, false, content.Description);
  }
  if (dimension == 3 && haveHeights(points))
  {
    result.Arrays.push_back({ heightName(result.Arrays), "", "", points.Type, false, false,
      readerOf(content.Points, 2) });
  }
  for (const FlatArray& array : content.CellData)
  {
    add(result, array, true, content.Description);
  }
  result.Times = content.Times;
  result.TimeUnits = content.Description.TimeUnits;
  result.Calendar = content.Description.Calendar;
  result.Crs = content.Description.Crs;
  return result;
}

} // namespace tipp
