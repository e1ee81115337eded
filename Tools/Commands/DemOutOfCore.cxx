// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/DemRuns.h"

#include "Commands/Commands.h"
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Constraints/OnDisk/ConstrainedPoints.h"
#include "Dem/MakeDem.h"
#include "Dem/RasterSink.h"
#include "Dem/SurfaceSink.h"
#include "OutOfCore/ScratchFiles.h"
#include "Points/PointStream.h"

#include <fmt/format.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <malloc.h>

namespace tipp
{
namespace
{

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
  if (!arguments.Memory.empty())
  {
    options.MemoryLimit = *parseMemorySize(arguments.Memory);
  }
  options.Threads = arguments.Request.Threads;
  options.Duplicates = arguments.Request.Duplicates;
  options.CountOnly = true;
  options.Resume = arguments.Resume;
  options.Scratch = arguments.Scratch;
  return options;
}

/// Triangulates the points without constraints, and sets `values` on the first rank: the heights
/// of this surface at the points of constraints. Does nothing if no point needs a height, or if the
/// run that uses them has already begun. Returns the exit code.
int findSurface(const DemArguments& arguments, Communicator& ranks, const OpenPoints& open,
  std::vector<std::vector<double>>& values, DemReport& report)
{
  const DemRequest& request = arguments.Request;
  const bool isNeeded = request.Constraints && needsSurface(*request.Constraints, request.Bands);
  const bool hasBegun = ranks.rank() == 0 && canResume(arguments.Output + workSuffix);
  if (!isNeeded || ranks.broadcast(hasBegun))
  {
    return Success;
  }
  SurfaceSink sink(*request.Constraints);
  OutOfCoreOptions options = optionsOf(arguments);
  options.Consumer = &sink;
  OutOfCoreStatistics statistics;
  const int code = runOutOfCore(ranks, "Finding heights for the lines", open,
    arguments.Output + surfaceSuffix, options, statistics);
  values = sink.takeValues();
  report.MakeSeconds += totalSeconds(statistics.Phases);
  return code;
}

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
        throw demError(arguments, error);
      }
    },
    [&](const TerrainSettings& settings, const TileSource& tiles,
      const std::function<bool(double)>& progress)
    {
      malloc_trim(0); // return the memory of pieces to the system
      RasterDescription whole = description;
      describeGrid(settings, whole);
      report.Settings = settings;
      const auto writer = createRaster(arguments.Output, whole, before);
      report.Filled =
        writeTiles(*writer, settings.Grid, tiles, progress, settings.Threads, settings.Bands);
      report.Filled < 0 ? void() : writer->close();
      report.Hidden = writer->hidden();
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
    auto stream = openPointStream(arguments.Inputs, withThinningFile(arguments));
    if (isFirst)
    {
      description = describeRaster(arguments, stream->crs());
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
    auto joined = std::make_unique<ConstrainedPoints>(std::move(stream),
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
  const std::vector<ProcessUsage> usage = gatherUsage(ranks);
  if (!isFirst)
  {
    return Success;
  }
  reportLeftOut(statistics.LeftOut, statistics.ThinnedOut);
  report.PeakMemory = largestMemory(usage);
  report.Ranks = ranks.size();
  report.Figures = statistics;
  report.MakeSeconds += totalSeconds(statistics.Phases);
  finishDem(arguments, report);
  return Success;
}

} // namespace tipp
