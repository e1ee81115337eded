// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippAlphaShape_h
#define tippAlphaShape_h

#include "Triangulation/Triangulate.h"

#include <functional>
#include <vector>

namespace tipp
{

/// Writes the x, y and z of a point; from any thread.
using PointAt = std::function<void(PointId, double*)>;

/// What is left of a triangulation at a radius: cells of 3, 2 and 1 point ids in a row.
template <typename Id>
struct AlphaShape
{
  Buffer<Id> Triangles; ///< circumradius in space at most alpha; in the order given
  Buffer<Id> Lines;     ///< at most 2 alpha long, in no such triangle; ascending
  Buffer<Id> Vertices;  ///< in neither; ascending
};

/// `covered` has one entry for each point, not 0 for those that can be no vertex (duplicates and
/// rejected points). A triangle without area in space counts as infinitely large.
template <typename Id>
AlphaShape<Id> alphaShape(
  const Buffer<Id>& triangles, const PointAt& pointAt, double alpha, std::vector<char> covered);

extern template AlphaShape<std::int32_t> alphaShape(
  const Buffer<std::int32_t>&, const PointAt&, double, std::vector<char>);
extern template AlphaShape<std::int64_t> alphaShape(
  const Buffer<std::int64_t>&, const PointAt&, double, std::vector<char>);

} // namespace tipp

#endif
