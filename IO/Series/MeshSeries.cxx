// SPDX-License-Identifier: BSD-3-Clause
#include "Series/MeshSeries.h"

#include "Files/IOError.h"

#include <algorithm>
#include <set>
#include <utility>

namespace tipp
{

SeriesNodes MeshSeries::readTriangles(const TakeTriangles& take)
{
  SeriesMesh mesh = this->readMesh();
  SeriesNodes nodes;
  nodes.add(mesh.XY);
  mesh.XY = {};
  take(nodes, { std::move(mesh.Triangles), 0, {} });
  return nodes;
}

void MeshSeries::readAt(std::size_t variable, std::size_t step, const std::vector<std::int32_t>& at,
  std::vector<double>& values)
{
  std::vector<double> all;
  this->read(variable, step, all);
  values.resize(at.size());
  std::transform(at.begin(), at.end(), values.begin(),
    [&all](std::int32_t index) { return all.at(std::size_t(index)); });
}

std::size_t findSeriesVariable(const MeshSeries& series, const std::string& name)
{
  const auto found = std::find_if(series.Variables.begin(), series.Variables.end(),
    [&](const SeriesVariable& variable) { return variable.Name == name; });
  if (found != series.Variables.end())
  {
    return std::size_t(found - series.Variables.begin());
  }
  for (const SeriesLeftOut& left : series.LeftOut)
  {
    if (left.Name == name)
    {
      throw IOError(
        series.Path, "'" + shownText(name) + "' " + left.Reason + ", so it cannot be used.");
    }
  }
  std::set<std::string> names;
  for (const SeriesVariable& variable : series.Variables)
  {
    names.insert(variable.Name);
  }
  throw IOError(series.Path,
    "has no variable '" + shownText(name) + "'" + listOfNames(names, "; there are ") + ".");
}

} // namespace tipp
