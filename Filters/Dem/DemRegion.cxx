// SPDX-License-Identifier: BSD-3-Clause
#include "Dem/DemRegion.h"

#include "Files/Formats.h"
#include "Las/LasHeader.h"
#include "Parallel/ParallelFor.h"
#include "Predicates/Circumball.h"
#include "Predicates/ExactPredicates.h"
#include "Predicates/ExactPredicates3.h"
#include "Resample/Lattice.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace tipp
{
namespace
{

/// Returns the box of the pixels' centres, with those positions that count as theirs by rounding.
Box2 centresOf(const RasterGrid& grid)
{
  const Lattice lattice = latticeOf(grid);
  Box2 box;
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    const double last = gridPosition(axis == 0 ? grid.West : grid.South, grid.Pixel[axis],
      2 * (axis == 0 ? grid.Columns : grid.Rows) - 1);
    box.Min[axis] = lattice.Min[axis] - 2 * lattice.Slack[axis];
    box.Max[axis] = last + 2 * lattice.Slack[axis];
  }
  return box;
}

Box2 grown(const Box2& box, double margin)
{
  return { { box.Min.x - margin, box.Min.y - margin }, { box.Max.x + margin, box.Max.y + margin } };
}

bool contains(Point2 a, Point2 b, Point2 c, Point2 p)
{
  return orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 && orientation(c, a, p) >= 0;
}

/// Checks the triangles that meet the box of a raster's pixels.
class RegionProof
{
public:
  RegionProof(PointsView points, const RasterGrid& grid, const Box2& region)
    : Points(points)
    , Raster(centresOf(grid))
    , Region(region)
    , Corners{ this->Raster.Min, { this->Raster.Max.x, this->Raster.Min.y }, this->Raster.Max,
      { this->Raster.Min.x, this->Raster.Max.y } }
  {
  }

  template <typename Ids>
  void check(const Ids& ids, int threads)
  {
    forChunks(std::int64_t(ids.size() / 3), 1 << 12, threads, {},
      [&](std::int64_t begin, std::int64_t end, int)
      {
        for (std::int64_t t = begin; t < end && this->AreFinal; ++t)
        {
          const auto* const corners = ids.data() + 3 * t;
          this->check(this->Points[std::size_t(corners[0])], this->Points[std::size_t(corners[1])],
            this->Points[std::size_t(corners[2])]);
        }
      });
  }

  bool holds() const
  {
    return this->AreFinal &&
      std::all_of(this->IsCovered.begin(), this->IsCovered.end(),
        [](const std::atomic<bool>& isCovered) { return isCovered.load(); });
  }

private:
  void check(Point2 a, Point2 b, Point2 c)
  {
    if (!triangleMeetsBox(a, b, c, inSpace(this->Raster)))
    {
      return;
    }
    if (!Circumdisk(a, b, c).inside(this->Region))
    {
      this->AreFinal = false;
      return;
    }
    for (std::size_t i = 0; i < this->Corners.size(); ++i)
    {
      if (contains(a, b, c, this->Corners[i]))
      {
        this->IsCovered[i] = true;
      }
    }
  }

  const PointsView Points;
  const Box2 Raster;
  const Box2 Region;
  const std::array<Point2, 4> Corners; ///< of the raster's box
  std::atomic<bool> AreFinal{ true };  ///< all triangles that meet it belong to all points
  std::array<std::atomic<bool>, 4> IsCovered{};
};

} // namespace

DemRegion::DemRegion(
  const std::vector<std::string>& paths, const PointOptions& options, const RasterRequest& request)
{
  const bool isLas = std::all_of(paths.begin(), paths.end(),
    [](const std::string& path) { return isOpenedBy(path, Opener::Las); });
  if (!isLas || (!request.Bounds && !request.Like) || options.Thin.isGiven() || options.Wrap > 0 ||
    options.Region || options.Spacing > 0)
  {
    return;
  }
  this->All = Box2::empty();
  double points = 0;
  for (const std::string& path : paths)
  {
    const LasHeader header = readLasHeader(path, options.Las);
    if (header.Bounds.isEmpty())
    {
      return;
    }
    this->All.extend(header.Bounds);
    points += double(header.Points);
  }
  if (request.Bounds && !this->All.contains(*request.Bounds))
  {
    return; // no triangle covers some of the pixels
  }
  const RasterGrid grid = makeRasterGrid(request, this->All);
  this->Raster = centresOf(grid);
  const double area = this->All.width(0) * this->All.width(1);
  constexpr double spacings = 8; // of points; most circumdisks are much smaller
  constexpr double pixels = 4;
  this->Margin = std::max(spacings * std::sqrt(area / std::max(points, 1.0)),
    pixels * std::max(grid.Pixel[0], grid.Pixel[1]));
  this->choose();
}

void DemRegion::choose()
{
  constexpr double most = 0.25; // of the area: reading as much in vain takes a third longer
  this->Box = grown(this->Raster, this->Margin);
  double part = 1;
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    part *= (std::min(this->Box->Max[axis], this->All.Max[axis]) -
              std::max(this->Box->Min[axis], this->All.Min[axis])) /
      this->All.width(axis);
  }
  // False for NaN. A raster that leaves the bounds is not covered by triangles.
  if (!(this->All.contains(this->Raster) && part <= most))
  {
    this->Box.reset();
  }
}

void DemRegion::grow()
{
  constexpr double factor = 4;
  this->Margin *= factor;
  this->choose();
}

Box2 DemRegion::around(const RasterRequest& request, double spacing)
{
  constexpr double spacings = 8;
  return grown(centresOf(makeRasterGrid(request, Box2())), spacings * spacing);
}

bool isKnown(PointsView points, const Triangulation& mesh, const RasterGrid& grid,
  const Box2& region, int threads)
{
  RegionProof proof(points, grid, region);
  mesh.Ids64.empty() ? proof.check(mesh.Ids32, threads) : proof.check(mesh.Ids64, threads);
  return proof.holds();
}

} // namespace tipp
