// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceOrder_h
#define tippPieceOrder_h

#include "Engine/PartitionOrder.h"
#include "OutOfCore/PiecePlan.h"
#include "OutOfCore/SpillPoints.h"
#include "Triangulation/BoundaryTriangles.h"
#include "Triangulation/Tiling.h"

#include <utility>
#include <vector>

namespace tipp
{

/// The order in which pieces are triangulated, and their partitions. A function of the plan and of
/// which pieces have points, so that every process computes the same one.
///
/// Pieces conflict if partitions of theirs do. They are coloured, too, and come by colour: pieces
/// of one colour have nothing to do with each other, so any number of threads and ranks has work. A
/// piece is a window of the order of partitions.
class VTKTIPPFILTERS_EXPORT PieceOrder
{
public:
  PieceOrder(const PiecePlan& plan, const SpilledPoints& points, int threads);

  /// Pieces with points, in order.
  const std::vector<PartitionIndex>& sequence() const { return this->Sequence; }
  const PartitionOrder& partitions() const { return this->Partitions; }
  /// Of all partitions.
  const Regions& regions() const { return this->Boxes; }
  /// Given once.
  BoundaryTriangles takeInitialMesh() { return std::move(this->InitialMesh); }

private:
  void orderPieces(const PiecePlan& plan);

  Regions Boxes;
  BoundaryTriangles InitialMesh;
  PartitionOrder Partitions;
  std::vector<PartitionIndex> Sequence;
};

} // namespace tipp

#endif
