// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDelaunayOracle_h
#define tippDelaunayOracle_h

#include "PointSets.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tipp
{
namespace test
{

/// Counter-clockwise ids of points, the lowest first: one form for each triangle.
using Triangle = std::array<std::int64_t, 3>;
/// Sorted, so that sets compare with ==.
using Triangles = std::vector<Triangle>;
using Ids = std::vector<std::int64_t>;

Triangle canonical(std::int64_t a, std::int64_t b, std::int64_t c);
Triangles sorted(Triangles triangles);

/// What a triangulation has to give.
struct Reference
{
  Triangles Mesh;     ///< of the points that stand for themselves
  Ids Representative; ///< for each point the lowest id at its place, or -1 if it is not finite
};

/// CGAL's Delaunay_triangulation_2 of the distinct finite points.
Reference reference(const Coordinates& xy);

/// CGAL's Delaunay_triangulation_2 of the points named, which are distinct.
Triangles delaunay(const Coordinates& xy, const Ids& ids);

} // namespace test
} // namespace tipp

#endif
