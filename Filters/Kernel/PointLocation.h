// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointLocation_h
#define tippPointLocation_h

#include "Kernel/HalfEdgeMesh.h"
#include "Kernel/KernelPredicates.h"
#include "Kernel/Lanes.h"

namespace tipp
{

/// A vertex as seen from the point p that is being inserted.
struct Direction
{
  double X;
  double Y;
  double lift() const { return this->X * this->X + this->Y * this->Y; }
};

/// A triangle in conflict with p, as seen from p. Edge i goes from corner i to the next; the
/// corners are in order, but need not begin with slot 0.
struct Location
{
  HalfEdgeMesh::Index Triangle;
  HalfEdgeMesh::Index Vertex[3];
  Direction Corner[3];
  double Cross[3]; ///< of each edge's ends
  HalfEdgeMesh::Index Outer[3];
  bool LastIsOutside;          ///< the triangle behind edge 2 is known not to be in conflict
  HalfEdgeMesh::Index EqualTo; ///< the vertex at p; then there is no conflict, or InfiniteVertex
};

inline Direction directionTo(Point2 v, Point2 p)
{
  return { v.x - p.x, v.y - p.y };
}

inline double cross(const Direction& a, const Direction& b)
{
  return a.X * b.Y - a.Y * b.X;
}

/// Finds a triangle in conflict with a point.
class PointLocation
{
public:
  using Index = HalfEdgeMesh::Index;

  PointLocation(
    const HalfEdgeMesh& mesh, const Point2* points, KernelPredicates& predicates, Point2 p)
    : Slot(mesh.slots())
    , Points(points)
    , Predicates(predicates)
    , P(p)
  {
  }

  /// Walks from a finite triangle towards p until a triangle is in conflict with it: the one that
  /// holds p at the latest, or the infinite triangle at a hull edge that p lies beyond. In a
  /// Delaunay triangulation such a walk ends (Devillers, Pion, Teillaud 2002).
  Location from(Index start)
  {
    const Index* const v = this->Slot + start;
    const Direction a = directionTo(this->Points[v[0]], this->P);
    const Direction b = directionTo(this->Points[v[1]], this->P);
    const Direction c = directionTo(this->Points[v[2]], this->P);
    const double ab = cross(a, b);
    const double bc = cross(b, c);
    const double ca = cross(c, a);
    if (this->isInConflict(start, a.lift(), b.lift(), c.lift(), ab, bc, ca))
    {
      return { start, { v[0], v[1], v[2] }, { a, b, c }, { ab, bc, ca },
        { v[2 + 4], v[0 + 4], v[1 + 4] }, false, this->EqualTo };
    }
    if (this->isRight(v[1], v[2], bc, b, c))
    {
      return this->walk(v[0 + 4], b, c, bc);
    }
    if (this->isRight(v[2], v[0], ca, c, a))
    {
      return this->walk(v[1 + 4], c, a, ca);
    }
    return this->walk(v[2 + 4], a, b, ab);
  }

private:
  /// p lies to the right of the edge from a to b; behind it, at half-edge h, is a triangle (a, d,
  /// b).
  Location walk(Index h, Direction a, Direction b, double ab)
  {
    double al = a.lift();
    double bl = b.lift();
    for (;;)
    {
      const Index id = this->Slot[h];
      const Index toA = HalfEdgeMesh::previous(h);
      const Index toB = HalfEdgeMesh::next(h);
      const Direction d = directionTo(this->Points[id], this->P);
      const double dl = d.lift();
      const double ad = cross(a, d);
      const double db = cross(d, b);
      if (this->isInConflict(HalfEdgeMesh::triangleOf(h), al, dl, bl, ad, db, -ab))
      {
        return { HalfEdgeMesh::triangleOf(h), { this->Slot[toA], id, this->Slot[toB] }, { a, d, b },
          { ad, db, -ab }, { this->Slot[toB + 4], this->Slot[toA + 4], this->Slot[h + 4] }, true,
          this->EqualTo };
      }
      if (this->isRight(this->Slot[toA], id, ad, a, d))
      {
        b = d;
        bl = dl;
        ab = ad;
        h = this->Slot[toB + 4];
      }
      else
      {
        a = d;
        al = dl;
        ab = db;
        h = this->Slot[toA + 4];
      }
    }
  }

  /// A vertex at p is on the circle, and ends the walk as well.
  bool isInConflict(
    Index triangle, double al, double bl, double cl, double ab, double bc, double ca)
  {
    const double det = al * bc + bl * ca + cl * ab;
    const double lifts = al + bl + cl;
    const double bound = CircleFilterBound * (lifts * lifts) + UnderflowBound;
    if (__builtin_expect(!(__builtin_fabs(det) > bound), 0))
    {
      this->EqualTo = vertexAt(this->Slot + triangle, this->Points, this->P);
      return this->EqualTo != InfiniteVertex ||
        this->Predicates.isInConflict(this->Slot + triangle, this->P);
    }
    return det > 0;
  }

  /// Static, as a call with this object would keep it in memory.
  [[gnu::noinline]] static Index vertexAt(const Index* corners, const Point2* points, Point2 p)
  {
    for (Index i = 0; i < 3; ++i)
    {
      if (points[corners[i]] == p)
      {
        return corners[i];
      }
    }
    return InfiniteVertex;
  }

  /// Whether p is to the right of the edge from u to w.
  bool isRight(Index u, Index w, double turn, const Direction& from, const Direction& to)
  {
    const double bound =
      TurnFilterBound * (__builtin_fabs(from.X * to.Y) + __builtin_fabs(from.Y * to.X)) +
      UnderflowBound;
    if (__builtin_expect(!(__builtin_fabs(turn) > bound), 0))
    {
      return this->Predicates.orientation(u, w, this->P) < 0;
    }
    return turn < 0;
  }

  const Index* const Slot;
  const Point2* const Points;
  KernelPredicates& Predicates;
  const Point2 P;
  Index EqualTo = InfiniteVertex;
};

} // namespace tipp

#endif
