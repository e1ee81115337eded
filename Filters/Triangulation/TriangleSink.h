// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangleSink_h
#define tippTriangleSink_h

#include "Triangulation/BoundaryTriangles.h"
#include "Triangulation/Buffer.h"
#include "Triangulation/PointBuckets.h"
#include "Triangulation/Triangulate.h"

#include <cstdint>
#include <vector>

namespace tipp
{

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

/// Makes the lowest id of coincident points the representative, in the finished triangles and in
/// the duplicates; sorts the duplicates.
template <typename Id>
void preferLowestIds(Buffer<Id>& ids, std::vector<Duplicate>& duplicates, int threads);

extern template class TriangleSink<std::int32_t>;
extern template class TriangleSink<std::int64_t>;
extern template void preferLowestIds(Buffer<std::int32_t>&, std::vector<Duplicate>&, int);
extern template void preferLowestIds(Buffer<std::int64_t>&, std::vector<Duplicate>&, int);

} // namespace tipp

#endif
