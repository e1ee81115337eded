// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/Insertion/PartitionPieces.h"

#include "Constraints/SegmentTree.h"
#include "Parallel/ParallelFor.h"
#include "Triangulation/PopulatePages.h"

#include <algorithm>
#include <array>
#include <utility>

namespace tipp
{
namespace
{

/// Finds the partitions near pieces.
class PieceFinder
{
public:
  PieceFinder(
    const Tiling& tiling, const std::vector<ConstraintPiece>& pieces, const EndPositions& ends)
    : Tiles(tiling)
    , Finder(tiling)
    , Pieces(pieces)
    , Ends(ends)
    , OfEnd(2 * pieces.size())
  {
  }

  /// Finds the partitions of the ends of pieces [begin, end). Call this before forPartitions().
  void locateEnds(std::size_t begin, std::size_t end)
  {
    constexpr std::size_t group = 128;
    constexpr std::size_t ahead = 32;
    const std::size_t last = end - 1;
    std::array<Point2, 2 * group> ends;
    populatePages(this->OfEnd.data() + 2 * begin, 2 * (end - begin) * sizeof(this->OfEnd[0]));
    for (; begin < end; begin += group)
    {
      const std::size_t count = std::min(group, end - begin);
      for (std::size_t i = 0; i < count; ++i)
      {
        const ConstraintPiece& later = this->Pieces[std::min(begin + i + ahead, last)];
        this->Ends.Points.prefetch(std::size_t(later.A)); // points are anywhere in memory
        this->Ends.Points.prefetch(std::size_t(later.B));
        ends[2 * i] = this->Ends[this->Pieces[begin + i].A];
        ends[2 * i + 1] = this->Ends[this->Pieces[begin + i].B];
      }
      this->Finder.locate(ends.data(), 2 * count, this->OfEnd.data() + 2 * begin);
    }
  }

  /// Calls visit(partition) for each partition near a piece.
  template <typename Visit>
  void forPartitions(std::size_t piece, const Visit& visit) const
  {
    const std::uint32_t first = this->OfEnd[2 * piece];
    const PointId last = std::max(this->Pieces[piece].A, this->Pieces[piece].B);
    if (first == this->OfEnd[2 * piece + 1] && std::size_t(last) < this->Ends.Points.size())
    {
      visit(PartitionIndex(first)); // most pieces; boxes are convex
      return;
    }
    const Point2 a = this->Ends[this->Pieces[piece].A];
    const Point2 b = this->Ends[this->Pieces[piece].B];
    const Box2 box = boxOf(a, b);
    this->Tiles.visitNear(box,
      [&](PartitionIndex p)
      {
        const Box2& tile = this->Tiles.box(p);
        overlap(box, tile) && lineMayMeet(a, b, tile) ? visit(p) : void();
      });
  }

private:
  const Tiling& Tiles;
  const PartitionFinder Finder;
  const std::vector<ConstraintPiece>& Pieces;
  const EndPositions& Ends;
  Buffer<std::uint32_t> OfEnd; ///< the partitions of each piece's A and B
};

} // namespace

PartitionPieces::PartitionPieces(const Tiling& tiling, const std::vector<ConstraintPiece>& pieces,
  const EndPositions& ends, int threads)
{
  const auto partitions = std::size_t(tiling.size());
  PieceFinder finder(tiling, pieces, ends);
  // A stable counting sort. By share of the pieces and partition: at first the number of entries,
  // later the next entry to write.
  std::vector<std::vector<std::size_t>> nextOf(
    std::size_t(threads), std::vector<std::size_t>(partitions, 0));
  parallelFor(threads, threads,
    [&](std::int64_t share)
    {
      const auto [begin, end] = evenShare(pieces.size(), int(share), threads);
      std::vector<std::size_t>& counts = nextOf[std::size_t(share)];
      finder.locateEnds(begin, end);
      for (std::size_t piece = begin; piece < end; ++piece)
      {
        finder.forPartitions(piece, [&](PartitionIndex p) { ++counts[std::size_t(p)]; });
      }
    });
  std::size_t sum = 0;
  this->Starts.reserve(partitions + 1);
  for (std::size_t p = 0; p < partitions; ++p)
  {
    this->Starts.push_back(sum);
    for (std::vector<std::size_t>& next : nextOf)
    {
      sum += std::exchange(next[p], sum);
    }
  }
  this->Starts.push_back(sum);
  this->Items = Buffer<std::int64_t>(sum);
  parallelFor(threads, threads,
    [&](std::int64_t share)
    {
      const auto [begin, end] = evenShare(pieces.size(), int(share), threads);
      std::vector<std::size_t>& next = nextOf[std::size_t(share)];
      const auto [first, last] = evenShare(this->Items.size(), int(share), threads);
      populatePages(this->Items.data() + first, (last - first) * sizeof(this->Items[0]));
      for (std::size_t piece = begin; piece < end; ++piece)
      {
        finder.forPartitions(piece,
          [&](PartitionIndex p) { this->Items[next[std::size_t(p)]++] = std::int64_t(piece); });
      }
    });
}

} // namespace tipp
