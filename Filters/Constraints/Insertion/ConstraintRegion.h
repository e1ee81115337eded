// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstraintRegion_h
#define tippConstraintRegion_h

#include "Arrays/IndexMap.h"
#include "Constraints/Insertion/ConstrainedMesh.h"
#include "Constraints/Insertion/LineWalker.h"
#include "Constraints/Insertion/SegmentInserter.h"
#include "Predicates/Points.h"
#include "Triangulation/Triangulate.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// A region of triangles that are retriangulated together. Segments are inserted one by one. The
/// result is the constrained Delaunay triangulation under the tie rule.
class ConstraintRegion
{
public:
  ConstraintRegion();
  ConstraintRegion(const ConstraintRegion&) = delete;
  ConstraintRegion& operator=(const ConstraintRegion&) = delete;

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
    for (std::size_t corner = 0; corner < 3 * this->Count; ++corner)
    {
      const Index h = halfEdge(corner);
      const Index twin = this->Mesh.twin(h);
      if (twin > h && !this->isOutside(twin) &&
        isConstraint(this->id(this->from(h)), this->id(this->to(h))))
      {
        this->Mesh.fix(h);
      }
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
    Index Next; ///< index of another one whose border edge starts at the same vertex, or None
  };

  static Index halfEdge(std::size_t corner) { return Index(8 * (corner / 3) + corner % 3); }
  Index from(Index h) const { return this->Slots[std::size_t(HalfEdgeMesh::next(h))]; }
  Index to(Index h) const { return this->Slots[std::size_t(HalfEdgeMesh::previous(h))]; }
  Index twin(Index h) const { return this->Slots[std::size_t(h) + 4]; }
  bool isOutside(Index h) const { return std::size_t(h) >= 8 * this->Count; }
  PointId id(Index v) const { return this->Ids[std::size_t(v)]; }
  Index append(const std::array<Index, 3>& corners);
  void join(Index h, Index g);
  void joinInside();
  void surround();
  Index lastAfter(Index outside) const;

  IndexMap Numbers;              ///< of the vertices, minus 1, by id
  std::vector<PointId> Ids;      ///< by vertex
  std::vector<Point2> Positions; ///< by vertex
  std::vector<Index> Slots;      ///< of the triangles inside and the infinite ones
  std::size_t Count = 0;         ///< of triangles inside
  IndexMap Edges;                ///< for joinInside()
  std::vector<Index> HalfOfEdge; ///< by edge, one of its half-edges
  std::vector<OutsideTriangle> Outside;
  std::vector<Index> FirstOutside; ///< by vertex: index of the first in Outside, or None
  ConstrainedMesh Mesh;
  LineWalker Walker;
  SegmentInserter Inserter;
};

} // namespace tipp

#endif
