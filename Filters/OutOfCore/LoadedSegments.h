// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLoadedSegments_h
#define tippLoadedSegments_h

#include "Constraints/ConstraintSegments.h"
#include "Constraints/Insertion/CrossedPart.h"
#include "Constraints/Insertion/PartitionConstraints.h"
#include "Ranks/Archive.h"
#include "Triangulation/Dataflow.h"
#include "Triangulation/PointsView.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

namespace tipp
{

/// The constraint segments near a piece that is in memory. A segment between two of its points is
/// inserted while the partitions are triangulated, if it crosses only interior triangles of one
/// partition. Points are identified by their index in the piece.
class LoadedSegments
{
public:
  /// `points` are the piece's points, and must outlive this object. `partitions` divides the piece;
  /// like the kernels, it has the points' coordinates multiplied by `factor`.
  LoadedSegments(
    ConstraintSegments segments, PointsView points, double factor, const Tiling& partitions);

  /// Returns an editor for a thread's worker. This object must outlive it.
  std::unique_ptr<PartitionEditor> makeEditor() { return this->Inserted->makeEditor(); }

  /// Call this when all partitions are triangulated, before the methods below. `representatives`:
  /// for each point that coincides with another one, the point that represents both in triangles.
  void finishInserting(const std::unordered_map<std::int32_t, std::int32_t>& representatives);

  /// Removes the triangles that are crossed by segments not yet inserted, and adds them to `part`,
  /// where vertex ids are indices plus `first`. The other triangles keep their order. `bucket`: the
  /// index in the piece of the partition whose interior triangles these are, or NoPartition.
  /// Returns the number of remaining triangles.
  std::size_t takeCrossed(PartitionIndex bucket, std::int64_t first, std::int32_t* corners,
    std::size_t triangles, CrossedPart& part) const;

  /// Call this after takeCrossed() of all triangles. Adds to `part` the triangles' edges that lie
  /// on segments, and the vertices in the interior of segments.
  void addEdgesAndTouches(std::int64_t first, CrossedPart& part) const;

private:
  const ConstraintSegments Segments;
  const PointsView Points;
  std::vector<IdSegment> ById; ///< the same segments, for PartitionConstraints
  std::unique_ptr<PartitionConstraints> Inserted;
  std::vector<std::int64_t> Remaining; ///< indices of the segments that were not inserted
  ConstraintSegments NotInserted;      ///< these segments
};

} // namespace tipp

#endif
