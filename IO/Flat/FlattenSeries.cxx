// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/FlatMesh.h"

#include "Series/StepReader.h"

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

/// An array that owns its values.
template <typename T>
FlatArray ownedArray(std::string name, Scalar type, std::vector<T> values, int components)
{
  const auto kept = std::make_shared<std::vector<T>>(std::move(values));
  const auto tuples = std::int64_t(kept->size()) / components;
  return { std::move(name), type, components, tuples, 0, kept->data(), kept };
}

/// What the array says of itself whose first component is a variable.
ArrayDescription descriptionOf(
  const MeshSeries& series, std::size_t first, const FlatArray& array, bool marksMissing)
{
  const SeriesVariable& variable = series.Variables[first];
  ArrayDescription description;
  description.LongName = variable.LongName;
  description.StandardName = variable.StandardName;
  description.Units = variable.Units;
  if (marksMissing && !std::isnan(variable.Mark))
  {
    description.Missing = variable.Mark;
  }
  bool isUsual = true;
  for (int i = 0; i < array.Components; ++i)
  {
    description.Components.push_back(series.Variables[first + std::size_t(i)].Name);
    isUsual = isUsual &&
      description.Components.back() == ArrayDescription().nameOf(array.Name, i, array.Components);
  }
  if (isUsual)
  {
    description.Components.clear();
  }
  return description;
}

/// The array of a variable, or of the vector whose components begin with it.
FlatArray arrayOf(MeshSeries& series, std::size_t first, std::int64_t tuples, bool marksMissing)
{
  const SeriesVariable& variable = series.Variables[first];
  int components = 1;
  while (!variable.Vector.empty() && first + std::size_t(components) < series.Variables.size() &&
    series.Variables[first + std::size_t(components)].Vector == variable.Vector)
  {
    ++components;
  }
  FlatArray array;
  array.Name = variable.Vector.empty() ? variable.Name : variable.Vector;
  array.Components = components;
  array.Tuples = tuples;
  array.Steps = variable.Varies ? std::int64_t(series.Times.size()) : 0;
  const auto reader = std::make_shared<StepReader>(series, first, components, marksMissing);
  array.Type = reader->type();
  array.StepValues = [reader](std::int64_t step) { return reader->read(std::size_t(step)); };
  return array;
}

} // namespace

FlatContent flattenSeries(MeshSeries& series, bool marksMissing)
{
  SeriesMesh mesh = series.readMesh();
  FlatContent content;
  content.Cells = std::move(mesh.Triangles);
  content.Points = ownedArray("points", Scalar::Float64, std::move(mesh.XY), 2);
  const auto cells = std::int64_t(content.Cells.size() / 3);
  for (std::size_t i = 0; i < series.Variables.size();)
  {
    const bool isOnCells = series.Variables[i].OnCells;
    FlatArray array = arrayOf(series, i, isOnCells ? cells : content.Points.Tuples, marksMissing);
    content.Description.add(array.Name, isOnCells, descriptionOf(series, i, array, marksMissing));
    i += std::size_t(array.Components);
    (isOnCells ? content.CellData : content.PointData).push_back(std::move(array));
  }
  if (!mesh.OriginalCells.empty())
  {
    content.CellData.push_back(
      ownedArray("OriginalCellId", Scalar::Int64, std::move(mesh.OriginalCells), 1));
  }
  content.Times = series.Times;
  content.Description.TimeUnits = series.TimeUnits;
  content.Description.Calendar = series.Calendar;
  content.Description.Crs = series.Crs;
  return content;
}

} // namespace tipp
