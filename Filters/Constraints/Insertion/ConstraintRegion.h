// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstraintRegion_h
#define tippConstraintRegion_h

#include "Arrays/IndexMap.h"
#include "Constraints/Insertion/ConstrainedMesh.h"
#include "Constraints/Insertion/SegmentInserter.h"
#include "Predicates/Geometry.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

namespace tipp
{

/// A region of triangles that are retriangulated together. Segments are inserted one by one. The
/// result is the constrained Delaunay triangulation under the tie rule.
class ConstraintRegion
{
public:
  ConstraintRegion()
    : Walker(this->Mesh)
    , Inserter(this->Mesh)
  {
  }
  ConstraintRegion(const ConstraintRegion&) = delete;
  ConstraintRegion& operator=(const ConstraintRegion&) = delete;

  void clear()
  {
    constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
    constexpr PointId none = -1;
    this->Numbers.clear();
    this->Ids.assign(1, none); // the infinite vertex
    this->Positions.assign(1, { nowhere, nowhere });
    this->Slots.clear();
    this->Count = 0;
  }

  /// Adds a counter-clockwise triangle. Call before finish().
  void add(const std::array<PointId, 3>& ids, const std::array<Point2, 3>& positions)
  {
    std::array<Index, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const auto [number, isNew] = this->Numbers.insert(ids[i]);
      if (isNew)
      {
        this->Ids.push_back(ids[i]);
        this->Positions.push_back(positions[i]);
      }
      corners[i] = number + 1;
    }
    this->append(corners);
    ++this->Count;
  }

  void finish()
  {
    this->joinInside();
    this->surround();
    this->Mesh.begin(this->Slots.data(), Index(this->Slots.size()), this->Positions.data(),
      this->Positions.size());
  }

  /// Fixes the edges ab inside the region for which isConstraint(a, b) is true.
  template <typename IsConstraint>
  void fixEdges(const IsConstraint& isConstraint)
  {
    for (std::size_t corner = 0; corner < 3 * this->Count; ++corner)
    {
      const Index h = halfEdge(corner);
      const Index twin = this->Mesh.twin(h);
      if (twin > h && !this->isOutside(twin) &&
        isConstraint(this->id(this->Mesh.from(h)), this->id(this->Mesh.to(h))))
      {
        this->Mesh.fix(h);
      }
    }
  }

  /// Makes ab an edge, unless it is outside the region or on its border, where it is an edge
  /// already. No vertex and no inserted segment may be between a and b.
  void insert(PointId a, PointId b)
  {
    const Index from = this->Numbers.find(a) + 1;
    const Index to = this->Numbers.find(b) + 1;
    if (from == ConstrainedMesh::Infinite || to == ConstrainedMesh::Infinite)
    {
      return;
    }
    const DirectedLine line{ this->Mesh.at(from), this->Mesh.at(to), to };
    const LineWalk walk = this->Walker.walk(line, from);
    if (walk.Reason == LineWalk::End::Touched)
    {
      throw std::logic_error("A vertex lies on a constraint that was not split there.");
    }
    if (walk.Edge != LineWalk::NoIndex)
    {
      this->Mesh.fix(walk.Edge);
    }
    else if (walk.Reason == LineWalk::End::Reached)
    {
      this->Inserter.insert(this->Walker.crossed());
    }
    else if (this->Walker.crossed().Count > 0)
    {
      throw std::logic_error("A constraint leaves its region.");
    }
  }

  std::size_t triangleCount() const { return this->Count; }
  std::array<PointId, 3> triangle(std::size_t t) const
  {
    const Index* const corners = this->Slots.data() + 8 * t;
    return { this->id(corners[0]), this->id(corners[1]), this->id(corners[2]) };
  }

private:
  using Index = ConstrainedMesh::Index;

  /// A triangle at the infinite vertex, which is its corner 0. The border edge starts at corner 2.
  struct OutsideTriangle
  {
    Index Triangle;
    Index Next; ///< index of another one whose border edge starts at the same vertex, or NoIndex
  };

