// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCavityGrowth_h
#define tippCavityGrowth_h

#include "Kernel/Cavity.h"

#include <algorithm>

// Cavity's steps, inline: Insertion.cxx compiles them for several sets of instructions.

namespace tipp
{

/// One run of open(): local, so that its counters stay in registers.
class Cavity::Growth
{
public:
  Growth(
    Cavity& cavity, const Index* slot, const Point2* points, KernelPredicates& predicates, Point2 p)
    : Result(cavity)
    , Slot(slot)
    , Points(points)
    , Predicates(predicates)
    , P(p)
  {
    this->update();
  }

  void run(const Location& at)
  {
    this->Triangles[this->TriangleCount++] = at.Triangle;
    // All three edges are tested before the first branch.
    const EdgePair last = this->lastEdge(at);
    ApexPair lastApex;
    const unsigned lastInside = this->test(last, lastApex);
    EdgePair edges = this->firstEdges(at);
    ApexPair apex;
    unsigned inside = this->test(edges, apex);
    if (lastInside & 1)
    {
      this->enter(last.FirstOuter);
      this->Stack[this->StackSize++] = { this->behindFirst(last, lastApex), true };
    }
    else
    {
      this->defer(last.FirstOuter);
    }
    for (;; inside = this->test(edges, apex))
    {
      if (inside & 1)
      {
        this->enter(edges.FirstOuter);
        if (inside & 2)
        {
          this->enter(edges.SecondOuter);
          this->Stack[this->StackSize++] = { this->behindSecond(edges, apex), true };
        }
        else
        {
          this->defer(edges.SecondOuter);
        }
        edges = this->behindFirst(edges, apex);
        continue;
      }
      this->emit(edges.FirstOuter);
      if (inside & 2)
      {
        this->enter(edges.SecondOuter);
        edges = this->behindSecond(edges, apex);
        continue;
      }
      this->emit(edges.SecondOuter);
      while (this->StackSize > 0 && !this->Stack[this->StackSize - 1].IsPair)
      {
        this->emit(this->Stack[--this->StackSize].Edges.FirstOuter);
      }
      if (this->StackSize == 0)
      {
        return;
      }
      edges = this->Stack[--this->StackSize].Edges;
    }
  }

  std::size_t ringSize() const { return this->RingSize; }

private:
  void update()
  {
    this->Triangles = this->Result.Triangles.data();
    this->Ring = this->Result.Ring.data();
    this->Stack = this->Result.Stack.data();
    // The ring and fill() need up to three places more.
    this->MostTriangles = this->Result.Triangles.size() - 3;
  }

  void enter(Index outer)
  {
    if (__builtin_expect(this->TriangleCount >= this->MostTriangles, 0))
    {
      this->Result.grow();
      this->update();
    }
    this->Triangles[this->TriangleCount++] = HalfEdgeMesh::triangleOf(outer);
  }

  void emit(Index outer)
  {
    this->Ring[this->RingSize++] = { outer, this->Slot[HalfEdgeMesh::previous(outer)] };
  }

  void defer(Index outer)
  {
    this->Stack[this->StackSize].Edges.FirstOuter = outer;
    this->Stack[this->StackSize++].IsPair = false;
  }

  static EdgePair firstEdges(const Location& at)
  {
    const Direction a = at.Corner[0];
    const Direction b = at.Corner[1];
    const Direction c = at.Corner[2];
    const double bl = b.lift();
    return { Pair{ a.X, b.X }, Pair{ a.Y, b.Y }, Pair{ a.lift(), bl }, Pair{ b.X, c.X },
      Pair{ b.Y, c.Y }, Pair{ bl, c.lift() }, Pair{ at.Cross[0], at.Cross[1] }, at.Outer[0],
      at.Outer[1] };
  }

  /// The third edge, in both lanes.
  static EdgePair lastEdge(const Location& at)
  {
    const Direction c = at.Corner[2];
    const Direction a = at.Corner[0];
    const double cl = c.lift();
    const double al = a.lift();
    const double ca = at.Cross[2];
    const Index outer = at.Outer[2];
    return { Pair{ c.X, c.X }, Pair{ c.Y, c.Y }, Pair{ cl, cl }, Pair{ a.X, a.X }, Pair{ a.Y, a.Y },
      Pair{ al, al }, Pair{ ca, ca }, outer, outer };
  }

