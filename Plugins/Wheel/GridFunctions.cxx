// SPDX-License-Identifier: BSD-3-Clause
// Functions that sample meshes on regular grids: rasters of points, and images of meshes.
#include "Binding.h"
#include "MeshRange.h"

#include "Dem/MakeDem.h"
#include "Flat/FlatMesh.h"
#include "Parallel/ParallelFor.h"
#include "Points/ReadPoints.h"
#include "Predicates/SensibleRange.h"
#include "Resample/Resample.h"
#include "Sampling/SampleValues.h"
#include "Sampling/SamplingLattice.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <cstring>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace tipp::python
{
namespace
{

/// Converts (k, 2) coordinates, heights or an empty array, and the (m, 2) ids of the ends of edges.
ConstraintTable linesOf(const nb::object& arrays)
{
  const auto lines = nb::cast<nb::tuple>(arrays);
  ConstraintTable table;
  table.XY = vectorOf<double>(nb::cast<InputArray>(lines[0]));
  table.Height = vectorOf<double>(nb::cast<InputArray>(lines[1]));
  table.Edges = vectorOf<std::array<std::int64_t, 2>>(nb::cast<InputArray>(lines[2]));
  return table;
}

/// Reads a file with read(path, wrap), or converts arrays as linesOf(). Returns nothing for None.
template <typename Read>
std::optional<ConstraintTable> constraintsOf(const nb::object& given, const Read& read)
{
  if (given.is_none())
  {
    return std::nullopt;
  }
  if (!nb::isinstance<nb::str>(given))
  {
    return linesOf(given);
  }
  const auto path = nb::cast<std::string>(given);
  return withoutLock([&] { return read(path, 0); });
}

DemRequest requestOf(const nb::dict& options)
{
  DemRequest request;
  request.Raster.Resolution = of<double>(options, "resolution");
  if (const auto bounds = of<std::optional<std::array<double, 4>>>(options, "bounds"))
  {
    request.Raster.Bounds = boxOfVtkBounds<2>(bounds->data());
    request.StrictBounds = of<bool>(options, "strict_bounds");
  }
  request.Raster.Aligned = of<bool>(options, "align");
  request.Bands = of<std::vector<std::string>>(options, "attributes");
  request.MaximumEdge = of<double>(options, "max_edge");
  request.Threads = of<int>(options, "threads");
  request.Duplicates = static_cast<DuplicateRule>(of<int>(options, "duplicates"));
  auto lines = constraintsOf(options["breaklines"], readBreaklines);
  auto boundary = constraintsOf(options["boundary"], readBoundary);
  if (lines && of<bool>(options, "soft"))
  {
    lines->Height.clear();
  }
  if (boundary)
  {
    requireClosedBoundary(*boundary);
  }
  constrain(request, std::move(lines), std::move(boundary));
  return request;
}

Thinning thinningOf(const nb::dict& options)
{
  Thinning thinning;
  thinning.Cell = of<double>(options, "thin_size");
  thinning.Keep = static_cast<Thinning::Rule>(of<int>(options, "thin_rule"));
  return thinning;
}

PointOptions pointOptionsOf(const nb::dict& options, const DemRequest& request)
{
  PointOptions result;
  result.Columns = columnsForBands(request.Bands);
  result.Threads = request.Threads;
  result.Z = of<std::string>(options, "z");
  result.Layer = of<std::string>(options, "layer");
  result.Crs = of<std::string>(options, "crs");
  result.Las = lasSelection(
    of<std::optional<std::vector<int>>>(options, "classes").value_or(std::vector<int>()),
    of<int>(options, "returns"), of<std::vector<std::string>>(options, "keep"));
  return result;
}

/// Returns a table of points. `xy` has the shape (n, 2); `columns` are values at the points, by
/// name. All are float64.
PointTable tableOf(const InputArray& xy, const nb::dict& columns)
{
  PointTable table;
  table.XY = vectorOf<double>(xy);
  for (const auto& [name, values] : namedArrays(columns, xy, "points"))
  {
    table.Columns.push_back({ name, vectorOf<double>(values) });
  }
  return table;
}

nb::tuple tupleOf(const RasterGrid& grid)
{
  return nb::make_tuple(grid.West, grid.South, grid.Columns, grid.Rows);
}

/// Returns the bands, with rows from south to north; the west, south, columns and rows of the grid;
/// the reference system; and the number of points that are not finite. `points`: names of files, or
/// a tuple of coordinates and columns.
nb::tuple makeRaster(const nb::object& points, const nb::dict& options, Progress progress)
{
  Reporter reporter(std::move(progress));
  const DemRequest request = requestOf(options);
  const Thinning thinning = thinningOf(options);
  const auto memory = of<std::uint64_t>(options, "memory");
  PointOptions reading = pointOptionsOf(options, request);
  std::unique_ptr<PointStream> stream; // null: the points of `files`
  DemFiles files;
  ReferenceSystem system;
  std::vector<TableReport> reports;
  files.Opened = [&](const PointStream& points)
  {
    system = points.referenceSystem();
    reports = points.reports();
  };
  if (nb::isinstance<nb::tuple>(points))
  {
    const auto pair = nb::cast<nb::tuple>(points);
    stream =
      streamTable(tableOf(nb::cast<InputArray>(pair[0]), nb::cast<nb::dict>(pair[1])), thinning);
  }
  else
  {
    reading.Thin = thinning;
    files.Paths = nb::cast<std::vector<std::string>>(points);
    files.Options = reading;
    if (memory > 0)
    {
      stream = withoutLock([&] { return openPointStream(files.Paths, reading); });
      files.Opened(*stream);
    }
  }
  TerrainSettings settings;
  BandValues samples;
  DemFigures figures;
  try
  {
    figures = withoutLock(
      [&]
      {
        const ThreadLimit limit(request.Threads);
        return stream
          ? makeDem(std::move(stream), request, memory, reporter.function(), settings, samples)
          : makeDem(files, request, reporter.function(), settings, samples);
      });
  }
  catch (const UnknownBand& error)
  {
    throw nb::key_error(error.what());
  }
  reporter.finish();
  warnOfFiles(reports, system.Problem);
  fillVoids(settings.Bands, samples);
  nb::list bands;
  for (std::vector<double>& band : samples)
  {
    bands.append(copyOf(band, std::size_t(settings.Grid.Columns)));
    std::vector<double>().swap(band);
  }
  return nb::make_tuple(bands, tupleOf(settings.Grid), system.Text, figures.Rejected);
}

/// Bytes per sample: a 32-bit cell number and the mask.
constexpr double claimBytes = 5;

double bytesOfTuples(const std::vector<NamedArray>& arrays)
{
  double bytes = 0;
  for (const auto& [name, array] : arrays)
  {
    bytes += double(scalarSize(scalarOf(array.dtype()))) * double(componentsOf(array));
  }
  return bytes;
}

/// Returns the lattice as describe() does, the arrays' samples, the mask and warnings.
/// `pointBounds`: those of the points, if the given ones are to be checked against them.
nb::tuple resampleMesh(const InputArray& points, const InputArray& cells,
  const std::optional<InputArray>& hidden, const nb::dict& pointData, const nb::dict& cellData,
  const std::array<double, 6>& givenBounds, const std::optional<std::array<double, 6>>& pointBounds,
  const std::array<int, 3>& given, const std::array<double, 3>& delta, double nullValue,
  const std::string& device, int threads, Progress progress)
{
  Reporter reporter(std::move(progress));
  const bool surface = cells.shape(1) == 3;
  const MeshSamples all = samplesOf({ givenBounds, pointBounds, given, delta }, surface);
  const Lattice& lattice = all.Grid;
  const std::vector<NamedArray> pointArrays = namedArrays(pointData, points, "points");
  const std::vector<NamedArray> cellArrays = namedArrays(cellData, cells, "cells");
  ResampleOptions options;
  options.Device = parseDeviceChoice(device);
  options.Threads = threadCount(threads);
  options.Progress = reporter.function();

  const double count = double(lattice.size(0)) * double(lattice.size(1)) * double(lattice.size(2));
  requireMemory(
    count, count * (bytesOfTuples(pointArrays) + bytesOfTuples(cellArrays) + claimBytes));
  std::vector<Buffer<char>> samples;
  std::vector<Scalar> types;
  std::vector<std::size_t> components;
  std::vector<Attribute> attributes;
  const auto add = [&](const InputArray& values, bool ofCells)
  {
    types.push_back(scalarOf(values.dtype()));
    components.push_back(componentsOf(values));
    samples.emplace_back(
      std::size_t(lattice.samples()) * components.back() * scalarSize(types.back()));
    attributes.push_back({ values.data(), samples.back().data(), types.back(),
      int(components.back()), ofCells, nullValue });
  };
  for (const auto& [name, array] : pointArrays)
  {
    add(array, false);
  }
  for (const auto& [name, array] : cellArrays)
  {
    add(array, true);
  }
  samples.emplace_back(std::size_t(lattice.samples()));
  std::memset(samples.back().data(), 0, samples.back().size());
  options.Valid = samples.back().as<unsigned char>();
  SimplexMesh mesh = meshOf(points, cells);
  mesh.Hidden = hidden ? static_cast<const unsigned char*>(hidden->data()) : nullptr;
  mesh.Axes[0] = all.Axes[0];
  mesh.Axes[1] = all.Axes[1];
  ResampleResult result;
  withoutLock(
    [&]
    {
      result = resample(mesh, lattice, attributes, options);
      // A surface is sampled in a single layer.
      for (Buffer<char>& buffer : samples)
      {
        repeatLayer(buffer.data(), buffer.size(), surface ? std::size_t(lattice.size(2)) : 1);
      }
    });
  reporter.finish();
  nb::list arrays;
  for (std::size_t i = 0; i < types.size(); ++i)
  {
    arrays.append(arrayOf(std::move(samples[i]), types[i], components[i]));
  }
  std::vector<std::string> warnings;
  if (!result.Warning.empty())
  {
    warnings.push_back(result.Warning);
  }
  return nb::make_tuple(
    describe(lattice), arrays, arrayOf(std::move(samples.back()), Scalar::Int8), warnings);
}

} // namespace

MeshSamples samplesOf(const MeshRange& range, bool isSurface)
{
  const Box3 bounds = boxOfVtkBounds<3>(range.Bounds.data());
  const std::array<int, 3>& given = range.Dimensions;
  const bool isChosen = given[0] == 0 || given[1] == 0 || given[2] == 0;
  MeshSamples samples;
  samples.Grid = rangeLattice(
    bounds, isChosen ? chosenDimensions(bounds, given, isSurface) : given, range.Delta);
  samples.Axes = surfaceAxes(
    { int(samples.Grid.size(0)), int(samples.Grid.size(1)), int(samples.Grid.size(2)) });
  if (range.PointBounds)
  {
    requireSensible(bounds, boxOfVtkBounds<3>(range.PointBounds->data()),
      isSurface ? samples.Axes : std::vector<int>{ 0, 1, 2 });
  }
  return samples;
}

nb::tuple describe(const Lattice& lattice)
{
  return nb::make_tuple(
    lattice.Min, lattice.Delta, nb::make_tuple(lattice.size(0), lattice.size(1), lattice.size(2)));
}

void addGridFunctions(nb::module_& module)
{
  module.def("dem", &makeRaster);
  module.def("raster_grid",
    [](const std::array<double, 4>& bounds, double resolution, bool isAligned)
    {
      RasterRequest request;
      request.Resolution = resolution;
      request.Aligned = isAligned;
      return tupleOf(makeRasterGrid(request, boxOfVtkBounds<2>(bounds.data())));
    });
  module.def("resample", &resampleMesh);
  module.def("range_lattice",
    [](const std::array<double, 6>& bounds, const std::array<int, 3>& dimensions,
      const std::array<double, 3>& delta)
    { return describe(rangeLattice(boxOfVtkBounds<3>(bounds.data()), dimensions, delta)); });
}

} // namespace tipp::python
