// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Commands/DemRuns.h"
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Console/Process.h"
#include "Files/IOError.h"
#include "Files/OutputPath.h"
#include "Parallel/Stopwatch.h"
#include "Points/PointStream.h"

#include "vtkMultiProcessController.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

namespace tipp
{

RasterDescription describeEncoding(const DemArguments& arguments)
{
  RasterDescription description;
  description.NoData = arguments.NoData;
  description.Double = arguments.Type == "float64";
  description.Compression = arguments.Compression;
  description.CloudOptimized = arguments.CloudOptimized;
  return description;
}

RasterDescription describeRaster(const DemArguments& arguments, const std::string& pointCrs)
{
  RasterDescription description = describeEncoding(arguments);
  description.Crs = arguments.Crs.empty() ? pointCrs : arguments.Crs;
  if (!arguments.Like.empty() && description.Crs.empty())
  {
    description.Crs = readRasterInfo(arguments.Like).Crs;
  }
  if (isGeoTiff(arguments.Output) && !description.Crs.empty())
  {
    requireCrs(description.Crs); // fail before the computation rather than after it
  }
  return description;
}

void describeGrid(const TerrainSettings& settings, RasterDescription& description)
{
  description.Grid = settings.Grid;
  description.Threads = settings.Threads;
  description.Bands = settings.Bands.names();
}

namespace
{

nlohmann::ordered_json jsonOf(const DemArguments& arguments, const DemReport& report)
{
  const RasterGrid& grid = report.Settings.Grid;
  return {
    { "input", arguments.Inputs },
    { "output", arguments.Output },
    { "points", report.Figures.Points },
    { "triangles", report.Figures.Triangles },
    { "duplicates", report.Figures.Duplicates },
    { "disagreeing_places", report.Figures.DisagreeingPositions },
    { "rejected", report.Figures.Rejected },
    { "without_elevation", report.Figures.WithoutElevation },
    { "columns", grid.Columns },
    { "rows", grid.Rows },
    { "west", grid.West },
    { "south", grid.South },
    { "pixel", grid.Pixel },
    { "bands", report.Settings.Bands.names() },
    { "pixels_with_value", report.Filled },
    { "values_equal_to_nodata", report.Hidden },
    { "read_seconds", report.ReadSeconds },
    { "make_seconds", report.MakeSeconds },
    { "write_seconds", report.WriteSeconds },
    { "threads", report.Settings.Threads },
    { "ranks", report.Ranks },
    { "peak_memory_bytes", report.PeakMemory },
  };
}

} // namespace

void requireDemWritable(const DemArguments& arguments)
{
  std::vector<std::string> inputs = arguments.Inputs;
  inputs.insert(inputs.end(), { arguments.Breaklines, arguments.Boundary });
  checkOutputs(arguments.Output, arguments.Statistics, arguments.Scratch, inputs);
}

IOError demError(const DemArguments& arguments, const std::runtime_error& error)
{
  const bool isColumn = dynamic_cast<const UnknownBand*>(&error) != nullptr;
  return IOError(arguments.Inputs.front(),
    std::string("cannot be made a raster: ") + error.what() +
      (isColumn ? " 'tipp info' lists all columns; name those to use with --attributes." : ""));
}

void finishDem(const DemArguments& arguments, const DemReport& report)
{
  const nlohmann::ordered_json json = jsonOf(arguments, report);
  if (!arguments.Statistics.empty())
  {
    writeJson(arguments.Statistics, json);
  }
  const RasterGrid& grid = report.Settings.Grid;
  fmt::print("{}, {} x {} pixels, {} with a value, {:.3f} s, peak memory {:.0f} MB{}, in {}\n",
    describeCounts(json), grid.Columns, grid.Rows, report.Filled,
    report.ReadSeconds + report.MakeSeconds + report.WriteSeconds, double(report.PeakMemory) / 1e6,
    report.Ranks == 1 ? "" : " of the largest rank", arguments.Output);
  if (report.Figures.WithoutElevation > 0)
  {
    fmt::print(stderr,
      "tipp: {} points have no elevation; pixels in triangles at them have no elevation.\n",
      report.Figures.WithoutElevation);
  }
  warnOfHidden(report.Hidden, arguments.NoData);
  if (report.Figures.Triangles == 0)
  {
    fmt::print(stderr,
      "tipp: warning: no pixel has a value, because there are fewer than three distinct points or "
      "all lie on one line.\n");
  }
  else if (report.Filled == 0)
  {
    fmt::print(stderr,
      "tipp: warning: no pixel has a value; compare --bounds, --like and --max-edge with the "
      "bounds that 'tipp info' prints.\n");
  }
}

namespace
{

constexpr const char* footer =
  R"(INPUT   one or more files of points, as for 'tipp delaunay': .las, .laz, .npy, .csv,
        .txt, .xyz and others. The elevation is the column z or elevation.
OUTPUT  .tif: a tiled and compressed GeoTIFF of float32. .npy: float64, rows x columns, the
        row of lowest y first; several bands: bands x rows x columns. .vti: a float64
        array for each band. Where there is no triangle, pixels of a GeoTIFF have the
        number of --nodata, and those of other files NaN.

A pixel has the value of the triangulated surface at its centre: the value that 'tipp
delaunay' and then 'tipp resample' give. The raster covers the points; borders of pixels
are at multiples of the resolution. Triangles are not stored.

Without --memory everything is in memory. With it, points, triangles and pixels may be
larger than memory: they are stored in a folder beside the output, or in that of
--scratch. The pixels are the same. Under mpirun the ranks share the work in this way,
each with the limit --memory, or 2G; all ranks must see these folders.

Examples:
  tipp dem tiles/*.las -o dem.tif --resolution 1 --class 2
  tipp dem survey.csv -o dem.tif --resolution 0.5 --max-edge 20 --crs EPSG:32633
  tipp dem tile.las -o relief.tif --resolution 1 --attributes elevation,slope,hillshade
  tipp dem tile.las -o same.tif --like other.tif
  tipp dem tile.las -o dem.tif --resolution 1 --breaklines rivers.csv --boundary area.vtp
  tipp dem tiles/*.las -o dem.tif --resolution 1 --memory 512M
  tipp dem tiles/*.las -o dem.tif --resolution 1 --memory 512M --breaklines rivers.csv
  mpirun -np 4 tipp dem tiles/*.las -o dem.tif --resolution 1 --memory 512M
)";

int runInMemory(const DemArguments& arguments)
{
  const PathState before = PendingFile(arguments.Output).before();
  Stopwatch watch;
  DemReport report;
  const auto stream = openPointStream(arguments.Inputs, arguments.Columns);
  const RasterDescription start = describeRaster(arguments, stream->crs());
  PointTable points = readAllPoints(*stream);
  reportLeftOut(points.LeftOut, points.ThinnedOut);
  if (isInterrupted())
  {
    return reportInterrupt();
  }
  report.ReadSeconds = watch.restart();
  auto bar = std::make_unique<ProgressBar>("Making the raster");
  const auto progress = progressOn(bar);
  SampledBands samples;
  report.Figures =
    makeDem(std::move(points), arguments.Request, progress, report.Settings, samples);
  report.MakeSeconds = watch.restart();
  if (report.Figures.Aborted || isInterrupted())
  {
    bar.reset();
    return reportInterrupt();
  }
  RasterDescription description = start;
  describeGrid(report.Settings, description);
  const auto writer = createRaster(arguments.Output, description, before);
  report.Filled = writeTiles(
    *writer, description.Grid, readFrom(report.Settings.Grid, samples),
    [&](double done) { return progress(0.8 + 0.2 * done); }, report.Settings.Threads,
    report.Settings.Bands);
  bar.reset();
  if (report.Filled < 0)
  {
    return reportInterrupt();
  }
  writer->close();
  report.Hidden = writer->hidden();
  report.WriteSeconds = watch.restart();
  report.PeakMemory = peakMemoryBytes();
  finishDem(arguments, report);
  return Success;
}

int runDem(const DemArguments& arguments)
{
  const MpiSession session;
  const bool isOnRanks = session.controller() && session.controller()->GetNumberOfProcesses() > 1;
  try
  {
    if (isOnRanks || !arguments.Memory.empty())
    {
      DemReport report;
      return runDemOutOfCore(arguments, session.controller(), report);
    }
    requireDemWritable(arguments);
    return runInMemory(arguments);
  }
  catch (const IOError&)
  {
    throw;
  }
  catch (const std::invalid_argument& error)
  {
    throw IOError(arguments.constraintFile(), error.what());
  }
  catch (const std::runtime_error& error)
  {
    throw demError(arguments, error);
  }
}

void addConstraintOptions(CLI::App& command, DemArguments& arguments)
{
  command.add_option("--breaklines", arguments.Breaklines,
    "A file of lines that become edges of triangles; their points have the file's heights, else "
    "those of the surface without the lines");
  command.add_option("--boundary", arguments.Boundary,
    "A file of closed lines: only pixels inside of them have values");
}

/// Reads the files of breaklines and boundary.
void readConstraints(DemArguments& arguments)
{
  std::optional<ConstraintTable> lines;
  std::optional<ConstraintTable> boundary;
  if (!arguments.Breaklines.empty())
  {
    lines = readBreaklines(arguments.Breaklines);
  }
  if (!arguments.Boundary.empty())
  {
    boundary = readBoundary(arguments.Boundary);
  }
  constrain(arguments.Request, std::move(lines), std::move(boundary));
}

void addGridOptions(CLI::App& command, DemArguments& arguments)
{
  RasterRequest& raster = arguments.Request.Raster;
  command
    .add_option(
      "--resolution", raster.Resolution, "Width and height of a pixel, in the units of the points")
    ->check(checkPositive);
  command
    .add_option("--bounds", arguments.Bounds,
      "The range of the raster: xmin xmax ymin ymax (default: that of the points)")
    ->expected(4);
  command
    .add_option_function<std::string>(
      "--align", [&raster](const std::string& which) { raster.Aligned = which == "grid"; },
      "Where pixels have their borders: grid: at multiples of the resolution (default); bounds: "
      "counted from the lower left corner of the bounds")
    ->check(CLI::IsMember({ "grid", "bounds" }));
  command.add_option("--like", arguments.Like,
    "A raster with the same pixels, instead of --resolution and --bounds");
}

void addValueOptions(CLI::App& command, DemArguments& arguments)
{
  command
    .add_option("--attributes", arguments.Request.Bands,
      "The bands: elevation; columns of the points, such as intensity; slope, aspect, hillshade "
      "and density (points per square unit) of the triangles; void: 1 where there is no triangle, "
      "else 0 (default: elevation)")
    ->delimiter(',')
    ->allow_extra_args(false);
  command
    .add_option("--max-edge", arguments.Request.MaximumEdge,
      "Pixels in triangles with an edge longer than this, in the plane, have no value")
    ->check(checkPositive);
  command
    .add_option(
      "--nodata", arguments.NoData, "The number that a GeoTIFF has where there is no triangle")
    ->capture_default_str();
  command.add_option("--crs", arguments.Crs,
    "The coordinate reference system, such as EPSG:25832 (default: that of the LAS files or of "
    "--like)");
  command
    .add_option("--type", arguments.Type, "The type of a GeoTIFF's values: float32 or float64")
    ->check(CLI::IsMember({ "float32", "float64" }))
    ->capture_default_str();
  command
    .add_option("--compress", arguments.Compression,
      "The compression of a GeoTIFF: deflate, lzw, zstd or none")
    ->check(CLI::IsMember({ "deflate", "lzw", "zstd", "none" }))
    ->capture_default_str();
  command.add_flag(
    "--cog", arguments.CloudOptimized, "Write a cloud optimized GeoTIFF, with overviews");
}

/// Throws CLI::ValidationError for options that would have no effect.
void requireUseful(const CLI::App& command, const DemArguments& arguments)
{
  for (const char* const name : { "--nodata", "--crs", "--type", "--compress", "--cog" })
  {
    refuseIf(
      command.count(name) > 0 && !isGeoTiff(arguments.Output), name, "needs an output named .tif");
  }
  for (const char* const name : { "--bounds", "--align" })
  {
    refuseIf(
      command.count(name) > 0 && !arguments.Like.empty(), name, "cannot be combined with --like");
  }
  std::vector<std::string> bands = arguments.Request.Bands;
  std::sort(bands.begin(), bands.end());
  const auto twice = std::adjacent_find(bands.begin(), bands.end());
  if (twice != bands.end())
  {
    throw CLI::ValidationError("--attributes", "lists '" + *twice + "' twice");
  }
}

void requireGood(const DemArguments& arguments)
{
  refuseIf(arguments.Like.empty() == (arguments.Request.Raster.Resolution == 0), "--resolution",
    arguments.Like.empty() ? "or --like is required" : "cannot be combined with --like");
  refuseIf(arguments.Type == "float32" && std::isfinite(arguments.NoData) &&
      std::fabs(arguments.NoData) > double(std::numeric_limits<float>::max()),
    "--nodata", "is not a 32-bit number; give another one, or --type float64");
  refuseIf(arguments.Memory.empty() && (arguments.Resume || !arguments.Scratch.empty()),
    arguments.Resume ? "--resume" : "--scratch", "needs --memory");
}

} // namespace

void addDemCommand(CLI::App& app, int& exitCode)
{
  auto arguments = std::make_shared<DemArguments>();
  CLI::App* const command = app.add_subcommand("dem",
    "Makes a raster from points: the values of the triangulated surface at the pixels' centres");
  addRunOptions(*command, *arguments, "The raster", isRasterFile, ".tif, .npy or .vti",
    "The memory limit of each process, such as 512M", "With --memory");
  addGridOptions(*command, *arguments);
  addValueOptions(*command, *arguments);
  addConstraintOptions(*command, *arguments);
  addPointOptions(*command, arguments->Columns);
  addDuplicatesOption(*command, arguments->Request.Duplicates);
  addThreadsOption(*command, arguments->Request.Threads);
  command->footer(footer);
  command->callback(
    [arguments, command, &exitCode]()
    {
      requireGood(*arguments);
      requireUseful(*command, *arguments);
      arguments->Columns.Threads = arguments->Request.Threads;
      arguments->Columns.Columns = columnsForBands(arguments->Request.Bands);
      if (!arguments->Bounds.empty())
      {
        const std::vector<double>& bounds = arguments->Bounds;
        arguments->Request.Raster.Bounds = { bounds[0], bounds[1], bounds[2], bounds[3] };
      }
      if (!arguments->Like.empty())
      {
        arguments->Request.Raster.Like = readRasterInfo(arguments->Like).Grid;
      }
      readConstraints(*arguments);
      exitCode = runDem(*arguments);
    });
}

} // namespace tipp
