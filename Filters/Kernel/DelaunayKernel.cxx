// SPDX-License-Identifier: BSD-3-Clause
#include "Kernel/DelaunayKernel.h"

#include "Predicates/InCircle.h"
#include "Predicates/Orientation.h"

#include <cmath>
#include <limits>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace tipp
{
namespace
{

// Filters on the original doubles, for vectors from the inserted point p (see Predicates/ for the
// bounds' proofs). The absolute terms cover underflow; overflow and NaN, which stands for the
// vertex at infinity, fail every comparison and so go to the exact path.
constexpr double TurnBound = 3.3306690738754716e-16;
constexpr double CircleBound = 3.4 * 1.1102230246251565e-16;
constexpr double UnderflowBound = 1e-300;

using Pair = double __attribute__((vector_size(16)));
using Mask = long long __attribute__((vector_size(16)));

inline Pair magnitude(Pair a)
{
  return reinterpret_cast<Pair>(reinterpret_cast<Mask>(a) & 0x7fffffffffffffffLL);
}

/// Bit 0 for the first lane, bit 1 for the second.
inline unsigned bitsOf(Mask mask)
{
#ifdef __SSE2__
  return static_cast<unsigned>(_mm_movemask_pd(reinterpret_cast<__m128d>(mask)));
#else
  return static_cast<unsigned>(mask[0] & 1) | static_cast<unsigned>(mask[1] & 2);
#endif
}

inline Pair low(Pair a, Pair b)
{
  return __builtin_shufflevector(a, b, 0, 2);
}

inline Pair high(Pair a, Pair b)
{
  return __builtin_shufflevector(a, b, 1, 3);
}

} // namespace

DelaunayKernel::DelaunayKernel()
  : Cavity(64)
  , Ring(64)
  , Stack(64)
{
  this->clear();
}

void DelaunayKernel::clear()
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  this->Mesh.clear();
  this->Points.assign(1, Point2{ nan, nan });
  this->Places.assign(1, 0);
  this->Duplicates.clear();
  this->PlaceEnd = 0;
  this->Pending = 1;
  this->Recent = 0;
  this->GridIsCurrent = false;
}

bool DelaunayKernel::isInfinite(Index triangle) const
{
  const Index* v = this->Mesh.slots() + triangle;
  return v[0] == Infinite || v[1] == Infinite || v[2] == Infinite;
}

void DelaunayKernel::insert(const Point2* points, std::size_t count)
{
  const std::vector<std::uint32_t>& order = this->Order.compute(points, count);
  const Index first = this->vertexEnd();
  this->Points.resize(this->Points.size() + count);
  this->Places.resize(this->Places.size() + count);
  for (std::size_t i = 0; i < count; ++i)
  {
    this->Points[first + i] = points[order[i]];
    this->Places[first + i] = this->PlaceEnd + order[i];
  }
  this->PlaceEnd += static_cast<std::uint32_t>(count);
  this->GridIsCurrent = false;
  this->TurnFailures = 0;

  // Euler: n vertices and the infinite one have 2 n - 2 triangles.
  this->Mesh.reserve(2 * this->Points.size());
  if (!this->hasTriangles() && !this->makeFirstTriangle(this->Pending))
  {
    return;
  }
  for (Index vertex = this->Pending; vertex < this->vertexEnd(); ++vertex)
  {
    this->insertVertex(vertex);
  }
  this->Pending = this->vertexEnd();
}

/// Finds three points that are not collinear, moves them to the front and makes their triangle and
/// its three infinite neighbours.
bool DelaunayKernel::makeFirstTriangle(Index first)
{
  const Index end = this->vertexEnd();
  const auto moveTo = [this](Index place, Index from)
  {
    std::swap(this->Points[place], this->Points[from]);
    std::swap(this->Places[place], this->Places[from]);
  };
  Index second = first + 1;
  while (second < end && this->Points[second] == this->Points[first])
  {
    ++second;
  }
  Index third = second + 1;
  int turn = 0;
  for (; third < end; ++third)
  {
    turn = orientation(this->Points[first], this->Points[second], this->Points[third]);
    if (turn != 0)
    {
      break;
    }
  }
  if (third >= end)
  {
    return false;
  }
  moveTo(first + 1, second);
  moveTo(first + 2, third);
  this->Pending = first + 3;

  const Index a = first;
  const Index b = turn > 0 ? first + 1 : first + 2;
  const Index c = turn > 0 ? first + 2 : first + 1;
  Index* slot = this->Mesh.slots();
  const Index corners[4][3] = { { a, b, c }, { Infinite, c, b }, { Infinite, a, c },
    { Infinite, b, a } };
  for (Index t = 0; t < 4; ++t)
  {
    for (Index i = 0; i < 3; ++i)
    {
      slot[8 * t + i] = corners[t][i];
    }
  }
  for (Index i = 0; i < 3; ++i)
  {
    this->Mesh.link(i, 8 * (i + 1));
    // Edge (Infinite, w) of infinite triangle i + 1 = (Infinite, w, u) is edge (w, Infinite) of the
    // one whose last corner is w, the next.
    this->Mesh.link(8 * (i + 1) + 2, 8 * ((i + 1) % 3 + 1) + 1);
  }
  this->Mesh.setEnd(32);
  this->Recent = 0;
  return true;
}

