// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCavity_h
#define tippCavity_h

#include "Kernel/HalfEdgeMesh.h"
#include "Kernel/KernelPredicates.h"
#include "Kernel/Pairs.h"
#include "Kernel/PointLocation.h"
#include "Predicates/Geometry.h"

#include <cstddef>
#include <vector>

// Cavity's steps, inline: Insertion.cxx compiles them for several sets of instructions.

namespace tipp
{

/// Replaces the triangles in conflict with an inserted vertex, its cavity (Bowyer 1981, Watson
/// 1981).
class Cavity
{
public:
  using Index = HalfEdgeMesh::Index;

  Cavity();

  /// Does so for `vertex`, starting at a triangle in conflict with it. Returns a new triangle that
  /// is finite.
  Index retriangulate(HalfEdgeMesh& mesh, const Point2* points, KernelPredicates& predicates,
    const Location& found, Index vertex);

  class Growth;

private:
  /// The apexes of the triangles across the two edges of a pair.
  struct ApexPair
  {
    Pair X;
    Pair Y;
    Pair Lift;
    Pair StartCross; ///< start x apex
    Pair CrossStop;  ///< apex x stop
    Index First;
    Index Second;
  };
  /// Consecutive new triangles, counter-clockwise around p.
  struct Fan
  {
    Index First;
    Index Last;
  };
  /// A pair of edges to process later, and the new triangles that follow those found across it.
  struct Deferred
  {
    EdgePair Edges;
    Fan After;
  };

  void grow();

  // Kept larger than any insertion so far has needed.
  std::vector<Index> Free; ///< indices for new triangles: the two appended, then the removed
  std::vector<Deferred> Stack;
};

/// Removes the triangles in conflict with a vertex step by step, and connects the vertex to every
/// edge of the cavity's boundary. The new triangles, two more than the removed ones, reuse their
/// indices and are appended to the mesh, which must have capacity for three. A local object, so
/// that its members stay in registers; it serves one vertex after another.
///
/// The cavity has no vertex inside, so its dual is a tree: no triangle is visited twice and no
/// marks are needed. After the removal of t triangles, depth-first, at most t + 2 boundary edges
/// are known, so an index is free for each new triangle as soon as its edge is found. The edges
/// still to be found lie in one gap of the ring, between the fan Before and the fan After. If both
/// triangles across an edge pair are in conflict, the second one's gap is deferred.
class Cavity::Growth
{
public:
  Growth(Cavity& cavity, HalfEdgeMesh& mesh, const Point2* points, KernelPredicates& predicates)
    : Result(cavity)
    , Mesh(mesh)
    , Slot(mesh.slots())
    , Points(points)
    , Predicates(predicates)
  {
  }

  /// Begins the cavity of `vertex` at a triangle in conflict with it.
  void begin(const Location& at, Index vertex)
  {
    const Index end = this->Mesh.end();
    this->P = pairAt(&this->Points[vertex].x);
    this->Vertex = vertex;
    this->None = end + 16;
    this->Last = this->None;
    this->After = { this->None, this->None };
    this->NextFree = this->FreeEnd = this->Result.Free.data();
    this->StackEnd = this->Result.Stack.data();
    *this->FreeEnd++ = end;
    *this->FreeEnd++ = end + 8;
    *this->FreeEnd++ = at.Triangle;
    this->Mesh.setEnd(end + 16);
    this->Edges = at.Edges;
    this->Inside = this->test(this->Edges, this->Apex);
    if (at.LastIsOutside)
    {
      this->addAcross(at.LastOuter, this->Edges.Stop, this->Edges.Start);
    }
    else
    {
      this->addLast(at);
    }
  }

  /// Adds what lies across the current pair of edges, and tests the next pair. Returns false, with
  /// nothing left to do, once all edges of the boundary are found. The result of a test decides
  /// only in the next step: until then the processor can do something else.
  bool step()
  {
    const EdgePair tested = this->Edges;
    if (this->Inside & 1)
    {
      this->destroy(tested.FirstOuter);
      if (this->Inside & 2)
      {
        this->destroy(tested.SecondOuter);
        this->defer(this->acrossSecond(tested, this->Apex));
        this->Edges = this->acrossFirst(tested, this->Apex);
      }
      else
      {
        this->Edges = this->acrossFirst(tested, this->Apex);
        this->addAcross(tested.SecondOuter, tested.Middle, tested.Stop);
      }
    }
    else if (this->Inside & 2)
    {
      this->destroy(tested.SecondOuter);
      this->Edges = this->acrossSecond(tested, this->Apex);
      this->addBefore(tested.FirstOuter, tested.Start, tested.Middle);
    }
    else
    {
      this->addBefore(tested.FirstOuter, tested.Start, tested.Middle);
      this->addBefore(tested.SecondOuter, tested.Middle, tested.Stop);
      this->closeGap();
      if (this->StackEnd == this->Result.Stack.data())
      {
        return false;
      }
      const Deferred& next = *--this->StackEnd;
      this->Edges = next.Edges;
      this->After = next.After;
    }
    this->Inside = this->test(this->Edges, this->Apex);
    return true;
  }

