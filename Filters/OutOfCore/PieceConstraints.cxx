// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/PieceConstraints.h"

#include "Constraints/ConstraintPoints.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace tipp
{

PieceConstraints::PieceConstraints(ConstraintSegments segments, PointsView points)
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
  const auto count = PointId(points.size());
  for (std::size_t i = 0; 2 * i < ends.size(); ++i)
  {
    const ConstraintPiece piece{ matched.Ids[2 * i], matched.Ids[2 * i + 1], std::int64_t(i) };
    std::min(piece.A, piece.B) < count ? this->Pieces.push_back(piece) : void();
  }
  std::vector<Point2> others;
  for (const std::size_t end : matched.New)
  {
    others.push_back(ends[end]);
  }
  this->Inserted =
    std::make_unique<PartitionConstraints>(points, this->Pieces, 1, std::move(others));
}

void PieceConstraints::finishInserting()
{
  constexpr std::int64_t none = -1;
  std::vector<std::int64_t> pieceOf(this->Segments.tree().items().size(), none);
  std::vector<char> isLeft(pieceOf.size(), 1);
  for (std::size_t p = 0; p < this->Pieces.size(); ++p)
  {
    const auto segment = std::size_t(this->Pieces[p].Constraint);
    pieceOf[segment] = std::int64_t(p);
    isLeft[segment] = char(!this->Inserted->isDone(p));
  }
  std::vector<ConstraintSegment> left;
  std::vector<std::int64_t> names;
  std::vector<std::int64_t> pieces;
  for (std::size_t i = 0; i < isLeft.size(); ++i)
  {
    if (isLeft[i])
    {
      const SegmentTree::Item& segment = this->Segments.at(std::int64_t(i));
      left.push_back({ segment.A, segment.B, SegmentRole::Line });
      names.push_back(this->Segments.nameOf(std::int64_t(i)));
      pieces.push_back(pieceOf[i]);
    }
  }
  std::vector<std::int64_t> indices;
  this->Left = ConstraintSegments(left, names, &indices);
  this->LeftOf.assign(this->Pieces.size(), none);
  for (const std::int64_t index : indices)
  {
    const std::int64_t piece = pieces[std::size_t(index)];
    piece >= 0 ? void(this->LeftOf[std::size_t(piece)] = std::int64_t(this->LeftPiece.size()))
               : void();
    this->LeftPiece.push_back(piece);
  }
}

std::size_t PieceConstraints::takeCrossed(PartitionIndex partition, std::int64_t first,
  std::int32_t* corners, std::size_t triangles, CrossedPart& part) const
{
  const auto pieceOf = [this](std::int64_t left) { return this->LeftPiece[std::size_t(left)]; };
  if (triangles == 0 || partition < 0 ||
    this->Inserted->mayEnter(this->Left.tree(), partition, pieceOf))
  {
    return tipp::takeCrossed(this->Points, this->Left, first, corners, triangles, part);
  }
  std::vector<ScannedTriangles::Crossing> crossings;
  for (const auto& [triangle, piece] : this->Inserted->interiorOf(partition).Crossings)
  {
    const std::int64_t segment = this->LeftOf[std::size_t(piece)];
    segment >= 0 ? crossings.push_back({ std::int64_t(triangle), segment }) : void();
  }
  return moveCrossed(this->Points, this->Left, first, crossings, corners, triangles, part);
}

void PieceConstraints::addEdgesAndTouches(std::int64_t first, CrossedPart& part) const
{
  for (const CrossedTriangles::Touch& touch : this->Inserted->touches())
  {
    const std::int64_t segment = this->LeftOf[std::size_t(touch.Piece)];
    if (segment >= 0)
    {
      part.Touches.push_back({ this->Left.nameOf(segment), first + touch.Vertex,
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
