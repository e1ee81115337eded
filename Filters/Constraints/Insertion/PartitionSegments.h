// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionSegments_h
#define tippPartitionSegments_h

#include "Arrays/Buffer.h"
#include "Constraints/ConstraintEdges.h"
#include "Triangulation/PointsView.h"
#include "Triangulation/Tiling.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// The positions of the ends of segments, by id. Ends that are not among the points have the ids
/// from Points.size() on.
struct EndPositions
{
  Point2 operator[](PointId id) const
  {
    const std::size_t count = this->Points.size();
    return std::size_t(id) < count ? this->Points[std::size_t(id)]
                                   : this->Others[std::size_t(id) - count];
  }

  PointsView Points;
  std::vector<Point2> Others;
};

/// For each partition, the segments of constraints that meet its box, and perhaps some that pass
/// near it.
class PartitionSegments
{
public:
  PartitionSegments() = default;

  PartitionSegments(const Tiling& tiling, const std::vector<IdSegment>& segments,
    const EndPositions& ends, int threads);

  ///@{
  /// The partition's segments, by their indices, ascending.
  const std::int64_t* begin(PartitionIndex partition) const
  {
    return this->Items.data() + this->Starts[std::size_t(partition)];
  }
  const std::int64_t* end(PartitionIndex partition) const { return this->begin(partition + 1); }
  ///@}

private:
  std::vector<std::size_t> Starts; ///< by partition, and the end of the last one
  Buffer<std::int64_t> Items;
};

} // namespace tipp

#endif
