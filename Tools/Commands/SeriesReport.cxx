// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/SeriesReport.h"

#include "Files/IOError.h"
#include "Files/MeshDescription.h"
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

} // namespace

void printTimes(
  const std::vector<double>& times, const std::string& units, const std::string& calendar)
{
  if (!times.empty())
  {
    fmt::print("steps       {}, {} to {}{}{}\n", times.size(), times.front(), times.back(),
      units.empty() ? "" : " " + onOneLine(units),
      calendar.empty() ? "" : ", calendar " + onOneLine(calendar));
  }
}

void printArray(const std::string& name, const char* where, bool varies, const std::string& units,
  const std::string& longName)
{
  fmt::print("{:<11} {}{}{}{}\n", onOneLine(name), where, varies ? ", varies" : "",
    units.empty() ? "" : ", in " + onOneLine(units),
    longName.empty() ? "" : ": " + onOneLine(longName));
}

void warnOfVariablesLeftOut(const std::string& path, const std::vector<SeriesLeftOut>& leftOut)
{
  for (const SeriesLeftOut& left : leftOut)
  {
    fmt::print(stderr, "tipp: warning: {}: {} {}.\n", shownPath(path), left.Name, left.Reason);
  }
}

void warnOfMissingValues(const std::string& path, const MeshDescription& description,
  const std::vector<std::string>& chosen, const std::function<std::string(double missing)>& advice)
{
  for (const auto* const arrays : { &description.PointData, &description.CellData })
  {
    for (const auto& [name, array] : *arrays)
    {
      const bool isChosen =
        chosen.empty() || std::find(chosen.begin(), chosen.end(), name) != chosen.end();
      if (array.Missing && isChosen)
      {
        fmt::print(stderr,
          "tipp: warning: {}: '{}' has {} where it has no value, which counts as a number here; "
          "{}.\n",
          shownPath(path), shownText(name), *array.Missing, advice(*array.Missing));
      }
    }
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
  printTimes(series.Times, series.TimeUnits, series.Calendar);
  for (const SeriesVariable& variable : series.Variables)
  {
    printArray(variable.Name, variable.OnCells ? "on cells" : "at nodes", variable.Varies,
      variable.Units, variable.LongName);
  }
  fmt::print("CRS         {}\n", series.Crs.empty() ? "not given" : series.Crs);
  for (const SeriesLeftOut& left : series.LeftOut)
  {
    fmt::print("left out    {} {}\n", left.Name, left.Reason);
  }
}

} // namespace tipp