  /// Links the first new triangle and the last one. Returns a new triangle that is finite.
  Index closeRing()
  {
    Index t = HalfEdgeMesh::twinOf(this->Slot, this->None + 1) - 2;
    this->link(this->Last, t);
    for (const Index* slot = this->Slot + t; slot[1] == InfiniteVertex || slot[2] == InfiniteVertex;
         slot = this->Slot + t)
    {
      t = HalfEdgeMesh::triangleOf(slot[5]);
    }
    return t;
  }

private:
  void destroy(Index outer)
  {
    if (__builtin_expect(this->FreeEnd == this->Result.Free.data() + this->Result.Free.size(), 0))
    {
      this->grow();
    }
    *this->FreeEnd++ = HalfEdgeMesh::triangleOf(outer);
  }

  void grow()
  {
    const std::ptrdiff_t next = this->NextFree - this->Result.Free.data();
    const std::ptrdiff_t freeEnd = this->FreeEnd - this->Result.Free.data();
    const std::ptrdiff_t stackEnd = this->StackEnd - this->Result.Stack.data();
    this->Result.grow();
    this->NextFree = this->Result.Free.data() + next;
    this->FreeEnd = this->Result.Free.data() + freeEnd;
    this->StackEnd = this->Result.Stack.data() + stackEnd;
  }

  void defer(const EdgePair& edges)
  {
    *this->StackEnd++ = { edges, this->After };
    this->After = { this->None, this->None };
  }

  /// Adds the triangle (vertex, start, stop) at an edge of the cavity's boundary; returns it.
  Index add(Index outer, Index start, Index stop)
  {
    const Index t = *this->NextFree++;
    Index* const slot = this->Slot + HalfEdgeMesh::offset(t);
    slot[0] = this->Vertex;
    slot[1] = start;
    slot[2] = stop;
    slot[4] = slot[7] = outer;
    HalfEdgeMesh::setTwin(this->Slot, outer, t);
    return t;
  }

  /// Makes half-edge 1 of `before` and half-edge 2 of `after` twins. The writes to neighbouring
  /// slots are HalfEdgeMesh's copies. A link with None writes beyond the end of the mesh.
  void link(Index before, Index after)
  {
    Index* const last = this->Slot + HalfEdgeMesh::offset(before);
    Index* const first = this->Slot + HalfEdgeMesh::offset(after);
    last[5] = after + 2;
    first[6] = first[3] = before + 1;
  }

  /// The last triangle of the fan After; `other` if the fan is empty.
  Index lastAfterOr(Index other) const
  {
    const bool isEmpty = this->After.First == this->None;
    return __builtin_expect_with_probability(isEmpty, 1, 0.5) ? other : this->After.Last;
  }

  void addBefore(Index outer, Index start, Index stop)
  {
    const Index t = this->add(outer, start, stop);
    this->link(this->Last, t);
    this->Last = t;
  }

  void addAcross(Index outer, Index start, Index stop)
  {
    const Index t = this->add(outer, start, stop);
    this->link(t, this->After.First);
    this->After.Last = this->lastAfterOr(t);
    this->After.First = t;
  }

  void closeGap()
  {
    this->link(this->Last, this->After.First);
    this->Last = this->lastAfterOr(this->Last);
  }

  /// Processes the third edge of the first triangle, copied to both lanes.
  void addLast(const Location& at)
  {
    const EdgePair last = at.Edges.closing(at.LastCross, at.LastOuter);
    ApexPair apex;
    if (this->test(last, apex) & 1)
    {
      this->destroy(last.FirstOuter);
      this->defer(this->acrossFirst(last, apex));
    }
    else
    {
      this->addAcross(last.FirstOuter, last.Start, last.Middle);
    }
  }