void DelaunayKernel::insertVertex(Index vertex)
{
  const Point2 p = this->Points[vertex];
  const Location location = this->locate(p);
  const Index equal = this->equalVertex(location, p);
  if (__builtin_expect(equal != Infinite, 0))
  {
    this->Duplicates.push_back({ this->Places[vertex], equal });
    return;
  }
  this->openCavity(location, p);
  this->fillCavity(vertex);
}

inline DelaunayKernel::Direction DelaunayKernel::directionTo(Index vertex, Point2 p) const
{
  const Point2 v = this->Points[vertex];
  return { v.x - p.x, v.y - p.y };
}

DelaunayKernel::Location DelaunayKernel::seenFrom(Point2 p, Index triangle) const
{
  const Index* v = this->Mesh.slots() + triangle;
  const Direction a = this->directionTo(v[0], p);
  const Direction b = this->directionTo(v[1], p);
  const Direction c = this->directionTo(v[2], p);
  return { triangle, { a, b, c },
    { a.X * b.Y - a.Y * b.X, b.X * c.Y - b.Y * c.X, c.X * a.Y - c.Y * a.X },
    { v[2 + 4], v[0 + 4], v[1 + 4] } };
}

/// Walks from the last insertion to a triangle that holds p, or to the infinite triangle at a hull
/// edge that p lies outside of. In a Delaunay triangulation such a walk ends (Devillers et al.).
DelaunayKernel::Location DelaunayKernel::locate(Point2 p)
{
  const Index* const slot = this->Mesh.slots();
  // p does not lie to the left of the edge from a to b; behind it is the triangle (a, d, b).
  Index h = this->Recent;
  Direction a = this->directionTo(slot[HalfEdgeMesh::previous(h)], p);
  Direction b = this->directionTo(slot[HalfEdgeMesh::next(h)], p);
  double ab = a.X * b.Y - a.Y * b.X;
  if (orientation(this->Points[slot[HalfEdgeMesh::previous(h)]],
        this->Points[slot[HalfEdgeMesh::next(h)]], p) > 0)
  {
    h = slot[h + 4];
    std::swap(a, b);
    ab = -ab;
  }
  for (;;)
  {
    const Index id = slot[h];
    if (__builtin_expect(id == Infinite, 0))
    {
      return this->seenFrom(p, HalfEdgeMesh::triangleOf(h));
    }
    const Index toA = HalfEdgeMesh::previous(h);
    const Index toB = HalfEdgeMesh::next(h);
    const Direction d = this->directionTo(id, p);
    const Pair left = Pair{ a.X, d.X } * Pair{ d.Y, b.Y };
    const Pair right = Pair{ a.Y, d.Y } * Pair{ d.X, b.X };
    const Pair cross = left - right; // a x d, d x b
    const Pair bound = TurnBound * (magnitude(left) + magnitude(right)) + UnderflowBound;
    unsigned isRight = bitsOf(-cross > bound);
    const unsigned undecided = ~(isRight | bitsOf(cross > bound));
    if (__builtin_expect(undecided & 1, 0))
    {
      isRight |= this->exactOrientation(this->Points[slot[toA]], this->Points[id], p) < 0 ? 1U : 0U;
    }
    if (__builtin_expect(undecided & 2, 0))
    {
      isRight |= this->exactOrientation(this->Points[id], this->Points[slot[toB]], p) < 0 ? 2U : 0U;
    }
    if (isRight & 1)
    {
      b = d;
      ab = cross[0];
      h = slot[toB + 4];
    }
    else if (isRight & 2)
    {
      a = d;
      ab = cross[1];
      h = slot[toA + 4];
    }
    else
    {
      return { HalfEdgeMesh::triangleOf(h), { a, d, b }, { cross[0], cross[1], -ab },
        { slot[toB + 4], slot[toA + 4], slot[h + 4] } };
    }
  }
}

inline DelaunayKernel::Index DelaunayKernel::equalVertex(const Location& at, Point2 p) const
{
  if (__builtin_expect((at.Cross[0] != 0) & (at.Cross[1] != 0) & (at.Cross[2] != 0), 1))
  {
    return Infinite;
  }
  for (Index i = 0; i < 3; ++i)
  {
    const Index v = this->Mesh.vertex(at.Triangle + i);
    if (this->Points[v] == p)
    {
      return v;
    }
  }
  return Infinite;
}

