// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionPieces_h
#define tippPartitionPieces_h

#include "Constraints/Constraint.h"
#include "Triangulation/PointsView.h"
#include "Triangulation/Tiling.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// For each partition, the pieces of constraints that meet its box, and perhaps some that pass near
/// it.
class PartitionPieces
{
public:
  PartitionPieces() = default;

  /// Ends of pieces are ids: indices in `points`, followed by indices in `others`, which are
  /// positions in no partition.
  PartitionPieces(const Tiling& tiling, const std::vector<ConstraintPiece>& pieces,
    PointsView points, const std::vector<Point2>& others, int threads);

  ///@{
  /// The partition's pieces, by their indices, ascending.
  const std::int64_t* begin(PartitionIndex partition) const
  {
    return this->Items.data() + this->Starts[std::size_t(partition)];
  }
  const std::int64_t* end(PartitionIndex partition) const { return this->begin(partition + 1); }
  ///@}

private:
  std::vector<std::size_t> Starts; ///< by partition, and the end of the last one
  std::vector<std::int64_t> Items;
};

} // namespace tipp

#endif
