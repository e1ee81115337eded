// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/NearSegments.h"

#include "Arrays/Concatenated.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <cmath>

namespace tipp
{
namespace
{

/// Half the length of the longer side of a segment's bounding box. Half, because the length may
/// overflow.
double halfSize(const SegmentTree::Item& segment)
{
  return std::max(
    std::fabs(segment.B.x / 2 - segment.A.x / 2), std::fabs(segment.B.y / 2 - segment.A.y / 2));
}

/// Divides long segments into parts. There are at most twice as many parts as segments, or if this
/// is more, a small number.
std::vector<SegmentTree::Item> partsOf(const std::vector<SegmentTree::Item>& segments)
{
  constexpr std::size_t enough = 64;
  constexpr std::size_t small = std::size_t(1) << 18;
  const std::size_t most = std::max(segments.size(), std::min(enough * segments.size(), small));
  long double total = 0;
  for (const SegmentTree::Item& segment : segments)
  {
    total += halfSize(segment);
  }
  const auto perLength = total > 0 ? static_cast<long double>(most) / total : 0;
  std::vector<SegmentTree::Item> parts;
  parts.reserve(segments.size() + most);
  for (std::size_t i = 0; i < segments.size(); ++i)
  {
    const auto& [a, b, id] = segments[i];
    const auto count = std::size_t(halfSize(segments[i]) * perLength) + 1;
    const auto at = [&, a = a, b = b](std::size_t part)
    {
      const double t = double(part) / double(count);
      return Point2{ a.x * (1 - t) + b.x * t, a.y * (1 - t) + b.y * t };
    };
    for (std::size_t part = 0; part < count; ++part)
    {
      parts.push_back({ at(part), at(part + 1), std::int64_t(i) });
    }
  }
  return parts;
}

/// How far rounding may move an end of a part.
double roundingOf(const std::vector<SegmentTree::Item>& segments, int threads)
{
  if (segments.empty())
  {
    return 0;
  }
  constexpr double relative = 0x1p-50;
  constexpr double smallest = 0x1p-1070; // for products that underflow
  return smallest + relative * SegmentTree::boxOfAll(segments, threads).largest();
}

} // namespace

NearSegments::NearSegments(std::vector<SegmentTree::Item> segments, int threads, double margin)
  : Segments(std::move(segments))
  , Margin(margin)
  , Slack(margin + roundingOf(this->Segments, threads))
  , Parts(partsOf(this->Segments), threads)
{
}

std::vector<std::pair<std::size_t, std::size_t>> findPointsOn(
  std::vector<SegmentTree::Item> segments, PointsView points, int threads)
{
  const NearSegments near(std::move(segments), threads);
  std::vector<std::vector<std::pair<std::size_t, std::size_t>>> found(
    static_cast<std::size_t>(threads));
  constexpr std::int64_t chunk = 8192;
  forChunks(std::int64_t(points.size()), chunk, threads, {},
    [&](std::int64_t begin, std::int64_t end, int thread)
    {
      points.forEach(std::size_t(begin), std::size_t(end),
        [&](std::size_t point, Point2 p)
        {
          near.visitOn(p,
            [&](std::size_t i)
            {
              const SegmentTree::Item& segment = near.segments()[i];
              if (isBetween(segment.A, p, segment.B))
              {
                found[std::size_t(thread)].emplace_back(i, point);
              }
            });
        });
    });
  return concatenated(found);
}

} // namespace tipp