inline unsigned DelaunayKernel::testPair(const EdgePair& pair, Point2 p, ApexPair& apex)
{
  const Index* const slot = this->Mesh.slots();
  const Point2 first = this->Points[slot[pair.FirstOuter]];
  const Point2 second = this->Points[slot[pair.SecondOuter]];
  apex.X = Pair{ first.x, second.x } - p.x;
  apex.Y = Pair{ first.y, second.y } - p.y;
  apex.Lift = apex.X * apex.X + apex.Y * apex.Y;
  apex.StartCross = pair.StartX * apex.Y - pair.StartY * apex.X;
  apex.StopCross = pair.StopX * apex.Y - pair.StopY * apex.X;
  const Pair det =
    pair.StopLift * apex.StartCross - pair.StartLift * apex.StopCross - apex.Lift * pair.Cross;
  const Pair lifts = pair.StartLift + pair.StopLift + apex.Lift;
  const Pair bound = CircleBound * (lifts * lifts) + UnderflowBound;
  unsigned inside = bitsOf(det > bound);
  const unsigned outside = bitsOf(-det > bound);
  const unsigned undecided = ~(inside | outside);
  if (__builtin_expect(undecided & 1, 0))
  {
    inside |= this->isInConflict(HalfEdgeMesh::triangleOf(pair.FirstOuter), p) ? 1U : 0U;
  }
  if (__builtin_expect(undecided & 2, 0))
  {
    inside |= this->isInConflict(HalfEdgeMesh::triangleOf(pair.SecondOuter), p) ? 2U : 0U;
  }
  return inside;
}

/// Collects the triangles in conflict with p and, counter-clockwise, the edges around them. The
/// cavity has no vertex inside, so its dual is a tree: no triangle is met twice, no marks are
/// needed, and depth-first order is the order around the ring.
void DelaunayKernel::openCavity(const Location& at, Point2 p)
{
  const Index* const slot = this->Mesh.slots();
  Index* cavity = this->Cavity.data();
  RingEdge* ring = this->Ring.data();
  Deferred* stack = this->Stack.data();
  std::size_t cavitySize = 0;
  std::size_t ringSize = 0;
  std::size_t stackSize = 0;

  const auto emit = [&](Index outer) {
    ring[ringSize++] = { outer, slot[HalfEdgeMesh::previous(outer)] };
  };
  const auto enter = [&](Index outer)
  {
    if (__builtin_expect(cavitySize + 3 >= this->Cavity.size(), 0))
    {
      this->Cavity.resize(2 * this->Cavity.size());
      this->Ring.resize(2 * this->Ring.size());
      this->Stack.resize(2 * this->Stack.size());
      cavity = this->Cavity.data();
      ring = this->Ring.data();
      stack = this->Stack.data();
    }
    cavity[cavitySize++] = HalfEdgeMesh::triangleOf(outer);
  };
  // The two edges behind a pair's edge whose triangle is in conflict.
  const auto first = [slot](const EdgePair& e, const ApexPair& v)
  {
    return EdgePair{ low(e.StartX, v.X), low(e.StartY, v.Y), low(e.StartLift, v.Lift),
      low(v.X, e.StopX), low(v.Y, e.StopY), low(v.Lift, e.StopLift),
      low(v.StartCross, -v.StopCross),
      slot[HalfEdgeMesh::next(e.FirstOuter) + 4], slot[HalfEdgeMesh::previous(e.FirstOuter) + 4] };
  };
  const auto second = [slot](const EdgePair& e, const ApexPair& v)
  {
    return EdgePair{ high(e.StartX, v.X), high(e.StartY, v.Y), high(e.StartLift, v.Lift),
      high(v.X, e.StopX), high(v.Y, e.StopY), high(v.Lift, e.StopLift),
      high(v.StartCross, -v.StopCross),
      slot[HalfEdgeMesh::next(e.SecondOuter) + 4], slot[HalfEdgeMesh::previous(e.SecondOuter) + 4] };
  };

  const Direction a = at.Corner[0];
  const Direction b = at.Corner[1];
  const Direction c = at.Corner[2];
  const double al = a.lift();
  const double bl = b.lift();
  const double cl = c.lift();
  cavity[cavitySize++] = at.Triangle;
  EdgePair edges{ Pair{ a.X, b.X }, Pair{ a.Y, b.Y }, Pair{ al, bl }, Pair{ b.X, c.X },
    Pair{ b.Y, c.Y }, Pair{ bl, cl }, Pair{ at.Cross[0], at.Cross[1] },
    at.Outer[0], at.Outer[1] };
  ApexPair apex;
  {
    // The third edge, in both lanes.
    const double ca = at.Cross[2];
    const Index outer = at.Outer[2];
    const EdgePair last{ Pair{ c.X, c.X }, Pair{ c.Y, c.Y }, Pair{ cl, cl }, Pair{ a.X, a.X },
      Pair{ a.Y, a.Y }, Pair{ al, al }, Pair{ ca, ca }, outer, outer };
    if (this->testPair(last, p, apex) & 1)
    {
      enter(outer);
      stack[stackSize++] = { first(last, apex), true };
    }
    else
    {
      stack[stackSize].Edges.FirstOuter = outer;
      stack[stackSize++].IsPair = false;
    }
  }
  for (;;)
  {
    const unsigned inside = this->testPair(edges, p, apex);
    if (inside & 1)
    {
      enter(edges.FirstOuter);
      if (inside & 2)
      {
        enter(edges.SecondOuter);
        stack[stackSize++] = { second(edges, apex), true };
      }
      else
      {
        stack[stackSize].Edges.FirstOuter = edges.SecondOuter;
        stack[stackSize++].IsPair = false;
      }
      edges = first(edges, apex);
      continue;
    }
    emit(edges.FirstOuter);
    if (inside & 2)
    {
      enter(edges.SecondOuter);
      edges = second(edges, apex);
      continue;
    }
    emit(edges.SecondOuter);
    while (stackSize > 0 && !stack[stackSize - 1].IsPair)
    {
      emit(stack[--stackSize].Edges.FirstOuter);
    }
    if (stackSize == 0)
    {
      break;
    }
    edges = stack[--stackSize].Edges;
  }
  this->CavitySize = cavitySize;
  this->RingSize = ringSize;
}

