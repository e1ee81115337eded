// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstrainedMesh_h
#define tippConstrainedMesh_h

#include "Constraints/ResolveCrossings.h"
#include "Constraints/SegmentTree.h"
#include "Kernel/HalfEdgeMesh.h"
#include "Kernel/KernelPredicates.h"
#include "Predicates/ExactPredicates.h"
#include "Predicates/Geometry.h"

#include <array>
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
  static constexpr Index NoIndex = -1;

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
    this->Out.assign(vertices, NoIndex);
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
  bool isUsed(Index v) const { return this->out(v) != NoIndex; }
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

/// A walk along a line through a mesh, from a vertex to the next vertex on the line.
struct LineWalk
{
  using Index = ConstrainedMesh::Index;
  static constexpr Index NoIndex = ConstrainedMesh::NoIndex;

  enum class End
  {
    Reached, ///< at the line's end
    Touched, ///< at another vertex, which is on the line
    LeftMesh ///< where the line leaves the part of the mesh that is final
  };
  End Reason = End::LeftMesh;
  Index Vertex = NoIndex; ///< where it ends, unless LeftMesh
  Index Edge = NoIndex;   ///< from the first vertex to Vertex, if these have an edge
};

/// A line with a start and an end.
struct DirectedLine
{
  Point2 A; ///< where the line starts
  Point2 B;
  ConstrainedMesh::Index Goal; ///< the vertex at B, or LineWalk::NoIndex if it is not known

  /// 1 if p is on the left of the line, -1 on the right, 0 on it.
  int side(Point2 p) const { return orientation(this->B, p, this->A); } // B - A is computed once
};

/// The triangles that a walk crosses. The edges around them form two chains, on the left and on the
/// right of the line, both from the vertex at which the walk starts to the one at which it ends.
struct CrossedCavity
{
  using Index = ConstrainedMesh::Index;

  struct ChainVertex
  {
    Index Vertex;
    ConstrainedMesh::Link Outer; ///< from the crossed triangle at the edge before this vertex
    Point2 Position;
  };

  /// All have the same size, which is at least Count + 2.
  std::vector<Index> Triangles;                   ///< in order along the line
  std::array<std::vector<ChainVertex>, 2> Chains; ///< left and right
  std::size_t Count = 0;                          ///< of triangles
  std::array<std::size_t, 2> ChainEnds{};         ///< one past the last vertices of the chains
  bool HasKept = false;                           ///< whether a crossed triangle must be kept
  bool HasRepeated = false; ///< whether a chain has a vertex between two occurrences of another
};

/// Follows lines through a mesh, and finds the triangles that they cross.
class LineWalker
{
public:
  using Index = ConstrainedMesh::Index;
  using Link = ConstrainedMesh::Link;
  static constexpr Index NoIndex = LineWalk::NoIndex;

  explicit LineWalker(const ConstrainedMesh& mesh)
    : Mesh(mesh)
  {
    this->resize(64);
  }

  /// Follows the line from vertex a, which is on it, to the next vertex on it. Throws CrossingFound
  /// if it crosses a fixed edge.
  LineWalk walk(const DirectedLine& line, Index a)
  {
    this->Crossed.Count = 0;
    LineWalk walk;
    const Index first = this->findFirst(line, a, walk);
    if (first != NoIndex)
    {
      this->cross(line, first, walk);
    }
    return walk;
  }

  /// As walk(), but starts at a half-edge through which the line leaves its triangle. crossed()
  /// then has no valid chains.
  LineWalk walkAcross(const DirectedLine& line, Index half)
  {
    LineWalk walk;
    this->cross(line, half, walk);
    return walk;
  }

  /// What the last walk crossed.
  CrossedCavity& crossed() { return this->Crossed; }

private:
  /// Turns around vertex a to the first half-edge that the line crosses. NoIndex if the line
  /// continues along an edge, which is written to `walk`, or leaves the mesh.
  Index findFirst(DirectedLine line, Index a, LineWalk& walk) const
  {
    const ConstrainedMesh& mesh = this->Mesh;
    const Index begin = mesh.out(a);
    Index h = begin;
    Index to = mesh.to(h);
    int side = this->sideOf(line, to);
    const bool turnsLeft = side != 1; // toward the line
    do
    {
      if (side == 0 && this->isNext(line, a, to))
      {
        walk = { to == line.Goal ? LineWalk::End::Reached : LineWalk::End::Touched, to, h };
        return NoIndex;
      }
      const Index other = turnsLeft ? mesh.twin(mesh.previous(h)) : mesh.next(mesh.twin(h));
      to = mesh.to(other);
      const int otherSide = this->sideOf(line, to);
      if (turnsLeft ? side == -1 && otherSide == 1 : side == 1 && otherSide == -1)
      {
        return mesh.next(turnsLeft ? h : other);
      }
      h = other;
      side = otherSide;
    } while (h != begin);
    return NoIndex;
  }

