// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/DelaunayRuns.h"

#include "Adcirc/AdcircGrid.h"
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Console/Process.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/TextFile.h"
#include "Meshes/MeshFiles.h"
#include "Partitioning/MeshTiling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>

namespace tipp
{
std::optional<GridSize> parseGrid(const std::string& text)
{
  if (text == "auto")
  {
    return GridSize{};
  }
  const std::optional<TilingChoice> choice = TilingChoice::parse("grid:" + text);
  const bool isFlat = std::count(text.begin(), text.end(), 'x') == 1; // has no layers
  return choice && isFlat ? std::make_optional(GridSize{ choice->Boxes[0], choice->Boxes[1] })
                          : std::nullopt;
}

std::optional<MinorChoice> parseMinor(const std::string& text)
{
  MinorChoice choice;
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos)
  {
    const std::optional<GridSize> grid = parseGrid(text);
    if (!grid)
    {
      return std::nullopt;
    }
    choice.Grid = *grid;
    choice.Kind = grid->isGiven() ? Division::Grid : Division::Tree;
    return choice;
  }
  const std::string kind = text.substr(0, colon);
  const auto threshold = wholeNumber<std::int64_t>(text.substr(colon + 1));
  if (!threshold || *threshold < 1 || (kind != "auto" && kind != "tree"))
  {
    return std::nullopt;
  }
  choice.Kind = kind == "auto" ? Division::Threshold : Division::Tree;
  choice.Threshold = *threshold;
  return choice;
}

DistributedOptions makeDistributedOptions(const DelaunayArguments& arguments)
{
  DistributedOptions options;
  options.Design = arguments.Masters == "single" ? Masters::Single
    : arguments.Masters == "multi"               ? Masters::Multi
                                                 : Masters::Auto;
  options.Order = arguments.Order == "stages" ? RankSchedule::Stages
    : arguments.Order == "producer-consumer"  ? RankSchedule::ProducerConsumer
                                              : RankSchedule::Dynamic;
  options.Groups = arguments.Groups == "equal" ? GroupSizes::Equal : GroupSizes::Proportional;
  options.Major = *parseGrid(arguments.Major);
  const MinorChoice minor = *parseMinor(arguments.Minor);
  options.MinorDivision = minor.Kind;
  options.Minor = minor.Grid;
  options.Threshold = minor.Threshold;
  const GridSize partitions = *parseGrid(arguments.Partitions);
  if (partitions.isGiven() && !arguments.isForRanks())
  {
    options.MinorDivision = Division::Grid;
    options.Minor = partitions;
  }
  options.InitialPointsPerPartition = arguments.InitialPoints;
  options.Threads = arguments.Threads;
  return options;
}

namespace
{

std::string describeLeftOut(std::int64_t notFinite)
{
  return notFinite > 0 ? fmt::format(", {} left out because an end is not finite", notFinite) : "";
}

std::string describe(const ResolvedConstraints& resolved, std::size_t constraints)
{
  return fmt::format("{} constraints of {} edges, {} crossings{}", constraints,
    resolved.Pieces.size(), resolved.Crossings.size(), describeLeftOut(resolved.NotFinite));
}

} // namespace

std::string describeSegments(const ConstraintFigures& figures)
{
  return fmt::format("{} constraints of {} segments, {} crossings{}", figures.Constraints,
    figures.Segments, figures.Crossings, describeLeftOut(figures.NotFinite));
}

std::string describeAdded(std::int64_t points, const DelaunayArguments& arguments)
{
  return fmt::format("it adds {} points to those of {}, which an .npy output does not store; name "
                     "the output .vtp or .vtu.",
    points, arguments.Inputs.front());
}

Triangulation triangulateWithConstraints(const DelaunayArguments& arguments, PointTable& points,
  const TriangulationOptions& options, std::string& report)
{
  const TableConstraints constraints = readConstraints(arguments.Constraints);
  const std::size_t given = points.size();
  try
  {
    ConstrainedTriangulation result = triangulateTable(points, constraints, options);
    if (result.Mesh.Aborted)
    {
      return std::move(result.Mesh);
    }
    if (points.size() > given && extensionOf(arguments.Output) == ".npy")
    {
      throw std::invalid_argument(describeAdded(std::int64_t(points.size() - given), arguments));
    }
    report = describe(
      result.Constraints, constraints.Lines.Edges.size() + constraints.Boundary.Edges.size());
    return std::move(result.Mesh);
  }
  catch (const std::invalid_argument& error)
  {
    throw IOError(arguments.Constraints.name(), error.what());
  }
}

namespace
{

TrianglesView viewOf(const Triangulation& result)
{
  return result.Ids64.empty() ? TrianglesView(result.Ids32.data(), result.triangleCount())
                              : TrianglesView(result.Ids64.data(), result.triangleCount());
}

/// Warns if boundaries are lost: they are lists of nodes, and thinning has removed some of the
/// nodes.
void warnOfLostBoundaries(const DelaunayArguments& arguments)
{
  const std::string boundaries = readAdcircGrid(arguments.Inputs.front()).Boundaries;
  constexpr std::ptrdiff_t linesOfNone = 4; // a grid without boundaries has only the counts
  if (std::count(boundaries.begin(), boundaries.end(), '\n') > linesOfNone)
  {
    fmt::print(stderr,
      "tipp: warning: {} has none of the boundaries of {}, because --thin has left out some of its "
      "nodes.\n",
      arguments.Output, arguments.Inputs.front());
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
  requireElevation(arguments.Duplicates, points.names());
  if (extensionOf(arguments.Output) == ".npy")
  {
    points.Columns.clear(); // only .vtp and .vtu store the columns
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
  if (arguments.Inputs.size() == 1 && isAdcircFile(arguments.Inputs.front()))
  {
    if (points.ThinnedOut == 0)
    {
      options.AdcircLike = arguments.Inputs.front();
    }
    else if (isAdcircFile(arguments.Output))
    {
      warnOfLostBoundaries(arguments);
    }
  }
  if (arguments.MapDuplicates)
  {
    const auto ids = representativeIds(result, std::int64_t(points.size()));
    options.Representatives.assign(ids.begin(), ids.end());
  }
  return writeMesh(arguments.Output, points, viewOf(result), options);
}

PathState requireWritable(const DelaunayArguments& arguments)
{
  std::vector<std::string> inputs = arguments.Inputs;
  inputs.push_back(arguments.Constraints.Lines);
  inputs.push_back(arguments.Constraints.Boundary);
  return requireWritable(arguments.Output, arguments.Statistics, inputs);
}

void reportRun(const DelaunayArguments& arguments, const DelaunayRun& run,
  const nlohmann::ordered_json& statistics, const std::string& more)
{
  nlohmann::ordered_json json = {
    { "input", arguments.Inputs.front() },
    { "output", arguments.Output },
    { "points", run.Points },
    { "disagreeing_places", run.DisagreeingPositions },
    { "read_seconds", run.ReadSeconds },
    { "triangulate_seconds", run.TriangulateSeconds },
    { "write_seconds", run.WriteSeconds },
    { "points_per_second",
      run.TriangulateSeconds > 0 ? double(run.Points) / run.TriangulateSeconds : 0 },
    { "peak_memory_bytes", peakMemoryBytes() },
  };
  json.update(statistics);
  reportRun(arguments.Statistics, json, run.TriangulateSeconds, more);
}

} // namespace tipp
