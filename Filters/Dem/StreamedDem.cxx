// SPDX-License-Identifier: BSD-3-Clause
#include "Dem/StreamedDem.h"

#include "Dem/RasterSink.h"
#include "Files/OutputFile.h"
#include "Files/TemporaryFiles.h"
#include "OutOfCore/OutOfCoreTriangulation.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

namespace tipp
{
namespace
{

/// A temporary folder, removed with its content by the destructor.
struct ScratchDirectory
{
  ScratchDirectory()
    : Path((std::filesystem::temp_directory_path() / "tipp-XXXXXX").string())
  {
    if (!mkdtemp(this->Path.data()))
    {
      failToWrite(this->Path);
    }
    this->Listed.list(this->Path);
  }
  ~ScratchDirectory()
  {
    std::error_code ignored;
    std::filesystem::remove_all(this->Path, ignored);
  }
  ScratchDirectory(const ScratchDirectory&) = delete;
  ScratchDirectory& operator=(const ScratchDirectory&) = delete;

  std::string Path;
  TemporaryPath Listed;
};

/// Copies all tiles to where their pixels are in the grid.
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

DemFigures makeWithin(PointStream& points, const DemRequest& request, std::uint64_t memory,
  const std::function<bool(double)>& progress, TerrainSettings& settings, SampledBands& samples)
{
  RasterSink sink(
    [&](const Box2& bounds, const std::vector<std::string>& columns)
    {
      TerrainSettings made = makeTerrainSettings(request, bounds, columns);
      requireMemory(made);
      return made;
    },
    [&](const TerrainSettings& made, const TileSource& tiles,
      const std::function<bool(double)>& report)
    {
      settings = made;
      return readTiles(settings, tiles, report, samples);
    },
    nullptr);
  sink.setIdentity("raster in memory");
  const ScratchDirectory folder;
  OutOfCoreOptions options;
  options.MemoryLimit = memory;
  options.Threads = request.Threads;
  options.MaximumEdge = request.MaximumEdge;
  options.Duplicates = request.Duplicates;
  options.CountOnly = true;
  options.Consumer = &sink;
  options.Progress = progress;
  const OutOfCoreStatistics statistics =
    triangulateOutOfCore(points, folder.Path + "/dem", options);
  return { statistics.Points, statistics.Triangles, statistics.Duplicates,
    statistics.DisagreeingPositions, statistics.Rejected, statistics.Aborted };
}

} // namespace

DemFigures makeDem(PointStream& points, const DemRequest& request, std::uint64_t memory,
  const std::function<bool(double)>& progress, TerrainSettings& settings, SampledBands& samples)
{
  if (memory == 0)
  {
    return makeDem(readAllPoints(points), request, progress, settings, samples);
  }
  if (request.Constraints)
  {
    throw std::invalid_argument(
      "Breaklines and boundaries need all points in memory: leave the memory limit out.");
  }
  return makeWithin(points, request, memory, progress, settings, samples);
}

} // namespace tipp
