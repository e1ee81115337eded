// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippAlphaShape3_h
#define tippAlphaShape3_h

#include "Triangulation3D/Tetrahedralize.h"

#include <vector>

namespace tipp
{

/// The alpha shape of a tetrahedralization: cells with 4, 3, 2 and 1 point ids each.
struct AlphaShape3
{
  Buffer<std::int32_t> Tetrahedra;     ///< circumradius at most alpha; in their order
  std::vector<std::int32_t> Triangles; ///< circumradius at most alpha, of no such cell; ascending
  std::vector<std::int32_t> Lines;     ///< edges at most 2 alpha long of none of these; ascending
  std::vector<std::int32_t> Vertices;  ///< points of none of these; ascending
};

/// Computes the alpha shape; `alpha` is in the points' unit of length. A flat cell counts as
/// infinitely large. Duplicates and rejected points are no vertices.
VTKTIPPFILTERS_EXPORT AlphaShape3 alphaShape(
  const Tetrahedralization& mesh, const Point3* points, std::size_t count, double alpha);

/// Returns four values for each tetrahedron: for each corner the index of the tetrahedron across
/// the facet opposite to it, or -1 at the hull.
VTKTIPPFILTERS_EXPORT Buffer<std::int64_t> neighborIds(
  const Tetrahedralization& mesh, std::size_t points);

/// Returns for each of `points` input points the id of its representative: its own id, for a
/// duplicate the representative's, for a rejected point -1.
VTKTIPPFILTERS_EXPORT Buffer<std::int64_t> representativeIds(
  const Tetrahedralization& mesh, std::size_t points);

} // namespace tipp

#endif
