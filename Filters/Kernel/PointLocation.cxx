// SPDX-License-Identifier: BSD-3-Clause
#include "Kernel/PointLocation.h"

#include "Kernel/Lanes.h"
#include "Predicates/Orientation.h"

#include <utility>

namespace tipp
{
namespace
{

using Index = HalfEdgeMesh::Index;

Direction directionTo(Point2 v, Point2 p)
{
  return { v.x - p.x, v.y - p.y };
}

Location seenFrom(const Index* slot, const Point2* points, Index triangle, Point2 p)
{
  const Index* v = slot + triangle;
  const Direction a = directionTo(points[v[0]], p);
  const Direction b = directionTo(points[v[1]], p);
  const Direction c = directionTo(points[v[2]], p);
  return { triangle, { a, b, c },
    { a.X * b.Y - a.Y * b.X, b.X * c.Y - b.Y * c.X, c.X * a.Y - c.Y * a.X },
    { v[2 + 4], v[0 + 4], v[1 + 4] } };
}

} // namespace

Location locate(const HalfEdgeMesh& mesh, const Point2* points, KernelPredicates& predicates,
  Index start, Point2 p)
{
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
    unsigned isRight = bitsOf(-cross > bound);
    const unsigned undecided = ~(isRight | bitsOf(cross > bound));
    if (__builtin_expect(undecided & 1, 0))
    {
      isRight |= predicates.orientation(slot[toA], id, p) < 0 ? 1U : 0U;
    }
    if (__builtin_expect(undecided & 2, 0))
    {
      isRight |= predicates.orientation(id, slot[toB], p) < 0 ? 2U : 0U;
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
