// SPDX-License-Identifier: BSD-3-Clause
#include "Dem/MakeDem.h"

#include "Constraints/OnDisk/ConstrainedStream.h"
#include "Constraints/SurfaceValues.h"
#include "Dem/DemRegion.h"
#include "Dem/DemSinks.h"
#include "Dem/RasterTiles.h"
#include "Files/Formats.h"
#include "Files/WorkFolder.h"
#include "InMemory/TriangulateTable.h"
#include "OutOfCore/OutOfCoreTriangulation.h"
#include "OutOfCore/TriangleConsumer.h"
#include "Parallel/ParallelFor.h"
#include "Predicates/SensibleRange.h"
#include "Resample/SimplexMesh.h"
#include "Triangulation/PointsView.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <unistd.h>

namespace tipp
{
namespace
{

void dropInfinite(std::vector<double>& heights)
{
  std::transform(heights.begin(), heights.end(), heights.begin(), heightOf);
}

/// Returns x, y and elevation interleaved, and frees the table's x and y.
std::vector<double> takeXYZ(PointTable& points, const DemBands& bands)
{
  std::vector<double> xyz(3 * points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    xyz[3 * i] = points.XY[2 * i];
    xyz[3 * i + 1] = points.XY[2 * i + 1];
    xyz[3 * i + 2] = bands.Elevation ? points.Columns[*bands.Elevation].Values[i] : 0;
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

/// Throws std::runtime_error if the pixels do not fit into this machine's memory.
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

/// Triangulates out of core in a temporary folder; `taker` receives the triangles.
OutOfCoreStatistics triangulateInto(TriangleConsumer& taker, PointStream& points,
  OutOfCoreOptions options, const std::function<bool(double)>& progress)
{
  const WorkFolder folder = WorkFolder::inSystem();
  options.CountOnly = true;
  options.Consumer = &taker;
  options.Progress = progress;
  return triangulateOutOfCore(points, folder.path() + "/dem", options);
}

DemFigures makeWithin(std::unique_ptr<PointStream> points, const DemRequest& request,
  std::uint64_t memory, const std::function<bool(double)>& progress, TerrainSettings& settings,
  BandValues& samples)
{
  OutOfCoreOptions options;
  options.MemoryLimit = memory;
  options.Threads = request.Threads;
  options.Duplicates = request.Duplicates;
  double finished = 0; // fraction of the progress
  if (request.Constraints)
  {
    SurfaceSink surface(*request.Constraints);
    if (needsSurface(*request.Constraints, request.Bands))
    {
      OutOfCoreStatistics made =
        triangulateInto(surface, *points, options, partOf(progress, 0, 0.4));
      if (made.Aborted)
      {
        return { made };
      }
      finished = 0.4;
    }
    auto constrained = std::make_unique<ConstrainedStream>(
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
    });
  options.MaximumEdge = request.MaximumEdge;
  return { triangulateInto(sink, *points, options, partOf(progress, finished, 1)) };
}

} // namespace

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
    dropInfinite(lines->Height);
    constraints.Lines = std::move(*lines);
  }
  if (boundary)
  {
    boundary->Height.clear();
    constraints.Boundary = std::move(*boundary);
  }
}

ConstraintTable readBreaklines(const std::string& path, int wrap)
{
  ConstraintTable lines = readConstraintFile(path, wrap);
  if (isOpenedBy(path, Opener::Vtk))
  {
    dropPlainHeights(lines);
  }
  return lines;
}

bool haveZeroHeights(const ConstraintTable& lines)
{
  const std::vector<double>& heights = lines.Height;
  return !heights.empty() &&
    std::all_of(heights.begin(), heights.end(), [](double height) { return height == 0; });
}

void dropPlainHeights(ConstraintTable& lines)
{
  if (haveZeroHeights(lines))
  {
    lines.Height.clear();
  }
}

std::vector<double> heightsBelow(
  const ConstraintTable& lines, const PointTable& points, int threads)
{
  const std::size_t column = findElevation(points.names());
  if (column == points.Columns.size())
  {
    return {};
  }
  const PointsView view(points.XY.data(), points.size(), 2);
  TriangulationOptions options;
  options.Threads = threads;
  std::vector<Point2> ends;
  for (std::size_t i = 0; i < lines.XY.size(); i += 2)
  {
    ends.push_back({ lines.XY[i], lines.XY[i + 1] });
  }
  return valuesOnSurface(
    ends, view, triangulate(view, options), { points.Columns[column].Values.data() }, threads)
    .front();
}

namespace
{

/// Returns the part of a box's area that another one covers.
double partCovered(const Box2& box, const Box2& cover)
{
  double part = 1;
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    const double length =
      std::min(box.Max[axis], cover.Max[axis]) - std::max(box.Min[axis], cover.Min[axis]);
    part *= length < 0 ? 0 : length == 0 ? 1 : length / box.width(axis);
  }
  return part;
}

void requireNear(const ConstraintTable& boundary, const Box2& points)
{
  Box2 box = Box2::empty();
  for (std::size_t i = 0; i < boundary.XY.size(); i += 2)
  {
    box.extend(Point2{ boundary.XY[i], boundary.XY[i + 1] });
  }
  if (!boundary.XY.empty() && partCovered(box, points) == 0)
  {
    throw std::runtime_error("the boundary, " + inWords(inSpace(box)) +
      ", is nowhere near the points, " + inWords(inSpace(points)) +
      ". Is it in another coordinate reference system?");
  }
}

} // namespace

