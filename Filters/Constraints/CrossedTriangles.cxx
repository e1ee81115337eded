// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/CrossedTriangles.h"

#include "Arrays/SortUnique.h"
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
};

/// Divides the triangles outside of the blocks into small ranges.
std::vector<TriangleRange> rangesBetween(
  const std::vector<TriangleBlock>& blocks, std::size_t triangles)
{
  constexpr std::size_t most = TriangleScan<std::int32_t>::MostTriangles;
  std::vector<TriangleRange> ranges;
  const auto append = [&ranges](std::size_t begin, std::size_t end)
  {
    for (std::size_t i = begin; i < end; i += most)
    {
      ranges.push_back({ i, std::min(i + most, end) });
    }
  };
  std::size_t done = 0;
  for (const TriangleBlock& block : blocks)
  {
    append(done, block.Begin);
    done = block.End;
  }
  append(done, triangles);
  return ranges;
}

using TriangleCrossing = ScannedTriangles::Crossing;

/// Collects crossings, in the order of triangles, by triangle.
class CrossingLists
{
public:
  void add(const TriangleCrossing& crossing)
  {
    if (this->All.Triangles.empty() || this->All.Triangles.back() != crossing.Triangle)
    {
      this->All.Triangles.push_back(crossing.Triangle);
      this->All.Starts.push_back(std::int64_t(this->All.Pieces.size()));
    }
    this->All.Pieces.push_back(crossing.Piece);
  }

  /// Adds the crossings recorded for a partition's interior triangles.
  void add(const TriangleBlock& block, const PartitionConstraints& inserted)
  {
    for (const auto& [triangle, piece] : inserted.crossingsIn(block.Partition))
    {
      if (block.Begin + triangle < block.End)
      {
        this->add({ std::int64_t(block.Begin + triangle), piece });
      }
    }
  }

  CrossedTriangles finish(std::vector<CrossedTriangles::Touch>&& touches)
  {
    this->All.Starts.push_back(std::int64_t(this->All.Pieces.size()));
    this->All.Touches = std::move(touches);
    sortUnique(this->All.Touches);
    return std::move(this->All);
  }

private:
  CrossedTriangles All;
};

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
  const std::vector<TriangleRange> ranges = rangesBetween(blocks, triangles);
  std::vector<TriangleScan<Id>> scans(std::size_t(threads), TriangleScan<Id>(points, tree));
  std::vector<ScannedTriangles> found(ranges.size());
  forChunks(std::int64_t(ranges.size()), 1, threads, {},
    [&](std::int64_t i, std::int64_t, int thread)
    {
      const TriangleRange& range = ranges[std::size_t(i)];
      ScannedTriangles& here = found[std::size_t(i)];
      scans[std::size_t(thread)].scan(corners, range.Begin, range.End, here);
      std::sort(here.Crossings.begin(), here.Crossings.end());
    });
  std::vector<CrossedTriangles::Touch> touches = inserted.touches();
  CrossingLists lists;
  auto block = blocks.begin();
  const auto addBlocksBefore = [&](std::size_t triangle)
  {
    for (; block != blocks.end() && block->Begin < triangle; ++block)
    {
      lists.add(*block, inserted);
    }
  };
  for (std::size_t i = 0; i < ranges.size(); ++i)
  {
    addBlocksBefore(ranges[i].Begin);
    for (const TriangleCrossing& crossing : found[i].Crossings)
    {
      lists.add(crossing);
    }
    touches.insert(touches.end(), found[i].Touches.begin(), found[i].Touches.end());
  }
  addBlocksBefore(triangles);
  return lists.finish(std::move(touches));
}

template CrossedTriangles findCrossedTriangles(PointsView, const std::int32_t*, std::size_t,
  const std::vector<TriangleBlock>&, const std::vector<ConstraintPiece>&,
  const PartitionConstraints&, const std::vector<std::int64_t>&, int);
template CrossedTriangles findCrossedTriangles(PointsView, const std::int64_t*, std::size_t,
  const std::vector<TriangleBlock>&, const std::vector<ConstraintPiece>&,
  const PartitionConstraints&, const std::vector<std::int64_t>&, int);

} // namespace tipp
