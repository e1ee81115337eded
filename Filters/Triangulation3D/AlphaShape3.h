// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippAlphaShape3_h
#define tippAlphaShape3_h

#include "Triangulation3D/Tetrahedralize.h"

#include <vector>

namespace tipp
{

/// The alpha shape of a tetrahedralization, as lists of cells with 4, 3, 2 and 1 point ids each.
/// All ids are indices of input points.
struct AlphaShape3
{
  /// Circumradius at most alpha; in the order of the tetrahedralization.
  Buffer<std::int32_t> Tetrahedra;
  /// Circumradius at most alpha, not a facet of Tetrahedra; sorted.
  std::vector<std::int32_t> Triangles;
  std::vector<std::int32_t> Lines; ///< at most 2 alpha long, not an edge of the cells above; sorted
  std::vector<std::int32_t> Vertices; ///< points of none of the cells above; ascending
};

/// Computes the alpha shape of `mesh`, whose ids are indices into the `count` points. `alpha` is in
/// the points' unit of length. A flat cell counts as infinitely large. Duplicates and rejected
/// points are no vertices.
VTKTIPPFILTERS_EXPORT AlphaShape3 alphaShape(
  const Tetrahedralization& mesh, const Point3* points, std::size_t count, double alpha);

/// Returns four values per tetrahedron, one for each corner: the index of the tetrahedron across
/// the facet opposite to the corner, or -1 at the hull. `points`: the number of input points.
VTKTIPPFILTERS_EXPORT Buffer<std::int64_t> neighborIds(
  const Tetrahedralization& mesh, std::size_t points);

/// Returns for each of the `points` input points the id of its representative: its own id for a
/// vertex, the representative's for a duplicate, -1 for a rejected point.
VTKTIPPFILTERS_EXPORT Buffer<std::int64_t> representativeIds(
  const Tetrahedralization& mesh, std::size_t points);

} // namespace tipp

#endif
