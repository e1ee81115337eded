// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Console/Process.h"
#include "Constraints/OnDisk/ConstrainedStream.h"
#include "Crs/StatedCodes.h"
#include "Dem/DemRegion.h"
#include "Dem/DemSinks.h"
#include "Dem/MakeDem.h"
#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Files/PendingOutput.h"
#include "Files/Platform.h"
#include "Files/TemporaryPaths.h"
#include "OutOfCore/ScratchFiles.h"
#include "Parallel/Stopwatch.h"
#include "Points/ReadPoints.h"
#include "Raster/ReadRaster.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

/// The options of `tipp dem`.
struct DemArguments : RunArguments
{
  const CLI::App* Command = nullptr; ///< tells which options are given
  DemRequest Request;
  std::vector<double> Bounds;
  std::string Like;
  bool StrictCrs = false; ///< whether a reference system that is not understood is an error
  double NoData = -9999;
  std::string Type = "float32";
  std::string Compression = "deflate";
  bool CloudOptimized = false;
  std::string Breaklines; ///< path of a file; empty: none
  bool Preview = false;   ///< reads only the levels of COPC files that are needed
  bool Soft = false;      ///< the heights of Breaklines are not used
  std::string Boundary;   ///< path of a file; empty: none

  /// Returns the file of constraints that messages name.
  std::string constraintFile() const
  {
    return this->Breaklines.empty() ? this->Boundary : this->Breaklines;
  }
};

/// The figures of a run of `tipp dem`.
struct DemReport
{
  DemFigures Figures;
  ReadFigures Read;
  TerrainSettings Settings;
  std::int64_t Filled = 0; ///< pixels with a value
  double Hidden = 0;       ///< number of values that equal --nodata
  double ReadSeconds = 0;
  double MakeSeconds = 0;
  double WriteSeconds = 0;
  std::int64_t PeakMemory = 0; ///< in bytes, of the process; with ranks, the largest of all
  int Ranks = 1;
};

/// Returns how a GeoTIFF stores values; the same on all ranks.
RasterDescription describeEncoding(const DemArguments& arguments)
{
  RasterDescription description;
  description.NoData = arguments.NoData;
  description.Double = arguments.Type == "float64";
  description.Compression = arguments.Compression;
  description.CloudOptimized = arguments.CloudOptimized;
  return description;
}

/// Returns the text of a system without its heights; empty if only the heights are described.
std::string withoutHeights(const std::string& text)
{
  const int code = hasHeightSystem(text) ? codesOf(text).Horizontal : 0;
  return code > 0 ? "EPSG:" + std::to_string(code) : "";
}

/// Returns the part of a system that a GeoTIFF can state, and what it cannot as the Problem.
ReferenceSystem statedInGeoTiff(ReferenceSystem system)
{
  while (!system.Text.empty())
  {
    try
    {
      requireCrs(system.Text);
      break;
    }
    catch (const IOError& error)
    {
      system.Problem = error.what();
      system.Text = withoutHeights(system.Text);
    }
  }
  return system;
}

/// Returns the description of the raster without its grid and bands. `ofPoints`: the reference
/// system of the points. A problem with it is an error with --strict-crs, else a warning, which is
/// printed if `isFirst`. Throws IOError if that of --crs is not known, or if such a file cannot be
/// written.
RasterDescription describeRaster(
  const DemArguments& arguments, const ReferenceSystem& ofPoints, bool isFirst)
{
  RasterDescription description = describeEncoding(arguments);
  // Fail before the computation rather than after it.
  if (arguments.OutputIs == Opener::GeoTiff)
  {
    requireGeoTiff(description, arguments.Output);
  }
  description.Crs = arguments.Columns.Crs;
  if (!description.Crs.empty())
  {
    if (arguments.OutputIs == Opener::GeoTiff)
    {
      requireCrs(description.Crs);
    }
    return description;
  }
  ReferenceSystem system = ofPoints;
  if (!arguments.Like.empty() && system.Text.empty())
  {
    const ReferenceSystem ofRaster = readRasterInfo(arguments.Like).Crs;
    system.Text = ofRaster.Text;
    if (!ofRaster.Problem.empty())
    {
      system.Problem = shownPath(arguments.Like) + " " + ofRaster.Problem;
    }
  }
  if (arguments.OutputIs == Opener::GeoTiff)
  {
    system = statedInGeoTiff(system);
  }
  description.Crs = system.Text;
  if (!system.Problem.empty() && arguments.StrictCrs)
  {
    throw IOError(system.Problem + "; name the right system with --crs.");
  }
  if (!system.Problem.empty() && isFirst && arguments.OutputIs == Opener::GeoTiff)
  {
    const ReferenceSystem stated = describeCrs(system.Text);
    fmt::print(stderr,
      "tipp: warning: {}; the raster states {}; --crs EPSG:CODE names the right system.\n",
      system.Problem,
      system.Text.empty()      ? "no reference system"
        : stated.Words.empty() ? shownText(system.Text)
                               : stated.Words);
  }
  return description;
}

