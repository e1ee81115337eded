// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstraintRegion_h
#define tippConstraintRegion_h

#include "Predicates/Point2.h"
#include "Triangulation/Triangulate.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Triangles of a Delaunay triangulation that are retriangulated together: segments are inserted
/// one by one, and what comes out is the constrained Delaunay triangulation under the tie rule.
///
/// A segment replaces the triangles that it crosses (Anglada 1997). On each side of it their
/// vertices are a chain from one end to the other. An ear of the chain is cut off until the segment
/// is left. There always is one: every vertex sees the segment along an edge that was crossed,
/// these lines of sight do not meet, and so three vertices in a row that turn away from the segment
/// enclose nothing. Then edges are flipped until all are locally Delaunay, as in CGAL's
/// triangulation.
//
// Half-edge h goes from corner h % 3 of triangle h / 3 to the next one.
class ConstraintRegion
{
public:
  using Index = std::int32_t;

  void clear();

  /// A counter-clockwise triangle; before finish().
  void add(const std::array<PointId, 3>& ids, const std::array<Point2, 3>& positions);
  void finish();

  /// Makes ab an edge, unless it is outside of the region or on its border, where it is one
  /// already. No vertex and no other inserted segment may be in the way.
  void insert(PointId a, PointId b);

  std::size_t triangleCount() const { return this->Corners.size() / 3; }
  std::array<PointId, 3> triangle(std::size_t t) const
  {
    return { this->id(this->Corners[3 * t]), this->id(this->Corners[3 * t + 1]),
      this->id(this->Corners[3 * t + 2]) };
  }

private:
  struct Vertex
  {
    PointId Id;
    Point2 Position;
  };
  struct BorderEdge
  {
    Index From; ///< its vertex
    Index Half;
  };
  /// An edge of a chain, from the vertex before to this one, with the cavity on its right.
  struct Link
  {
    Index To;
    Index Outer;     ///< the half-edge on its left, or a border edge
    Index OldInner;  ///< the half-edge of the removed triangle on its right
    bool IsFixed;    ///< an inserted segment
    bool IsDangling; ///< the cavity is on both sides
  };
  using Chain = std::vector<Link>;

  static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static Index previous(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }
  Index from(Index h) const { return this->Corners[std::size_t(h)]; }
  Index to(Index h) const { return this->from(next(h)); }
  Index twin(Index h) const { return this->Twins[std::size_t(h)]; }
  PointId id(Index v) const { return this->Vertices[std::size_t(v)].Id; }
  Point2 at(Index v) const { return this->Vertices[std::size_t(v)].Position; }
  Index find(PointId id) const;
  int turn(Index a, Index b, Index c) const;

  void matchEdges();
  void join(Index half, Index outer);
  void fix(Index half);
  Index findToward(Index a, Index b, bool& isEdge) const;
  Index sweep(Index first, Index b, bool& isEdge) const;
  void insertAcross(Index a, Index b, Index first);
  void remove(Index half, std::vector<Index>& removed);
  Link makeLink(Index to, Index inner) const;
  void markDangling(Chain& chain);
  Index fill(Index from, const Chain& chain, std::vector<Index>& slots);
  Index makeTriangle(const Link& first, Index from, const Link& second, Index slot);
  void attach(Index half, const Link& link);
  void legalize();
  void flip(Index half);

  std::vector<Vertex> Vertices;    ///< by id
  std::vector<Index> Corners;      ///< their vertices
  std::vector<Index> Twins;        ///< of half-edges: the half-edge on the other side, or ~(border)
  std::vector<char> Fixed;         ///< of half-edges: an inserted segment
  std::vector<BorderEdge> Borders; ///< by From
  std::vector<Index> Out;          ///< of vertices: a half-edge from there
  std::vector<PointId> AddedIds;   ///< of corners, before finish()
  std::vector<Index> Suspects;     ///< half-edges that may have to be flipped
  std::vector<char> IsRemoved;     ///< of triangles
  std::vector<Index> NewInner;     ///< of old half-edges at dangling edges: the new ones
};

} // namespace tipp

#endif
