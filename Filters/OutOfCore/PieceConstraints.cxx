// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/PieceConstraints.h"

#include "Constraints/ConstraintPoints.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace tipp
{
namespace
{

/// The segments between two of the points; their Constraint is their index among the segments.
std::vector<ConstraintPiece> piecesAmong(PointsView points, const ConstraintSegments& segments)
{
  std::vector<double> ends;
  ends.reserve(4 * segments.tree().items().size());
  for (const SegmentTree::Item& segment : segments.tree().items())
  {
    ends.insert(ends.end(), { segment.A.x, segment.A.y, segment.B.x, segment.B.y });
  }
  const std::vector<PointId> ids =
    matchPositions(points, PointsView(ends.data(), ends.size() / 2, 2)).Ids;
  const auto count = PointId(points.size());
  std::vector<ConstraintPiece> pieces;
  for (std::size_t i = 0; 2 * i < ids.size(); ++i)
  {
    const ConstraintPiece piece{ ids[2 * i], ids[2 * i + 1], std::int64_t(i) };
    piece.A < count&& piece.B < count ? pieces.push_back(piece) : void();
  }
  return pieces;
}

} // namespace

PieceConstraints::PieceConstraints(ConstraintSegments segments, PointsView points)
  : Segments(std::move(segments))
  , Points(points)
  , Pieces(piecesAmong(points, this->Segments))
  , Inserted(points, this->Pieces, 1)
{
}

void PieceConstraints::takeCrossed(std::int64_t first, CrossedPart& part,
  const std::function<void(const ConstraintSegments&)>& take) const
{
  std::vector<char> isLeft(this->Segments.tree().items().size(), 1);
  for (std::size_t i = 0; i < this->Pieces.size(); ++i)
  {
    isLeft[std::size_t(this->Pieces[i].Constraint)] = char(!this->Inserted.isDone(i));
  }
  std::vector<ConstraintSegment> left;
  std::vector<std::int64_t> names;
  for (std::size_t i = 0; i < isLeft.size(); ++i)
  {
    if (isLeft[i])
    {
      const SegmentTree::Item& segment = this->Segments.at(std::int64_t(i));
      left.push_back({ segment.A, segment.B, SegmentRole::Line });
      names.push_back(this->Segments.nameOf(std::int64_t(i)));
    }
  }
  take(ConstraintSegments(left, names));
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
