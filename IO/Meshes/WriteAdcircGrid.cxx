// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes/MeshFiles.h"

#include "Adcirc/AdcircGrid.h"
#include "Files/IOError.h"
#include "Files/OutputFile.h"
#include "Files/PendingOutput.h"
#include "Files/TextFile.h"
#include "Points/ReadPoints.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace tipp
{

namespace
{

constexpr const char* noBoundaries = "0 = number of open boundaries\n"
                                     "0 = total number of open boundary nodes\n"
                                     "0 = number of land boundaries\n"
                                     "0 = total number of land boundary nodes\n";

void append(std::string& line, double value)
{
  char text[32];
  line += ' ';
  line.append(text, std::to_chars(text, text + sizeof text, value).ptr);
}

std::vector<double> depthsOf(const PointTable& points)
{
  const std::vector<std::string> names = points.names();
  const auto depth = std::find_if(
    names.begin(), names.end(), [](const std::string& name) { return lowerCase(name) == "depth"; });
  if (depth != names.end())
  {
    return points.Columns[std::size_t(depth - names.begin())].Values;
  }
  std::vector<double> depths(points.size(), 0);
  const std::size_t elevation = findElevation(names);
  if (elevation < names.size())
  {
    const std::vector<double>& z = points.Columns[elevation].Values;
    std::transform(z.begin(), z.end(), depths.begin(), [](double value) { return 0 - value; });
  }
  return depths;
}

/// The numbers of a grid's nodes, in the order of the file `path`, and of further nodes up to
/// `points`. Throws IOError if these would exceed 64 bits.
std::vector<std::int64_t> nodeNumbers(
  const std::string& path, const AdcircGrid& grid, std::size_t points)
{
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
  std::vector<std::int64_t> numbers(grid.IndexOf.size());
  std::int64_t last = numbers.empty() ? 0 : std::numeric_limits<std::int64_t>::min();
  for (const auto& [number, index] : grid.IndexOf)
  {
    numbers[std::size_t(index)] = number;
    last = std::max(last, number);
  }
  while (numbers.size() < points)
  {
    if (last == most)
    {
      throw IOError(path,
        "has the largest node number possible, so new nodes cannot be numbered; renumber its "
        "nodes.");
    }
    numbers.push_back(++last);
  }
  return numbers;
}

} // namespace

bool writeAdcircGrid(const std::string& path, const PointTable& points, TrianglesView triangles,
  const std::string& like, const std::optional<PathState>& before,
  const std::function<bool()>& aborted)
{
  AdcircGrid frame; // its title, node numbers and boundaries are written
  frame.Title = "Triangles made by tipp";
  if (!like.empty())
  {
    frame = readAdcircNodes(like);
  }
  const std::vector<std::int64_t> numbers = nodeNumbers(like, frame, points.size());
  const std::vector<double> depths = depthsOf(points);
  PendingFile pending(path, before);
  OutputStream out(pending.file());
  out << frame.Title << "\n" << triangles.size() << " " << points.size() << "\n";
  std::string line;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (!std::isfinite(points.XY[2 * i]) || !std::isfinite(points.XY[2 * i + 1]))
    {
      throw IOError(path,
        "cannot hold point " + std::to_string(i) +
          ", whose coordinates are not finite; remove it, or write .vtu.");
    }
    line = std::to_string(numbers[i]);
    append(line, points.XY[2 * i]);
    append(line, points.XY[2 * i + 1]);
    append(line, depths[i]);
    out << line << "\n";
  }
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    line = std::to_string(t + 1) + " 3";
    for (int corner = 0; corner < 3; ++corner)
    {
      line += ' ' + std::to_string(numbers[std::size_t(triangles.id(t, corner))]);
    }
    out << line << "\n";
  }
  out << (frame.Boundaries.empty() ? noBoundaries : frame.Boundaries);
  out.finish();
  if (aborted && aborted())
  {
    return false;
  }
  pending.commit();
  return true;
}

} // namespace tipp
