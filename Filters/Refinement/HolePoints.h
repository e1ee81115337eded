// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippHolePoints_h
#define tippHolePoints_h

#include "Meshes/MeshOptions.h"
#include "Predicates/Geometry.h"
#include "vtkTIPPFiltersModule.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Points in the holes of a mesh, as files of Triangle list them.
struct HolePoints
{
  std::vector<Point2> Points; ///< at most one in each hole
  std::int64_t TooThin = 0;   ///< holes without a point, because doubles have none inside
};

/// Finds a point in each hole: in each bounded part of the plane that no triangle covers.
/// `segments`: pairs of nodes, among them all edges of the border. The triangles are
/// counter-clockwise and do not overlap. One thread.
VTKTIPPFILTERS_EXPORT HolePoints findHolePoints(const NodesView& nodes, TrianglesView triangles,
  const std::vector<std::array<std::int64_t, 2>>& segments);

} // namespace tipp

#endif
