// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes/TextMeshes.h"

#include "Arrays/ShortestText.h"
#include "Files/IOError.h"
#include "Files/TextFile.h"

#include <algorithm>
#include <cmath>

namespace tipp
{

void appendNumber(std::string& line, double value)
{
  NumberText text;
  line += ' ';
  line.append(text.data(), writeShortest(text, value));
}

void appendNode(std::string& line, const PointTable& points, std::size_t node, double third)
{
  appendNumber(line, points.XY[2 * node]);
  appendNumber(line, points.XY[2 * node + 1]);
  appendNumber(line, third);
}

bool finishMesh(OutputStream& out, PendingFile& pending, const MeshOptions& options)
{
  out.finish();
  if (options.Aborted && options.Aborted())
  {
    return false;
  }
  pending.commit();
  return true;
}

void requireFinite(const std::string& path, const PointTable& points)
{
  const auto found = std::find_if(
    points.XY.begin(), points.XY.end(), [](double value) { return !std::isfinite(value); });
  if (found != points.XY.end())
  {
    throw IOError(path,
      "cannot hold point " + std::to_string((found - points.XY.begin()) / 2) +
        ", whose coordinates are not finite; remove it, or write .vtu.");
  }
}

namespace
{

/// The first of two values that the table has, the second one negated; else zeros. `first` and
/// `second` are indices of columns, or the number of columns.
std::vector<double> valuesOrNegated(const PointTable& points, std::size_t first, std::size_t second)
{
  if (first < points.Columns.size())
  {
    return points.Columns[first].Values;
  }
  std::vector<double> values(points.size(), 0);
  if (second < points.Columns.size())
  {
    const std::vector<double>& from = points.Columns[second].Values;
    std::transform(
      from.begin(), from.end(), values.begin(), [](double value) { return 0 - value; });
  }
  return values;
}

std::size_t findDepth(const PointTable& points)
{
  const auto found = std::find_if(points.Columns.begin(), points.Columns.end(),
    [](const PointTable::Column& column) { return lowerCase(column.Name) == "depth"; });
  return std::size_t(found - points.Columns.begin());
}

} // namespace

std::vector<double> depthsOf(const PointTable& points)
{
  return valuesOrNegated(points, findDepth(points), findElevation(points.names()));
}

std::vector<double> elevationsOf(const PointTable& points)
{
  return valuesOrNegated(points, findElevation(points.names()), findDepth(points));
}

} // namespace tipp
