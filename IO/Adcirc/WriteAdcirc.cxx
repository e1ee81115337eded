// SPDX-License-Identifier: BSD-3-Clause
#include "Adcirc/WriteAdcirc.h"

#include "Adcirc/AdcircGrid.h"
#include "Files/IOError.h"
#include "Files/OutputStream.h"
#include "Files/PendingFile.h"
#include "Points/ElevationColumn.h"

#include <algorithm>
#include <charconv>
#include <cmath>
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
  std::vector<std::string> names;
  for (const PointTable::Column& column : points.Columns)
  {
    names.push_back(column.Name);
  }
  const auto depth = std::find(names.begin(), names.end(), "depth");
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

/// A grid without nodes that the file is like.
AdcircFrame frameFor(const std::string& like, std::size_t points)
{
  AdcircFrame frame;
  if (like.empty())
  {
    frame.Title = "Triangles made by tipp";
  }
  else
  {
    frame = readAdcircFrame(like);
  }
  if (frame.Boundaries.empty())
  {
    frame.Boundaries = noBoundaries;
  }
  std::int64_t last = frame.NodeNumbers.empty()
    ? 0
    : *std::max_element(frame.NodeNumbers.begin(), frame.NodeNumbers.end());
  while (frame.NodeNumbers.size() < points)
  {
    frame.NodeNumbers.push_back(++last);
  }
  return frame;
}

} // namespace

bool isAdcircExtension(const std::string& extension)
{
  return extension == ".14" || extension == ".grd";
}

bool writeAdcircGrid(const std::string& path, const PointTable& points, TrianglesView triangles,
  const std::string& like, const std::optional<PathState>& before,
  const std::function<bool()>& aborted)
{
  const AdcircFrame frame = frameFor(like, points.size());
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
    line = std::to_string(frame.NodeNumbers[i]);
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
      line += ' ' + std::to_string(frame.NodeNumbers[std::size_t(triangles.id(t, corner))]);
    }
    out << line << "\n";
  }
  out << frame.Boundaries;
  out.finish();
  if (aborted && aborted())
  {
    return false;
  }
  pending.commit();
  return true;
}

} // namespace tipp