nlohmann::ordered_json jsonOf(const DemArguments& arguments, const DemReport& report)
{
  const RasterGrid& grid = report.Settings.Grid;
  return {
    { "input", arguments.Inputs },
    { "output", arguments.Output },
    { "points", report.Figures.Points },
    { "not_read", jsonOf(report.Read) },
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

/// Throws IOError if an output is also an input, or cannot be written. Call it before the
/// computation. Returns the state of the output's path; writeRaster() refuses to replace anything
/// else.
PathState requireDemWritable(const DemArguments& arguments)
{
  std::vector<std::string> inputs = arguments.Inputs;
  inputs.insert(inputs.end(), { arguments.Breaklines, arguments.Boundary, arguments.Like });
  checkOutputs(arguments.Output, arguments.Statistics, arguments.Scratch, inputs);
  return PendingFile(arguments.Output).before();
}

/// Returns the error to throw if no raster can be made from the points.
IOError demError(const DemArguments& arguments, const std::runtime_error& error)
{
  const bool isColumn = dynamic_cast<const UnknownBand*>(&error) != nullptr;
  return IOError(arguments.Inputs.front(),
    std::string("cannot be made a raster: ") + error.what() +
      (isColumn ? " 'tipp info' lists all columns; name those to use with --attributes." : ""));
}

/// Writes the raster's file. `description`: from describeRaster(); `report`: its Settings are set.
/// Returns false, without a file, if `progress` stopped it.
bool writeRaster(const DemArguments& arguments, RasterDescription description,
  const PathState& before, const TileSource& tiles, const std::function<bool(double)>& progress,
  DemReport& report)
{
  const TerrainSettings& settings = report.Settings;
  description.Grid = settings.Grid;
  description.Threads = settings.Threads;
  description.Bands = settings.Bands.names();
  description.Overviews = settings.Bands.overviews();
  const auto writer = createRaster(arguments.Output, description, before);
  report.Filled =
    writeTiles(*writer, settings.Grid, tiles, progress, settings.Threads, settings.Bands);
  if (report.Filled < 0)
  {
    return false;
  }
  writer->close();
  report.Hidden = writer->hidden();
  return true;
}

/// Prints the summary, and writes the statistics if they are requested.
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
    fmt::print(stderr, "tipp: warning: no pixel has a value, because {}.\n",
      reasonForNoTriangles(arguments.Request.MaximumEdge));
  }
  else if (report.Filled == 0)
  {
    fmt::print(stderr,
      "tipp: warning: no pixel has a value; compare --bounds (xmin xmax ymin ymax), --like and "
      "--max-edge with the bounds that 'tipp info' prints.\n");
  }
}

bool haveZeroHeights(const DemRequest& request)
{
  return request.Constraints && haveZeroHeights(request.Constraints->Lines);
}

/// Warns if the surface is on one side of breaklines whose heights are all 0. `heights`: of the
/// surface, at the breaklines.
void warnOfZeroHeights(const DemArguments& arguments, std::vector<double> heights)
{
  const auto missing = [](double height) { return !std::isfinite(height); };
  heights.erase(std::remove_if(heights.begin(), heights.end(), missing), heights.end());
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  if (!heights.empty() && (*low > 0 || *high < 0))
  {
    fmt::print(stderr,
      "tipp: warning: {}: all heights are 0, but the surface at the lines is from {} to {}. They "
      "move it to 0; if they have no heights, give --soft.\n",
      arguments.Breaklines, *low, *high);
  }
}

/// What is noteworthy about points that have been read.
class PointNotes
{
public:
  explicit PointNotes(const PointTable& points)
    : Read(points.Figures)
    , LeftOut(points.LeftOut)
    , ThinnedOut(points.ThinnedOut)
    , Reports(points.Reports)
  {
    this->Span.add(points.XY);
  }

