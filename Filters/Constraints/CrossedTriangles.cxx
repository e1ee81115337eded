// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/CrossedTriangles.h"

#include "Constraints/PartitionConstraints.h"
#include "Constraints/SegmentTree.h"
#include "Constraints/TriangleScan.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <utility>

namespace tipp
{
namespace
{

struct TriangleRange
{
  std::size_t Begin;
  std::size_t End;
  PartitionIndex Partition; ///< whose interior triangles they are, or -1
};

/// The triangles in ranges of a few, without ranges of blocks that only known pieces are near, or
/// none.
std::vector<TriangleRange> makeRanges(std::size_t triangles,
  const std::vector<TriangleBlock>& blocks, const SegmentTree& tree,
  const PartitionConstraints& inserted)
{
  constexpr std::size_t most = TriangleScan<std::int32_t>::MostTriangles;
  constexpr std::size_t each = PartitionConstraints::RangeTriangles;
  static_assert(each <= most, "a range is scanned at once");
  std::vector<TriangleRange> ranges;
  const auto appendOthers = [&ranges](std::size_t begin, std::size_t end)
  {
    constexpr PartitionIndex none = -1;
    for (std::size_t i = begin; i < end; i += most)
    {
      ranges.push_back({ i, std::min(i + most, end), none });
    }
  };
  const auto isNear = [&](const Box2& box, PartitionIndex partition)
  {
    bool isNear = false;
    tree.visitNear(box,
      [&](const SegmentTree::Item& item)
      {
        isNear = !inserted.isKnown(item.Id, partition) && lineMayMeet(item.A, item.B, box);
        return !isNear;
      });
    return isNear;
  };
  std::size_t done = 0;
  for (const TriangleBlock& block : blocks)
  {
    appendOthers(done, block.Begin);
    if (isNear(block.Box, block.Partition))
    {
      std::size_t begin = block.Begin;
      for (const Box2& box : inserted.rangesOf(block.Partition))
      {
        const std::size_t end = std::min(begin + each, block.End);
        if (begin < end && isNear(box, block.Partition))
        {
          ranges.push_back({ begin, end, block.Partition });
        }
        begin = end;
      }
    }
    done = block.End;
  }
  appendOthers(done, triangles);
  return ranges;
}

/// The noted crossings of triangles in blocks; the other triangles have been scanned.
void addNoted(const PartitionConstraints& inserted, const std::vector<TriangleBlock>& blocks,
  ScannedTriangles& found)
{
  for (const PartitionConstraints::Crossing& crossing : inserted.crossings())
  {
    const auto block = std::lower_bound(blocks.begin(), blocks.end(), crossing.Partition,
      [](const TriangleBlock& one, PartitionIndex wanted) { return one.Partition < wanted; });
    if (block != blocks.end() && block->Partition == crossing.Partition &&
      block->Begin + crossing.Triangle < block->End)
    {
      found.Crossings.push_back({ std::int64_t(block->Begin + crossing.Triangle), crossing.Piece });
    }
  }
}

/// By triangle; each once.
CrossedTriangles sorted(ScannedTriangles& found)
{
  std::vector<ScannedTriangles::Crossing>& crossings = found.Crossings;
  std::sort(crossings.begin(), crossings.end());
  crossings.erase(std::unique(crossings.begin(), crossings.end()), crossings.end());
  CrossedTriangles all;
  for (const ScannedTriangles::Crossing& crossing : crossings)
  {
    if (all.Triangles.empty() || all.Triangles.back() != crossing.Triangle)
    {
      all.Triangles.push_back(crossing.Triangle);
      all.Starts.push_back(std::int64_t(all.Pieces.size()));
    }
    all.Pieces.push_back(crossing.Piece);
  }
  all.Starts.push_back(std::int64_t(all.Pieces.size()));
  all.Touches = std::move(found.Touches);
  using Touch = CrossedTriangles::Touch;
  std::sort(all.Touches.begin(), all.Touches.end(),
    [](const Touch& a, const Touch& b)
    { return a.Piece < b.Piece || (a.Piece == b.Piece && a.Vertex < b.Vertex); });
  all.Touches.erase(
    std::unique(all.Touches.begin(), all.Touches.end(),
      [](const Touch& a, const Touch& b) { return a.Piece == b.Piece && a.Vertex == b.Vertex; }),
    all.Touches.end());
  return all;
}

/// The segments of pieces that were not inserted; their Ids are those of pieces.
SegmentTree treeOfOthers(PointsView points, const std::vector<ConstraintPiece>& pieces,
  const PartitionConstraints& inserted)
{
  std::vector<SegmentTree::Item> items;
  for (std::size_t p = 0; p < pieces.size(); ++p)
  {
    if (!inserted.isDone(p))
    {
      items.push_back(
        { points[std::size_t(pieces[p].A)], points[std::size_t(pieces[p].B)], std::int64_t(p) });
    }
  }
  return SegmentTree(std::move(items));
}

} // namespace

template <typename Id>
CrossedTriangles findCrossedTriangles(PointsView points, const Id* corners, std::size_t triangles,
  const std::vector<TriangleBlock>& blocks, const std::vector<ConstraintPiece>& pieces,
  const PartitionConstraints& inserted, int threads)
{
  const SegmentTree tree = treeOfOthers(points, pieces, inserted);
  const std::vector<TriangleRange> ranges = makeRanges(triangles, blocks, tree, inserted);
  std::vector<TriangleScan<Id>> scans(std::size_t(threads), TriangleScan<Id>(points, tree));
  std::vector<ScannedTriangles> parts(static_cast<std::size_t>(threads));
  forChunks(std::int64_t(ranges.size()), 1, threads, {},
    [&](std::int64_t i, std::int64_t, int thread)
    {
      const TriangleRange& range = ranges[std::size_t(i)];
      const auto isKnown = [&](std::int64_t piece)
      { return inserted.isKnown(piece, range.Partition); };
      scans[std::size_t(thread)].scan(
        corners, range.Begin, range.End, isKnown, parts[std::size_t(thread)]);
    });
  ScannedTriangles all;
  all.Touches = inserted.touches();
  addNoted(inserted, blocks, all);
  for (const ScannedTriangles& part : parts)
  {
    all.Crossings.insert(all.Crossings.end(), part.Crossings.begin(), part.Crossings.end());
    all.Touches.insert(all.Touches.end(), part.Touches.begin(), part.Touches.end());
  }
  return sorted(all);
}

template CrossedTriangles findCrossedTriangles(PointsView, const std::int32_t*, std::size_t,
  const std::vector<TriangleBlock>&, const std::vector<ConstraintPiece>&,
  const PartitionConstraints&, int);
template CrossedTriangles findCrossedTriangles(PointsView, const std::int64_t*, std::size_t,
  const std::vector<TriangleBlock>&, const std::vector<ConstraintPiece>&,
  const PartitionConstraints&, int);

} // namespace tipp
