// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation3D/MergeClosePoints3.h"

#include "InMemory/HashGrid.h"
#include "Triangulation3D/Tiling3.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tipp
{

Tetrahedralization tetrahedralizeMerged(const Point3* points, std::size_t count, double distance,
  const TetrahedralizationOptions& options)
{
  double largest = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    if (isFinite(points[i]))
    {
      largest = std::max(
        { largest, std::fabs(points[i].x), std::fabs(points[i].y), std::fabs(points[i].z) });
    }
  }
  HashGrid<3> grid(count, distance, largest);
  std::vector<std::int32_t> ids; // original ids of the kept points, ascending
  std::vector<Duplicate> duplicates;
  std::vector<PointId> rejected;
  for (std::size_t i = 0; i < count; ++i)
  {
    const PointId close =
      isFinite(points[i]) ? grid.find({ points[i].x, points[i].y, points[i].z }) : -1;
    if (!isFinite(points[i]))
    {
      rejected.push_back(PointId(i));
    }
    else if (close >= 0)
    {
      duplicates.push_back({ PointId(i), ids[std::size_t(close)] });
    }
    else
    {
      grid.keep({ points[i].x, points[i].y, points[i].z });
      ids.push_back(std::int32_t(i));
    }
  }
  const Buffer<double> kept = grid.takeCoordinates();
  Tetrahedralization mesh = tetrahedralize(kept.as<Point3>(), ids.size(), options);
  // The ids keep their order, so the tetrahedra do, too.
  for (std::int32_t& id : mesh.Ids)
  {
    id = ids[std::size_t(id)];
  }
  mesh.Duplicates = std::move(duplicates);
  mesh.Rejected = std::move(rejected);
  return mesh;
}

} // namespace tipp