  void print() const
  {
    reportRead(this->Read);
    reportLeftOut(this->LeftOut, this->ThinnedOut);
    warnOfLongitudes(this->Span);
    reportTables(this->Reports);
  }

private:
  ReadFigures Read;
  std::int64_t LeftOut;
  std::int64_t ThinnedOut;
  std::vector<TableReport> Reports;
  LongitudeSpan Span;
};

int runInMemory(const DemArguments& arguments)
{
  const PathState before = requireDemWritable(arguments);
  const DemRequest& request = arguments.Request;
  DemReport report;
  std::optional<RasterDescription> description;
  std::optional<PointNotes> notes;
  std::unique_ptr<ProgressBar> bar;
  Stopwatch watch;
  DemFiles files{ arguments.Inputs, arguments.Columns };
  files.Opened = [&](const PointStream& stream)
  {
    bar.reset();
    report.MakeSeconds += watch.restart();
    if (!description)
    {
      description = describeRaster(arguments, stream.referenceSystem(), true);
    }
  };
  files.Read = [&](const PointTable& points, bool isPart)
  {
    if (!isPart)
    {
      // Another raster may be larger.
      requireInBounds(arguments.Inputs, arguments.Columns, std::int64_t(points.size()),
        arguments.Like.empty() ? points.Figures : ReadFigures());
    }
    notes.emplace(points);
    report.Read = points.Figures;
    report.ReadSeconds += watch.restart();
    if (!isPart) // it may turn out that more points are needed
    {
      notes->print();
    }
    if (haveZeroHeights(request) && !isInterrupted())
    {
      warnOfZeroHeights(
        arguments, heightsBelow(request.Constraints->Lines, points, request.Threads));
    }
    bar = std::make_unique<ProgressBar>("Making the raster");
  };
  const auto progress = progressOn(bar);
  BandValues samples;
  report.Figures = makeDem(files, request, progress, report.Settings, samples);
  report.MakeSeconds += watch.restart();
  if (report.Figures.Aborted || isInterrupted())
  {
    bar.reset();
    return reportInterrupt();
  }
  if (report.Figures.IsOfPart)
  {
    notes->print();
  }
  const bool isWritten = writeRaster(
    arguments, *description, before, readFrom(report.Settings.Grid, samples),
    [&](double done) { return progress(0.8 + 0.2 * done); }, report);
  bar.reset();
  if (!isWritten)
  {
    return reportInterrupt();
  }
  report.WriteSeconds = watch.restart();
  report.PeakMemory = peakMemoryBytes();
  finishDem(arguments, report);
  return Success;
}

/// Returns a text of the options that a resumed run must have in common with the first one, besides
/// the points and the memory.
std::string identityOf(const DemArguments& arguments, const RasterDescription& description)
{
  const RasterRequest& raster = arguments.Request.Raster;
  std::string text = fmt::format("raster tiles {} {} {} {} {} {} {}", raster.Resolution,
    raster.Aligned, description.NoData, description.Double, description.Compression,
    description.CloudOptimized, description.Crs);
  for (const double bound : arguments.Bounds)
  {
    text += fmt::format(" {}", bound);
  }
  if (raster.Like)
  {
    text += fmt::format(" like {} {} {} {} {} {}", raster.Like->West, raster.Like->South,
      raster.Like->Pixel[0], raster.Like->Pixel[1], raster.Like->Columns, raster.Like->Rows);
  }
  for (const std::string& band : arguments.Request.Bands)
  {
    text += "\n" + band;
  }
  return text;
}

/// Suffixes of the folders beside the output in which runs keep their files.
constexpr const char* workSuffix = ".pixels";
constexpr const char* surfaceSuffix = ".surface";

OutOfCoreOptions optionsOf(const DemArguments& arguments)
{
  OutOfCoreOptions options;
  arguments.setOptions(options);
  options.Threads = arguments.Request.Threads;
  options.Duplicates = arguments.Request.Duplicates;
  options.CountOnly = true;
  return options;
}

