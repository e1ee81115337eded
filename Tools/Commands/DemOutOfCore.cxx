// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/DemArguments.h"

#include "Commands/Commands.h"
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Dem/RasterSink.h"
#include "Files/IOError.h"
#include "Points/PointStream.h"

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <vector>

#include <malloc.h>

namespace tipp
{
namespace
{

/// What else than the points and the memory a resumed run must have in common with the first one.
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

/// Of the folder beside the output that a run keeps its files in.
constexpr const char* workSuffix = ".pixels";

} // namespace

int runDemOutOfCore(
  const DemArguments& arguments, vtkMultiProcessController* controller, DemReport& report)
{
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
        settings.IsSingle = isGeoTiff(arguments.Output) && arguments.Type == "float32";
        return settings;
      }
      catch (const std::runtime_error& error)
      {
        throw IOError(
          arguments.Inputs.front(), std::string("cannot be made a raster: ") + error.what());
      }
    },
    [&](const TerrainSettings& settings, const TileSource& tiles,
      const std::function<bool(double)>& progress)
    {
      malloc_trim(0); // what pieces have freed
      RasterDescription whole = description;
      describeGrid(settings, whole);
      report.Settings = settings;
      const auto writer = createRaster(arguments.Output, whole, before);
      report.Filled =
        writeTiles(*writer, settings.Grid, tiles, progress, settings.Threads, settings.Bands);
      report.Filled < 0 ? void() : writer->close();
      return report.Filled >= 0;
    },
    isGeoTiff(arguments.Output) ? &encoding : nullptr);
  const auto open = [&]
  {
    if (isFirst)
    {
      requireDemWritable(arguments);
      before = PendingFile(arguments.Output).before();
    }
    PointOptions points = arguments.Points;
    setThinningFile(points, arguments.Scratch, arguments.Output);
    auto stream = openPointStream(arguments.Inputs, points);
    if (isFirst)
    {
      description = describeRaster(arguments, stream->crs());
      sink.setIdentity(identityOf(arguments, description));
    }
    return stream;
  };
  OutOfCoreOptions options;
  if (!arguments.Memory.empty())
  {
    options.MemoryLimit = *parseMemorySize(arguments.Memory);
  }
  options.Threads = arguments.Request.Threads;
  options.MaximumEdge = arguments.Request.MaximumEdge;
  options.Duplicates = arguments.Request.Duplicates;
  options.CountOnly = true;
  options.Consumer = &sink;
  options.Resume = arguments.Resume;
  options.Scratch = arguments.Scratch;
  OutOfCoreStatistics statistics;
  const int code = runOutOfCore(
    ranks, "Making the raster", open, arguments.Output + workSuffix, options, statistics);
  if (code != Success)
  {
    return code;
  }
  const std::vector<ProcessUsage> usage = gatherUsage(ranks);
  if (!isFirst)
  {
    return Success;
  }
  reportLeftOut(statistics.LeftOut, statistics.ThinnedOut);
  report.PeakMemory = largestMemory(usage);
  report.Ranks = ranks.size();
  report.Figures.Points = statistics.Points;
  report.Figures.Triangles = statistics.Triangles;
  report.Figures.Duplicates = statistics.Duplicates;
  report.Figures.DisagreeingPositions = statistics.DisagreeingPositions;
  report.Figures.Rejected = statistics.Rejected;
  report.MakeSeconds = totalSeconds(statistics.Phases);
  finishDem(arguments, report);
  return Success;
}

} // namespace tipp
