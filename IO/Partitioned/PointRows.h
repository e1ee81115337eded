// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointRows_h
#define tippPointRows_h

#include "Partitioned/PieceFormat.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace tipp
{

/// The layout of points in rows of 8-byte words: x, y, further columns, and last the global id.
struct PointRowLayout
{
  std::size_t Words = 3;
  int Z = -1; ///< the word that is the third coordinate; -1: it is 0
  /// The word of each of the mesh's point arrays; -1: the representative's id.
  std::vector<int> Attributes;

  std::int64_t id(const double* row) const
  {
    std::int64_t id = 0;
    std::memcpy(&id, row + this->Words - 1, sizeof(id));
    return id;
  }
};

/// A range of triangles: three row indices each.
struct TriangleRange
{
  const std::int32_t* Begin;
  std::size_t Triangles;
};

/// Returns a hash of a triangle's point ids that is independent of which corner comes first.
VTKTIPPIO_EXPORT std::uint64_t hashTriangle(std::int64_t a, std::int64_t b, std::int64_t c);

/// Returns the sum of the triangles' hashes; `rows` are those of their points.
std::uint64_t sumTriangles(
  const TriangleRange& triangles, const double* rows, const PointRowLayout& layout);

/// Copies a row's values of a point array to the array's next tuple.
void copyPoint(const PieceArray& array, const double* row, const PointRowLayout& layout,
  bool isGhost, std::int64_t representative, char* to);

/// Extends the bounds by a row's point; coordinates that are not finite are ignored.
void extendBounds(Bounds& bounds, const double* row, const PointRowLayout& layout);

} // namespace tipp

#endif