/// Triangulates the points without constraints, and sets `values` on the first rank: the heights
/// of this surface at the points of constraints. Does nothing if no height is needed, or if the
/// run that uses them has already begun. Returns the exit code.
int findSurface(const DemArguments& arguments, Communicator& ranks, const OpenPoints& open,
  std::vector<std::vector<double>>& values, DemReport& report)
{
  const DemRequest& request = arguments.Request;
  const bool isNeeded = request.Constraints && needsSurface(*request.Constraints, request.Bands);
  const bool areZero = haveZeroHeights(request);
  const bool hasBegun = ranks.rank() == 0 && canResume(arguments.Output + workSuffix);
  if ((!isNeeded && !areZero) || ranks.broadcast(hasBegun))
  {
    return Success;
  }
  SurfaceSink sink(*request.Constraints);
  OutOfCoreOptions options = optionsOf(arguments);
  options.Consumer = &sink;
  OutOfCoreStatistics statistics;
  const int code = runOutOfCore(ranks, "Finding heights for the lines", open,
    arguments.Output + surfaceSuffix, options, statistics);
  if (areZero && ranks.isFirst())
  {
    std::vector<double> heights = sink.heights();
    heights.resize(std::min(heights.size(), request.Constraints->Lines.XY.size() / 2));
    warnOfZeroHeights(arguments, std::move(heights));
  }
  values = isNeeded ? sink.takeValues() : std::vector<std::vector<double>>();
  report.MakeSeconds += totalSeconds(statistics.Phases);
  return code;
}

/// Runs `tipp dem` with a memory limit, on the ranks of a controller or in this process alone
/// (null). Returns the exit code, which is the same on all ranks.
int runInPieces(const DemArguments& arguments, vtkMultiProcessController* controller)
{
  DemReport report;
  Communicator ranks(controller);
  const bool isFirst = ranks.rank() == 0;
  PathState before;
  RasterDescription description;
  const RasterDescription encoding = describeEncoding(arguments);
  RasterSink sink(
    [&](const Box2& bounds, const std::vector<std::string>& columns)
    {
      try
      {
        TerrainSettings settings = makeTerrainSettings(arguments.Request, bounds, columns);
        settings.IsSingle = arguments.OutputIs == Opener::GeoTiff && arguments.Type == "float32";
        return settings;
      }
      catch (const std::runtime_error& error)
      {
        throw demError(arguments, error);
      }
    },
    [&](const TerrainSettings& settings, const TileSource& tiles,
      const std::function<bool(double)>& progress)
    {
      returnFreedMemory(); // of pieces
      report.Settings = settings;
      return writeRaster(arguments, description, before, tiles, progress, report);
    },
    arguments.OutputIs == Opener::GeoTiff ? std::make_optional(encoding) : std::nullopt);
  bool isReported = false; // the points may be opened twice
  const auto open = [&]
  {
    if (isFirst)
    {
      before = requireDemWritable(arguments);
    }
    auto stream = openPointStream(arguments.Inputs, withThinningFile(arguments));
    if (isFirst)
    {
      if (!isReported)
      {
        report.Read = stream->readFigures();
        reportRead(report.Read);
        reportTables(stream->reports());
      }
      description = describeRaster(arguments, stream->referenceSystem(), !isReported);
      isReported = true;
      sink.setIdentity(identityOf(arguments, description));
    }
    return stream;
  };
  std::vector<std::vector<double>> surface;
  const int surfaceCode = findSurface(arguments, ranks, open, surface, report);
  if (surfaceCode != Success)
  {
    return surfaceCode;
  }
  const auto openConstrained = [&]() -> std::unique_ptr<PointStream>
  {
    auto stream = open();
    if (!arguments.Request.Constraints)
    {
      return stream;
    }
    auto joined = std::make_unique<ConstrainedStream>(std::move(stream),
      *arguments.Request.Constraints, arguments.constraintFile(), arguments.Request.Threads);
    joined->setSurface(std::move(surface));
    return joined;
  };
  OutOfCoreOptions options = optionsOf(arguments);
  options.MaximumEdge = arguments.Request.MaximumEdge;
  options.Consumer = &sink;
  OutOfCoreStatistics statistics;
  const int code = runOutOfCore(ranks, "Making the raster", openConstrained,
    arguments.Output + workSuffix, options, statistics);
  if (code != Success)
  {
    return code;
  }
  const RankUsage usage = gatherUsage(ranks);
  if (!isFirst)
  {
    return Success;
  }
  reportLeftOut(statistics.LeftOut, statistics.ThinnedOut);
  report.PeakMemory = *std::max_element(usage.PeakMemory.begin(), usage.PeakMemory.end());
  report.Ranks = ranks.size();
  report.Figures = { statistics };
  report.MakeSeconds += totalSeconds(statistics.Phases);
  finishDem(arguments, report);
  return Success;
}

constexpr const char* footer =
  R"(INPUT   one or more files of points, as for 'tipp delaunay': .las, .laz, .npy, .csv,
        .txt, .xyz and others. The elevation is the column z or elevation.
