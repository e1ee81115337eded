// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellKey_h
#define tippCellKey_h

#include "Arrays/Random.h"
#include "Predicates/Geometry.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <utility>

namespace tipp
{

/// The key that decides which cell claims a sample: the lowest among the cells that contain it. Its
/// highest four bits are the cell's moveRank() at the sample; the others are a hash of the corners'
/// coordinates, so that the choice among overlapping cells does not depend on the order of cells,
/// ids or pieces. Equal keys mean copies of one cell.
using CellKey = std::uint64_t;

constexpr CellKey noCellKey = ~CellKey(0);

/// The key of a cell with rank 0; its corners may come in any order.
template <int Corners>
CellKey cellKey(const Point3 (&corners)[Corners])
{
  Point3 sorted[Corners];
  std::copy(corners, corners + Corners, sorted);
  for (int i = 0; i < Corners; ++i)
  {
    for (int j = i + 1; j < Corners; ++j)
    {
      if (lexicographicLess(sorted[j], sorted[i]))
      {
        std::swap(sorted[i], sorted[j]);
      }
    }
  }
  std::uint64_t hash = 0;
  for (const Point3& corner : sorted)
  {
    for (const double coordinate : { corner.x, corner.y, corner.z })
    {
      const double value = coordinate + 0.0; // -0 becomes 0
      std::uint64_t bits;
      std::memcpy(&bits, &value, sizeof bits);
      hash = mixBits(hash + bits);
    }
  }
  return hash >> 4;
}

/// The key of a cell of a SimplexAccess.
template <typename Access>
CellKey keyOf(const Access& cells, std::int64_t cell)
{
  Point3 corners[Access::Corners];
  for (int i = 0; i < Access::Corners; ++i)
  {
    corners[i] = cells.point(cells.ids(cell)[i]);
  }
  return cellKey(corners);
}

inline CellKey withRank(CellKey key, int rank)
{
  return (key << 4 >> 4) | (CellKey(rank) << 60);
}

/// moveRank() of a cell that contains a sample is the lowest rank of a symbolic move that takes the
/// sample into the cell's interior. Rank 0 is the move by (e, e^2, e^3) with infinitesimal e. Rank
/// m is that move mirrored along x if bit 0 of m is set, along y if bit 1, and along z if bit 2.
/// `closedOnly` means that no move does. Among the cells at a sample, the one of lowest rank claims
/// it.
constexpr int closedOnly = 8;

/// The rank of a triangle at a sample that is outside of it, but within Lattice::Slack.
constexpr int nearOnly = 9;

/// Exact. The corners are in any order; the triangle has an area. nearOnly if the sample is
/// outside.
int moveRank(const Point2 (&corners)[3], Point2 sample);
/// Exact. The corners are in any order; the tetrahedron has a volume and contains the sample.
int moveRank(const Point3 (&corners)[4], Point3 sample);

} // namespace tipp

#endif
