// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippAlphaShape_h
#define tippAlphaShape_h

#include "Triangulation/Triangulate.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace tipp
{

/// Writes the x, y and z of a point, given its id, to the array; must be thread-safe.
using PointAt = std::function<void(PointId, double*)>;

/// The alpha shape of triangles or tetrahedra, as lists of cells with 4, 3, 2 and 1 point ids each.
/// A cell is small if its circumradius in 3D is at most alpha; a line, if it is at most 2 alpha
/// long.
template <typename Id>
struct AlphaShape
{
  Buffer<Id> Tetrahedra; ///< the small ones, in their order
  /// The small ones, in their order. Of tetrahedra: the small facets of those that are not small,
  /// unless they are facets of Tetrahedra; sorted.
  Buffer<Id> Triangles;
  Buffer<Id> Lines;    ///< the small edges of cells that are not small and of none above; sorted
  Buffer<Id> Vertices; ///< points of none of the cells above; ascending
};

/// Computes the alpha shape of cells with this number of corners, 3 or 4. `covered` has one entry
/// for each point: not 0 if it cannot be a vertex. A cell without area or volume in 3D counts as
/// infinitely large. `alpha` is in the points' unit of length.
template <std::size_t Corners = 3, typename Id>
AlphaShape<Id> alphaShape(
  const Buffer<Id>& cells, const PointAt& pointAt, double alpha, std::vector<char> covered);

} // namespace tipp

#endif
