// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstrainedMesh_h
#define tippConstrainedMesh_h

#include "Kernel/HalfEdgeMesh.h"
#include "Kernel/KernelPredicates.h"
#include "Predicates/Points.h"

#include <cstddef>
#include <limits>
#include <vector>

namespace tipp
{

/// A view of triangles, in the memory layout of HalfEdgeMesh, whose edges can be fixed. Edges at
/// the border of the mesh have triangles at the infinite vertex, so that each half-edge has a twin.
/// Unlike in HalfEdgeMesh, slot 3 is a mark of the triangle, and slot 7 is not used.
class ConstrainedMesh
{
public:
  using Index = HalfEdgeMesh::Index;
  static constexpr Index Infinite = InfiniteVertex;
  static constexpr Index None = -1;

  /// The twin of a half-edge, plus FixedBit if their edge is fixed.
  using Link = Index;
  static constexpr Link FixedBit = 4;

  /// Begins to edit the triangles in slots [0, end), which belong to the caller, as do the
  /// positions. Nothing may be fixed yet.
  void begin(Index* slots, Index end, const Point2* positions, std::size_t vertices)
  {
    this->Slots = slots;
    this->Positions = positions;
    this->LastMark = 0;
    this->Out.assign(vertices, None);
    for (Index t = 0; t < end; t += 8)
    {
      for (Index i = 0; i < 3; ++i)
      {
        this->Out[std::size_t(slots[t + i])] = halfFrom(t, i);
      }
    }
  }

  /// The half-edge that starts at corner i.
  static Index halfFrom(Index triangle, Index i)
  {
    return i == 0 ? triangle + 2 : triangle + i - 1;
  }
  static Index triangleOf(Index h) { return HalfEdgeMesh::triangleOf(h); }
  static Index next(Index h) { return HalfEdgeMesh::next(h); }
  static Index previous(Index h) { return HalfEdgeMesh::previous(h); }
  Index from(Index h) const { return this->apex(next(h)); }
  Index to(Index h) const { return this->apex(previous(h)); }
  Index apex(Index h) const { return this->Slots[HalfEdgeMesh::offset(h)]; }
  Point2 at(Index v) const { return this->Positions[std::size_t(v)]; }

  /// Whether a vertex has triangles. A duplicate has none.
  bool isUsed(Index v) const { return this->out(v) != None; }
  /// A half-edge from the vertex.
  Index out(Index v) const { return this->Out[std::size_t(v)]; }
  void setOut(Index v, Index h) { this->Out[std::size_t(v)] = h; }

  ///@{
  /// Start to load what a walk from a vertex reads first: the vertex, then its triangle, then the
  /// corners and the neighbours of this triangle. Each function reads what the one before has
  /// loaded. Inlined, because GCC leaves out calls of functions that only prefetch.
  [[gnu::always_inline]] void prefetchVertex(Index v) const
  {
    __builtin_prefetch(&this->Out[std::size_t(v)]);
    __builtin_prefetch(&this->Positions[std::size_t(v)]);
  }
  [[gnu::always_inline]] void prefetchTriangle(Index v) const
  {
    __builtin_prefetch(this->Slots + triangleOf(this->out(v)));
  }
  [[gnu::always_inline]] void prefetchAround(Index v) const
  {
    const Index* const triangle = this->Slots + triangleOf(this->out(v));
    for (int i = 0; i < 3; ++i)
    {
      __builtin_prefetch(&this->Positions[std::size_t(triangle[i])]);
      __builtin_prefetch(this->Slots + triangle[i + 4]);
    }
  }
  ///@}

  Link link(Index h) const { return this->Slots[HalfEdgeMesh::offset(h) + 4]; }
  static Index twinOf(Link link) { return link & ~FixedBit; }
  static bool isFixed(Link link) { return (link & FixedBit) != 0; }
  Index twin(Index h) const { return twinOf(this->link(h)); }
  void setLink(Index h, Link link) { this->Slots[HalfEdgeMesh::offset(h) + 4] = link; }

  void fix(Index h)
  {
    const Index twin = this->twin(h);
    this->setLink(h, twin | FixedBit);
    this->setLink(twin, h | FixedBit);
  }
  /// Makes h the twin of link's half-edge. Their edge is fixed if `link` says so.
  void attach(Index h, Link link)
  {
    this->setLink(h, link);
    this->setLink(twinOf(link), h | (link & FixedBit));
  }

  /// Sets the corners of a triangle, but not its links, nor half-edges from the corners.
  void setCorners(Index triangle, Index a, Index b, Index c)
  {
    Index* const slots = this->Slots + HalfEdgeMesh::offset(triangle);
    slots[0] = a;
    slots[1] = b;
    slots[2] = c;
  }

  ///@{
  /// Triangles that must not be replaced. A walk may cross them, but no segment may be inserted
  /// there.
  void keep(Index triangle) { this->setMark(triangle, Kept); }
  bool isKept(Index triangle) const { return this->mark(triangle) == Kept; }
  ///@}

  ///@{
  /// Marks of other triangles. newMark() returns one that no triangle has.
  Index newMark() { return --this->LastMark; }
  Index mark(Index triangle) const { return this->Slots[HalfEdgeMesh::offset(triangle) + 3]; }
  void setMark(Index triangle, Index mark)
  {
    this->Slots[HalfEdgeMesh::offset(triangle) + 3] = mark;
  }
  ///@}

private:
  static constexpr Index Kept = std::numeric_limits<Index>::min(); ///< a mark

  Index* Slots = nullptr;
  const Point2* Positions = nullptr;
  Index LastMark = 0;
  std::vector<Index> Out; ///< by vertex: a half-edge from it
};

} // namespace tipp

#endif
