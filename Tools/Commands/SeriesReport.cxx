// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/SeriesReport.h"

#include "Files/IOError.h"
#include "Files/TemporaryPaths.h"
#include "Predicates/Geometry.h"
#include "Series/MeshSeries.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace tipp
{
namespace
{

void printMesh(const SeriesMesh& mesh)
{
  const auto& originals = mesh.OriginalCells;
  Box2 box = Box2::empty();
  for (std::size_t i = 0; i < mesh.XY.size(); i += 2)
  {
    box.extend(Point2{ mesh.XY[i], mesh.XY[i + 1] });
  }
  fmt::print("triangles   {}{}\n", mesh.Triangles.size() / 3,
    originals.empty() ? ""
                      : fmt::format(", cut from {} cells",
                          1 + *std::max_element(originals.begin(), originals.end())));
  fmt::print(
    "x           {} to {}\ny           {} to {}\n", box.Min.x, box.Max.x, box.Min.y, box.Max.y);
}

void printTimes(const MeshSeries& series)
{
  if (!series.Times.empty())
  {
    fmt::print("steps       {}, {} to {}{}{}\n", series.Times.size(), series.Times.front(),
      series.Times.back(), series.TimeUnits.empty() ? "" : " " + series.TimeUnits,
      series.Calendar.empty() ? "" : ", calendar " + series.Calendar);
  }
}

void printVariable(const SeriesVariable& variable)
{
  fmt::print("{:<11} {}{}{}{}\n", variable.Name, variable.OnCells ? "on cells" : "at nodes",
    variable.Varies ? ", varies" : "", variable.Units.empty() ? "" : ", in " + variable.Units,
    variable.LongName.empty() ? "" : ": " + variable.LongName);
}

} // namespace

void warnOfVariablesLeftOut(const std::string& path, const std::vector<SeriesLeftOut>& leftOut)
{
  for (const SeriesLeftOut& left : leftOut)
  {
    fmt::print(stderr, "tipp: warning: {}: {} {}.\n", shownPath(path), left.Name, left.Reason);
  }
}

void warnOfDescriptionLost(
  const std::string& path, const std::string& timeUnits, const std::string& crs)
{
  if (!timeUnits.empty())
  {
    fmt::print(stderr,
      "tipp: warning: {}: its times are '{}', and the output has the numbers alone.\n",
      shownPath(path), timeUnits);
  }
  if (!crs.empty())
  {
    fmt::print(stderr,
      "tipp: warning: {}: the output does not state the reference system, {}; give it again with "
      "--crs where it matters.\n",
      shownPath(path), crs);
  }
}

void describeSeries(MeshSeries& series)
{
  fmt::print("{}: {}, {} nodes\n", shownPath(series.Path), series.Kind, series.Nodes);
  try
  {
    printMesh(series.readMesh());
  }
  catch (const IOError& error) // what it has can be told all the same
  {
    fmt::print("check       {}\n", error.what());
  }
  printTimes(series);
  for (const SeriesVariable& variable : series.Variables)
  {
    printVariable(variable);
  }
  fmt::print("CRS         {}\n", series.Crs.empty() ? "not given" : series.Crs);
  for (const SeriesLeftOut& left : series.LeftOut)
  {
    fmt::print("left out    {} {}\n", left.Name, left.Reason);
  }
}

} // namespace tipp
