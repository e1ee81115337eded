// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCrossedPart_h
#define tippCrossedPart_h

#include "Constraints/ConstraintSegments.h"
#include "Constraints/Insertion/CrossedTriangles.h"
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

/// Crossed triangles of a part of a triangulation, with everything that is needed to retriangulate
/// them. Vertices and segments have numbers that all parts agree on (ConstraintSegments::nameOf()).
///
/// A segment is *complete* in a part if the part has all triangles that the segment crosses. Parts
/// are retriangulated in two steps. First, each part retriangulates the jobs whose segments are all
/// complete; this changes no triangle of other parts. Then the rest of all parts is retriangulated
/// together.
struct CrossedPart
{
  using Corners = std::array<std::int64_t, 3>;
  struct Touch
  {
    std::int64_t Segment;
    std::int64_t Vertex; ///< number of a vertex in the interior of the segment
    Point2 Position;
  };

  std::vector<Corners> Triangles;
  std::vector<std::array<Point2, 3>> Positions; ///< of the corners of each triangle
  std::vector<std::uint64_t> SegmentEnds;       ///< end of each triangle's range in Segments
  std::vector<std::int64_t> Segments;           ///< segments that cross each triangle, concatenated
  std::vector<SegmentTree::Item> Known;         ///< these segments, possibly repeated
  /// Edges of these triangles that are on segments, as vertex numbers.
  std::vector<std::array<std::int64_t, 2>> FixedEdges;
  std::vector<Touch> Touches;

  /// Replaces the numbers of all vertices by newNumber(number).
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

/// Appends the content of `from` to `to`.
VTKTIPPFILTERS_EXPORT void append(CrossedPart&& from, CrossedPart& to);

/// Moves the triangles that segments cross to `part`, and keeps the order of the others. `corners`
/// are indices of points; a vertex has the number index + `first`. Returns the number of remaining
/// triangles.
template <typename Id>
VTKTIPPFILTERS_EXPORT std::size_t takeCrossed(PointsView points, const ConstraintSegments& segments,
  std::int64_t first, Id* corners, std::size_t triangles, CrossedPart& part);

/// As takeCrossed(), if the crossings are known: segments are indices in `segments`, and crossings
/// are sorted by triangle. Edges and vertices on segments are not added.
template <typename Id>
VTKTIPPFILTERS_EXPORT std::size_t moveCrossed(PointsView points, const ConstraintSegments& segments,
  std::int64_t first, const std::vector<CrossedTriangles::Crossing>& crossings, Id* corners,
  std::size_t triangles, CrossedPart& part);

/// Removes the triangles of jobs with incomplete segments, and returns them. isInner(vertex) says
/// whether the part has all triangles at a vertex.
VTKTIPPFILTERS_EXPORT CrossedPart splitIncomplete(
  CrossedPart& part, const std::function<bool(std::int64_t)>& isInner);

/// Replaces the part's triangles by those of the constrained triangulation, each starting with its
/// lowest vertex. All jobs must be complete.
VTKTIPPFILTERS_EXPORT void retriangulate(CrossedPart& part, int threads);

/// The edges of constrained triangles that are on segments. An edge on several segments is listed
/// for each of them.
template <typename Id>
std::vector<ScannedTriangles::Edge> edgesOnSegments(
  PointsView points, const ConstraintSegments& segments, const Id* corners, std::size_t triangles);

/// Sets marks[c] of each corner c of the constrained triangles: 1 if the edge opposite to the
/// corner is on a segment, otherwise 0.
template <typename Id>
VTKTIPPFILTERS_EXPORT void markEdges(PointsView points, const ConstraintSegments& segments,
  const Id* corners, std::size_t triangles, std::uint8_t* marks);

/// Removes the triangles that polygons and boundary do not keep. Returns the number of remaining
/// triangles.
template <typename Id>
std::size_t cutTriangles(
  PointsView points, const ConstraintSegments& segments, Id* corners, std::size_t triangles);

} // namespace tipp

#endif
