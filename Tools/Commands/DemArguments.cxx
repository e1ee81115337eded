// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/DemArguments.h"

#include "Commands/PointArguments.h"
#include "Commands/Report.h"

#include <fmt/format.h>

namespace tipp
{

RasterDescription describeRaster(const DemArguments& arguments, const std::string& pointCrs)
{
  RasterDescription description;
  description.Crs = arguments.Crs.empty() ? pointCrs : arguments.Crs;
  if (!arguments.Like.empty() && description.Crs.empty())
  {
    description.Crs = readRasterInfo(arguments.Like).Crs;
  }
  description.NoData = arguments.NoData;
  description.Double = arguments.Type == "float64";
  description.Compression = arguments.Compression;
  description.CloudOptimized = arguments.CloudOptimized;
  if (isGeoTiff(arguments.Output) && !description.Crs.empty())
  {
    requireCrs(description.Crs); // before the work rather than after it
  }
  return description;
}

void describeGrid(const TerrainSettings& settings, RasterDescription& description)
{
  description.Grid = settings.Grid;
  description.Threads = settings.Threads;
  description.Bands = settings.Bands.names();
}

std::string summarize(const DemArguments& arguments, const DemReport& report)
{
  const RasterGrid& grid = report.Settings.Grid;
  const DemFigures& figures = report.Figures;
  const std::string rejected =
    figures.Rejected == 0 ? "" : fmt::format(", {} rejected", figures.Rejected);
  return fmt::format(
    "{} points, {} triangles, {}{}, {} x {} pixels, {} with a value, {:.3f} s, peak "
    "memory {:.0f} MB, in {}",
    figures.Points, figures.Triangles,
    describeDuplicates(figures.Duplicates, figures.DisagreeingPlaces), rejected, grid.Columns,
    grid.Rows, report.Filled, report.ReadSeconds + report.MakeSeconds + report.WriteSeconds,
    double(peakMemoryBytes()) / 1e6, arguments.Output);
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
      { "disagreeing_places", report.Figures.DisagreeingPlaces },
      { "rejected", report.Figures.Rejected },
      { "columns", grid.Columns },
      { "rows", grid.Rows },
      { "west", grid.West },
      { "south", grid.South },
      { "pixel", grid.Pixel },
      { "bands", report.Settings.Bands.names() },
      { "pixels_with_value", report.Filled },
      { "read_seconds", report.ReadSeconds },
      { "make_seconds", report.MakeSeconds },
      { "write_seconds", report.WriteSeconds },
      { "threads", report.Settings.Threads },
      { "peak_memory_bytes", peakMemoryBytes() },
    });
}

} // namespace tipp
