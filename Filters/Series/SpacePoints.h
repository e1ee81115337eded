// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSpacePoints_h
#define tippSpacePoints_h

#include "Parallel/ParallelFor.h"
#include "Resample/SimplexMesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// The nodes of a mesh in the plane, with z = 0 as SimplexMesh has them.
class SpacePoints
{
public:
  /// `xy`: x and y interleaved.
  SpacePoints(const std::vector<double>& xy, int threads)
    : XYZ(xy.size() / 2 * 3)
  {
    forIndices(
      std::int64_t(xy.size() / 2),
      [&](std::int64_t i)
      {
        this->XYZ[3 * std::size_t(i)] = xy[2 * std::size_t(i)];
        this->XYZ[3 * std::size_t(i) + 1] = xy[2 * std::size_t(i) + 1];
      },
      threads);
  }

  /// A view of triangles of these nodes. The arguments and this must outlive it.
  SimplexMesh meshOf(const std::vector<std::int64_t>& triangles) const
  {
    SimplexMesh mesh;
    mesh.Points = this->XYZ.data();
    mesh.PointCount = std::int64_t(this->XYZ.size() / 3);
    mesh.Ids = triangles.data();
    mesh.Wide = true;
    mesh.Cells = std::int64_t(triangles.size() / 3);
    return mesh;
  }

private:
  std::vector<double> XYZ;
};

} // namespace tipp

#endif
