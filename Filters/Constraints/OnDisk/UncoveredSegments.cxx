// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/OnDisk/UncoveredSegments.h"

#include "Constraints/OnDisk/SplitStored.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

/// The index of a segment, and the end of the part that others cover.
using CoveredPart = std::pair<std::int64_t, Point2>;

/// Returns the covered parts by ascending index.
std::vector<CoveredPart> findCovered(
  const std::string& file, const ConstrainedStream& segments, std::uint64_t memory, int threads)
{
  const auto forEachItem = [&segments](const SegmentTiles::Visit& visit)
  {
    std::int64_t index = 0;
    segments.forEach(
      [&](const ConstraintSegment& segment)
      {
        // A hole's outline is no edge of the triangulation.
        if (segment.Role != SegmentRole::Hole)
        {
          visit({ segment.A, segment.B, index });
        }
        ++index;
      });
  };
  const SegmentTiles tiles(
    file, forEachItem, SegmentTiles::tilesFor(segments.count(), memory), threads);
  std::vector<CoveredPart> covered;
  tiles.findCovered(
    [&covered](std::int64_t segment, Point2 end) { covered.emplace_back(segment, end); });
  std::sort(covered.begin(), covered.end(),
    [](const CoveredPart& a, const CoveredPart& b) { return a.first < b.first; });
  return covered;
}

} // namespace

void visitUncovered(const std::string& file, const ConstrainedStream& segments,
  std::uint64_t memory, int threads, const VisitSegment& visit)
{
  const std::vector<CoveredPart> all = findCovered(file, segments, memory, threads);
  std::int64_t index = 0;
  auto covered = all.begin();
  segments.forEach(
    [&](const ConstraintSegment& segment)
    {
      const bool isCovered = covered != all.end() && covered->first == index;
      ++index;
      const Point2 end = isCovered ? (covered++)->second : segment.A;
      if (!isCovered || segment.Role != SegmentRole::Line) // others also decide what is inside
      {
        visit(segment);
        return;
      }
      const Point2 high = lexicographicLess(segment.A, segment.B) ? segment.B : segment.A;
      if (!(end == high))
      {
        visit({ end, high, segment.Role });
      }
    });
}

} // namespace tipp
