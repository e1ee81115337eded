// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/DemOutOfCore.h"

#include "Commands/Commands.h"
#include "Commands/MemorySize.h"
#include "Commands/PointArguments.h"
#include "Console/Interrupt.h"
#include "Console/ProgressBar.h"
#include "Dem/RasterSink.h"
#include "OutOfCore/OutOfCoreTriangulation.h"
#include "Points/PointStream.h"

#include <fmt/format.h>

#include <memory>

#include <malloc.h>

namespace tipp
{
namespace
{

/// What else than the points and the memory a resumed run must have in common with the first one.
std::string identityOf(const DemArguments& arguments, const RasterDescription& description)
{
  const RasterRequest& raster = arguments.Request.Raster;
  std::string text = fmt::format("raster {} {} {} {} {} {} {}", raster.Resolution, raster.Aligned,
    description.NoData, description.Double, description.Compression, description.CloudOptimized,
    description.Crs);
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

/// Of the folder beside the output that a run keeps its files in.
constexpr const char* workSuffix = ".pixels";

std::unique_ptr<ProgressBar> makeBar()
{
  return std::make_unique<ProgressBar>("Making the raster");
}

} // namespace

int runDemOutOfCore(const DemArguments& arguments, DemReport& report)
{
  // Large blocks go back to the system when they are freed, whatever was freed before.
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
  const PathState before = PendingFile(arguments.Output).before();
  PointOptions points = arguments.Points;
  setThinningFile(points, arguments.Scratch, arguments.Output);
  const auto stream = openPointStream(arguments.Inputs, points);
  const RasterDescription description = describeRaster(arguments, stream->crs());
  std::unique_ptr<ProgressBar> bar = makeBar();
  RasterSink sink(
    identityOf(arguments, description),
    [&](const Box2& bounds, const std::vector<std::string>& columns)
    { return makeTerrainSettings(arguments.Request, bounds, columns); },
    [&](const TerrainSettings& settings, const ReadTile& readTile,
      const std::function<bool(double)>& progress)
    {
      RasterDescription whole = description;
      describeGrid(settings, whole);
      report.Settings = settings;
      const auto writer = createRaster(arguments.Output, whole, before);
      report.Filled = writeTiles(*writer, settings.Grid, readTile, progress);
      report.Filled < 0 ? void() : writer->close();
      return report.Filled >= 0;
    });
  OutOfCoreOptions options;
  options.MemoryLimit = *parseMemorySize(arguments.Memory);
  options.Threads = arguments.Request.Threads;
  options.MaximumEdge = arguments.Request.MaximumEdge;
  options.Duplicates = arguments.Request.Duplicates;
  options.CountOnly = true;
  options.Taker = &sink;
  options.Resume = arguments.Resume;
  options.Scratch = arguments.Scratch;
  options.Progress = [&bar](double fraction)
  {
    if (bar)
    {
      bar->update(fraction);
    }
    return !isInterrupted();
  };
  options.Warn = [&bar](const std::string& sentence)
  {
    bar.reset();
    fmt::print(stderr, "tipp: warning: {}\n", sentence);
    bar = makeBar();
  };
  const OutOfCoreStatistics statistics =
    triangulateOutOfCore(*stream, arguments.Output + workSuffix, options);
  bar.reset();
  if (statistics.Aborted)
  {
    return reportInterrupt(
      statistics.Kept ? "the same command with --resume goes on" : "nothing was written");
  }
  reportLeftOut(statistics.LeftOut, statistics.ThinnedOut);
  report.Figures.Points = statistics.Points;
  report.Figures.Triangles = statistics.Triangles;
  report.Figures.Duplicates = statistics.Duplicates;
  report.Figures.DisagreeingPlaces = statistics.DisagreeingPlaces;
  report.Figures.Rejected = statistics.Rejected;
  for (const OutOfCoreStatistics::Phase& phase : statistics.Phases)
  {
    report.MakeSeconds += phase.Seconds;
  }
  return Success;
}

} // namespace tipp
