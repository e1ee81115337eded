// SPDX-License-Identifier: BSD-3-Clause
#include "Binding.h"

#include "Dem/MakeDem.h"
#include "Parallel/ParallelFor.h"
#include "Points/PointStream.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <memory>
#include <optional>
#include <utility>

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

/// Reads a file with read(path), or converts arrays as linesOf(). Returns nothing for None.
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
  return withoutLock([&] { return read(path); });
}

/// Returns an entry of the options, which the Python side has checked.
template <typename Value>
Value of(const nb::dict& options, const char* name)
{
  return nb::cast<Value>(options[name]);
}

DemRequest requestOf(const nb::dict& options)
{
  DemRequest request;
  request.Raster.Resolution = of<double>(options, "resolution");
  request.Raster.Bounds = of<std::optional<std::array<double, 4>>>(options, "bounds");
  request.Raster.Aligned = of<bool>(options, "align");
  request.Bands = of<std::vector<std::string>>(options, "attributes");
  request.MaximumEdge = of<double>(options, "max_edge");
  request.Threads = of<int>(options, "threads");
  request.Duplicates = static_cast<DuplicateRule>(of<int>(options, "duplicates"));
  auto lines = constraintsOf(options["breaklines"], readBreaklines);
  auto boundary = constraintsOf(options["boundary"], readBoundary);
  boundary ? requireClosedBoundary(*boundary) : void();
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
  for (const auto& [name, values] : columns)
  {
    table.Columns.push_back(
      { nb::cast<std::string>(name), vectorOf<double>(nb::cast<InputArray>(values)) });
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
nb::tuple makeRaster(const nb::object& points, const nb::dict& options, nb::object progress)
{
  Reporter reporter(std::move(progress));
  const DemRequest request = requestOf(options);
  const Thinning thinning = thinningOf(options);
  const auto memory = of<std::uint64_t>(options, "memory");
  PointOptions reading = pointOptionsOf(options, request);
  std::unique_ptr<PointStream> stream;
  if (nb::isinstance<nb::tuple>(points))
  {
    const auto pair = nb::cast<nb::tuple>(points);
    stream =
      streamTable(tableOf(nb::cast<InputArray>(pair[0]), nb::cast<nb::dict>(pair[1])), thinning);
  }
  else
  {
    reading.Thin = thinning;
    const auto files = nb::cast<std::vector<std::string>>(points);
    stream = withoutLock([&] { return openPointStream(files, reading); });
  }
  const std::string crs = stream->crs();
  TerrainSettings settings;
  SampledBands samples;
  OutOfCoreStatistics figures;
  try
  {
    figures = withoutLock(
      [&]
      {
        const ThreadLimit limit(request.Threads);
        return makeDem(std::move(stream), request, memory, reporter.function(), settings, samples);
      });
  }
  catch (const UnknownBand& error)
  {
    throw nb::key_error(error.what());
  }
  reporter(1);
  reporter.raiseIfStopped();
  fillVoids(settings.Bands, samples.Values);
  nb::list bands;
  for (std::vector<double>& band : samples.Values)
  {
    bands.append(copyOf(band, std::size_t(settings.Grid.Columns)));
    std::vector<double>().swap(band);
  }
  return nb::make_tuple(bands, tupleOf(settings.Grid), crs, figures.Rejected);
}

/// Returns the west, south, columns and rows of the pixels that cover xmin, xmax, ymin, ymax.
nb::tuple rasterGrid(const std::array<double, 4>& bounds, double resolution, bool isAligned)
{
  RasterRequest request;
  request.Resolution = resolution;
  request.Aligned = isAligned;
  return tupleOf(makeRasterGrid(request, bounds));
}

} // namespace

void addDemFunction(nb::module_& module)
{
  module.def("dem", &makeRaster, nb::arg("points"), nb::arg("options"), nb::arg("progress").none());
  module.def(
    "raster_grid", &rasterGrid, nb::arg("bounds"), nb::arg("resolution"), nb::arg("align"));
}

} // namespace tipp::python
