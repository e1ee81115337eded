// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/DelaunayArguments.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"

#include <fmt/format.h>

#include <charconv>
#include <stdexcept>

namespace tipp
{
namespace
{

std::optional<std::int64_t> parseCount(const std::string& text)
{
  std::int64_t count = 0;
  const char* const end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, count);
  return parsed.ec == std::errc() && parsed.ptr == end && count >= 1 ? std::make_optional(count)
                                                                     : std::nullopt;
}

} // namespace

std::optional<GridSize> parseGrid(const std::string& text)
{
  if (text == "auto")
  {
    return GridSize{};
  }
  constexpr int limit = 10000;
  GridSize grid;
  const char* const end = text.data() + text.size();
  const auto columns = std::from_chars(text.data(), end, grid.Columns);
  if (columns.ec != std::errc() || columns.ptr == end || *columns.ptr != 'x')
  {
    return std::nullopt;
  }
  const auto rows = std::from_chars(columns.ptr + 1, end, grid.Rows);
  const bool good = rows.ec == std::errc() && rows.ptr == end && grid.Columns >= 1 &&
    grid.Columns <= limit && grid.Rows >= 1 && grid.Rows <= limit;
  return good ? std::make_optional(grid) : std::nullopt;
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
  const std::optional<std::int64_t> threshold = parseCount(text.substr(colon + 1));
  if (!threshold || (kind != "auto" && kind != "tree"))
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
  return notFinite > 0 ? fmt::format(", {} left out, since an end is not finite", notFinite) : "";
}

std::string describe(const ResolvedConstraints& resolved, std::size_t constraints)
{
  return fmt::format("{} constraints of {} edges, {} crossings{}", constraints,
    resolved.Pieces.size(), resolved.Crossings.size(), describeLeftOut(resolved.NotFinite));
}

} // namespace

std::string describeSegments(const ConstrainedPoints::Figures& figures)
{
  return fmt::format("{} constraints of {} segments, {} crossings{}", figures.Constraints,
    figures.Segments, figures.Crossings, describeLeftOut(figures.NotFinite));
}

std::string describeAdded(std::int64_t points, const DelaunayArguments& arguments)
{
  return fmt::format("it adds {} points to those of {}, which an output named .npy does not hold; "
                     "name it .vtp or .vtu.",
    points, arguments.Input);
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

} // namespace tipp
