// SPDX-License-Identifier: BSD-3-Clause
#include "IoSubjects.h"

#include "Flat/FlatMesh.h"
#include "Loading/VertexLoader.h"
#include "OpenCL/Devices.h"
#include "Partition/ClassifyCells.h"
#include "Partitioning/MeshTiling.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

namespace tipp
{
namespace benchmark
{
namespace
{

// The first cells of a mesh in memory, like a chunk in partitioning.
struct LoadedCells
{
  LoadedCells(const std::string& path, int threads, std::int64_t most)
  {
    const FlatMesh mesh = openFlatMesh(path);
    this->Corners = mesh.CellSize;
    this->Dimension = mesh.CellSize - 1;
    std::vector<std::int64_t> ids;
    CellReader(mesh, threads).read(0, std::min(most, mesh.Cells.Tuples), ids);
    LoaderOptions options;
    options.Kind = Loader::Mmap;
    options.Threads = threads;
    std::vector<char> raw(ids.size() * mesh.Points.tupleBytes());
    void* const out[] = { raw.data() };
    makeVertexLoader({ mesh.Points }, options)->load(ids.data(), ids.size(), out);
    this->Coordinates.resize(ids.size() * std::size_t(this->Dimension));
    takeCoordinates(mesh.Points, raw.data(), ids.size(), this->Dimension, this->Coordinates.data());
  }

  CellsView view() const
  {
    return { this->Dimension, this->Corners, this->Coordinates.data(),
      this->Coordinates.size() / std::size_t(this->Dimension * this->Corners) };
  }

  Box3 bounds() const
  {
    Box3 box;
    const auto dimension = std::size_t(this->Dimension);
    for (std::size_t axis = 0; axis < dimension; ++axis)
    {
      box.Min[axis] = box.Max[axis] = this->Coordinates[axis];
    }
    for (std::size_t i = 0; i < this->Coordinates.size(); ++i)
    {
      box.Min[i % dimension] = std::min(box.Min[i % dimension], this->Coordinates[i]);
      box.Max[i % dimension] = std::max(box.Max[i % dimension], this->Coordinates[i]);
    }
    return box;
  }

  int Dimension;
  int Corners;
  std::vector<double> Coordinates;
};

double secondsSince(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Nanoseconds per cell in the fastest of `repeat` runs.
double measure(const LoadedCells& cells, const BoxTiling& tiling, const ClassifyOptions& options,
  int repeat, Membership& result)
{
  double best = 0;
  for (int i = 0; i < repeat; ++i)
  {
    const auto start = std::chrono::steady_clock::now();
    result = classifyCells(cells.view(), tiling, options);
    const double seconds = secondsSince(start);
    best = i == 0 ? seconds : std::min(best, seconds);
  }
  return 1e9 * best / double(cells.view().Cells);
}

BoxTiling treeOf(const LoadedCells& cells, std::int64_t threshold, int threads)
{
  const std::int64_t stride = cells.Dimension * cells.Corners;
  CellSource source;
  source.Dimension = cells.Dimension;
  source.Corners = cells.Corners;
  source.Cells = std::int64_t(cells.view().Cells);
  source.Read = [&](std::int64_t first, std::int64_t count, std::vector<double>& coordinates)
  {
    const auto begin = cells.Coordinates.begin() + first * stride;
    coordinates.assign(begin, begin + count * stride);
  };
  TreeOptions options;
  options.Threshold = threshold;
  options.Threads = threads;
  const auto start = std::chrono::steady_clock::now();
  BoxTiling tree = buildTree(source, cells.bounds(), options);
  std::printf("Tree of threshold %lld: %lld leaves, %.2f s\n", (long long)threshold,
    (long long)tree.count(), secondsSince(start));
  return tree;
}

void printRow(const char* name, const BoxTiling& tiling, const LoadedCells& cells,
  const IoArguments& arguments, bool openCl)
{
  ClassifyOptions options;
  options.Threads = arguments.Threads;
  options.Device.Kind = Device::OpenMP;
  Membership onThreads;
  const double threads = measure(cells, tiling, options, arguments.Repeat, onThreads);
  std::printf("%-12s %10lld %10zu %9.1f", name, (long long)tiling.count(),
    onThreads.Borrowers.size(), threads);
  if (openCl)
  {
    options.Device.Kind = Device::OpenCL;
    Membership onDevice;
    // The first run builds the device's kernels and is not counted.
    measure(cells, tiling, options, 1, onDevice);
    const double device = measure(cells, tiling, options, arguments.Repeat, onDevice);
    const bool same = onThreads.Owner == onDevice.Owner &&
      onThreads.BorrowerStart == onDevice.BorrowerStart &&
      onThreads.Borrowers == onDevice.Borrowers;
    std::printf(" %9.1f %6.2fx %s", device, device / threads, same ? "yes" : "NO");
  }
  std::printf("\n");
  std::fflush(stdout);
}

} // namespace

void benchmarkClassify(const IoArguments& arguments)
{
  // The chunk has the largest size that is used to measure loaders.
  const LoadedCells cells(arguments.Meshes[0], arguments.Threads, 4000000);
  const bool openCl = std::any_of(listDevices().begin(), listDevices().end(),
    [](const DeviceDescription& device) { return device.Double; });
  DeviceChoice any;
  any.Kind = Device::OpenCL;
  std::printf("%zu cells; OpenCL: %s. Nanoseconds a cell.\n", cells.view().Cells,
    openCl ? chooseDevice(any, listDevices())->Name.c_str() : "no device");
  const Box3 domain = cells.bounds();
  const BoxTiling tree = treeOf(cells, 100000, arguments.Threads);
  const BoxTiling fine = treeOf(cells, 1000, arguments.Threads);
  std::printf("%-12s %10s %10s %9s %9s %7s %s\n", "tiling", "partitions", "borrowers", "OpenMP",
    "OpenCL", "ratio", "same");
  const int dimension = cells.Dimension;
  printRow("grid:4", BoxTiling::grid(dimension, domain, { 4, 4, 4 }), cells, arguments, openCl);
  printRow("grid:64", BoxTiling::grid(dimension, domain, { 64, 64, 64 }), cells, arguments, openCl);
  printRow("tree:100000", tree, cells, arguments, openCl);
  printRow("tree:1000", fine, cells, arguments, openCl);
}

} // namespace benchmark
} // namespace tipp