/// Joins the vertex to every edge of the ring, in the places of the destroyed triangles and two
/// new ones.
void DelaunayKernel::fillCavity(Index vertex)
{
  Index* const slot = this->Mesh.slots();
  Index* const cavity = this->Cavity.data();
  RingEdge* const ring = this->Ring.data();
  const std::size_t count = this->RingSize;
  const Index end = this->Mesh.end();
  cavity[count - 2] = end;
  cavity[count - 1] = end + 8;
  this->Mesh.setEnd(end + 16);

  ring[count] = ring[0];
  Index before = cavity[count - 1];
  Index start = ring[0].Start;
  for (std::size_t i = 0; i < count; ++i)
  {
    const Index t = cavity[i];
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
  while (slot[cavity[finite] + 1] == Infinite || slot[cavity[finite] + 2] == Infinite)
  {
    ++finite;
  }
  this->Recent = cavity[finite];
}

/// The exact answer where the filter has none.
bool DelaunayKernel::isInConflict(Index triangle, Point2 p)
{
  const Index* v = this->Mesh.slots() + triangle;
  for (Index i = 0; i < 3; ++i)
  {
    if (v[i] == Infinite)
    {
      return this->isInConflictWithInfinite(triangle + i, p);
    }
  }
  const Point2 a = this->Points[v[0]];
  const Point2 b = this->Points[v[1]];
  const Point2 c = this->Points[v[2]];
  const int side = this->grid().inCircle(a, b, c, p);
  return side != 0 ? side > 0 : tieIsInside(a, b, c, p);
}

/// The circumdisk of an infinite triangle is the open half-plane beyond its hull edge, and the open
/// edge itself.
bool DelaunayKernel::isInConflictWithInfinite(Index infiniteSlot, Point2 p)
{
  const Point2 u = this->Points[this->Mesh.vertex(HalfEdgeMesh::next(infiniteSlot))];
  const Point2 w = this->Points[this->Mesh.vertex(HalfEdgeMesh::previous(infiniteSlot))];
  const int side = orientation(u, w, p);
  if (side != 0)
  {
    return side > 0;
  }
  return lexicographicLess(u, w) ? lexicographicLess(u, p) && lexicographicLess(p, w)
                                 : lexicographicLess(w, p) && lexicographicLess(p, u);
}

int DelaunayKernel::exactOrientation(Point2 a, Point2 b, Point2 c)
{
  // Some failures come with any input; the grid pays where there are many.
  constexpr std::size_t few = 32;
  return ++this->TurnFailures > few ? this->grid().orientation(a, b, c) : orientationExact(a, b, c);
}

const CoordinateGrid& DelaunayKernel::grid()
{
  if (!this->GridIsCurrent)
  {
    this->Grid.analyse(this->Points.data() + 1, this->Points.size() - 1);
    this->GridIsCurrent = true;
  }
  return this->Grid;
}

} // namespace tipp