  static Index halfEdge(std::size_t corner) { return Index(8 * (corner / 3) + corner % 3); }
  bool isOutside(Index h) const { return std::size_t(h) >= 8 * this->Count; }
  PointId id(Index v) const { return this->Ids[std::size_t(v)]; }

  /// @name Before Mesh has the slots
  ///@{
  Index from(Index h) const { return this->Slots[std::size_t(HalfEdgeMesh::next(h))]; }
  Index to(Index h) const { return this->Slots[std::size_t(HalfEdgeMesh::previous(h))]; }
  Index twin(Index h) const { return this->Slots[std::size_t(h) + 4]; }
  void join(Index h, Index g)
  {
    this->Slots[std::size_t(h) + 4] = g;
    this->Slots[std::size_t(g) + 4] = h;
  }

  /// Appends a triangle without neighbours.
  Index append(const std::array<Index, 3>& corners)
  {
    constexpr Index none = ConstrainedMesh::NoIndex;
    const auto triangle = Index(this->Slots.size());
    this->Slots.insert(
      this->Slots.end(), { corners[0], corners[1], corners[2], 0, none, none, none, 0 });
    return triangle;
  }

  void joinInside()
  {
    this->Edges.clear();
    this->HalfOfEdge.clear();
    for (std::size_t corner = 0; corner < 3 * this->Count; ++corner)
    {
      const Index h = halfEdge(corner);
      const auto [low, high] = std::minmax({ this->from(h), this->to(h) });
      const auto [edge, isNew] = this->Edges.insert(std::int64_t(low) << 32 | high);
      isNew ? this->HalfOfEdge.push_back(h) : this->join(h, this->HalfOfEdge[std::size_t(edge)]);
    }
  }

  /// Adds the triangles at the infinite vertex. All triangles around a vertex become neighbours in
  /// turn, also those between which the region has several gaps.
  void surround()
  {
    this->Outside.clear();
    this->FirstOutside.assign(this->Positions.size(), ConstrainedMesh::NoIndex);
    for (const Index h : this->HalfOfEdge)
    {
      if (this->twin(h) == ConstrainedMesh::NoIndex)
      {
        const Index outside =
          this->append({ ConstrainedMesh::Infinite, this->to(h), this->from(h) });
        this->join(h, outside);
        Index& first = this->FirstOutside[std::size_t(this->from(h))];
        this->Outside.push_back({ outside, first });
        first = Index(this->Outside.size() - 1);
      }
    }
    for (const OutsideTriangle& one : this->Outside)
    {
      const Index from = this->Slots[std::size_t(one.Triangle) + 2];
      const Index next =
        one.Next != ConstrainedMesh::NoIndex ? one.Next : this->FirstOutside[std::size_t(from)];
      this->join(
        this->Outside[std::size_t(next)].Triangle + 1, this->outsideAfterInside(one.Triangle) + 2);
    }
  }

  /// The infinite triangle that is reached from `outside` by turning counter-clockwise around the
  /// start of its edge, through the triangles inside.
  Index outsideAfterInside(Index outside) const
  {
    Index h = this->twin(outside);
    while (!this->isOutside(h))
    {
      h = this->twin(HalfEdgeMesh::previous(h));
    }
    return HalfEdgeMesh::triangleOf(h);
  }
  ///@}

  IndexMap Numbers;              ///< of the vertices, minus 1, by id
  std::vector<PointId> Ids;      ///< by vertex
  std::vector<Point2> Positions; ///< by vertex
  std::vector<Index> Slots;      ///< of the triangles inside and the infinite ones
  std::size_t Count = 0;         ///< of triangles inside
  IndexMap Edges;                ///< for joinInside()
  std::vector<Index> HalfOfEdge; ///< by edge, one of its half-edges
  std::vector<OutsideTriangle> Outside;
  std::vector<Index> FirstOutside; ///< by vertex: index of the first in Outside, or NoIndex
  ConstrainedMesh Mesh;
  LineWalker Walker;
  SegmentInserter Inserter;
};

} // namespace tipp

#endif
