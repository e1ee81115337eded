// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellKey_h
#define tippCellKey_h

#include "Predicates/Point3.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <utility>

namespace tipp
{

/// Of the cells that contain a sample, the one with the lowest key claims it. A key's highest four
/// bits are the cell's moveRank() at the sample; the others are a hash of its corners' coordinates,
/// so that the choice between overlapping cells does not depend on order, ids and pieces. Equal
/// keys mean copies of one cell.
using CellKey = std::uint64_t;

constexpr CellKey noCellKey = ~CellKey(0);

inline std::uint64_t scramble(std::uint64_t x)
{
  // The finaliser of SplitMix64: Steele, Lea, Flood, Fast Splittable Pseudorandom Number
  // Generators, 2014.
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

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
      lexicographicLess(sorted[j], sorted[i]) ? std::swap(sorted[i], sorted[j]) : void();
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
      hash = scramble(hash + 0x9e3779b97f4a7c15u + bits);
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

} // namespace tipp

#endif
