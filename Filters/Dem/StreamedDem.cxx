// SPDX-License-Identifier: BSD-3-Clause
#include "Dem/StreamedDem.h"

#include "Constraints/ConstrainedPoints.h"
#include "Dem/RasterSink.h"
#include "Dem/SurfaceSink.h"
#include "Files/TemporaryFiles.h"
#include "OutOfCore/OutOfCoreTriangulation.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <string>
#include <utility>

namespace tipp
{
namespace
{

/// Copies all tiles into the grid. Returns false if `progress` stopped it.
bool readTiles(const TerrainSettings& settings, const TileSource& tiles,
  const std::function<bool(double)>& progress, SampledBands& samples)
{
  const RasterGrid& grid = settings.Grid;
  samples.Values.resize(settings.Bands.Bands.size());
  for (std::vector<double>& band : samples.Values)
  {
    band.resize(std::size_t(grid.pixels()));
  }
  return forChunks(tileCount(grid), 1, settings.Threads, progress,
    [&](std::int64_t number, std::int64_t, int)
    {
      const RasterWindow window = tileOf(grid, number);
      std::vector<std::vector<double>> values;
      tiles.Read(window, values);
      for (std::size_t band = 0; band < values.size(); ++band)
      {
        for (std::int64_t row = 0; row < window.Rows; ++row)
        {
          std::copy_n(values[band].data() + row * window.Columns, window.Columns,
            samples.Values[band].data() + (window.Row + row) * grid.Columns + window.Column);
        }
      }
    });
}

/// Triangulates out of core in a temporary folder; `taker` receives the triangles.
OutOfCoreStatistics triangulateInto(TriangleConsumer& taker, PointStream& points,
  OutOfCoreOptions options, const std::function<bool(double)>& progress)
{
  const ScratchDirectory folder;
  options.CountOnly = true;
  options.Consumer = &taker;
  options.Progress = progress;
  return triangulateOutOfCore(points, folder.path() + "/dem", options);
}

DemFigures makeWithin(std::unique_ptr<PointStream> points, const DemRequest& request,
  std::uint64_t memory, const std::function<bool(double)>& progress, TerrainSettings& settings,
  SampledBands& samples)
{
  OutOfCoreOptions options;
  options.MemoryLimit = memory;
  options.Threads = request.Threads;
  options.Duplicates = request.Duplicates;
  double before = 0; // last reported progress
  const auto report = [&](double done)
  { return !progress || progress(before + (1 - before) * done); };
  DemFigures figures;
  if (request.Constraints)
  {
    SurfaceSink surface(*request.Constraints);
    if (needsSurface(*request.Constraints, request.Bands))
    {
      figures.Aborted = triangulateInto(surface, *points, options,
        [&](double done) {
          return report(0.4 * done);
        }).Aborted;
      before = 0.4;
    }
    if (figures.Aborted)
    {
      return figures;
    }
    auto constrained = std::make_unique<ConstrainedPoints>(
      std::move(points), *request.Constraints, "the constraints", request.Threads);
    constrained->setSurface(surface.takeValues());
    options.Constraints = [&from = *constrained]() -> SegmentSource& { return from; };
    points = std::move(constrained);
  }
  RasterSink sink(
    [&](const Box2& bounds, const std::vector<std::string>& columns)
    {
      TerrainSettings made = makeTerrainSettings(request, bounds, columns);
      requireMemory(made);
      return made;
    },
    [&](const TerrainSettings& made, const TileSource& tiles, const Report& written)
    {
      settings = made;
      return readTiles(settings, tiles, written, samples);
    },
    nullptr);
  options.MaximumEdge = request.MaximumEdge;
  return figuresOf(triangulateInto(sink, *points, options, report));
}

} // namespace

DemFigures figuresOf(const OutOfCoreStatistics& made)
{
  return { made.Points, made.Triangles, made.Duplicates, made.DisagreeingPositions, made.Rejected,
    made.WithoutElevation, made.Aborted };
}

DemFigures makeDem(std::unique_ptr<PointStream> points, const DemRequest& request,
  std::uint64_t memory, const std::function<bool(double)>& progress, TerrainSettings& settings,
  SampledBands& samples)
{
  return memory == 0 ? makeDem(readAllPoints(*points), request, progress, settings, samples)
                     : makeWithin(std::move(points), request, memory, progress, settings, samples);
}

} // namespace tipp
