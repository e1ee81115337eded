// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/TableConstraints.h"

#include "Files/IOError.h"
#include "Points/Longitudes.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <stdexcept>

namespace tipp
{

bool isHeightColumn(const std::string& name)
{
  return name == "z" || name == "Z" || name == "elevation";
}

TableConstraints readConstraints(const ConstraintFiles& files)
{
  TableConstraints constraints;
  if (!files.Lines.empty())
  {
    constraints.Lines = readConstraintFile(files.Lines, files.Wrap);
  }
  for (const auto& [x, y] : files.Holes)
  {
    constraints.Lines.Holes.insert(constraints.Lines.Holes.end(), { x, y });
  }
  wrapLongitudes(files.name(), files.Wrap, constraints.Lines.Holes);
  if (!files.Boundary.empty())
  {
    constraints.Boundary = readBoundary(files.Boundary, files.Wrap);
  }
  constraints.Crossings = files.Crossings;
  return constraints;
}

ConstraintTable readBoundary(const std::string& path, int wrap)
{
  ConstraintTable boundary = readConstraintFile(path, wrap);
  try
  {
    requireClosedBoundary(boundary);
  }
  catch (const std::invalid_argument& error)
  {
    throw IOError(path, error.what());
  }
  return boundary;
}

void requireClosedBoundary(const ConstraintTable& boundary)
{
  if (boundary.Edges.empty() || boundary.XY.empty())
  {
    throw std::invalid_argument(
      "it has no lines with coordinates, so it is no boundary; give closed lines or polygons.");
  }
  std::map<std::pair<double, double>, int> ends; // number of edges; odd ends are open
  for (const auto& edge : boundary.Edges)
  {
    for (const std::int64_t end : edge)
    {
      const auto at = 2 * std::size_t(end);
      ++ends[{ boundary.XY[at], boundary.XY[at + 1] }];
    }
  }
  const auto open =
    std::find_if(ends.begin(), ends.end(), [](const auto& end) { return end.second % 2 != 0; });
  if (open != ends.end())
  {
    std::ostringstream text;
    text << "the boundary is not closed: a line ends at (" << open->first.first << ", "
         << open->first.second << "); close it there.";
    throw std::invalid_argument(text.str());
  }
}

} // namespace tipp