TerrainSettings makeTerrainSettings(
  const DemRequest& request, const Box2& bounds, const std::vector<std::string>& columns)
{
  if (bounds.isEmpty())
  {
    throw std::runtime_error("there is no point with finite coordinates.");
  }
  if (request.Raster.Bounds && request.StrictBounds)
  {
    requireSensible(inSpace(*request.Raster.Bounds), inSpace(bounds));
  }
  if (request.Constraints)
  {
    requireNear(request.Constraints->Boundary, bounds);
  }
  TerrainSettings settings;
  settings.Grid = makeRasterGrid(request.Raster, bounds);
  settings.Bands = findBands(request.Bands, columns);
  settings.Threads = threadCount(request.Threads);
  return settings;
}

DemFigures makeDem(PointTable points, const DemRequest& request,
  const std::function<bool(double)>& progress, TerrainSettings& settings, BandValues& samples)
{
  DemFigures figures;
  figures.IsOfPart = request.Region.has_value();
  const std::vector<std::string> columns = points.names();
  const PointsView view(points.XY.data(), points.size(), 2);
  const Box2 bounds = surveyPoints(view, threadCount(request.Threads)).Bounds;
  requireElevation(request.Duplicates, columns);
  figures.NeedsMorePoints = request.Region && bounds.isEmpty();
  if (figures.NeedsMorePoints)
  {
    return figures;
  }
  settings = makeTerrainSettings(request, request.Region.value_or(bounds), columns);
  requireMemory(settings);
  TriangulationOptions options;
  options.Threads = request.Threads;
  options.MaximumEdge = request.Region ? 0 : request.MaximumEdge;
  options.Progress = partOf(progress, 0, 0.5);
  const TableConstraints none;
  Triangulation triangulation = std::move(
    triangulateTable(points, request.Constraints ? *request.Constraints : none, options).Mesh);
  if (request.Region && !triangulation.Aborted)
  {
    figures.NeedsMorePoints =
      !isKnown(view, triangulation, settings.Grid, *request.Region, settings.Threads);
    leaveOutLong(view, request.MaximumEdge, triangulation);
  }
  figures.Points = std::int64_t(points.size());
  figures.WithoutElevation =
    settings.Bands.Elevation ? countMissing(points.Columns[*settings.Bands.Elevation].Values) : 0;
  figures.Triangles = std::int64_t(triangulation.triangleCount());
  figures.Duplicates = std::int64_t(triangulation.Duplicates.size());
  figures.Rejected = std::int64_t(triangulation.Rejected.size());
  figures.Aborted = triangulation.Aborted;
  if (figures.Aborted || figures.NeedsMorePoints)
  {
    return figures;
  }
  figures.DisagreeingPositions =
    resolveDuplicates(points, triangulation.Duplicates, request.Duplicates);
  if (settings.Bands.Elevation)
  {
    dropInfinite(points.Columns[*settings.Bands.Elevation].Values);
  }
  const std::vector<double> xyz = takeXYZ(points, settings.Bands);
  TerrainColumns values;
  for (const PointTable::Column& column : points.Columns)
  {
    values.push_back(column.Values.data());
  }
  figures.Aborted = !sampleTerrain(
    settings, values, meshOf(xyz, triangulation), partOf(progress, 0.5, 0.8), samples);
  return figures;
}

DemFigures makeDem(std::unique_ptr<PointStream> points, const DemRequest& request,
  std::uint64_t memory, const std::function<bool(double)>& progress, TerrainSettings& settings,
  BandValues& samples)
{
  return memory == 0 ? makeDem(readAllPoints(*points), request, progress, settings, samples)
                     : makeWithin(std::move(points), request, memory, progress, settings, samples);
}

namespace
{

DemFigures makeOfPart(const DemFiles& files, const std::optional<Box2>& region, DemRequest request,
  const std::function<bool(double)>& progress, TerrainSettings& settings, BandValues& samples)
{
  PointOptions options = files.Options;
  options.Region = region ? region : options.Region;
  request.Region = region;
  const auto stream = openPointStream(files.Paths, options);
  if (files.Opened)
  {
    files.Opened(*stream);
  }
  PointTable points = readAllPoints(*stream);
  if (files.Read)
  {
    files.Read(points, region.has_value());
  }
  return makeDem(std::move(points), request, progress, settings, samples);
}

} // namespace

DemFigures makeDem(const DemFiles& files, const DemRequest& request,
  const std::function<bool(double)>& progress, TerrainSettings& settings, BandValues& samples)
{
  DemRegion region(files.Paths, files.Options, request.Raster);
  while (true)
  {
    // Constraints change triangles, so that circumdisks prove nothing.
    const auto box = request.Constraints ? std::nullopt : region.box();
    const DemFigures figures = makeOfPart(files, box, request, progress, settings, samples);
    if (!figures.NeedsMorePoints)
    {
      return figures;
    }
    region.grow();
  }
}

} // namespace tipp
