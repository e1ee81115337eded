// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/LoadedSegments.h"

#include "Constraints/PositionIndex.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace tipp
{
LoadedSegments::LoadedSegments(
  ConstraintSegments segments, PointsView points, double factor, const Tiling& partitions)
  : Segments(std::move(segments))
  , Points(points)
  , NotInserted({})
{
  std::vector<Point2> ends;
  ends.reserve(2 * this->Segments.tree().items().size());
  for (const SegmentTree::Item& segment : this->Segments.tree().items())
  {
    ends.insert(ends.end(), { segment.A, segment.B });
  }
  const MatchedPositions matched = matchPositions(points, PointsView(ends));
  for (std::size_t i = 0; 2 * i < ends.size(); ++i)
  {
    this->ById.push_back({ matched.Ids[2 * i], matched.Ids[2 * i + 1], std::int64_t(i) });
  }
  std::vector<Point2> others;
  for (const std::size_t end : matched.New)
  {
    others.push_back(ends[end]);
  }
  this->Inserted = std::make_unique<PartitionConstraints>(this->ById, 1, std::move(others));
  this->Inserted->begin(points.scaled(factor), partitions);
}

void LoadedSegments::finishInserting(
  const std::unordered_map<std::int32_t, std::int32_t>& representatives)
{
  this->Inserted->rename(
    [&representatives](PointId id)
    {
      const auto found = representatives.find(std::int32_t(id));
      return found == representatives.end() ? id : PointId(found->second);
    });
  std::vector<ConstraintSegment> segments;
  std::vector<std::int64_t> names;
  this->Remaining = this->Inserted->remaining();
  for (const std::int64_t i : this->Remaining)
  {
    const SegmentTree::Item& segment = this->Segments.at(i);
    segments.push_back({ segment.A, segment.B, SegmentRole::Line });
    names.push_back(this->Segments.nameOf(i));
  }
  this->NotInserted = ConstraintSegments(segments, names);
}

std::size_t LoadedSegments::takeCrossed(PartitionIndex bucket, std::int64_t first,
  std::int32_t* corners, std::size_t triangles, CrossedPart& part) const
{
  return bucket == NoPartition
    ? tipp::takeCrossed(this->Points, this->NotInserted, first, corners, triangles, part)
    : moveCrossed(this->Points, this->Segments, first, this->Inserted->crossingsIn(bucket), corners,
        triangles, part);
}

void LoadedSegments::addEdgesAndTouches(std::int64_t first, CrossedPart& part) const
{
  for (const CrossedTriangles::Touch& touch : this->Inserted->touches())
  {
    if (std::binary_search(this->Remaining.begin(), this->Remaining.end(), touch.Segment))
    {
      part.Touches.push_back({ this->Segments.nameOf(touch.Segment), first + touch.Vertex,
        this->Points[std::size_t(touch.Vertex)] });
    }
  }
  std::vector<std::int64_t> corners;
  for (const CrossedPart::Corners& triangle : part.Triangles)
  {
    std::transform(triangle.begin(), triangle.end(), std::back_inserter(corners),
      [first](std::int64_t vertex) { return vertex - first; });
  }
  for (const ScannedTriangles::Edge& edge :
    edgesOnSegments(this->Points, this->Segments, corners.data(), part.Triangles.size()))
  {
    const CrossedPart::Corners& triangle = part.Triangles[std::size_t(edge.Triangle)];
    part.FixedEdges.push_back({ triangle[edge.From], triangle[(edge.From + 1) % 3] });
  }
}

} // namespace tipp
