// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceConstraints_h
#define tippPieceConstraints_h

#include "Constraints/ConstraintSegments.h"
#include "Constraints/CrossedPart.h"
#include "Constraints/PartitionConstraints.h"
#include "Triangulation/PointsView.h"
#include "Triangulation/Worker.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace tipp
{

/// The segments near a piece that is in memory. Those between its own points are inserted while its
/// partitions are triangulated, if only interior triangles of one partition are in their way.
class PieceConstraints
{
public:
  /// Points: the piece's, which must outlive this.
  PieceConstraints(ConstraintSegments segments, PointsView points);

  /// An editor for a thread's worker, whose coordinates are those of the points times `factor`.
  std::unique_ptr<PartitionEditor> makeEditor(double factor)
  {
    return this->Inserted->makeEditor(factor);
  }

  /// Call it when all partitions are triangulated, before the following.
  void finishInserting();

  /// Removes the triangles that segments cross which are not inserted, keeps the order of the
  /// others, and adds them to `part`; vertices are numbered from `first` on. Partition: whose
  /// interior triangles they are, or -1. Returns the number of triangles that are left.
  std::size_t takeCrossed(PartitionIndex partition, std::int64_t first, std::int32_t* corners,
    std::size_t triangles, CrossedPart& part) const;

  /// After takeCrossed() of all triangles: adds their edges that lie on segments, and the vertices
  /// in the interior of segments.
  void addEdgesAndTouches(std::int64_t first, CrossedPart& part) const;

private:
  bool isUnknownNear(PartitionIndex partition) const;

  const ConstraintSegments Segments;
  const PointsView Points;
  std::vector<ConstraintPiece> Pieces; ///< segments with an end among the points
  std::unique_ptr<PartitionConstraints> Inserted;
  ConstraintSegments Left;             ///< segments that are not inserted
  std::vector<std::int64_t> LeftPiece; ///< of these, the number among Pieces, or -1
  std::vector<std::int64_t> LeftOf;    ///< of each of Pieces, its number in Left, or -1
};

} // namespace tipp

#endif
