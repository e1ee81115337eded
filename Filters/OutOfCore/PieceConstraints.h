// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceConstraints_h
#define tippPieceConstraints_h

#include "Constraints/ConstraintSegments.h"
#include "Constraints/CrossedPart.h"
#include "Constraints/PartitionConstraints.h"
#include "Triangulation/PointsView.h"
#include "Triangulation/Worker.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace tipp
{

/// The segments near a piece that is in memory. Those between its own points are inserted while its
/// partitions are triangulated, if only interior triangles of one partition are in their way.
class PieceConstraints
{
public:
  /// Segments: kept. Points: the piece's, which must outlive this.
  PieceConstraints(ConstraintSegments segments, PointsView points);

  /// An editor for a thread's worker, whose coordinates are those of the points times `factor`.
  std::unique_ptr<PartitionEditor> makeEditor(double factor)
  {
    return this->Inserted.makeEditor(factor);
  }

  /// After the partitions are triangulated: calls take(left) once, with the segments that are not
  /// inserted; it moves triangles that they cross to `part`, whose vertices are numbered from
  /// `first` on. Adds the edges of these triangles that lie on inserted segments.
  void takeCrossed(std::int64_t first, CrossedPart& part,
    const std::function<void(const ConstraintSegments&)>& take) const;

private:
  const ConstraintSegments Segments;
  const PointsView Points;
  const std::vector<ConstraintPiece> Pieces; ///< between two of the points
  PartitionConstraints Inserted;
};

} // namespace tipp

#endif
