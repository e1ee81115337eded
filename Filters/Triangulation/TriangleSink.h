// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangleSink_h
#define tippTriangleSink_h

#include "Arrays/Buffer.h"
#include "Parallel/CountingSort.h"
#include "Parallel/ParallelFor.h"
#include "Predicates/Geometry.h"
#include "Triangulation/BoundaryCells.h"
#include "Triangulation/PointBuckets.h"
#include "Triangulation/Triangulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <unordered_map>
#include <vector>

namespace tipp
{

/// Whether a triangle has an edge longer than `length`. Does not depend on the order of the
/// corners.
inline bool hasLongEdge(Point2 a, Point2 b, Point2 c, double length)
{
  const auto isLong = [length](Point2 p, Point2 q)
  {
    const double dx = std::fabs(p.x - q.x);
    const double dy = std::fabs(p.y - q.y);
    // The sum decides for most edges, which are short. Squares could overflow.
    return dx + dy > length && std::hypot(dx, dy) > length;
  };
  return isLong(a, b) || isLong(b, c) || isLong(c, a);
}

/// Keeps the triangles for which isKept(index) is true, in their order. `ids` has three per
/// triangle. Returns the number of triangles left.
template <typename Id, typename IsKept>
std::size_t keepTriangles(Id* ids, std::size_t triangles, const IsKept& isKept)
{
  std::size_t kept = 0;
  for (std::size_t t = 0; t < triangles; ++t)
  {
    if (isKept(t))
    {
      std::copy_n(ids + 3 * t, 3, ids + 3 * kept++);
    }
  }
  return kept;
}

/// Removes the triangles with an edge longer than `length`; `pointOf` returns the coordinates of an
/// id. Otherwise like keepTriangles().
template <typename Id, typename PointOf>
std::size_t dropLongTriangles(Id* ids, std::size_t triangles, double length, const PointOf& pointOf)
{
  return keepTriangles(ids, triangles,
    [&](std::size_t t)
    {
      const Id* const corners = ids + 3 * t;
      return !hasLongEdge(pointOf(corners[0]), pointOf(corners[1]), pointOf(corners[2]), length);
    });
}

/// Assembles the final triangles into one array: the partitions' interior triangles where they were
/// written, and the boundary triangles in the gaps. The order depends only on the points
/// and the partitions, not on the schedule.
template <typename Id>
class TriangleSink
{
public:
  explicit TriangleSink(PointBuckets<Id>& buckets)
    : Buckets(buckets)
    , InteriorCounts(static_cast<std::size_t>(buckets.partitions()), 0)
  {
  }

  void setInteriorCount(PartitionIndex p, std::size_t count)
  {
    this->InteriorCounts[std::size_t(p)] = count;
  }

  std::size_t interiorCount(PartitionIndex p) const { return this->InteriorCounts[std::size_t(p)]; }

  using Corners = std::array<Id, 3>;
  /// A boundary triangle that is final, without artificial corners.
  struct FinalTriangle
  {
    Corners Ids;              ///< point ids, the lowest first
    PartitionIndex Partition; ///< partition of the point with the lowest id
  };
  /// Rotates the corners so that the lowest id is first.
  static Corners fromLowest(const Corners& ids)
  {
    const auto first = std::size_t(std::min_element(ids.begin(), ids.end()) - ids.begin());
    return { ids[first], ids[(first + 1) % 3], ids[(first + 2) % 3] };
  }

