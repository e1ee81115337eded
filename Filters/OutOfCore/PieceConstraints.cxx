// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/PieceConstraints.h"

#include "Constraints/ConstraintPoints.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace tipp
{

PieceConstraints::PieceConstraints(
  ConstraintSegments segments, PointsView points, double factor, const Tiling& partitions)
  : Segments(std::move(segments))
  , Points(points)
  , Left({})
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
    this->Pieces.push_back({ matched.Ids[2 * i], matched.Ids[2 * i + 1], std::int64_t(i) });
  }
  std::vector<Point2> others;
  for (const std::size_t end : matched.New)
  {
    others.push_back(ends[end]);
  }
  this->Inserted = std::make_unique<PartitionConstraints>(this->Pieces, 1, std::move(others));
  this->Inserted->begin(points.scaled(factor), partitions);
}

void PieceConstraints::finishInserting()
{
  std::vector<ConstraintSegment> segments;
  std::vector<std::int64_t> names;
  this->Remaining = this->Inserted->remaining();
  for (const std::int64_t i : this->Remaining)
  {
    const SegmentTree::Item& segment = this->Segments.at(i);
    segments.push_back({ segment.A, segment.B, SegmentRole::Line });
    names.push_back(this->Segments.nameOf(i));
  }
  this->Left = ConstraintSegments(segments, names);
}

std::size_t PieceConstraints::takeCrossed(PartitionIndex bucket, std::int64_t first,
  std::int32_t* corners, std::size_t triangles, CrossedPart& part) const
{
  return bucket < 0 ? tipp::takeCrossed(this->Points, this->Left, first, corners, triangles, part)
                    : moveCrossed(this->Points, this->Segments, first,
                        this->Inserted->crossingsIn(bucket), corners, triangles, part);
}

void PieceConstraints::addEdgesAndTouches(std::int64_t first, CrossedPart& part) const
{
  for (const CrossedTriangles::Touch& touch : this->Inserted->touches())
  {
    if (std::binary_search(this->Remaining.begin(), this->Remaining.end(), touch.Piece))
    {
      part.Touches.push_back({ this->Segments.nameOf(touch.Piece), first + touch.Vertex,
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
    const CrossedPart::Corners& its = part.Triangles[std::size_t(edge.Triangle)];
    part.FixedEdges.push_back({ its[edge.From], its[(edge.From + 1) % 3] });
  }
}

} // namespace tipp
