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

/// The crossings recorded for triangles in blocks, ascending.
std::vector<TriangleCrossing> notedIn(
  const std::vector<TriangleBlock>& blocks, const PartitionConstraints& inserted)
{
  std::vector<TriangleCrossing> noted;
  for (const TriangleBlock& block : blocks)
  {
    for (const auto& [triangle, piece] : inserted.crossingsIn(block.Partition))
    {
      if (block.Begin + triangle < block.End)
      {
        noted.push_back({ std::int64_t(block.Begin + triangle), piece });
      }
    }
  }
  return noted;
}

/// Merges sorted lists into one.
std::vector<TriangleCrossing> merged(std::vector<std::vector<TriangleCrossing>> lists)
{
  for (std::size_t step = 1; step < lists.size(); step *= 2)
  {
    for (std::size_t i = 0; i + step < lists.size(); i += 2 * step)
    {
      std::vector<TriangleCrossing> both(lists[i].size() + lists[i + step].size());
      std::merge(lists[i].begin(), lists[i].end(), lists[i + step].begin(), lists[i + step].end(),
        both.begin());
      lists[i] = std::move(both);
      std::vector<TriangleCrossing>().swap(lists[i + step]);
    }
  }
  return std::move(lists.front());
}

/// Groups sorted crossings by triangle.
CrossedTriangles listed(
  std::vector<TriangleCrossing>&& crossings, std::vector<CrossedTriangles::Touch>&& touches)
{
  crossings.erase(std::unique(crossings.begin(), crossings.end()), crossings.end());
  CrossedTriangles all;
  all.Pieces.reserve(crossings.size());
  for (const TriangleCrossing& crossing : crossings)
  {
    if (all.Triangles.empty() || all.Triangles.back() != crossing.Triangle)
    {
      all.Triangles.push_back(crossing.Triangle);
      all.Starts.push_back(std::int64_t(all.Pieces.size()));
    }
    all.Pieces.push_back(crossing.Piece);
  }
  all.Starts.push_back(std::int64_t(all.Pieces.size()));
  all.Touches = std::move(touches);
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

/// A tree of the pieces that have not been inserted. An item's Id is the index of the piece.
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
  const std::vector<TriangleRange> ranges = rangesBetween(blocks, triangles);
  std::vector<TriangleScan<Id>> scans(std::size_t(threads), TriangleScan<Id>(points, tree));
  std::vector<ScannedTriangles> parts(static_cast<std::size_t>(threads));
  forChunks(std::int64_t(ranges.size()), 1, threads, {},
    [&](std::int64_t i, std::int64_t, int thread)
    {
      const TriangleRange& range = ranges[std::size_t(i)];
      ScannedTriangles& part = parts[std::size_t(thread)];
      const auto before = std::ptrdiff_t(part.Crossings.size());
      scans[std::size_t(thread)].scan(corners, range.Begin, range.End, part);
      std::sort(part.Crossings.begin() + before, part.Crossings.end());
    });
  std::vector<std::vector<TriangleCrossing>> lists;
  std::vector<CrossedTriangles::Touch> touches = inserted.touches();
  for (ScannedTriangles& part : parts)
  {
    lists.push_back(std::move(part.Crossings));
    touches.insert(touches.end(), part.Touches.begin(), part.Touches.end());
  }
  lists.push_back(notedIn(blocks, inserted));
  return listed(merged(std::move(lists)), std::move(touches));
}

template CrossedTriangles findCrossedTriangles(PointsView, const std::int32_t*, std::size_t,
  const std::vector<TriangleBlock>&, const std::vector<ConstraintPiece>&,
  const PartitionConstraints&, int);
template CrossedTriangles findCrossedTriangles(PointsView, const std::int64_t*, std::size_t,
  const std::vector<TriangleBlock>&, const std::vector<ConstraintPiece>&,
  const PartitionConstraints&, int);

} // namespace tipp