  /// Returns the triangles, three point ids each, in the buckets' memory. `boundary` are several
  /// lists of boundary triangles without artificial corners. Their vertices need not be in the
  /// buckets, so there can be more than two triangles per point.
  Buffer<Id> assemble(const std::vector<std::vector<FinalTriangle>>& boundary, int threads)
  {
    const GroupedItems<Corners> sorted = this->sortBoundary(boundary, threads);
    const std::size_t total =
      std::accumulate(this->InteriorCounts.begin(), this->InteriorCounts.end(), sorted.size());
    const std::size_t room = 2 * this->Buckets.size();
    Buffer<Id> ids = this->Buckets.release();
    if (3 * total > ids.size())
    {
      Buffer<Id> larger(3 * total);
      std::copy(ids.begin(), ids.begin() + 3 * room, larger.begin());
      ids = std::move(larger);
    }
    const auto copyTriangle = [&ids](std::size_t to, const Id* corners)
    { std::copy(corners, corners + 3, ids.data() + 3 * to); };
    // Interior triangles beyond the end, last partition first, are moved to the gaps that are left.
    std::size_t donor = this->InteriorCounts.size();
    std::size_t donorAt = 0;
    std::size_t donorBegin = 0;
    const auto nextBeyond = [&]()
    {
      while (donorAt == donorBegin)
      {
        --donor;
        const std::size_t begin = 2 * this->Buckets.start(static_cast<PartitionIndex>(donor));
        donorAt = begin + this->InteriorCounts[donor];
        donorBegin = std::min(std::max(begin, total), donorAt);
      }
      return ids.data() + 3 * --donorAt;
    };
    const Corners* next = sorted.data();
    const Corners* const end = next + sorted.size();
    for (PartitionIndex p = 0; p < this->Buckets.partitions(); ++p)
    {
      const std::size_t gap = 2 * this->Buckets.start(p) + this->InteriorCounts[std::size_t(p)];
      const std::size_t gapEnd = std::min(2 * this->Buckets.start(p + 1), total);
      for (std::size_t at = gap; at < gapEnd; ++at)
      {
        copyTriangle(at, next != end ? (next++)->data() : nextBeyond());
      }
    }
    for (std::size_t at = room; at < total; ++at)
    {
      copyTriangle(at, (next++)->data());
    }
    ids.truncate(3 * total);
    return ids;
  }

private:
  /// The boundary triangles by partition, sorted within each.
  GroupedItems<Corners> sortBoundary(
    const std::vector<std::vector<FinalTriangle>>& boundary, int threads) const
  {
    const std::size_t partitions = this->InteriorCounts.size();
    GroupedItems<Corners> sorted(partitions, 1,
      [&boundary](const auto& visit)
      {
        for (const std::vector<FinalTriangle>& list : boundary)
        {
          for (const FinalTriangle& triangle : list)
          {
            visit(std::size_t(triangle.Partition), triangle.Ids);
          }
        }
      });
    forChunks(std::int64_t(partitions), 16, threads, {},
      [&](std::int64_t begin, std::int64_t end, int)
      {
        for (auto p = std::size_t(begin); p < std::size_t(end); ++p)
        {
          std::sort(sorted.begin(p), sorted.end(p));
        }
      });
    return sorted;
  }

  PointBuckets<Id>& Buckets;
  std::vector<std::size_t> InteriorCounts;
};

/// Makes the lowest id of coincident points their representative, even if the triangulation has
/// another of them as a vertex.
class LowestPoints
{
public:
  /// Changes the representatives in `duplicates`.
  explicit LowestPoints(std::vector<Duplicate>& duplicates)
  {
    for (const Duplicate& duplicate : duplicates)
    {
      if (duplicate.Point < duplicate.Representative)
      {
        PointId& low =
          this->Lowest.emplace(duplicate.Representative, duplicate.Point).first->second;
        low = std::min(low, duplicate.Point);
      }
    }
    if (this->isEmpty())
    {
      return;
    }
    constexpr std::size_t tableSize = 1 << 14;
    this->MayChange.assign(tableSize, 0);
    for (const auto& change : this->Lowest)
    {
      this->MayChange[std::size_t(change.first) % tableSize] = 1;
    }
    for (Duplicate& duplicate : duplicates)
    {
      const PointId low = this->renamed(duplicate.Representative);
      duplicate = { duplicate.Point == low ? duplicate.Representative : duplicate.Point, low };
    }
  }

  bool isEmpty() const { return this->Lowest.empty(); }

  /// Returns the id to use for a vertex in triangles.
  PointId renamed(PointId id) const
  {
    // Few ids change: a small table in the cache avoids most look-ups.
    if (this->isEmpty() || !this->MayChange[std::size_t(id) % this->MayChange.size()])
    {
      return id;
    }
    const auto found = this->Lowest.find(id);
    return found == this->Lowest.end() ? id : found->second;
  }

private:
  std::unordered_map<PointId, PointId> Lowest; ///< by vertex
  std::vector<char> MayChange;                 ///< by id modulo its size
};

/// Applies LowestPoints to the finished triangles and the duplicates, and sorts the duplicates.
template <typename Id>
void preferLowestIds(Buffer<Id>& ids, std::vector<Duplicate>& duplicates, int threads)
{
  const LowestPoints lowest(duplicates);
  forIndices(
    lowest.isEmpty() ? 0 : std::int64_t(ids.size()),
    [&](std::int64_t i)
    {
      const PointId id = ids[std::size_t(i)];
      const PointId renamed = lowest.renamed(id);
      if (renamed != id) // unchanged memory is not written
      {
        ids[std::size_t(i)] = static_cast<Id>(renamed);
      }
    },
    threads);
  std::sort(duplicates.begin(), duplicates.end());
}

} // namespace tipp

#endif
