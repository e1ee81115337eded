// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCrossedPart_h
#define tippCrossedPart_h

#include "Constraints/ConstraintSegments.h"
#include "Constraints/TriangleScan.h"
#include "Triangulation/PointsView.h"
#include "vtkTIPPFiltersModule.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace tipp
{

/// Crossed triangles of a part of a triangulation, with all that is needed to retriangulate them.
/// Vertices and segments are named by numbers that all parts agree on
/// (ConstraintSegments::nameOf()).
///
/// A segment is *complete* in a part if all triangles that it crosses are in the part. Parts are
/// retriangulated in two steps: each the jobs whose segments are complete, which change no other
/// part's triangles; and then the rest of all parts together.
struct CrossedPart
{
  using Corners = std::array<std::int64_t, 3>;
  struct Touch
  {
    std::int64_t Segment;
    std::int64_t Vertex; ///< in the interior of the segment
    Point2 Position;
  };

  std::vector<Corners> Triangles;
  std::vector<std::array<Point2, 3>> Positions; ///< of each triangle's corners
  std::vector<std::uint64_t> SegmentEnds;       ///< of each triangle, in Segments
  std::vector<std::int64_t> Segments;           ///< that cross each triangle
  std::vector<SegmentTree::Item> Known;         ///< these, some perhaps several times
  /// Edges of these triangles that lie on segments.
  std::vector<std::array<std::int64_t, 2>> FixedEdges;
  std::vector<Touch> Touches;

  /// Replaces the numbers of all vertices.
  template <typename NewNumber>
  void rename(const NewNumber& newNumber)
  {
    for (Corners& triangle : this->Triangles)
    {
      std::transform(triangle.begin(), triangle.end(), triangle.begin(), newNumber);
    }
    for (auto& edge : this->FixedEdges)
    {
      std::transform(edge.begin(), edge.end(), edge.begin(), newNumber);
    }
    for (Touch& touch : this->Touches)
    {
      touch.Vertex = newNumber(touch.Vertex);
    }
  }
};

template <typename Archive>
void serialize(Archive& archive, CrossedPart& part)
{
  archive(part.Triangles, part.Positions, part.SegmentEnds, part.Segments, part.Known,
    part.FixedEdges, part.Touches);
}

/// Moves the triangles of `from` to the end of those in `to`.
VTKTIPPFILTERS_EXPORT void append(CrossedPart&& from, CrossedPart& to);

/// Removes the triangles that segments cross, keeps the order of the others, and adds them to
/// `part`. Corners are indices of points; the number of a vertex is its index plus `first`. Returns
/// the number of triangles that are left.
template <typename Id>
VTKTIPPFILTERS_EXPORT std::size_t takeCrossed(PointsView points, const ConstraintSegments& segments,
  std::int64_t first, Id* corners, std::size_t triangles, CrossedPart& part);

/// The same where it is known which segments cross which triangles: by indices among `segments`,
/// ascending by triangle. Adds no edges and vertices that lie on segments.
template <typename Id>
VTKTIPPFILTERS_EXPORT std::size_t moveCrossed(PointsView points, const ConstraintSegments& segments,
  std::int64_t first, const std::vector<ScannedTriangles::Crossing>& crossings, Id* corners,
  std::size_t triangles, CrossedPart& part);

/// Removes the triangles of jobs with segments that are not complete, and returns them. isInner():
/// whether all triangles at a vertex are in the part.
VTKTIPPFILTERS_EXPORT CrossedPart splitIncomplete(
  CrossedPart& part, const std::function<bool(std::int64_t)>& isInner);

/// Replaces the triangles of whole jobs by those of the constrained triangulation, their lowest
/// corners first.
VTKTIPPFILTERS_EXPORT void retriangulate(CrossedPart& part, int threads);

/// The edges of constrained triangles that lie on segments; an edge on several segments is listed
/// once for each.
template <typename Id>
std::vector<ScannedTriangles::Edge> edgesOnSegments(
  PointsView points, const ConstraintSegments& segments, const Id* corners, std::size_t triangles);

/// Sets marks[c] for each corner c of the constrained triangles to 1 if the edge opposite to it
/// lies on a segment, else to 0.
template <typename Id>
VTKTIPPFILTERS_EXPORT void markEdges(PointsView points, const ConstraintSegments& segments,
  const Id* corners, std::size_t triangles, std::uint8_t* marks);

/// Removes the triangles that polygons and boundary do not keep; returns the number of the others.
template <typename Id>
std::size_t cutTriangles(
  PointsView points, const ConstraintSegments& segments, Id* corners, std::size_t triangles);

} // namespace tipp

#endif
