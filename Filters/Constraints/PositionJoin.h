// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPositionJoin_h
#define tippPositionJoin_h

#include "Constraints/ConstraintPoints.h"
#include "Partitioning/StoredRows.h"
#include "Triangulation/PointsView.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace tipp
{

/// Finds on disk which of many positions points of a stream have. Positions, and the points that
/// may have one of them by a few bits of a hash, are sorted into buckets by that hash; the buckets
/// are then joined one by one. Memory: the bits, and a bucket.
class VTKTIPPFILTERS_EXPORT PositionJoin
{
public:
  /// Temporary files' paths begin with `file`. Wanted: how many calls of want() follow.
  /// Columns: values of a point that are kept. Memory: in bytes; about an eighth is used.
  PositionJoin(const std::string& file, std::int64_t wanted, std::size_t columns,
    std::uint64_t memory, int threads);

  /// A position that is looked for; `number` is the caller's. It must be finite.
  void want(Point2 position, std::int64_t number);
  /// After all want() and before add().
  void seal();

  /// Adds the next points of the stream. valueOf(i, column): of the points.
  template <typename ValueOf>
  void add(PointsView points, const ValueOf& valueOf)
  {
    std::vector<double> row(2 + this->Columns);
    for (const std::size_t i : this->mayMatch(points))
    {
      row[0] = points[i].x;
      row[1] = points[i].y;
      for (std::size_t c = 0; c < this->Columns; ++c)
      {
        row[2 + c] = valueOf(i, c);
      }
      this->Candidates.add(this->bucketOf(points[i]), row.data());
    }
  }

  /// After all points.
  void finish();

  /// A position that was looked for.
  struct Match
  {
    Point2 Position;
    std::int64_t Number;
    std::int64_t First;   ///< the number of the first want() of the position
    const double* Values; ///< of the first point at the position; null: there is none
  };

  /// After finish(): calls visit() for each want(), those of equal positions in their order. May be
  /// called several times.
  void forEachMatch(const std::function<void(const Match&)>& visit) const;

private:
  struct Wanted
  {
    Point2 Position;
    std::int64_t Number;
  };

  std::size_t bucketOf(Point2 position) const
  {
    return (PositionIndex::hashOf(position) >> 24) % MostBuckets % this->Positions.keys();
  }
  std::uint64_t& wordOf(std::uint64_t hash) { return this->Bits[hash >> 32 & this->Mask]; }
  /// Four of 64.
  static std::uint64_t bitsOf(std::uint64_t hash)
  {
    constexpr std::uint64_t one = 1;
    return one << (hash & 63) | one << (hash >> 6 & 63) | one << (hash >> 12 & 63) |
      one << (hash >> 18 & 63);
  }
  std::vector<std::size_t> mayMatch(PointsView points);
  void matchBucket(std::size_t bucket, const std::function<void(const Match&)>& visit) const;

  static constexpr std::size_t MostBuckets = 1024;

  const std::size_t Columns;
  const int Threads;
  std::uint64_t Mask;              ///< of an index in Bits
  std::vector<std::uint64_t> Bits; ///< a few are set for each position
  KeyedRows Positions;             ///< Wanted
  KeyedRows Candidates;            ///< points that may match: x, y and the values
};

} // namespace tipp

#endif