  /// Bit i: the triangle behind edge i is in conflict with p. Of the in-circle determinant's terms
  /// only those with the apex are new.
  unsigned test(const EdgePair& pair, ApexPair& apex)
  {
    const Point2 first = this->Points[this->Slot[pair.FirstOuter]];
    const Point2 second = this->Points[this->Slot[pair.SecondOuter]];
    apex.X = Pair{ first.x, second.x } - this->P.x;
    apex.Y = Pair{ first.y, second.y } - this->P.y;
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
      return this->testExactly(pair.FirstOuter, pair.SecondOuter, decided, ~signsOf(det) & decided);
    }
    return ~signsOf(det);
  }

  [[gnu::noinline]] unsigned testExactly(
    Index first, Index second, unsigned decided, unsigned inside)
  {
    if (!(decided & 1))
    {
      inside |= this->isInConflict(first) ? 1U : 0U;
    }
    if (!(decided & 2))
    {
      inside |= this->isInConflict(second) ? 2U : 0U;
    }
    return inside;
  }

  bool isInConflict(Index outer)
  {
    return this->Predicates.isInConflict(this->Slot + HalfEdgeMesh::triangleOf(outer), this->P);
  }

  /// The two edges behind the first edge, whose triangle is in conflict; and behind the second.
  EdgePair behindFirst(const EdgePair& e, const ApexPair& v) const
  {
    return { low(e.StartX, v.X), low(e.StartY, v.Y), low(e.StartLift, v.Lift), low(v.X, e.StopX),
      low(v.Y, e.StopY), low(v.Lift, e.StopLift), low(v.StartCross, v.CrossStop),
      this->Slot[HalfEdgeMesh::next(e.FirstOuter) + 4],
      this->Slot[HalfEdgeMesh::previous(e.FirstOuter) + 4] };
  }
  EdgePair behindSecond(const EdgePair& e, const ApexPair& v) const
  {
    return { high(e.StartX, v.X), high(e.StartY, v.Y), high(e.StartLift, v.Lift),
      high(v.X, e.StopX), high(v.Y, e.StopY), high(v.Lift, e.StopLift),
      high(v.StartCross, v.CrossStop), this->Slot[HalfEdgeMesh::next(e.SecondOuter) + 4],
      this->Slot[HalfEdgeMesh::previous(e.SecondOuter) + 4] };
  }

  Cavity& Result;
  const Index* const Slot;
  const Point2* const Points;
  KernelPredicates& Predicates;
  const Point2 P;
  Index* Triangles;
  RingEdge* Ring;
  Deferred* Stack;
  std::size_t MostTriangles;
  std::size_t TriangleCount = 0;
  std::size_t RingSize = 0;
  std::size_t StackSize = 0;
};

/// The cavity has no vertex inside, so its dual is a tree: no triangle is met twice, no marks are
/// needed, and depth-first order is the order around the ring.
inline void Cavity::open(const HalfEdgeMesh& mesh, const Point2* points,
  KernelPredicates& predicates, const Location& location, Point2 p)
{
  Growth growth(*this, mesh.slots(), points, predicates, p);
  growth.run(location);
  this->RingSize = growth.ringSize();
}

inline Cavity::Index Cavity::fill(HalfEdgeMesh& mesh, Index vertex)
{
  Index* const slot = mesh.slots();
  Index* const triangles = this->Triangles.data();
  RingEdge* const ring = this->Ring.data();
  const std::size_t count = this->RingSize;
  const Index end = mesh.end();
  triangles[count - 2] = end;
  triangles[count - 1] = end + 8;
  mesh.setEnd(end + 16);

  ring[count] = ring[0];
  Index before = triangles[count - 1];
  Index start = ring[0].Start;
  for (std::size_t i = 0; i < count; ++i)
  {
    const Index t = triangles[i];
    const Index outer = ring[i].Outer;
    const Index stop = ring[i + 1].Start;
    slot[t] = vertex;
    slot[t + 1] = start;
    slot[t + 2] = stop;
    slot[t + 4] = outer;
    slot[outer + 4] = t;
    slot[t + 2 + 4] = before + 1;
    slot[before + 1 + 4] = t + 2;
    before = t;
    start = stop;
  }
  std::size_t finite = 0;
  while (
    slot[triangles[finite] + 1] == InfiniteVertex || slot[triangles[finite] + 2] == InfiniteVertex)
  {
    ++finite;
  }
  return triangles[finite];
}

} // namespace tipp

#endif