  /// Returns a mask: bit i is set if the triangle across edge i is in conflict with p. Only the
  /// terms of the in-circle determinant that contain the apex are computed.
  unsigned test(const EdgePair& pair, ApexPair& apex)
  {
    apex.First = this->Slot[HalfEdgeMesh::offset(pair.FirstOuter)];
    apex.Second = this->Slot[HalfEdgeMesh::offset(pair.SecondOuter)];
    const Pair first = towards(this->P, this->Points, apex.First);
    const Pair second = towards(this->P, this->Points, apex.Second);
    apex.X = low(first, second);
    apex.Y = high(first, second);
    apex.Lift = apex.X * apex.X + apex.Y * apex.Y;
    apex.StartCross = pair.StartX * apex.Y - pair.StartY * apex.X;
    apex.CrossStop = pair.StopY * apex.X - pair.StopX * apex.Y;
    const Pair det =
      pair.StopLift * apex.StartCross + pair.StartLift * apex.CrossStop - apex.Lift * pair.Cross;
    const Pair lifts = pair.StartLift + pair.StopLift + apex.Lift;
    const Pair bound = CircleFilterBound * (lifts * lifts) + UnderflowBound;
    const unsigned decided = bitsOf(magnitude(det) > bound);
    if (__builtin_expect(decided != 3, 0))
    {
      // Of an edge's ends a and b, |ax by| + |ay bx| is at most half the sum of their lifts.
      const unsigned isLeft =
        bitsOf(pair.Cross > TurnFilterBound * (pair.StartLift + pair.StopLift) + UnderflowBound);
      return testExactly(this->Predicates, this->Slot, { this->P[0], this->P[1] }, pair.FirstOuter,
        pair.SecondOuter, decided, isLeft, ~signsOf(det) & decided);
    }
    return ~signsOf(det);
  }

  /// The conflict mask, with the lanes that the filter left undecided evaluated exactly. Mostly the
  /// triangle across such an edge is infinite: no conflict if p is to the left. Static, because a
  /// call on this object would force it into memory.
  [[gnu::noinline]] static unsigned testExactly(KernelPredicates& predicates, const Index* slot,
    Point2 p, Index first, Index second, unsigned decided, unsigned isLeft, unsigned inside)
  {
    const auto isInConflict = [&](Index outer, unsigned lane)
    {
      return !((isLeft & lane) != 0 && slot[outer] == InfiniteVertex) &&
        predicates.isInConflict(slot + HalfEdgeMesh::triangleOf(outer), p);
    };
    if (!(decided & 1) && isInConflict(first, 1))
    {
      inside |= 1;
    }
    if (!(decided & 2) && isInConflict(second, 2))
    {
      inside |= 2;
    }
    return inside;
  }

  /// The other two edges of the triangle across the first edge, and across the second, which is in
  /// conflict.
  EdgePair acrossFirst(const EdgePair& e, const ApexPair& v) const
  {
    return { low(e.StartX, v.X), low(e.StartY, v.Y), low(e.StartLift, v.Lift), low(v.X, e.StopX),
      low(v.Y, e.StopY), low(v.Lift, e.StopLift), low(v.StartCross, v.CrossStop),
      HalfEdgeMesh::twinOfNext(this->Slot, e.FirstOuter),
      HalfEdgeMesh::twinOfPrevious(this->Slot, e.FirstOuter), e.Start, v.First, e.Middle };
  }
  EdgePair acrossSecond(const EdgePair& e, const ApexPair& v) const
  {
    return { high(e.StartX, v.X), high(e.StartY, v.Y), high(e.StartLift, v.Lift),
      high(v.X, e.StopX), high(v.Y, e.StopY), high(v.Lift, e.StopLift),
      high(v.StartCross, v.CrossStop), HalfEdgeMesh::twinOfNext(this->Slot, e.SecondOuter),
      HalfEdgeMesh::twinOfPrevious(this->Slot, e.SecondOuter), e.Middle, v.Second, e.Stop };
  }

  Cavity& Result;
  HalfEdgeMesh& Mesh;
  Index* const Slot;
  const Point2* const Points;
  KernelPredicates& Predicates;
  Pair P{ 0, 0 };
  Index Vertex = 0;
  Index None = 0; ///< no triangle
  Index Last = 0; ///< the last triangle of the fan Before
  Fan After{ 0, 0 };
  // Pointers into the cavity's arrays.
  const Index* NextFree = nullptr;
  Index* FreeEnd = nullptr;
  Deferred* StackEnd = nullptr;
  // The current pair of edges, and the result of its test.
  EdgePair Edges = {};
  ApexPair Apex = {};
  unsigned Inside = 0;
};

inline Cavity::Index Cavity::retriangulate(HalfEdgeMesh& mesh, const Point2* points,
  KernelPredicates& predicates, const Location& found, Index vertex)
{
  Growth growth(*this, mesh, points, predicates);
  growth.begin(found, vertex);
  while (growth.step())
  {
  }
  return growth.closeRing();
}

} // namespace tipp

#endif
