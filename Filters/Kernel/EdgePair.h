// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippEdgePair_h
#define tippEdgePair_h

#include "Kernel/HalfEdgeMesh.h"
#include "Kernel/Lanes.h"
#include "Predicates/Point2.h"

namespace tipp
{

/// The vector from a vertex to the point p that is being inserted; lanes x and y.
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
  // Their twins. Not an array, which would keep the struct out of registers.
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

} // namespace tipp

#endif
