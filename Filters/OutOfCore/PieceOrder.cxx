// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/PieceOrder.h"

#include "Triangulation/InitialMesh.h"

#include <algorithm>
#include <utility>

namespace tipp
{
namespace
{

/// A partition's region is its box: its points have not been read yet.
Regions regionsOf(const PiecePlan& plan, const SpilledPoints& points)
{
  std::vector<Box2> boxes;
  std::vector<char> used;
  for (PartitionIndex p = 0; p < plan.Partitions.size(); ++p)
  {
    boxes.push_back(plan.Partitions.box(p));
    used.push_back(points.count(plan.PieceOf[std::size_t(p)]) > 0);
  }
  return { plan.Partitions, std::move(boxes), std::move(used) };
}

/// None where all partitions conflict.
std::vector<ConflictGraph::Pair> conflictsOfPieces(
  const PartitionOrder& partitions, const std::vector<std::int32_t>& pieceOf)
{
  const ConflictGraph& conflicts = partitions.conflicts();
  std::vector<ConflictGraph::Pair> pairs;
  for (PartitionIndex p = 0; std::size_t(p) < conflicts.size(); ++p)
  {
    const std::int32_t piece = pieceOf[std::size_t(p)];
    for (const PartitionIndex q : conflicts.neighbours(p))
    {
      if (pieceOf[std::size_t(q)] != piece)
      {
        pairs.emplace_back(piece, pieceOf[std::size_t(q)]);
      }
    }
  }
  return pairs;
}

} // namespace

PieceOrder::PieceOrder(const PiecePlan& plan, const SpilledPoints& points, int threads)
  : Boxes(regionsOf(plan, points))
  , InitialMesh(triangulateVertices(this->Boxes, plan.initialVertices(), threads))
  , Partitions(this->Boxes.areUsed(), this->InitialMesh)
{
  for (PartitionIndex piece = plan.pieces() - 1; piece >= 0; --piece)
  {
    if (points.count(piece) > 0)
    {
      this->Sequence.push_back(piece);
    }
  }
  this->orderPieces(plan);
}

void PieceOrder::orderPieces(const PiecePlan& plan)
{
  ConflictGraph conflicts(std::size_t(plan.pieces()));
  conflicts.add(conflictsOfPieces(this->Partitions, plan.PieceOf));
  const std::vector<std::uint32_t> colours = conflicts.colours();
  std::stable_sort(this->Sequence.begin(), this->Sequence.end(),
    [&](PartitionIndex a, PartitionIndex b)
    { return colours[std::size_t(a)] < colours[std::size_t(b)]; });
  std::vector<std::int32_t> positions(std::size_t(plan.pieces()), 0);
  for (std::size_t i = 0; i < this->Sequence.size(); ++i)
  {
    positions[std::size_t(this->Sequence[i])] = std::int32_t(i);
  }
  std::vector<std::int32_t> windows;
  for (const std::int32_t piece : plan.PieceOf)
  {
    windows.push_back(positions[std::size_t(piece)]);
  }
  this->Partitions.setWindows(windows);
}

} // namespace tipp
