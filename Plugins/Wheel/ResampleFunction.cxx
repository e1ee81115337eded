// SPDX-License-Identifier: BSD-3-Clause
#include "Binding.h"

#include "Flat/FlatMesh.h"
#include "Parallel/ParallelFor.h"
#include "Resample/Resample.h"
#include "Sampling/SamplingLattice.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cstring>
#include <optional>

namespace tipp::python
{
namespace
{

/// Bytes per sample: a 32-bit cell number and the mask.
constexpr double claimBytes = 5;

double bytesOfTuples(const std::vector<InputArray>& arrays)
{
  double bytes = 0;
  for (const InputArray& array : arrays)
  {
    bytes += double(scalarSize(scalarOf(array.dtype()))) *
      (array.ndim() > 1 ? double(array.shape(1)) : 1.0);
  }
  return bytes;
}

/// Repeats the single layer in which a surface is sampled along z.
void repeatLayers(const Lattice& lattice, std::vector<Buffer<char>>& samples)
{
  for (Buffer<char>& buffer : samples)
  {
    const std::size_t layer = buffer.size() / std::size_t(lattice.size(2));
    for (std::size_t at = layer; layer > 0 && at < buffer.size(); at += layer)
    {
      std::memcpy(buffer.data() + at, buffer.data(), layer);
    }
  }
}

/// Returns the origin, spacing and numbers of samples.
nb::tuple describe(const Lattice& lattice)
{
  return nb::make_tuple(
    lattice.Min, lattice.Delta, nb::make_tuple(lattice.size(0), lattice.size(1), lattice.size(2)));
}

nb::tuple latticeOf(const std::array<double, 6>& bounds, const std::array<int, 3>& dimensions,
  const std::array<double, 3>& delta)
{
  return describe(rangeLattice(bounds, dimensions, delta));
}

/// Returns the lattice as describe() does, the arrays' samples, the mask and warnings.
nb::tuple resampleMesh(const InputArray& points, const InputArray& cells,
  const std::optional<InputArray>& hidden, const std::vector<InputArray>& pointArrays,
  const std::vector<InputArray>& cellArrays, const std::array<double, 6>& bounds,
  const std::array<int, 3>& given, const std::array<double, 3>& delta, double nullValue,
  const std::string& device, int threads, nb::object progress)
{
  Reporter reporter(std::move(progress));
  const bool surface = cells.shape(1) == 3;
  const bool isChosen = given[0] == 0 || given[1] == 0 || given[2] == 0;
  const std::array<int, 3> dimensions = isChosen ? chosenDimensions(bounds, given, surface) : given;
  const Lattice lattice = rangeLattice(bounds, dimensions, delta);
  const std::vector<int> axes =
    surfaceAxes({ int(lattice.size(0)), int(lattice.size(1)), int(lattice.size(2)) });
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
    components.push_back(values.ndim() > 1 ? values.shape(1) : 1);
    samples.emplace_back(
      std::size_t(lattice.samples()) * components.back() * scalarSize(types.back()));
    attributes.push_back({ values.data(), samples.back().data(), types.back(),
      int(components.back()), ofCells, nullValue });
  };
  for (const InputArray& array : pointArrays)
  {
    add(array, false);
  }
  for (const InputArray& array : cellArrays)
  {
    add(array, true);
  }
  samples.emplace_back(std::size_t(lattice.samples()));
  std::memset(samples.back().data(), 0, samples.back().size());
  options.Valid = samples.back().as<unsigned char>();
  SimplexMesh mesh = meshOf(points, cells);
  mesh.Hidden = hidden ? static_cast<const unsigned char*>(hidden->data()) : nullptr;
  mesh.Axes[0] = axes[0];
  mesh.Axes[1] = axes[1];
  ResampleResult result;
  withoutLock(
    [&]
    {
      result = resample(mesh, lattice, attributes, options);
      surface ? repeatLayers(lattice, samples) : void();
    });
  reporter(1);
  reporter.raiseIfStopped();
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

void addResampleFunction(nb::module_& module)
{
  module.def("resample", &resampleMesh, nb::arg("points"), nb::arg("cells"),
    nb::arg("hidden").none(), nb::arg("point_arrays"), nb::arg("cell_arrays"), nb::arg("bounds"),
    nb::arg("dimensions"), nb::arg("delta"), nb::arg("null_value"), nb::arg("device"),
    nb::arg("threads"), nb::arg("progress").none());
  module.def(
    "range_lattice", &latticeOf, nb::arg("bounds"), nb::arg("dimensions"), nb::arg("delta"));
}

} // namespace tipp::python