  static constexpr int Unknown = -2; ///< of the infinite vertex

  int sideOf(const DirectedLine& line, Index v) const
  {
    return v == ConstrainedMesh::Infinite ? Unknown : line.side(this->Mesh.at(v));
  }

  bool isNext(const DirectedLine& line, Index a, Index v) const
  {
    return v == line.Goal || isBetween(this->Mesh.at(a), this->Mesh.at(v), line.B);
  }

  /// A vertex of a chain after the edge of a crossed triangle's half-edge.
  CrossedCavity::ChainVertex chainVertex(Index v, Index inner) const
  {
    return { v, this->Mesh.link(inner), this->Mesh.at(v) };
  }

  /// Follows the line across the half-edge `out`.
  void cross(DirectedLine line, Index out, LineWalk& walk)
  {
    const ConstrainedMesh& mesh = this->Mesh;
    CrossedCavity& crossed = this->Crossed;
    const Index a = mesh.apex(out);
    crossed.Chains[0][0] = crossed.Chains[1][0] = { a, NoIndex, mesh.at(a) };
    crossed.Chains[0][1] = this->chainVertex(mesh.to(out), mesh.next(out));
    crossed.Chains[1][1] = this->chainVertex(mesh.from(out), mesh.previous(out));
    crossed.Triangles[0] = mesh.triangleOf(out);
    crossed.HasKept = mesh.isKept(crossed.Triangles[0]);
    crossed.HasRepeated = false;
    std::size_t count = 1;
    std::size_t left = 2;
    std::size_t right = 2;
    for (;;)
    {
      crossed.Count = count;
      if (line.Goal == NoIndex &&
        orientation(mesh.at(mesh.from(out)), mesh.at(mesh.to(out)), line.B) >= 0)
      {
        return; // B is in this triangle; another partition will add its vertex
      }
      const Link link = mesh.link(out);
      if (ConstrainedMesh::isFixed(link))
      {
        throw CrossingFound();
      }
      if (count + 2 == crossed.Triangles.size())
      {
        this->resize(2 * count);
      }
      const Index in = ConstrainedMesh::twinOf(link);
      const Index toApex = mesh.next(in);
      const Index fromApex = mesh.previous(in);
      const Index apex = mesh.apex(in);
      crossed.Triangles[count++] = mesh.triangleOf(in);
      crossed.HasKept |= mesh.isKept(mesh.triangleOf(in));
      const Point2 position = mesh.at(apex);
      if (apex == ConstrainedMesh::Infinite)
      {
        return;
      }
      const int side = apex == line.Goal ? 0 : line.side(position);
      if (side > 0)
      {
        crossed.HasRepeated |= crossed.Chains[0][left - 2].Vertex == apex;
        crossed.Chains[0][left++] = { apex, mesh.link(fromApex), position };
        out = toApex;
      }
      else if (side < 0)
      {
        crossed.HasRepeated |= crossed.Chains[1][right - 2].Vertex == apex;
        crossed.Chains[1][right++] = { apex, mesh.link(toApex), position };
        out = fromApex;
      }
      else
      {
        crossed.Chains[0][left++] = { apex, mesh.link(fromApex), position };
        crossed.Chains[1][right++] = { apex, mesh.link(toApex), position };
        crossed.Count = count;
        crossed.ChainEnds = { left, right };
        if (apex == line.Goal || !(position == line.B))
        {
          walk = { apex == line.Goal ? LineWalk::End::Reached : LineWalk::End::Touched, apex,
            NoIndex };
        }
        return;
      }
    }
  }

  void resize(std::size_t size)
  {
    this->Crossed.Triangles.resize(size);
    for (std::vector<CrossedCavity::ChainVertex>& chain : this->Crossed.Chains)
    {
      chain.resize(size);
    }
  }

  const ConstrainedMesh& Mesh;
  CrossedCavity Crossed;
};

} // namespace tipp

#endif
