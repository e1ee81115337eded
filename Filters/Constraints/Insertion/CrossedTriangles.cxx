// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/Insertion/CrossedTriangles.h"

#include "Arrays/SortUnique.h"
#include "Constraints/Insertion/PartitionConstraints.h"
#include "Constraints/Insertion/TriangleScan.h"
#include "Constraints/SegmentTree.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <utility>

namespace tipp
{
namespace
{

constexpr PartitionIndex NoPartition = -1;

/// The blocks, and small ranges of the triangles between them, which have NoPartition.
std::vector<TriangleBlock> withGaps(const std::vector<TriangleBlock>& blocks, std::size_t triangles)
{
  constexpr std::size_t most = TriangleScan<std::int32_t>::MostTriangles;
  std::vector<TriangleBlock> all;
  std::size_t done = 0;
  const auto fillUntil = [&](std::size_t end)
  {
    for (; done < end; done = all.back().End)
    {
      all.push_back({ NoPartition, done, std::min(done + most, end) });
    }
  };
  for (const TriangleBlock& block : blocks)
  {
    fillUntil(block.Begin);
    all.push_back(block);
    done = block.End;
  }
  fillUntil(triangles);
  return all;
}

/// A tree of these pieces. An item's Id is the index of the piece.
SegmentTree treeOf(const std::vector<std::int64_t>& some, PointsView points,
  const std::vector<ConstraintPiece>& pieces, int threads)
{
  std::vector<SegmentTree::Item> items(some.size());
  forChunks(std::int64_t(some.size()), SegmentTree::Chunk, threads, {},
    [&](std::int64_t begin, std::int64_t end, int)
    {
      for (auto i = std::size_t(begin); i < std::size_t(end); ++i)
      {
        const ConstraintPiece& piece = pieces[std::size_t(some[i])];
        items[i] = { points[std::size_t(piece.A)], points[std::size_t(piece.B)], some[i] };
      }
    });
  return SegmentTree(std::move(items), threads);
}

} // namespace

template <typename Id>
CrossedTriangles findCrossedTriangles(PointsView points, const Id* corners, std::size_t triangles,
  const std::vector<TriangleBlock>& blocks, const std::vector<ConstraintPiece>& pieces,
  const PartitionConstraints& inserted, const std::vector<std::int64_t>& remaining, int threads)
{
  const SegmentTree tree = treeOf(remaining, points, pieces, threads);
  const std::vector<TriangleBlock> ranges = withGaps(blocks, triangles);
  std::vector<TriangleScan<Id>> scans(std::size_t(threads), TriangleScan<Id>(points, tree));
  std::vector<ScannedTriangles> found(ranges.size());
  forChunks(std::int64_t(ranges.size()), 1, threads, {},
    [&](std::int64_t i, std::int64_t, int thread)
    {
      const TriangleBlock& range = ranges[std::size_t(i)];
      ScannedTriangles& here = found[std::size_t(i)];
      if (range.Partition == NoPartition)
      {
        scans[std::size_t(thread)].scan(corners, range.Begin, range.End, here);
        std::sort(here.Crossings.begin(), here.Crossings.end());
      }
    });
  CrossedTriangles all;
  all.Touches = inserted.touches();
  const auto add = [&all](std::int64_t triangle, std::int64_t piece)
  {
    if (all.Triangles.empty() || all.Triangles.back() != triangle)
    {
      all.Triangles.push_back(triangle);
      all.Starts.push_back(std::int64_t(all.Pieces.size()));
    }
    all.Pieces.push_back(piece);
  };
  for (std::size_t i = 0; i < ranges.size(); ++i)
  {
    const auto& [partition, begin, end] = ranges[i];
    if (partition != NoPartition)
    {
      for (const auto& [triangle, piece] : inserted.crossingsIn(partition))
      {
        const std::int64_t number = std::int64_t(begin) + triangle;
        number < std::int64_t(end) ? add(number, piece) : void();
      }
    }
    for (const CrossedTriangles::Crossing& crossing : found[i].Crossings)
    {
      add(crossing.Triangle, crossing.Piece);
    }
    all.Touches.insert(all.Touches.end(), found[i].Touches.begin(), found[i].Touches.end());
  }
  all.Starts.push_back(std::int64_t(all.Pieces.size()));
  sortUnique(all.Touches);
  return all;
}

template CrossedTriangles findCrossedTriangles(PointsView, const std::int32_t*, std::size_t,
  const std::vector<TriangleBlock>&, const std::vector<ConstraintPiece>&,
  const PartitionConstraints&, const std::vector<std::int64_t>&, int);
template CrossedTriangles findCrossedTriangles(PointsView, const std::int64_t*, std::size_t,
  const std::vector<TriangleBlock>&, const std::vector<ConstraintPiece>&,
  const PartitionConstraints&, const std::vector<std::int64_t>&, int);

} // namespace tipp
