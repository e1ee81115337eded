// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPositionIndex_h
#define tippPositionIndex_h

#include "Predicates/Geometry.h"
#include "Triangulation/Duplicate.h"
#include "Triangulation/PointsView.h"
#include "vtkTIPPFiltersModule.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace tipp
{

/// A hash table of points by their coordinates.
class PositionIndex
{
public:
  explicit PositionIndex(std::vector<Point2> points);

  const std::vector<Point2>& points() const { return this->Points; }

  /// A hash of the coordinates, all bits of which depend on both.
  static std::uint64_t hashOf(Point2 position)
  {
    // -0 becomes +0, since both are equal.
    const double xy[2] = { position.x + 0.0, position.y + 0.0 };
    std::uint64_t bits[2];
    std::memcpy(bits, xy, sizeof bits);
    std::uint64_t hash = bits[0] * 0x9e3779b97f4a7c15U + bits[1];
    hash ^= hash >> 32;
    hash *= 0xd6e8feb86659fd93U;
    return hash ^ hash >> 32;
  }

  /// The index of the first point with these coordinates, or -1. NaN and infinity are not found.
  std::int64_t find(Point2 position) const;

  /// Calls found(i, index) for each of `count` positions that equals a point. Faster than find()
  /// for each, because memory is prefetched.
  template <typename Found>
  void findAll(const Point2* positions, std::size_t count, const Found& found) const
  {
    constexpr std::size_t group = 32;
    std::array<std::uint64_t, group> hashes;
    for (std::size_t begin = 0; begin < count; begin += group)
    {
      const std::size_t size = std::min(group, count - begin);
      for (std::size_t i = 0; i < size; ++i)
      {
        hashes[i] = hashOf(positions[begin + i]);
        __builtin_prefetch(&this->markOf(hashes[i]));
      }
      for (std::size_t i = 0; i < size; ++i)
      {
        const std::int64_t index =
          this->isMarked(hashes[i]) ? this->lookUp(positions[begin + i], hashes[i]) : -1;
        if (index >= 0)
        {
          found(begin + i, std::size_t(index));
        }
      }
    }
  }

private:
  bool isMarked(std::uint64_t hash) const
  {
    return (this->markOf(hash) >> (hash >> 32 & 7) & 1) != 0;
  }
  std::int64_t lookUp(Point2 position, std::uint64_t hash) const;
  const std::uint8_t& markOf(std::uint64_t hash) const
  {
    return this->Marks[hash >> 35 & (this->Marks.size() - 1)];
  }

  static constexpr std::uint32_t NoPoint = 0xffffffff;

  std::vector<Point2> Points;
  std::vector<std::uint32_t> Slots; ///< point indices, or NoPoint; the size is a power of two
  /// A filter by other bits of the hash, with four bits per slot. It rejects most positions that
  /// are not found, and more of it than of the slots fits into caches.
  std::vector<std::uint8_t> Marks;
};

/// The ids of other points after they have been added to a triangulation's points.
struct MatchedPositions
{
  /// For each other point, the id of the first point equal to it, or a new id. New ids start at the
  /// number of points.
  std::vector<PointId> Ids;
  std::vector<std::size_t> New; ///< the other points that have new ids
};

VTKTIPPFILTERS_EXPORT MatchedPositions matchPositions(PointsView points, PointsView others);

} // namespace tipp

#endif
