// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/Insertion/PartitionSegments.h"

#include "Constraints/SegmentTree.h"
#include "Parallel/CountingSort.h"
#include "Parallel/ParallelFor.h"
#include "Triangulation/PopulatePages.h"

#include <algorithm>
#include <array>

namespace tipp
{
namespace
{

/// Finds the partitions of the ends A and B of segments [begin, end).
void locateEnds(const PartitionFinder& finder, const std::vector<IdSegment>& segments,
  const EndPositions& ends, std::size_t begin, std::size_t end, std::uint32_t* partitions)
{
  constexpr std::size_t group = 128;
  constexpr std::size_t ahead = 32;
  const std::size_t last = end - 1;
  std::array<Point2, 2 * group> positions;
  populatePages(partitions + 2 * begin, 2 * (end - begin) * sizeof(*partitions));
  for (; begin < end; begin += group)
  {
    const std::size_t count = std::min(group, end - begin);
    for (std::size_t i = 0; i < count; ++i)
    {
      const IdSegment& later = segments[std::min(begin + i + ahead, last)];
      ends.Points.prefetch(std::size_t(later.A)); // points are anywhere in memory
      ends.Points.prefetch(std::size_t(later.B));
      positions[2 * i] = ends[segments[begin + i].A];
      positions[2 * i + 1] = ends[segments[begin + i].B];
    }
    finder.locate(positions.data(), 2 * count, partitions + 2 * begin);
  }
}

/// Calls visit(partition) for each partition near a segment. `ofEnds`: the partitions of its ends.
template <typename Visit>
void forPartitions(const Tiling& tiling, const IdSegment& segment, const EndPositions& ends,
  const std::uint32_t* ofEnds, const Visit& visit)
{
  if (ofEnds[0] == ofEnds[1] && std::size_t(std::max(segment.A, segment.B)) < ends.Points.size())
  {
    visit(PartitionIndex(ofEnds[0])); // most segments; boxes are convex
    return;
  }
  const Point2 a = ends[segment.A];
  const Point2 b = ends[segment.B];
  const Box2 box = Box2::of(a, b);
  tiling.visitNear(box,
    [&](PartitionIndex p)
    {
      const Box2& tile = tiling.box(p);
      if (box.meets(tile) && lineMayMeet(a, b, tile))
      {
        visit(p);
      }
    });
}

} // namespace

PartitionSegments::PartitionSegments(const Tiling& tiling, const std::vector<IdSegment>& segments,
  const EndPositions& ends, int threads)
{
  const auto partitions = std::size_t(tiling.size());
  const PartitionFinder finder(tiling);
  Buffer<std::uint32_t> ofEnds(2 * segments.size()); // the partitions of each segment's A and B
  // A stable counting sort. By share of the segments and partition: at first the number of entries,
  // later the next entry to write.
  std::vector<std::vector<std::size_t>> nextOf(
    std::size_t(threads), std::vector<std::size_t>(partitions, 0));
  parallelFor(threads, threads,
    [&](std::int64_t share)
    {
      const auto [begin, end] = evenShare(segments.size(), int(share), threads);
      std::vector<std::size_t>& counts = nextOf[std::size_t(share)];
      locateEnds(finder, segments, ends, begin, end, ofEnds.data());
      for (std::size_t segment = begin; segment < end; ++segment)
      {
        forPartitions(tiling, segments[segment], ends, &ofEnds[2 * segment],
          [&](PartitionIndex p) { ++counts[std::size_t(p)]; });
      }
    });
  this->Starts = countsToIndices(partitions, nextOf);
  this->Items = Buffer<std::int64_t>(this->Starts.back());
  parallelFor(threads, threads,
    [&](std::int64_t share)
    {
      const auto [begin, end] = evenShare(segments.size(), int(share), threads);
      std::vector<std::size_t>& next = nextOf[std::size_t(share)];
      const auto [first, last] = evenShare(this->Items.size(), int(share), threads);
      populatePages(this->Items.data() + first, (last - first) * sizeof(this->Items[0]));
      for (std::size_t segment = begin; segment < end; ++segment)
      {
        forPartitions(tiling, segments[segment], ends, &ofEnds[2 * segment],
          [&](PartitionIndex p) { this->Items[next[std::size_t(p)]++] = std::int64_t(segment); });
      }
    });
}

} // namespace tipp
