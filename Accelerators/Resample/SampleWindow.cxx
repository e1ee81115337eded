// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/SampleWindow.h"

#include "Parallel/ParallelFor.h"
#include "Resample/Lattice.h"

#include <array>
#include <cmath>
#include <vector>

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

template <typename Access>
class CellBounds
{
public:
  static constexpr int D = Access::Dimension;

  explicit CellBounds(const SimplexMesh& mesh)
    : Cells(mesh)
  {
  }

  void add(std::int64_t point)
  {
    double p[D];
    this->Cells.coordinates(point, p);
    for (int axis = 0; axis < D; ++axis)
    {
      // In this order of arguments a NaN counts for nothing: its cells have no samples.
      this->Low[axis] = std::min(this->Low[axis], p[axis]);
      this->High[axis] = std::max(this->High[axis], p[axis]);
    }
  }

  void addCell(std::int64_t cell)
  {
    for (int i = 0; i < Access::Corners; ++i)
    {
      this->add(this->Cells.ids(cell)[i]);
    }
  }

  void add(const CellBounds& other)
  {
    for (int axis = 0; axis < D; ++axis)
    {
      this->Low[axis] = std::min(this->Low[axis], other.Low[axis]);
      this->High[axis] = std::max(this->High[axis], other.High[axis]);
    }
  }

  double Low[3] = { HUGE_VAL, HUGE_VAL, HUGE_VAL };
  double High[3] = { -HUGE_VAL, -HUGE_VAL, -HUGE_VAL };

private:
  Access Cells;
};

template <typename Access>
CellBounds<Access> boundsOf(const SimplexMesh& mesh, int threads)
{
  std::vector<CellBounds<Access>> bounds(
    static_cast<std::size_t>(threads), CellBounds<Access>(mesh));
  // Parts of a mesh may all have the points of the whole.
  const bool byPoints = mesh.PointCount <= mesh.Cells * Access::Corners;
  forChunks(byPoints ? mesh.PointCount : mesh.Cells, 1 << 14, threads, {},
    [&](std::int64_t begin, std::int64_t end, int thread)
    {
      CellBounds<Access> mine(mesh);
      for (std::int64_t i = begin; i < end; ++i)
      {
        byPoints ? mine.add(i) : mine.addCell(i);
      }
      bounds[std::size_t(thread)].add(mine);
    });
  for (const CellBounds<Access>& of : bounds)
  {
    bounds.front().add(of);
  }
  return bounds.front();
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
  withAccess(mesh,
    [&](const auto& access)
    {
      using Access = std::decay_t<decltype(access)>;
      const CellBounds<Access> bounds = boundsOf<Access>(mesh, threads);
      for (int i = 0; i < Access::Dimension; ++i)
      {
        const auto axis = std::size_t(axes[std::size_t(i)]);
        // With such an error samples are looked for one by one, as exactly as cells contain them.
        const IndexRange found =
          LatticeAxis(lattice, int(axis)).range(bounds.Low[i], bounds.High[i], HUGE_VAL);
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
