// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangleSink_h
#define tippTriangleSink_h

#include "Triangulation/Buffer.h"
#include "Triangulation/PointBuckets.h"
#include "Triangulation/SeamTriangles.h"
#include "Triangulation/Triangulate.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// The final triangles in a row: the partitions' interior triangles where they were written, and
/// the seams' in the gaps. The order depends on the points and the partitions alone, not on the
/// schedule.
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
  struct Seam
  {
    Corners Ids;              ///< the lowest first
    PartitionIndex Partition; ///< of that one
  };
  /// The corners in their order, from the lowest id on.
  static Corners fromLowest(const Corners& ids);

  /// Takes the buckets' memory. The seams come in several lists; their vertices must be true
  /// points; some may be points that are not in the buckets, so that there can be more than two
  /// triangles a point.
  Buffer<Id> assemble(const std::vector<std::vector<Seam>>& seams, int threads);

private:
  std::vector<Corners> sortSeams(const std::vector<std::vector<Seam>>& seams, int threads) const;

  PointBuckets<Id>& Buckets;
  std::vector<std::size_t> InteriorCounts;
};

/// Exchanges ids in finished triangles: for each duplicate that is lower than the point which
/// stands for it, and in the duplicates themselves. Sorts these.
template <typename Id>
void preferLowestIds(Buffer<Id>& ids, std::vector<Duplicate>& duplicates, int threads);

extern template class TriangleSink<std::int32_t>;
extern template class TriangleSink<std::int64_t>;
extern template void preferLowestIds(Buffer<std::int32_t>&, std::vector<Duplicate>&, int);
extern template void preferLowestIds(Buffer<std::int64_t>&, std::vector<Duplicate>&, int);

} // namespace tipp

#endif