OUTPUT  .tif: a tiled and compressed GeoTIFF of float32. .npy: float64, rows x columns, the
        row of lowest y first; several bands: bands x rows x columns. .vti: a float64
        array for each band. Where there is no triangle, pixels of a GeoTIFF have the
        number of --nodata, and those of other files NaN.

A pixel has the value of the triangulated surface at its centre: the value that 'tipp
delaunay' and then 'tipp resample' give. The raster covers the points; borders of pixels
are at multiples of the resolution. Triangles are not stored. With --bounds, only the
points of LAS and LAZ files are read that the pixels depend on, unless memory is limited.

Without --memory everything is in memory. With it, points, triangles and pixels may be
larger than memory: they are stored in a folder beside the output, or in that of
--scratch. The pixels are the same. Under mpirun the ranks share the work in this way,
each with the limit --memory, or 2G; all ranks must see these folders.

Examples:
  tipp dem tiles/*.las -o dem.tif --resolution 1 --class 2
  tipp dem survey.csv -o dem.tif --resolution 0.5 --max-edge 20 --crs EPSG:32633
  tipp dem tile.las -o relief.tif --resolution 1 --attributes elevation,slope,hillshade
  tipp dem tile.las -o same.tif --like other.tif
  tipp dem tile.copc.laz -o part.tif --resolution 1 --bounds 5000 6000 2000 3000
  tipp dem tile.copc.laz -o small.tif --resolution 20 --preview
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

void addPreviewOption(CLI::App& command, DemArguments& arguments)
{
  command.add_flag("--preview", arguments.Preview,
    "Of COPC files, read only the levels that are needed for about one point a pixel");
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
    refuseIf(arguments.Command->count(name) > 0 && arguments.OutputIs != Opener::GeoTiff, name,
      "needs an output named .tif");
  }
  for (const char* const name : { "--bounds", "--align" })
  {
    refuseIf(arguments.Command->count(name) > 0 && !arguments.Like.empty(), name,
      "cannot be combined with --like");
  }
  refuseIf(arguments.Preview && arguments.Columns.Spacing > 0, "--preview",
    "cannot be combined with --spacing, which chooses the levels");
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
  addRunOptions(command, arguments, "The raster", Use::WritesRasters,
    "The memory limit of each process, such as 512M", "With --memory");
  addGridOptions(command, arguments);
  addPreviewOption(command, arguments);
  addValueOptions(command, arguments);
  addConstraintOptions(command, arguments);
  addDuplicatesOption(command, arguments.Request.Duplicates);
  addThreadsOption(command, arguments.Request.Threads);
}

/// Sets what the runs take from several options. Throws IOError if a file of --like, --breaklines
/// or
/// --boundary cannot be read, and std::runtime_error if there cannot be such a raster.
void complete(DemArguments& arguments)
{
  arguments.Columns.Threads = arguments.Request.Threads;
  arguments.Columns.Columns = columnsForBands(arguments.Request.Bands);
  if (!arguments.Bounds.empty())
  {
    arguments.Request.Raster.Bounds = boxOfVtkBounds<2>(arguments.Bounds.data());
  }
  if (!arguments.Like.empty())
  {
    arguments.Request.Raster.Like = readRasterInfo(arguments.Like).Grid;
  }
  const RasterRequest& raster = arguments.Request.Raster;
  double& spacing = arguments.Columns.Spacing;
  if (arguments.Preview)
  {
    spacing =
      raster.Like ? std::min(raster.Like->Pixel[0], raster.Like->Pixel[1]) : raster.Resolution;
  }
  if (spacing > 0 && (raster.Like || raster.Bounds))
  {
    arguments.Columns.Region = DemRegion::around(raster, spacing);
    arguments.Request.StrictBounds = false;
  }
  readConstraints(arguments);
}

int run(DemArguments& arguments)
{
  arguments.OutputIs = openerOf(arguments.Output, Use::WritesRasters);
  requireGood(arguments);
  requireUseful(arguments);
  const MpiSession session;
  try
  {
    complete(arguments);
    return session.ranks() > 1 || !arguments.Memory.empty()
      ? runInPieces(arguments, session.controller())
      : runInMemory(arguments);
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

} // namespace

void addDemCommand(CLI::App& app, int& exitCode)
{
  addCommand<DemArguments>(app, exitCode, "dem",
    "Makes a raster from points: the values of the triangulated surface at the pixels' centres",
    footer, addOptions, run);
}

} // namespace tipp
