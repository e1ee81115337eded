// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/SampleWindow.h"

#include "Parallel/BoundsOf.h"
#include "Resample/SamplingAccess.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace tipp
{
namespace
{

/// The lattice's axes that a mesh is sampled along, in the order of Access::coordinates().
std::array<int, 3> axesOf(const SimplexMesh& mesh)
{
  return mesh.Dimension == 2 ? std::array<int, 3>{ mesh.Axes[0], mesh.Axes[1], -1 }
                             : std::array<int, 3>{ 0, 1, 2 };
}

/// The bounding box of the cells, or of all points if that is faster.
template <typename Access>
auto boundsOfCells(const SimplexMesh& mesh, const Access& access, int threads)
{
  constexpr int D = Access::Dimension;
  // Each part of a mesh may have all points of the whole mesh.
  if (mesh.PointCount <= mesh.Cells * Access::Corners)
  {
    return boundsOf<D>(mesh.PointCount, threads,
      [&](std::int64_t point) { return Box<D>::of(access.coordinates(point)); });
  }
  return boundsOf<D>(mesh.Cells, threads,
    [&](std::int64_t cell)
    {
      Box<D> box = Box<D>::empty();
      for (int i = 0; i < Access::Corners; ++i)
      {
        box.extend(access.coordinates(access.ids(cell)[i]));
      }
      return box;
    });
}

} // namespace

SampleWindow::SampleWindow(const SimplexMesh& mesh, const Lattice& lattice)
  : Part(lattice)
{
  this->measure(mesh);
  this->AllWidth = this->Width;
  this->AllHeight = this->Height;
}

void SampleWindow::measure(const SimplexMesh& mesh)
{
  const std::array<int, 3> axes = axesOf(mesh);
  this->Width = this->Part.size(axes[0]);
  this->Height = this->Part.size(axes[1]);
  this->Layers = mesh.Dimension == 3 ? this->Part.size(axes[2]) : 1;
}

SampleWindow SampleWindow::around(const SimplexMesh& mesh, const Lattice& lattice, int threads)
{
  SampleWindow window(mesh, lattice);
  const std::array<int, 3> axes = axesOf(mesh);
  std::int64_t begins[3] = {};
  withSamplingAccess(mesh,
    [&](const auto& access)
    {
      const auto bounds = boundsOfCells(mesh, access, threads);
      for (std::size_t i = 0; i < access.Dimension; ++i)
      {
        const auto axis = std::size_t(axes[i]);
        // With an infinite error each sample is compared exactly, just as the cells do.
        const LatticeAxis samples(lattice, int(axis));
        const double slack = mesh.Dimension == 2 && samples.Slack > 0
          ? std::max(samples.Slack, roundingOf(bounds.Min[i], bounds.Max[i]))
          : 0;
        const IndexRange found =
          samples.range(bounds.Min[i] - slack, bounds.Max[i] + slack, HUGE_VAL);
        begins[i] = found.Begin;
        const int first = lattice.Extent[2 * axis];
        window.Part.Extent[2 * axis] = first + found.Begin;
        window.Part.Extent[2 * axis + 1] = first + std::max(found.End, found.Begin) - 1;
      }
    });
  window.measure(mesh);
  window.First = (begins[2] * window.AllHeight + begins[1]) * window.AllWidth + begins[0];
  window.Whole = window.Part.Extent == lattice.Extent;
  return window;
}

} // namespace tipp
