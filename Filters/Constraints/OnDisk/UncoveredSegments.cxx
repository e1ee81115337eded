// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/OnDisk/UncoveredSegments.h"

#include "Constraints/OnDisk/SplitStored.h"

#include <algorithm>

namespace tipp
{

UncoveredSegments::UncoveredSegments(
  const std::string& file, SegmentSource& segments, std::uint64_t memory, int threads)
  : All(segments)
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
  tiles.findCovered(
    [this](std::int64_t segment, Point2 end) { this->Covered.emplace_back(segment, end); });
  std::sort(this->Covered.begin(), this->Covered.end(),
    [](const auto& a, const auto& b) { return a.first < b.first; });
}

void UncoveredSegments::forEach(const VisitSegment& visit) const
{
  std::int64_t index = 0;
  auto covered = this->Covered.begin();
  this->All.forEach(
    [&](const ConstraintSegment& segment)
    {
      const bool isCovered = covered != this->Covered.end() && covered->first == index;
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
