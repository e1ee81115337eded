// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstraintRegion_h
#define tippConstraintRegion_h

#include "Arrays/IndexMap.h"
#include "Constraints/SegmentInserter.h"
#include "Predicates/Points.h"
#include "Triangulation/Triangulate.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tipp
{

/// A region of triangles that are retriangulated together. Segments are inserted one by one. The
/// result is the constrained Delaunay triangulation under the tie rule.
//
// Half-edge h goes from corner h % 3 of triangle h / 3 to the next one.
class ConstraintRegion
{
public:
  using Index = std::int32_t;

  void clear();

  /// Adds a counter-clockwise triangle. Call before finish().
  void add(const std::array<PointId, 3>& ids, const std::array<Point2, 3>& positions);
  void finish();

  /// Makes ab an edge, unless it is outside the region or on its border, where it is an edge
  /// already. No vertex and no inserted segment may be between a and b.
  void insert(PointId a, PointId b);

  /// Fixes the edges ab inside the region for which isConstraint(a, b) is true.
  template <typename IsConstraint>
  void fixEdges(const IsConstraint& isConstraint)
  {
    for (Index h = 0; h < Index(this->Corners.size()); ++h)
    {
      if (this->twin(h) > h && isConstraint(this->id(this->from(h)), this->id(this->to(h))))
      {
        this->fix(h);
      }
    }
  }

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
    Index Half;
    Index Next; ///< the next border edge from the same vertex, or None
  };
  static constexpr Index None = -1;
  static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static Index previous(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }
  Index from(Index h) const { return this->Corners[std::size_t(h)]; }
  Index to(Index h) const { return this->from(next(h)); }
  Index twin(Index h) const { return this->Twins[std::size_t(h)]; }
  PointId id(Index v) const { return this->Vertices[std::size_t(v)].Id; }
  Point2 at(Index v) const { return this->Vertices[std::size_t(v)].Position; }
  int turn(Index a, Index b, Index c) const;

  /// @name The mesh of the inserter
  ///@{
  friend class SegmentInserter<ConstraintRegion>;
  static Index half(Index triangle, Index corner) { return 3 * triangle + corner; }
  static Index triangleOf(Index h) { return h / 3; }
  bool isFixed(Index h) const { return (this->Fixed[std::size_t(h)] & FixedBit) != 0; }
  void setFixed(Index h, bool isFixed) { this->Fixed[std::size_t(h)] = isFixed ? FixedBit : 0; }
  void markRemoved(Index triangle) { this->Fixed[3 * std::size_t(triangle)] |= RemovedBit; }
  bool isRemoved(Index triangle) const
  {
    return (this->Fixed[3 * std::size_t(triangle)] & RemovedBit) != 0;
  }
  void setCorners(Index triangle, const std::array<Index, 3>& corners);
  bool isInCircle(Index a, Index b, Index c, Index d) const;
  bool mustFlip(Index half) const;
  ///@}

  void matchEdges();
  void join(Index half, Index outer);
  void fix(Index half);
  Index findToward(Index a, Index b, bool& isEdge) const;
  Index sweep(Index first, Index b, bool& isEdge) const;
  void insertAcross(Index a, Index b, Index first);

  IndexMap Numbers; ///< of the vertices, by id
  std::vector<Vertex> Vertices;
  std::vector<Index> Corners; ///< vertex of each corner
  std::vector<Index> Twins;   ///< per half-edge: its twin, or ~(index of the border edge)
  static constexpr char FixedBit = 1;
  static constexpr char RemovedBit = 2; ///< in Fixed, of a triangle's first half-edge

  std::vector<char> Fixed; ///< per half-edge: whether it is on an inserted segment
  std::vector<Index> Out;  ///< per vertex: a half-edge that starts there
  std::vector<BorderEdge> Borders;
  std::vector<Index> FirstBorder; ///< per vertex: the first border edge from it, or None
  std::vector<Index> Crossed;     ///< half-edges that the current segment crosses
  IndexMap Edges;                 ///< for matchEdges()
  std::vector<Index> HalfOfEdge;  ///< for matchEdges()
  SegmentInserter<ConstraintRegion> Inserter;
};

} // namespace tipp

#endif
