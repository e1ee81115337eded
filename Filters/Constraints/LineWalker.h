// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLineWalker_h
#define tippLineWalker_h

#include "Constraints/Constraint.h"
#include "Kernel/DelaunayKernel.h"
#include "Predicates/ExactPredicates.h"
#include "Predicates/Points.h"

#include <vector>

namespace tipp
{

/// A walk along a line through a kernel's mesh, from a vertex to the next vertex on the line.
struct LineWalk
{
  using Index = DelaunayKernel::Index;
  static constexpr Index None = -1;

  enum class End
  {
    Reached, ///< at the line's end
    Touched, ///< at another vertex, which is on the line
    Left     ///< where the line leaves the part of the mesh that is final
  };
  End How = End::Left;
  Index Vertex = None; ///< where it ends, unless Left
  Index Edge = None;   ///< from the first vertex to Vertex, if these have an edge
};

/// A line with a start and an end.
struct DirectedLine
{
  Point2 A; ///< where the line starts
  Point2 B;
  DelaunayKernel::Index Goal; ///< the vertex at B, or LineWalk::None if it is not known

  int side(Point2 p) const { return orientation(this->A, this->B, p); }

  /// Whether p, a point on the line, is between `from` and B.
  bool isBetween(Point2 from, Point2 p) const
  {
    return lexicographicLess(this->A, this->B)
      ? lexicographicLess(from, p) && lexicographicLess(p, this->B)
      : lexicographicLess(p, from) && lexicographicLess(this->B, p);
  }
};

/// Follows lines through a mesh, and finds the edges that they cross.
class LineWalker
{
public:
  using Index = DelaunayKernel::Index;
  static constexpr Index None = LineWalk::None;

  explicit LineWalker(const MeshEditor& mesh)
    : Mesh(mesh)
  {
  }

  /// Follows the line from vertex a, which is on it, to the next vertex on it. Throws CrossingFound
  /// if it crosses a fixed edge.
  LineWalk walk(const DirectedLine& line, Index a)
  {
    this->Crossed.clear();
    LineWalk walk;
    const Index first = this->findFirst(line, a, walk);
    if (first != None)
    {
      this->cross(line, first, walk);
    }
    return walk;
  }

  /// As walk(), from a half-edge that the line crosses out of its triangle.
  LineWalk walkAcross(const DirectedLine& line, Index half)
  {
    this->Crossed.clear();
    LineWalk walk;
    this->cross(line, half, walk);
    return walk;
  }

  /// The half-edges that the last walk crossed, each in the triangle that the walk left there.
  const std::vector<Index>& crossed() const { return this->Crossed; }

private:
  /// Turns around vertex a to the first half-edge that the line crosses. None if the line continues
  /// along an edge, which is written to `walk`, or leaves the mesh.
  Index findFirst(const DirectedLine& line, Index a, LineWalk& walk) const
  {
    const MeshEditor& mesh = this->Mesh;
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
        return None;
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
    return None;
  }

  static constexpr int Unknown = -2; ///< of the infinite vertex

  int sideOf(const DirectedLine& line, Index v) const
  {
    return v == DelaunayKernel::Infinite ? Unknown : line.side(this->Mesh.at(v));
  }

  bool isNext(const DirectedLine& line, Index a, Index v) const
  {
    return v == line.Goal || line.isBetween(this->Mesh.at(a), this->Mesh.at(v));
  }

  void cross(const DirectedLine& line, Index crossed, LineWalk& walk)
  {
    for (;;)
    {
      if (line.Goal == None &&
        orientation(this->Mesh.at(this->Mesh.from(crossed)), this->Mesh.at(this->Mesh.to(crossed)),
          line.B) >= 0)
      {
        return; // B is in this triangle; another partition will add its vertex
      }
      if (this->Mesh.isFixed(crossed))
      {
        throw CrossingFound();
      }
      this->Crossed.push_back(crossed);
      const Index half = this->Mesh.twin(crossed);
      const Index apex = this->Mesh.apex(half);
      if (apex == DelaunayKernel::Infinite)
      {
        return;
      }
      if (apex == line.Goal)
      {
        walk = { LineWalk::End::Reached, apex, None };
        return;
      }
      const int side = line.side(this->Mesh.at(apex));
      if (side == 0)
      {
        if (!(this->Mesh.at(apex) == line.B))
        {
          walk = { LineWalk::End::Touched, apex, None };
        }
        return;
      }
      crossed = side > 0 ? this->Mesh.next(half) : this->Mesh.previous(half);
    }
  }

  const MeshEditor& Mesh;
  std::vector<Index> Crossed;
};

} // namespace tipp

#endif
