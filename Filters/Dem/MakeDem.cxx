// SPDX-License-Identifier: BSD-3-Clause
#include "Dem/MakeDem.h"

#include "Constraints/OnDisk/ConstrainedPoints.h"
#include "Dem/RasterSink.h"
#include "Dem/SurfaceSink.h"
#include "Files/TemporaryFiles.h"
#include "Parallel/ParallelFor.h"
#include "Resample/SimplexMesh.h"
#include "Vtk/VtkFiles.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <unistd.h>

namespace tipp
{
namespace
{

/// Returns x, y and elevation interleaved, and frees the table's x and y.
std::vector<double> takeXYZ(PointTable& points, const DemBands& bands)
{
  std::vector<double> xyz(3 * points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    xyz[3 * i] = points.XY[2 * i];
    xyz[3 * i + 1] = points.XY[2 * i + 1];
    xyz[3 * i + 2] = bands.HasElevation ? points.Columns[bands.Elevation].Values[i] : 0;
  }
  std::vector<double>().swap(points.XY);
  return xyz;
}

SimplexMesh meshOf(const std::vector<double>& xyz, const Triangulation& triangulation)
{
  SimplexMesh mesh;
  mesh.Points = xyz.data();
  mesh.PointCount = std::int64_t(xyz.size() / 3);
  mesh.Wide = !triangulation.Ids64.empty();
  mesh.Ids =
    mesh.Wide ? static_cast<const void*>(triangulation.Ids64.data()) : triangulation.Ids32.data();
  mesh.Cells = std::int64_t(triangulation.triangleCount());
  return mesh;
}

} // namespace

void requireMemory(const TerrainSettings& settings)
{
  const double each = 8 * double(settings.Bands.Bands.size()) + 1;
  const double needed = each * double(settings.Grid.Columns) * double(settings.Grid.Rows);
  const double memory = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
  if (needed > memory)
  {
    throw std::runtime_error("the raster has " + std::to_string(settings.Grid.Columns) + " x " +
      std::to_string(settings.Grid.Rows) +
      " pixels, more than the memory of this machine: give a " +
      "larger resolution or smaller bounds, or --memory.");
  }
}

void constrain(DemRequest& request, std::optional<ConstraintTable> lines,
  std::optional<ConstraintTable> boundary)
{
  if (!lines && !boundary)
  {
    return;
  }
  TableConstraints& constraints = request.Constraints.emplace();
  constraints.Surface = request.Duplicates;
  if (lines)
  {
    lines->PolygonBegin = lines->Edges.size();
    lines->Holes.clear();
    constraints.Lines = std::move(*lines);
  }
  if (boundary)
  {
    boundary->Height.clear();
    constraints.Boundary = std::move(*boundary);
  }
}

ConstraintTable readBreaklines(const std::string& path)
{
  ConstraintTable lines = readConstraintFile(path);
  isVtkFile(path) ? dropPlainHeights(lines) : void();
  return lines;
}

void dropPlainHeights(ConstraintTable& lines)
{
  std::vector<double>& heights = lines.Height;
  if (std::all_of(heights.begin(), heights.end(), [](double height) { return height == 0; }))
  {
    heights.clear();
  }
}

TerrainSettings makeTerrainSettings(
  const DemRequest& request, const Box2& bounds, const std::vector<std::string>& columns)
{
  TerrainSettings settings;
  settings.Grid =
    makeRasterGrid(request.Raster, { bounds.xmin, bounds.xmax, bounds.ymin, bounds.ymax });
  settings.Bands = findBands(request.Bands, columns);
  settings.Threads = threadCount(request.Threads);
  return settings;
}

OutOfCoreStatistics makeDem(PointTable points, const DemRequest& request,
  const std::function<bool(double)>& progress, TerrainSettings& settings, SampledBands& samples)
{
  const std::vector<std::string> columns = points.names();
  const Box2 bounds = boundsOf(points.XY.data(), 2, points.size());
  if (!(bounds.xmin <= bounds.xmax))
  {
    throw std::runtime_error("there is no point with finite coordinates.");
  }
  requireElevation(request.Duplicates, columns);
  settings = makeTerrainSettings(request, bounds, columns);
  requireMemory(settings);
  OutOfCoreStatistics figures;
  TriangulationOptions options;
  options.Threads = request.Threads;
  options.MaximumEdge = request.MaximumEdge;
  options.Progress = [&progress](double done) { return !progress || progress(0.5 * done); };
  const Triangulation triangulation = request.Constraints
    ? std::move(triangulateTable(points, *request.Constraints, options).Mesh)
    : triangulate(PointsView(points.XY.data(), points.size(), 2), options);
  figures.Points = std::int64_t(points.size());
  figures.WithoutElevation =
    settings.Bands.HasElevation ? countMissing(points.Columns[settings.Bands.Elevation].Values) : 0;
  figures.Triangles = std::int64_t(triangulation.triangleCount());
  figures.Duplicates = std::int64_t(triangulation.Duplicates.size());
  figures.Rejected = std::int64_t(triangulation.Rejected.size());
  figures.Aborted = triangulation.Aborted;
  if (figures.Aborted)
  {
    return figures;
  }
  figures.DisagreeingPositions =
    resolveDuplicates(points, triangulation.Duplicates, request.Duplicates);
  const std::vector<double> xyz = takeXYZ(points, settings.Bands);
  TerrainColumns values;
  for (const PointTable::Column& column : points.Columns)
  {
    values.push_back(column.Values.data());
  }
  const auto report = [&progress](double done) { return !progress || progress(0.5 + 0.3 * done); };
  figures.Aborted = !sampleTerrain(settings, values, meshOf(xyz, triangulation), report, samples);
  return figures;
}

TileSource readFrom(const RasterGrid& grid, const SampledBands& samples)
{
  TileSource source;
  source.Read = [&grid, &samples](
                  const RasterWindow& window, std::vector<std::vector<double>>& values)
  {
    values.resize(samples.Values.size());
    for (std::size_t band = 0; band < values.size(); ++band)
    {
      values[band].resize(std::size_t(window.Columns * window.Rows));
      for (std::int64_t row = 0; row < window.Rows; ++row)
      {
        const double* const from =
          samples.Values[band].data() + (window.Row + row) * grid.Columns + window.Column;
        std::copy_n(from, window.Columns, values[band].data() + row * window.Columns);
      }
    }
  };
  return source;
}

std::int64_t fillTile(const DemBands& bands, std::vector<std::vector<double>>& values)
{
  const auto filled = std::count_if(
    values.front().begin(), values.front().end(), [](double value) { return !std::isnan(value); });
  fillVoids(bands, values);
  return filled;
}

std::vector<const double*> pointersTo(const std::vector<std::vector<double>>& values)
{
  std::vector<const double*> pointers;
  pointers.reserve(values.size());
  for (const std::vector<double>& band : values)
  {
    pointers.push_back(band.data());
  }
  return pointers;
}

std::int64_t writeTiles(RasterWriter& writer, const RasterGrid& grid, const TileSource& tiles,
  const std::function<bool(double)>& progress, int threads, const DemBands& bands)
{
  std::atomic<std::int64_t> filled{ 0 };
  const bool isDone = forChunks(tileCount(grid), 1, threadCount(threads), progress,
    [&](std::int64_t number, std::int64_t, int)
    {
      std::optional<FinishedTile> finished;
      if (tiles.ReadFinished && (finished = tiles.ReadFinished(number)))
      {
        filled += finished->Filled;
        writer.writeEncoded(number, std::move(finished->Encoded));
        return;
      }
      const RasterWindow window = tileOf(grid, number);
      std::vector<std::vector<double>> values;
      tiles.Read(window, values);
      filled += fillTile(bands, values);
      writer.write(window, pointersTo(values));
    });
  return isDone ? filled.load() : -1;
}

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

OutOfCoreStatistics makeWithin(std::unique_ptr<PointStream> points, const DemRequest& request,
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
  if (request.Constraints)
  {
    SurfaceSink surface(*request.Constraints);
    if (needsSurface(*request.Constraints, request.Bands))
    {
      OutOfCoreStatistics made =
        triangulateInto(surface, *points, options, [&](double done) { return report(0.4 * done); });
      if (made.Aborted)
      {
        return made;
      }
      before = 0.4;
    }
    auto constrained = std::make_unique<ConstrainedPoints>(
      std::move(points), *request.Constraints, "the constraints", request.Threads);
    constrained->setSurface(surface.takeValues());
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
  return triangulateInto(sink, *points, options, report);
}

} // namespace

OutOfCoreStatistics makeDem(std::unique_ptr<PointStream> points, const DemRequest& request,
  std::uint64_t memory, const std::function<bool(double)>& progress, TerrainSettings& settings,
  SampledBands& samples)
{
  return memory == 0 ? makeDem(readAllPoints(*points), request, progress, settings, samples)
                     : makeWithin(std::move(points), request, memory, progress, settings, samples);
}

} // namespace tipp
