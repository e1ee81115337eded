// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippAlphaShape_h
#define tippAlphaShape_h

#include "Triangulation/Triangulate.h"

#include <functional>
#include <vector>

namespace tipp
{

/// Writes the x, y and z of a point, given its id, to the array; must be thread-safe.
using PointAt = std::function<void(PointId, double*)>;

/// The alpha shape of a triangulation: cells with 3, 2 and 1 point ids each, concatenated.
template <typename Id>
struct AlphaShape
{
  Buffer<Id> Triangles; ///< triangles whose circumradius in 3D is at most alpha; in input order
  Buffer<Id> Lines;     ///< edges at most 2 alpha long that belong to no such triangle; ascending
  Buffer<Id> Vertices;  ///< points in neither; ascending
};

/// Returns for each of `points` points 1 if it is a duplicate or rejected, else 0.
std::vector<char> coveredPoints(const Triangulation& triangulation, std::int64_t points);

/// Computes the alpha shape. `covered` has one entry for each point: not 0 if it cannot be a
/// vertex. A triangle without area in 3D counts as infinitely large. `alpha` is in the points' unit
/// of length.
template <typename Id>
AlphaShape<Id> alphaShape(
  const Buffer<Id>& triangles, const PointAt& pointAt, double alpha, std::vector<char> covered);

} // namespace tipp

#endif
