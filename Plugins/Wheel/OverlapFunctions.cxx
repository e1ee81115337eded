// SPDX-License-Identifier: BSD-3-Clause
// Functions over the common parts of surfaces: means over pixels and cells, and volumes.
#include "Binding.h"
#include "MeshRange.h"

#include "Overlap/AddOverlaps.h"
#include "Overlap/CutFill.h"
#include "Parallel/ParallelFor.h"
#include "Predicates/SensibleRange.h"
#include "Sampling/SamplingLattice.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace tipp::python
{
namespace
{

SimplexMesh surfaceOf(
  const InputArray& points, const InputArray& cells, const std::optional<InputArray>& hidden)
{
  SimplexMesh mesh = meshOf(points, cells);
  mesh.Hidden = hidden ? static_cast<const unsigned char*>(hidden->data()) : nullptr;
  return mesh;
}

/// The arrays of a surface, float64, which stay in Python's memory: those of points, then those of
/// cells.
std::vector<OverlapField> fieldsOf(
  const std::vector<NamedArray>& ofPoints, const std::vector<NamedArray>& ofCells)
{
  std::vector<OverlapField> fields;
  for (const bool isOfCells : { false, true })
  {
    for (const auto& [name, array] : isOfCells ? ofCells : ofPoints)
    {
      fields.push_back(
        { static_cast<const double*>(array.data()), int(componentsOf(array)), isOfCells });
    }
  }
  return fields;
}

/// Returns the means of each field, or `null` in targets that are not covered.
nb::list meansOf(const std::vector<OverlapField>& fields, const OverlapSums& sums,
  const std::vector<double>& shares, double null)
{
  nb::list result;
  int first = 0;
  for (const OverlapField& field : fields)
  {
    const std::size_t components = std::size_t(field.Components);
    Buffer<double> means(shares.size() * components);
    sums.copyMeans(first, field.Components, shares, null, means.data(), 0);
    first += field.Components;
    result.append(arrayOf(std::move(means), components));
  }
  return result;
}

/// Returns the lattice as describe() does, the means of the arrays, and the covered share of each
/// pixel.
nb::tuple averagePixels(const InputArray& points, const InputArray& cells,
  const std::optional<InputArray>& hidden, const nb::dict& pointData, const nb::dict& cellData,
  const std::array<double, 6>& bounds, const std::optional<std::array<double, 6>>& pointBounds,
  const std::array<int, 3>& dimensions, const std::array<double, 3>& delta, double nullValue,
  int threads, Progress progress)
{
  Reporter reporter(std::move(progress));
  if (cells.shape(1) != 3)
  {
    throw std::runtime_error(
      "the mesh has cells with a volume, and conservative means are over areas: give a surface.");
  }
  const MeshSamples samples = samplesOf({ bounds, pointBounds, dimensions, delta }, true);
  requirePixels(samples.Grid, samples.Axes);
  const std::vector<NamedArray> pointArrays = namedArrays(pointData, points, "points");
  const std::vector<NamedArray> cellArrays = namedArrays(cellData, cells, "cells");
  OverlapSource source;
  source.Mesh = surfaceOf(points, cells, hidden);
  source.Mesh.Axes[0] = samples.Axes[0];
  source.Mesh.Axes[1] = samples.Axes[1];
  source.Fields = fieldsOf(pointArrays, cellArrays);
  const int components = componentsOf(source.Fields);
  const double pixels = double(samples.Grid.samples());
  requireMemory(pixels, pixels * double(3 * components + 3) * sizeof(double));
  OverlapSums sums(samples.Grid.samples(), components);
  std::vector<double> shares;
  withoutLock(
    [&]
    {
      const int count = threadCount(threads);
      addPixels(samples.Grid, source, sums, count, reporter.function());
      shares = sharesOfPixels(samples.Grid, { samples.Axes[0], samples.Axes[1] }, sums, count);
    });
  reporter.finish();
  return nb::make_tuple(
    describe(samples.Grid), meansOf(source.Fields, sums, shares, nullValue), copyOf(shares));
}

/// Returns the means of the arrays over the target's triangles, and their covered shares.
nb::tuple averageCells(const InputArray& points, const InputArray& cells,
  const std::optional<InputArray>& hidden, const nb::dict& pointData, const nb::dict& cellData,
  const InputArray& targetPoints, const InputArray& targetCells, double nullValue, int threads,
  Progress progress)
{
  Reporter reporter(std::move(progress));
  const std::vector<NamedArray> pointArrays = namedArrays(pointData, points, "points");
  const std::vector<NamedArray> cellArrays = namedArrays(cellData, cells, "cells");
  OverlapSource source;
  source.Mesh = surfaceOf(points, cells, hidden);
  source.Fields = fieldsOf(pointArrays, cellArrays);
  const SimplexMesh target = surfaceOf(targetPoints, targetCells, {});
  OverlapSums sums(target.Cells, componentsOf(source.Fields));
  std::vector<double> shares;
  withoutLock(
    [&]
    {
      const int count = threadCount(threads);
      addOverlaps(target, source, sums, count, reporter.function());
      shares = sharesOfTriangles(target, sums, count);
    });
  reporter.finish();
  return nb::make_tuple(meansOf(source.Fields, sums, shares, nullValue), copyOf(shares));
}

/// Returns cut, fill, the common area and the areas of only one surface; and for each surface the
/// number of triangles that the other one covers more than once.
nb::tuple volumeBetween(const InputArray& points, const InputArray& cells,
  const std::optional<InputArray>& hidden, const InputArray& otherPoints,
  const InputArray& otherCells, const std::optional<InputArray>& otherHidden,
  const std::optional<std::array<double, 4>>& bounds, int threads, Progress progress)
{
  Reporter reporter(std::move(progress));
  const SimplexMesh first = surfaceOf(points, cells, hidden);
  const SimplexMesh second = surfaceOf(otherPoints, otherCells, otherHidden);
  std::optional<Box2> box;
  if (bounds)
  {
    box = boxOfVtkBounds<2>(bounds->data());
  }
  const CutFill result = withoutLock(
    [&]
    {
      CutFillSums sums(first, box, threadCount(threads));
      return sums.add(second, reporter.function()) ? sums.result() : CutFill();
    });
  reporter.finish();
  return nb::make_tuple(
    nb::make_tuple(result.Cut, result.Fill, result.Area, result.OnlyFirst, result.OnlySecond),
    nb::make_tuple(result.CoveredTwice[0], result.CoveredTwice[1]));
}

/// Throws as requireSensible() does, for ranges in VTK's order.
void requireSensibleBounds(
  const std::array<double, 4>& range, const std::array<double, 6>& pointBounds)
{
  const std::array<double, 6> inSpace = { range[0], range[1], range[2], range[3], 0, 0 };
  requireSensible(
    boxOfVtkBounds<3>(inSpace.data()), boxOfVtkBounds<3>(pointBounds.data()), { 0, 1 });
}

std::string boundsInWords(const std::array<double, 6>& bounds)
{
  return inWords(boxOfVtkBounds<3>(bounds.data()));
}

} // namespace

void addOverlapFunctions(nb::module_& module)
{
  module.def("pixel_means", &averagePixels);
  module.def("remap", &averageCells);
  module.def("volume", &volumeBetween);
  module.def("require_sensible", &requireSensibleBounds);
  module.def("bounds_in_words", &boundsInWords);
}

} // namespace tipp::python
