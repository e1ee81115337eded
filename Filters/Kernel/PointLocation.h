// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointLocation_h
#define tippPointLocation_h

#include "Kernel/HalfEdgeMesh.h"
#include "Kernel/KernelPredicates.h"
#include "Kernel/Lanes.h"
#include "Predicates/Orientation.h"

#include <utility>

namespace tipp
{

/// A vertex as seen from the point p that is being inserted.
struct Direction
{
  double X;
  double Y;
  double lift() const { return this->X * this->X + this->Y * this->Y; }
};

/// The triangle that holds p, or an infinite one in conflict with it, as seen from p. Edge i goes
/// from corner i to the next; the corners are in order, but need not begin with slot 0.
struct Location
{
  HalfEdgeMesh::Index Triangle;
  Direction Corner[3];
  double Cross[3]; ///< of each edge's ends
  HalfEdgeMesh::Index Outer[3];
};

inline Direction directionTo(Point2 v, Point2 p)
{
  return { v.x - p.x, v.y - p.y };
}

inline Location seenFrom(
  const HalfEdgeMesh::Index* slot, const Point2* points, HalfEdgeMesh::Index triangle, Point2 p)
{
  const HalfEdgeMesh::Index* v = slot + triangle;
  const Direction a = directionTo(points[v[0]], p);
  const Direction b = directionTo(points[v[1]], p);
  const Direction c = directionTo(points[v[2]], p);
  return { triangle, { a, b, c },
    { a.X * b.Y - a.Y * b.X, b.X * c.Y - b.Y * c.X, c.X * a.Y - c.Y * a.X },
    { v[2 + 4], v[0 + 4], v[1 + 4] } };
}

/// Walks from the edge opposite to `start`, of a finite triangle, to a triangle that holds p, or to
/// the infinite triangle at a hull edge that p lies outside of. In a Delaunay triangulation such a
/// walk ends (Devillers, Pion, Teillaud 2002).
inline Location locate(const HalfEdgeMesh& mesh, const Point2* points, KernelPredicates& predicates,
  HalfEdgeMesh::Index start, Point2 p)
{
  using Index = HalfEdgeMesh::Index;
  const Index* const slot = mesh.slots();
  // p does not lie to the left of the edge from a to b; behind it is the triangle (a, d, b).
  Index h = start;
  Direction a = directionTo(points[slot[HalfEdgeMesh::previous(h)]], p);
  Direction b = directionTo(points[slot[HalfEdgeMesh::next(h)]], p);
  double ab = a.X * b.Y - a.Y * b.X;
  if (orientation(points[slot[HalfEdgeMesh::previous(h)]], points[slot[HalfEdgeMesh::next(h)]], p) >
    0)
  {
    h = slot[h + 4];
    std::swap(a, b);
    ab = -ab;
  }
  for (;;)
  {
    const Index id = slot[h];
    if (__builtin_expect(id == InfiniteVertex, 0))
    {
      return seenFrom(slot, points, HalfEdgeMesh::triangleOf(h), p);
    }
    const Index toA = HalfEdgeMesh::previous(h);
    const Index toB = HalfEdgeMesh::next(h);
    const Direction d = directionTo(points[id], p);
    const Pair left = Pair{ a.X, d.X } * Pair{ d.Y, b.Y };
    const Pair right = Pair{ a.Y, d.Y } * Pair{ d.X, b.X };
    const Pair cross = left - right; // a x d, d x b
    const Pair bound = TurnFilterBound * (magnitude(left) + magnitude(right)) + UnderflowBound;
    unsigned isRight = signsOf(cross);
    const unsigned decided = bitsOf(magnitude(cross) > bound);
    if (__builtin_expect(decided != 3, 0))
    {
      if (!(decided & 1))
      {
        isRight = (isRight & 2) | (predicates.orientation(slot[toA], id, p) < 0 ? 1U : 0U);
      }
      if (!(decided & 2))
      {
        isRight = (isRight & 1) | (predicates.orientation(id, slot[toB], p) < 0 ? 2U : 0U);
      }
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

} // namespace tipp

#endif
