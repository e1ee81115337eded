// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointLocation_h
#define tippPointLocation_h

#include "Kernel/HalfEdgeMesh.h"
#include "Kernel/KernelPredicates.h"
#include "Kernel/Pairs.h"
#include "Predicates/Geometry.h"

#include <utility>

namespace tipp
{

/// The vector from a vertex to the point p that is being inserted, as lanes x and y.
inline Pair towards(Pair p, const Point2* points, HalfEdgeMesh::Index vertex)
{
  return p - pairAt(&points[HalfEdgeMesh::offset(vertex)].x);
}

/// A vertex relative to p.
struct Corner
{
  double X; ///< vector from the vertex to p
  double Y;
  double Lift;
  HalfEdgeMesh::Index Vertex;

  static Corner of(Pair p, const Point2* points, HalfEdgeMesh::Index vertex)
  {
    const Pair d = towards(p, points, vertex);
    return { d[0], d[1], d[0] * d[0] + d[1] * d[1], vertex };
  }
};

/// The cross product a x b of the corners' vectors.
inline double cross(const Corner& a, const Corner& b)
{
  return a.X * b.Y - a.Y * b.X;
}

/// Two consecutive edges, one in each lane of every pair, counter-clockwise around p: from the
/// vertex Start to Middle, and from Middle to Stop. Vectors point from the vertices to p.
struct EdgePair
{
  using Index = HalfEdgeMesh::Index;

  Pair StartX;
  Pair StartY;
  Pair StartLift;
  Pair StopX;
  Pair StopY;
  Pair StopLift;
  Pair Cross; ///< start x stop
  // The edges' twins. Not an array, which would prevent keeping the struct in registers.
  Index FirstOuter;
  Index SecondOuter;
  Index Start;
  Index Middle;
  Index Stop;

  static EdgePair of(const Corner& a, const Corner& b, const Corner& c, double ab, double bc,
    Index firstOuter, Index secondOuter)
  {
    return { Pair{ a.X, b.X }, Pair{ a.Y, b.Y }, Pair{ a.Lift, b.Lift }, Pair{ b.X, c.X },
      Pair{ b.Y, c.Y }, Pair{ b.Lift, c.Lift }, Pair{ ab, bc }, firstOuter, secondOuter, a.Vertex,
      b.Vertex, c.Vertex };
  }

  /// The edge from Stop to Start, in both lanes.
  EdgePair closing(double cross, Index outer) const
  {
    return { high(this->StopX, this->StopX), high(this->StopY, this->StopY),
      high(this->StopLift, this->StopLift), low(this->StartX, this->StartX),
      low(this->StartY, this->StartY), low(this->StartLift, this->StartLift), Pair{ cross, cross },
      outer, outer, this->Stop, this->Start, this->Start };
  }
};

/// A triangle in conflict with the point p that is being inserted.
struct Location
{
  HalfEdgeMesh::Index Triangle;  ///< the triangle's index in the mesh
  EdgePair Edges;                ///< two of its edges
  HalfEdgeMesh::Index LastOuter; ///< the twin of the third edge, from Stop to Start
  double LastCross;
  bool LastIsOutside;          ///< the triangle across that edge is known not to be in conflict
  HalfEdgeMesh::Index EqualTo; ///< vertex with p's coordinates, or InfiniteVertex if none
};

/// Finds a triangle in conflict with a point, by a walk that the caller does step by step.
class PointLocation
{
public:
  using Index = HalfEdgeMesh::Index;

  PointLocation(const HalfEdgeMesh& mesh, const Point2* points, KernelPredicates& predicates)
    : Slot(mesh.slots())
    , Points(points)
    , Predicates(predicates)
  {
  }

  /// Begins a walk towards p at the finite triangle `start`. It ends at the first triangle in
  /// conflict with p: at the latest the one that contains p, or the infinite triangle at a hull
  /// edge that p lies beyond. In a Delaunay triangulation it terminates (Devillers, Pion, Teillaud
  /// 2002).
  void begin(Pair p, Index start)
  {
    this->P = p;
    this->EqualTo = InfiniteVertex;
    const Index* const v = this->Slot + HalfEdgeMesh::offset(start);
    this->A = this->corner(v[0]);
    this->B = this->corner(v[1]);
    this->C = this->corner(v[2]);
    this->AB = cross(this->A, this->B);
    this->BC = cross(this->B, this->C);
    this->CA = cross(this->C, this->A);
    this->Last = start + 1;
    this->IsAtStart = true;
    this->IsAtEnd = this->isInConflict();
  }

  bool isAtEnd() const { return this->IsAtEnd; }

