// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Commands/DemRuns.h"
#include "Commands/PointArguments.h"
#include "Points/ReadPoints.h"
#include "Raster/RasterFile.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

namespace tipp
{
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

void addConstraintOptions(CLI::App& command, DemArguments& arguments)
{
  command.add_option("--breaklines", arguments.Breaklines,
    "A file of lines that become edges of triangles; their points have the file's heights, else "
    "those of the surface without the lines");
  command.add_flag("--soft", arguments.Soft,
    "The breaklines have no heights, even if the file has: they get those of the surface");
  command.add_option("--boundary", arguments.Boundary,
    "A file of closed lines: only pixels inside of them have values");
  addCurveOption(command);
}

/// Reads the files of breaklines and boundary.
void readConstraints(DemArguments& arguments)
{
  std::optional<ConstraintTable> lines;
  std::optional<ConstraintTable> boundary;
  if (!arguments.Breaklines.empty())
  {
    lines = readBreaklines(arguments.Breaklines, arguments.Columns.Wrap);
    if (arguments.Soft)
    {
      lines->Height.clear();
    }
  }
  if (!arguments.Boundary.empty())
  {
    boundary = readBoundary(arguments.Boundary, arguments.Columns.Wrap);
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
  command.add_flag("--strict-crs", arguments.StrictCrs,
    "Fail, rather than warn, if the files state a coordinate reference system that is not "
    "understood");
  addChecked(command, "--type", arguments.Type, CLI::IsMember({ "float32", "float64" }),
    "The type of a GeoTIFF's values: float32 or float64");
  addChecked(command, "--compress", arguments.Compression,
    CLI::IsMember({ "deflate", "lzw", "zstd", "none" }),
    "The compression of a GeoTIFF: deflate, lzw, zstd or none");
  command.add_flag(
    "--cog", arguments.CloudOptimized, "Write a cloud optimized GeoTIFF, with overviews");
}

/// Throws CLI::ValidationError for options that would have no effect.
void requireUseful(const DemArguments& arguments)
{
  for (const char* const name : { "--nodata", "--strict-crs", "--type", "--compress", "--cog" })
  {
    refuseIf(arguments.Command->count(name) > 0 && !isGeoTiff(arguments.Output), name,
      "needs an output named .tif");
  }
  for (const char* const name : { "--bounds", "--align" })
  {
    refuseIf(arguments.Command->count(name) > 0 && !arguments.Like.empty(), name,
      "cannot be combined with --like");
  }
  refuseIf(arguments.Soft && arguments.Breaklines.empty(), "--soft", "needs --breaklines");
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
  const auto single = float(arguments.NoData);
  refuseIf(arguments.Type == "float32" &&
      (std::isinf(single) != std::isinf(arguments.NoData) ||
        (single == 0) != (arguments.NoData == 0)),
    "--nodata", "is not a 32-bit number; give another one, or --type float64");
  refuseIf(arguments.Memory.empty() && (arguments.Resume || !arguments.Scratch.empty()),
    arguments.Resume ? "--resume" : "--scratch", "needs --memory");
}

void addOptions(CLI::App& command, DemArguments& arguments)
{
  arguments.Command = &command;
  addRunOptions(command, arguments, "The raster", isRasterFile, ".tif, .npy or .vti",
    "The memory limit of each process, such as 512M", "With --memory");
  addGridOptions(command, arguments);
  addValueOptions(command, arguments);
  addConstraintOptions(command, arguments);
  addDuplicatesOption(command, arguments.Request.Duplicates);
  addThreadsOption(command, arguments.Request.Threads);
}

int run(DemArguments& arguments)
{
  requireGood(arguments);
  requireUseful(arguments);
  arguments.Columns.Threads = arguments.Request.Threads;
  arguments.Columns.Columns = columnsForBands(arguments.Request.Bands);
  if (!arguments.Bounds.empty())
  {
    const std::vector<double>& bounds = arguments.Bounds;
    arguments.Request.Raster.Bounds = { bounds[0], bounds[1], bounds[2], bounds[3] };
  }
  if (!arguments.Like.empty())
  {
    arguments.Request.Raster.Like = readRasterInfo(arguments.Like).Grid;
  }
  readConstraints(arguments);
  return runDem(arguments);
}

} // namespace

void addDemCommand(CLI::App& app, int& exitCode)
{
  addCommand<DemArguments>(app, exitCode, "dem",
    "Makes a raster from points: the values of the triangulated surface at the pixels' centres",
    footer, addOptions, run);
}

} // namespace tipp
