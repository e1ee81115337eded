// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"
#include "Commands/MadeMesh.h"
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Console/Process.h"
#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/PagedMemory.h"
#include "Files/RequireApart.h"
#include "Files/TextFile.h"
#include "Meshes/MeshFiles.h"
#include "Parallel/Stopwatch.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

namespace tipp
{
namespace
{

/// The triangles that are not as asked, and why.
nlohmann::ordered_json listOutside(const RefinedMesh& mesh, double angle, bool isThin)
{
  constexpr double rounding = 1e-6; // of an angle, in degrees
  const auto textOf = [](TriangleOutside::Reason reason)
  {
    switch (reason)
    {
      case TriangleOutside::Reason::InputAngle:
        return "input angle";
      case TriangleOutside::Reason::ShortestEdge:
        return "shortest edge";
      case TriangleOutside::Reason::KeptSegments:
        return "kept segments";
      case TriangleOutside::Reason::MostPoints:
        break;
    }
    return "most points";
  };
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const TriangleOutside& outside : mesh.Outside)
  {
    if ((outside.Angle < angle + rounding) == isThin)
    {
      list.push_back({ { "triangle", outside.Triangle }, { "angle", outside.Angle },
        { "area", outside.Area }, { "reason", textOf(outside.Why) } });
    }
  }
  return list;
}

/// Prints a summary. `json`: the statistics.
void printFigures(const MeshArguments& arguments, const MadeMesh& made,
  const nlohmann::ordered_json& json, double seconds)
{
  fmt::print("{} points, {} in {:.3f} s, peak memory {:.1f} MB\n", made.nodeCount(),
    counted(std::int64_t(made.Triangles.size() / 3), "triangle", "triangles"), seconds,
    double(peakMemoryBytes()) / 1e6);
  const auto thin = std::int64_t(json["below_bound"].size());
  const auto large = std::int64_t(json["above_area"].size());
  if (thin > 0)
  {
    const auto forced = std::count_if(made.Refined.Outside.begin(), made.Refined.Outside.end(),
      [](const TriangleOutside& outside)
      { return outside.Why == TriangleOutside::Reason::InputAngle; });
    fmt::print(
      "{} an angle below {:g} degrees, {} of them because segments of the input meet below 60\n",
      counted(thin, "triangle has", "triangles have"), arguments.MinimumAngle, forced);
  }
  if (large > 0)
  {
    fmt::print("{} larger than asked\n", counted(large, "triangle is", "triangles are"));
  }
}

/// Writes the statistics and prints a summary. Throws IOError.
void report(const MeshArguments& arguments, const MadeMesh& made, double seconds)
{
  const RefinementStatistics& figures = made.Refined.Statistics;
  const auto triangles = std::int64_t(made.Triangles.size() / 3);
  nlohmann::ordered_json json = { { "input", arguments.Constraints.name() },
    { "output", arguments.Output }, { "points", made.nodeCount() }, { "triangles", triangles },
    { "points_given", made.GivenPoints }, { "points_left_out", made.LeftOut },
    { "points_added", figures.Inserted }, { "segment_splits", figures.Splits },
    { "levels", figures.Levels }, { "rounds", figures.Rounds }, { "blocks", figures.Blocks },
    { "moves", figures.Moves }, { "bandwidth", made.Bandwidth }, { "mesh_seconds", seconds },
    { "peak_memory_bytes", peakMemoryBytes() } };
  if (made.Depths)
  {
    json["depths"] = { { "from_cells", made.Depths->FromCells },
      { "at_nodes", made.Depths->AtNodes }, { "from_others", made.Depths->FromOthers },
      { "missing", made.Depths->Missing } };
  }
  json["below_bound"] = listOutside(made.Refined, arguments.MinimumAngle, true);
  json["above_area"] = listOutside(made.Refined, arguments.MinimumAngle, false);
  if (!arguments.Statistics.empty())
  {
    writeJson(arguments.Statistics, json);
  }
  printFigures(arguments, made, json, seconds);
}

/// Whether --size is a number, not a file.
bool isNumber(const std::string& size)
{
  return wholeNumber<double>(size).has_value();
}

/// Throws IOError if the .poly file beside an output of Triangle's is there without a .node file:
/// it is a graph that a user has written, and no part of a mesh.
void requireNoOtherGraph(const MeshArguments& arguments)
{
  if (arguments.OutputIs != Opener::Triangle)
  {
    return;
  }
  namespace fs = std::filesystem;
  std::error_code ignored;
  const fs::path graph = fs::path(arguments.Output).replace_extension(".poly");
  if (fs::exists(graph, ignored) &&
    !fs::exists(fs::path(arguments.Output).replace_extension(".node"), ignored))
  {
    throw IOError(graph.string(),
      fmt::format("would be replaced by the segments of {}; give the output another name.",
        arguments.Output));
  }
}

/// Throws IOError unless the output files can be written and differ from the inputs: also the .ele
/// and .poly files that belong to a .node file. Returns the state of the output's path.
PathState requireOutputs(const MeshArguments& arguments)
{
  std::vector<std::string> named = arguments.Points;
  named.insert(named.end(),
    { arguments.Constraints.Lines, arguments.Constraints.Boundary, arguments.Sizes.Depth,
      isNumber(arguments.Sizes.Size) ? "" : arguments.Sizes.Size, arguments.OpenPolygon,
      arguments.RegionFile });
  const std::vector<std::string> inputs = filesOfMeshes(named);
  std::vector<std::string> outputs = filesOfMesh(arguments.Output, true);
  outputs.push_back(arguments.Statistics);
  requireApart(outputs, inputs);
  requireNoOtherGraph(arguments);
  return requireWritable(arguments.Output, arguments.Statistics, inputs);
}

/// Returns where the mesh is if --memory is given; otherwise null. Throws IOError.
std::unique_ptr<PagedMemory> memoryOf(const MeshArguments& arguments)
{
  if (arguments.Memory.empty())
  {
    return nullptr;
  }
  const std::string folder = arguments.Scratch.empty()
    ? std::filesystem::path(arguments.Output).parent_path().string()
    : arguments.Scratch;
  return std::make_unique<PagedMemory>(
    folder, *parseMemorySize(arguments.Memory), "name another folder by --scratch");
}

int runMesh(const MeshArguments& arguments)
{
  const PathState before = requireOutputs(arguments);
  const std::unique_ptr<PagedMemory> memory = memoryOf(arguments);
  MadeMesh made;
  Stopwatch watch;
  if (!makeMesh(arguments, memory.get(), made) || isInterrupted())
  {
    return reportInterrupt();
  }
  completeMesh(arguments, memory.get(), made);
  const double seconds = watch.restart();
  if (isInterrupted() || !writeMade(arguments, made, before))
  {
    return reportInterrupt();
  }
  report(arguments, made, seconds);
  return Success;
}

/// Throws CLI::ValidationError for options of sizes that would have no effect or lack another one.
void requireFittingSizes(const MeshArguments& arguments)
{
  const SizeArguments& sizes = arguments.Sizes;
  const auto needsSize = [&arguments](bool isGiven, const char* option)
  {
    refuseIf(
      isGiven && !arguments.hasSizes(), option, "needs a size: --size, --dis, --wl or --slp");
  };
  needsSize(sizes.Least.has_value(), "--min-size");
  needsSize(sizes.Largest.has_value(), "--max-size");
  needsSize(sizes.Gradation.has_value(), "--g");
  needsSize(sizes.Geographic, "--geographic");
  refuseIf(!sizes.Column.empty() && (sizes.Size.empty() || isNumber(sizes.Size)), "--size-column",
    "needs --size with a file");
  refuseIf(sizes.Dis && !sizes.Least, "--dis", "needs --min-size, the size at the shoreline");
  refuseIf(sizes.WaveLength && sizes.Depth.empty(), "--wl", "needs --depth");
  refuseIf(sizes.Slope && sizes.Depth.empty(), "--slp", "needs --depth");
  refuseIf(sizes.Slope && !(sizes.Least && sizes.Largest), "--slp",
    "needs --min-size and --max-size, because a level bottom allows any size");
  refuseIf(sizes.Least && sizes.Largest && *sizes.Least > *sizes.Largest, "--min-size",
    "must not be above --max-size");
}

/// Throws CLI::ValidationError for --memory without --keep-order, and --scratch without --memory.
void requireFittingMemory(const MeshArguments& arguments)
{
  refuseIf(!arguments.Scratch.empty() && arguments.Memory.empty(), "--scratch", "needs --memory");
  refuseIf(!arguments.Memory.empty() && !arguments.KeepOrder, "--memory",
    "needs --keep-order, because to renumber the nodes the whole mesh must be in memory");
}

/// Throws CLI::ValidationError for options that would have no effect or contradict each other.
void requireFitting(const MeshArguments& arguments)
{
  refuseIf(arguments.OutputIs == Opener::Npy, "--output",
    "must not be .npy, which does not store the points that are added");
  refuseIf(arguments.KeepBorder && arguments.KeepSegments, "--keep-border",
    "has no effect beside --keep-segments, which also keeps the border");
  requireFittingSizes(arguments);
  requireFittingMemory(arguments);
  const bool hasDepths = !arguments.Sizes.Depth.empty();
  refuseIf(arguments.OpenDepth && !hasDepths, "--open-deeper", "needs --depth");
  refuseIf(arguments.OpenDepth && !arguments.OpenPolygon.empty(), "--open-deeper",
    "cannot be combined with --open");
  refuseIf(arguments.isOpen() && !arguments.hasBoundaryLists(),
    arguments.OpenDepth ? "--open-deeper" : "--open",
    "needs an output named .14, .grd or .gr3, which lists boundaries");
  refuseIf(arguments.DepthsAtNodes && !hasDepths, "--depth-at-nodes", "needs --depth");
  refuseIf(arguments.DepthsAtNodes && !arguments.depthsAreRaster(), "--depth-at-nodes",
    "needs --depth with a raster");
  refuseIf(arguments.Sizes.RasterBounds && !isOpenedBy(arguments.Sizes.Depth, Opener::Npy) &&
      !isOpenedBy(arguments.Sizes.Size, Opener::Npy),
    "--npy-bounds", "needs --size or --depth with an .npy file");
  refuseIf(arguments.Sizes.DepthIsElevation && !hasDepths, "--positive-up", "needs --depth");
  refuseIf(!arguments.Sizes.DepthColumn.empty() && !hasDepths, "--depth-column", "needs --depth");
}

/// Validates a finite number on the command line: returns an error message, or an empty text.
std::string checkFinite(const std::string& text)
{
  const auto value = wholeNumber<double>(text);
  return value && std::isfinite(*value) ? "" : "'" + text + "' is not a number";
}

/// Validates --size on the command line: a path, or a number above 0.
std::string checkSize(const std::string& text)
{
  return isNumber(text) ? checkPositive(text) : std::string();
}

void addShape(CLI::App& command, MeshArguments& arguments)
{
  addChecked(command, "--min-angle", arguments.MinimumAngle,
    CLI::Range(0.0, RefinementOptions::LargestAngle),
    "The smallest angle, in degrees: up to 20.7 proved to end, up to 33 tried");
  command
    .add_option("--max-area", arguments.LargestArea,
      "The largest area of a triangle, in the square of the input's unit")
    ->check(checkPositive);
  command
    .add_option("--region", arguments.Regions,
      "x and y of a point and the largest area of triangles (inf: no further limit) in its part of "
      "the domain, up to the segments around it; may be given several times")
    ->allow_extra_args(false);
  command.add_option("--regions", arguments.RegionFile,
    "A file of such points, after those of --region: a .poly file with areas of regions, or points "
    "with a column area or size");
  command
    .add_option("--hole", arguments.Constraints.Holes,
      "x and y of a point in a hole: there are no triangles up to the segments around it; may be "
      "given several times")
    ->allow_extra_args(false);
  command.add_flag("--convex", arguments.Convex,
    "Mesh the convex hull; otherwise what polygons contain or, without polygons, what lines "
    "enclose");
  command
    .add_option("--min-edge", arguments.ShortestEdge,
      "Make no edge shorter than this; --stats lists what this leaves (default: 2^-36 of the "
      "domain)")
    ->check(checkPositive);
  command.add_option("--max-points", arguments.MostPoints, "Add at most so many points")
    ->check(CLI::PositiveNumber);
  command
    .add_option("--smooth", arguments.SmoothingRounds,
      "Move added points inside the domain towards the mean of their neighbours, where angles grow "
      "and all bounds hold: the number of rounds, or 5 without a number")
    ->expected(0, 1)
    ->default_str("5")
    ->check(CLI::PositiveNumber);
  command.add_flag("--keep-border", arguments.KeepBorder, "Add no points on the border");
  command.add_flag("--keep-segments", arguments.KeepSegments, "Add no points on any segment");
}

void addSizes(CLI::App& command, SizeArguments& sizes)
{
  command
    .add_option("--size", sizes.Size,
      "Length of edges: a number, or a file with lengths: a raster, a mesh or points")
    ->check(checkSize);
  command.add_option("--size-column", sizes.Column, "The column or array of the file of --size");
  command
    .add_option("--dis", sizes.Dis,
      "Let sizes grow by so much per unit of distance from the shoreline, from --min-size on")
    ->check(checkPositive);
  command
    .add_option("--wl", sizes.WaveLength,
      "At least so many edges to a wavelength of the M2 tide; needs --depth")
    ->check(checkPositive);
  command
    .add_option("--slp", sizes.Slope,
      "Let sizes be at most 2 pi depth / (so much x the slope of the bottom); needs --depth")
    ->check(checkPositive);
  command.add_option("--min-size", sizes.Least, "The smallest size")->check(checkPositive);
  command.add_option("--max-size,--max-el", sizes.Largest, "The largest size")
    ->check(checkPositive);
  command
    .add_option("--g,--grade", sizes.Gradation,
      "Let sizes at two places differ by at most so much per unit of distance")
    ->check(checkPositive);
  command.add_flag("--geographic", sizes.Geographic,
    "x and y are degrees of longitude and latitude; sizes are metres, but areas square degrees");
}

void addModel(CLI::App& command, MeshArguments& arguments)
{
  command.add_option("--depth", arguments.Sizes.Depth,
    "A file with depths, of the nodes and for --wl and --slp: a raster or points");
  command.add_option("--depth-column", arguments.Sizes.DepthColumn,
    "The column of the points of --depth (default: depth, or z with --positive-up)");
  command.add_flag("--positive-up", arguments.Sizes.DepthIsElevation,
    "The values of --depth are elevations, positive upwards");
  addBoxOption(command, "--npy-bounds", arguments.Sizes.RasterBounds,
    "The .npy files of --size and --depth are rasters, the lowest row first, with these outer "
    "borders: xmin xmax ymin ymax");
  command.add_flag("--depth-at-nodes", arguments.DepthsAtNodes,
    "Interpolate a raster at the nodes; otherwise a node gets the mean over its cell");
  command.add_option(
    "--open", arguments.OpenPolygon, "A file with polygons: border nodes inside are open boundary");
  command
    .add_option(
      "--open-deeper", arguments.OpenDepth, "Border nodes deeper than this are open boundary")
    ->check(checkFinite);
  command.add_flag("--keep-order", arguments.KeepOrder,
    "Leave the nodes in order, the input's first; otherwise they are renumbered for a low "
    "bandwidth");
}

void addOptions(CLI::App& command, MeshArguments& arguments)
{
  command.add_option("input", arguments.Constraints.Lines, "Lines and polygons, see INPUT below")
    ->required();
  addOutput(command, arguments.Output, "The mesh", Use::WritesTriangles);
  command
    .add_option("--points", arguments.Points,
      "A file of points that must be vertices where they are in the domain; may be given several "
      "times")
    ->allow_extra_args(false);
  command.add_option(
    "--boundary", arguments.Constraints.Boundary, "A file of closed lines: the domain is inside");
  addShape(command, arguments);
  addSizes(command, arguments.Sizes);
  addModel(command, arguments);
  addCurveOption(command);
  command
    .add_option("--memory", arguments.Memory,
      "A memory limit, such as 1G: the mesh is in temporary files, and may be larger than memory")
    ->check(checkRunMemory);
  command.add_option("--scratch", arguments.Scratch,
    "With --memory: a folder for temporary files (default: that of the output)");
  addThreadsOption(command, arguments.Threads);
  command.add_option("--stats", arguments.Statistics,
    "Write figures and the triangles below the bounds to a JSON file");
}

constexpr const char* footer =
  R"(INPUT   .poly (Triangle); .csv, .txt (a segment per line: x and y of both ends); .14,
        .grd, .gr3 (the boundaries of a grid); files of a GIS such as .shp, .gpkg,
        .geojson; any VTK file: lines and polygons. Counter-clockwise polygons are
        the domain, clockwise ones are holes.
OUTPUT  .14, .grd (ADCIRC), .gr3 (SCHISM), .2dm (SMS), .msh (Gmsh), .node with .ele and
        .poly (Triangle), .nc (NetCDF by UGRID), .vtu or .vtp.

The mesh is a constrained Delaunay triangulation that keeps every segment. No angle is
below --min-angle, and no triangle larger than the limits allow: a size h allows the
area of the equilateral triangle with edge h. Where segments meet below 60 degrees,
smaller angles are left; --stats lists each with its reason, and 'tipp check --quality'
proves the rest. The result does not depend on the number of threads, nor on --memory.
With it, the mesh may be larger than memory; it needs --keep-order.

Examples:
  tipp mesh lake.shp -o lake.vtu --max-area 500
  tipp mesh coast.gpkg -o coast.14 --min-size 200 --dis 0.15 --max-size 5000
  tipp mesh bay.shp -o fort.14 --size 100 --depth dem.tif --positive-up --open sea.shp
  tipp mesh coast.gpkg -o coast.vtu --size 20 --keep-order --memory 2G
  tipp mesh part.poly -o fine.node --min-angle 33 --stats fine.json
  tipp check fine.node --quality 33 --constraints part.poly --listed fine.json
)";

int run(MeshArguments& arguments)
{
  arguments.OutputIs = openerOf(arguments.Output, Use::WritesTriangles);
  requireFitting(arguments);
  try
  {
    return isIdleRank() ? Success : runMesh(arguments);
  }
  catch (const WorkAborted&)
  {
    return reportInterrupt();
  }
  catch (const std::invalid_argument& error)
  {
    throw IOError(arguments.Constraints.name(), error.what());
  }
  catch (const std::length_error& error)
  {
    throw IOError(arguments.Output, error.what());
  }
}

} // namespace

void addMeshCommand(CLI::App& app, int& exitCode)
{
  addCommand<MeshArguments>(app, exitCode, "mesh",
    "Makes a mesh with good angles and chosen sizes inside lines and polygons", footer, addOptions,
    run);
}

} // namespace tipp
