// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangleSink_h
#define tippTriangleSink_h

#include "Arrays/Buffer.h"
#include "Predicates/Points.h"
#include "Triangulation/BoundaryTriangles.h"
#include "Triangulation/PointBuckets.h"
#include "Triangulation/Triangulate.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
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
  explicit TriangleSink(PointBuckets<Id>& buckets);

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
  static Corners fromLowest(const Corners& ids);

  /// Returns the triangles, three point ids each, in the buckets' memory. `boundary` are several
  /// lists of boundary triangles without artificial corners. Their vertices need not be in the
  /// buckets, so there can be more than two triangles per point.
  Buffer<Id> assemble(const std::vector<std::vector<FinalTriangle>>& boundary, int threads);

private:
  std::vector<Corners> sortBoundary(
    const std::vector<std::vector<FinalTriangle>>& boundary, int threads) const;

  PointBuckets<Id>& Buckets;
  std::vector<std::size_t> InteriorCounts;
};

/// Makes the lowest id of coincident points their representative, even if the triangulation has
/// another of them as a vertex.
class LowestPoints
{
public:
  /// Changes the representatives in `duplicates`.
  explicit LowestPoints(std::vector<Duplicate>& duplicates);

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
void preferLowestIds(Buffer<Id>& ids, std::vector<Duplicate>& duplicates, int threads);

} // namespace tipp

#endif