  /// Goes to the next triangle.
  void step()
  {
    this->IsAtStart ? this->chooseFirstExit() : this->chooseExit();
    this->enter();
  }

  /// Continues with the triangle behind the exit.
  void enter()
  {
    this->IsAtStart = false;
    this->B = this->corner(this->Slot[HalfEdgeMesh::offset(this->Last)]);
    this->AB = cross(this->A, this->B);
    this->BC = cross(this->B, this->C);
    this->IsAtEnd = this->isInConflict();
  }

  /// Where the walk ended.
  Location location() const
  {
    const Index last = this->Last;
    return { HalfEdgeMesh::triangleOf(last),
      EdgePair::of(this->A, this->B, this->C, this->AB, this->BC,
        HalfEdgeMesh::twinOfNext(this->Slot, last), HalfEdgeMesh::twinOfPrevious(this->Slot, last)),
      HalfEdgeMesh::twinOf(this->Slot, last), this->CA, !this->IsAtStart, this->EqualTo };
  }

  /// The whole walk.
  Location from(Pair p, Index start)
  {
    this->begin(p, start);
    if (!this->IsAtEnd)
    {
      this->chooseFirstExit();
      this->enter();
      while (!this->IsAtEnd)
      {
        this->chooseExit();
        this->enter();
      }
    }
    return this->location();
  }

private:
  Corner corner(Index vertex) const { return Corner::of(this->P, this->Points, vertex); }

  /// Chooses an edge of the first triangle that p lies beyond as the edge from C to A, whose
  /// opposite vertex B is to be found next.
  void chooseFirstExit()
  {
    const Index* const v = this->Slot + HalfEdgeMesh::offset(HalfEdgeMesh::triangleOf(this->Last));
    if (this->isRight(this->B, this->C, this->BC))
    {
      this->Last = v[4];
      this->A = this->B;
      this->CA = -this->BC;
    }
    else if (this->isRight(this->C, this->A, this->CA))
    {
      this->Last = v[5];
      std::swap(this->A, this->C);
      this->CA = -this->CA;
    }
    else
    {
      this->Last = v[6];
      this->C = this->B;
      this->CA = -this->AB;
    }
  }

  /// The same in a later triangle, which the walk entered across the edge from C to A.
  void chooseExit()
  {
    if (this->isRight(this->A, this->B, this->AB))
    {
      this->C = this->B;
      this->CA = -this->AB;
      this->Last = HalfEdgeMesh::twinOfNext(this->Slot, this->Last);
    }
    else
    {
      this->A = this->B;
      this->CA = -this->BC;
      this->Last = HalfEdgeMesh::twinOfPrevious(this->Slot, this->Last);
    }
  }

  /// A vertex with p's coordinates is on the circle, and ends the walk as well.
  bool isInConflict()
  {
    const double det = this->A.Lift * this->BC + this->B.Lift * this->CA + this->C.Lift * this->AB;
    const double lifts = this->A.Lift + this->B.Lift + this->C.Lift;
    const double bound = CircleFilterBound * (lifts * lifts) + UnderflowBound;
    if (__builtin_expect(!(__builtin_fabs(det) > bound), 0))
    {
      const Index* const corners =
        this->Slot + HalfEdgeMesh::offset(HalfEdgeMesh::triangleOf(this->Last));
      this->EqualTo = vertexAt(corners, this->Points, this->point());
      return this->EqualTo != InfiniteVertex ||
        this->Predicates.isInConflict(corners, this->point());
    }
    return det > 0;
  }

  /// The corner with p's coordinates, if any. Static, because a call on this object would force it
  /// into memory.
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

  /// Whether p is to the right of the edge from u to w. |ux wy| + |uy wx| is at most half the sum
  /// of their lifts.
  bool isRight(const Corner& u, const Corner& w, double turn)
  {
    const double bound = TurnFilterBound * (u.Lift + w.Lift) + UnderflowBound;
    if (__builtin_expect(!(__builtin_fabs(turn) > bound), 0))
    {
      return this->Predicates.orientation(u.Vertex, w.Vertex, this->point()) < 0;
    }
    return turn < 0;
  }

  Point2 point() const { return { this->P[0], this->P[1] }; }

  const Index* const Slot;
  const Point2* const Points;
  KernelPredicates& Predicates;
  Pair P{ 0, 0 };
  Index EqualTo = InfiniteVertex;
  bool IsAtStart = true;
  bool IsAtEnd = false;

  // The triangle reached: Last is its half-edge from C to A.
  Corner A = {};
  Corner B = {};
  Corner C = {};
  double AB = 0;
  double BC = 0;
  double CA = 0;
  Index Last = 0;
};

} // namespace tipp

#endif
