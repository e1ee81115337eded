// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/DemArguments.h"

#include "Commands/PointArguments.h"
#include "Commands/Report.h"

#include <fmt/format.h>

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

std::string summarize(const DemArguments& arguments, const DemReport& report)
{
  const RasterGrid& grid = report.Settings.Grid;
  const OutOfCoreStatistics& figures = report.Figures;
  const std::string rejected =
    figures.Rejected == 0 ? "" : fmt::format(", {} rejected", figures.Rejected);
  return fmt::format(
    "{} points, {} triangles, {}{}, {} x {} pixels, {} with a value, {:.3f} s, peak "
    "memory {:.0f} MB{}, in {}",
    figures.Points, figures.Triangles,
    describeDuplicates(figures.Duplicates, figures.DisagreeingPositions), rejected, grid.Columns,
    grid.Rows, report.Filled, report.ReadSeconds + report.MakeSeconds + report.WriteSeconds,
    double(report.PeakMemory) / 1e6, report.Ranks == 1 ? "" : " of the largest rank",
    arguments.Output);
}

void writeDemReport(const DemArguments& arguments, const DemReport& report)
{
  const RasterGrid& grid = report.Settings.Grid;
  writeJson(arguments.Statistics,
    {
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
    });
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
  if (!arguments.Statistics.empty())
  {
    writeDemReport(arguments, report);
  }
  fmt::print("{}\n", summarize(arguments, report));
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

} // namespace tipp
