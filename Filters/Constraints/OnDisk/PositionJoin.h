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

/// Looks up many positions among the points of a stream, on disk. Positions are sorted into buckets
/// by a hash. So are points that may have one of these positions, as a few bits of the hash tell.
/// Then the buckets are joined one by one. In memory are the bits and one bucket.
class VTKTIPPFILTERS_EXPORT PositionJoin
{
public:
  /// Paths of temporary files begin with `file`. `wanted`: the number of calls of want() that
  /// follow. `columns`: the number of values kept per point. `memory`: in bytes; about an eighth of
  /// it is used.
  PositionJoin(const std::string& file, std::int64_t wanted, std::size_t columns,
    std::uint64_t memory, int threads);

  /// Adds a position to be looked up, which must be finite. `number` identifies it for the caller.
  void want(Point2 position, std::int64_t number);
  /// Call it once, between the last want() and the first add().
  void seal();

  /// Adds the next points of the stream. valueOf(i, column) returns a value of point i.
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

  /// Call it once, after the last point.
  void finish();

  /// The result for one call of want().
  struct Match
  {
    Point2 Position;
    std::int64_t Number;
    std::int64_t First;   ///< number of the first want() with this position
    const double* Values; ///< of the first point at the position; null: no point has it
  };

  /// Calls visit() once per want(); those with equal positions in their order. Requires finish().
  /// May be called several times.
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
  /// Sets four of 64 bits.
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
  std::uint64_t Mask;              ///< for indices of Bits
  std::vector<std::uint64_t> Bits; ///< the filter: a few bits are set for each position
  KeyedRows Positions;             ///< rows of Wanted
  KeyedRows Candidates;            ///< points that passed the filter: x, y and values
};

} // namespace tipp

#endif
