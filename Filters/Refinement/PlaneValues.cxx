// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/PlaneValues.h"

#include "Files/Formats.h"
#include "Locate/BoxTree.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace tipp
{

PlaneValues::~PlaneValues() = default;

std::unique_ptr<PlaneValues> openPlaneValues(
  const std::string& path, const PlaneValuesOptions& options)
{
  const bool isRaster = openerOf(path, Use::Rasters) != Opener::None ||
    (options.RasterBounds && isOpenedBy(path, Opener::Npy));
  return isRaster ? openRasterPlane(path, options) : openPointPlane(path, options);
}

void takeNearest(const SizeLattice& lattice, const std::vector<Point2>& positions,
  const std::vector<double>& given, int threads, const Report& report, std::vector<double>& values)
{
  const BoxTree<2> tree(std::int64_t(positions.size()), threadCount(threads),
    [&positions](std::int64_t i) { return Box2::of(positions[std::size_t(i)]); });
  const auto nearestTo = [&](Point2 node)
  {
    double least = std::numeric_limits<double>::infinity();
    std::int32_t nearest = -1;
    tree.searchNear(node,
      [&](std::int32_t i)
      {
        const Point2 apart = positions[std::size_t(i)] - node;
        const double distance = std::hypot(apart.x, apart.y);
        if (nearest < 0 || distance < least || (distance == least && i < nearest))
        {
          least = distance;
          nearest = i;
        }
        return least;
      });
    return nearest;
  };
  forRows(lattice, threads, report,
    [&](int row)
    {
      for (int column = 0; column < lattice.columns(); ++column)
      {
        double& value = values[lattice.index(column, row)];
        if (std::isnan(value))
        {
          value = given[std::size_t(nearestTo(lattice.at(column, row)))];
        }
      }
    });
}

} // namespace tipp
