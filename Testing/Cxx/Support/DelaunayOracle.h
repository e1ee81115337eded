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

/// Point ids counter-clockwise, starting with the lowest, so that equal triangles compare equal.
using Triangle = std::array<std::int64_t, 3>;
/// Sorted, so that sets of triangles can be compared with ==.
using Triangles = std::vector<Triangle>;
using Ids = std::vector<std::int64_t>;

Triangle canonical(std::int64_t a, std::int64_t b, std::int64_t c);
Triangles sorted(Triangles triangles);

/// The correct triangulation of a point set.
struct Reference
{
  Triangles Mesh;     ///< uses representatives only
  Ids Representative; ///< per point the lowest id with its coordinates, or -1 if not finite
};

/// CGAL's Delaunay_triangulation_2 of the distinct finite points.
Reference reference(const Coordinates& xy);

/// CGAL's Delaunay_triangulation_2 of the points `ids`, which must be distinct.
Triangles delaunay(const Coordinates& xy, const Ids& ids);

} // namespace test
} // namespace tipp

#endif
