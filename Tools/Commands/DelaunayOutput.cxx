// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/DelaunayOutput.h"

#include "Adcirc/AdcircGrid.h"
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Console/Signals.h"
#include "Files/InputFile.h"
#include "Files/OutputPath.h"
#include "Files/PendingOutput.h"
#include "Meshes/MeshFiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace tipp
{
namespace
{

TrianglesView viewOf(const Triangulation& result)
{
  return result.Ids64.empty() ? TrianglesView(result.Ids32.data(), result.triangleCount())
                              : TrianglesView(result.Ids64.data(), result.triangleCount());
}

std::vector<std::int64_t> representatives(const Triangulation& result, std::size_t points)
{
  std::vector<std::int64_t> ids(points);
  std::iota(ids.begin(), ids.end(), std::int64_t(0));
  for (const Duplicate& duplicate : result.Duplicates)
  {
    ids[std::size_t(duplicate.Point)] = duplicate.Representative;
  }
  for (const PointId rejected : result.Rejected)
  {
    ids[std::size_t(rejected)] = -1;
  }
  return ids;
}

bool isAdcircFile(const std::string& path)
{
  const std::string extension = extensionOf(path);
  return extension == ".14" || extension == ".grd";
}

/// Boundaries are lists of nodes, which are there only where no point was left out.
void warnOfLostBoundaries(const DelaunayArguments& arguments)
{
  const std::string boundaries = readAdcircFrame(arguments.Input).Boundaries;
  constexpr std::ptrdiff_t linesOfNone = 4; // counts alone
  if (std::count(boundaries.begin(), boundaries.end(), '\n') > linesOfNone)
  {
    fmt::print(stderr,
      "tipp: warning: {} has none of the boundaries of {}, since --thin has left out some of its "
      "nodes.\n",
      arguments.Output, arguments.Input);
  }
}

} // namespace

bool holdsArrays(const std::string& path)
{
  return extensionOf(path) != ".npy" && !isAdcircFile(path);
}

PointTable readPointsFor(const DelaunayArguments& arguments)
{
  PointTable points = readPoints(arguments.Inputs, arguments.Columns);
  std::vector<std::string> names;
  for (const PointTable::Column& column : points.Columns)
  {
    names.push_back(column.Name);
  }
  requireElevation(arguments.Duplicates, names);
  if (extensionOf(arguments.Output) == ".npy")
  {
    points.Columns.clear(); // only .vtp and .vtu keep them
  }
  return points;
}

bool writeResult(const DelaunayArguments& arguments, const PointTable& points,
  const Triangulation& result, const PathState& before)
{
  MeshOptions options;
  options.Before = before;
  options.Aborted = isInterrupted;
  options.Neighbors = arguments.Neighbors;
  if (arguments.Inputs.size() == 1 && isAdcircFile(arguments.Input))
  {
    points.ThinnedOut == 0 ? void(options.AdcircLike = arguments.Input) : void();
    if (points.ThinnedOut > 0 && isAdcircFile(arguments.Output))
    {
      warnOfLostBoundaries(arguments);
    }
  }
  if (arguments.MapDuplicates)
  {
    options.Representatives = representatives(result, points.size());
  }
  return writeMesh(arguments.Output, points, viewOf(result), options);
}

PathState requireWritable(const DelaunayArguments& arguments)
{
  std::vector<std::string> inputs = arguments.Inputs;
  inputs.push_back(arguments.Constraints);
  inputs.push_back(arguments.Boundary);
  requireApart({ arguments.Output, arguments.Statistics }, inputs);
  const PendingFile output(arguments.Output);
  if (!arguments.Statistics.empty())
  {
    const PendingFile statistics(arguments.Statistics);
  }
  return output.before();
}

namespace
{

double pointsPerSecond(const DelaunayRun& run)
{
  return run.TriangulateSeconds > 0 ? double(run.Points) / run.TriangulateSeconds : 0;
}

nlohmann::ordered_json describeRun(const DelaunayRun& run)
{
  return {
    { "input", run.Input },
    { "output", run.Output },
    { "points", run.Points },
    { "disagreeing_places", run.DisagreeingPositions },
    { "read_seconds", run.ReadSeconds },
    { "triangulate_seconds", run.TriangulateSeconds },
    { "write_seconds", run.WriteSeconds },
    { "points_per_second", pointsPerSecond(run) },
    { "peak_memory_bytes", peakMemoryBytes() },
  };
}

} // namespace

std::string summarize(const DelaunayRun& run, const Triangulation& result)
{
  const std::string rejected =
    result.Rejected.empty() ? "" : fmt::format(", {} rejected", result.Rejected.size());
  return fmt::format("{} points, {} triangles, {}{}, {:.3f} s, {:.0f} points/s, peak "
                     "memory {:.0f} MB",
    run.Points, result.triangleCount(),
    describeDuplicates(std::int64_t(result.Duplicates.size()), run.DisagreeingPositions), rejected,
    run.TriangulateSeconds, pointsPerSecond(run), double(peakMemoryBytes()) / 1e6);
}

void writeStatistics(const std::string& path, const DelaunayRun& run, const Triangulation& result)
{
  nlohmann::ordered_json json = describeRun(run);
  json.update(jsonOf(statisticsOf(result, run.Points, std::int64_t(result.triangleCount()))));
  writeJson(path, json);
}

std::string summarize(
  const DelaunayRun& run, const Triangulation& all, const DistributedStatistics& statistics)
{
  return fmt::format("{}, {} ranks of {} threads", summarize(run, all), statistics.Ranks.size(),
    statistics.ThreadsPerRank);
}

void writeStatistics(
  const std::string& path, const DelaunayRun& run, const DistributedTriangulation& result)
{
  nlohmann::ordered_json json = describeRun(run);
  json.update(jsonOf(statisticsOf(result)));
  for (std::size_t i = 0; i < result.Statistics.Masters.size(); ++i)
  {
    json["masters"][i]["stages"] = jsonOf(stagesOf(result.Statistics.Masters[i].Stages));
  }
  writeJson(path, json);
}

} // namespace tipp
