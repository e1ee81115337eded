// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointLocation_h
#define tippPointLocation_h

#include "Kernel/HalfEdgeMesh.h"
#include "Kernel/KernelPredicates.h"

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

/// Walks from the edge opposite to `start`, of a finite triangle, to a triangle that holds p, or to
/// the infinite triangle at a hull edge that p lies outside of. In a Delaunay triangulation such a
/// walk ends (Devillers, Pion, Teillaud 2002).
Location locate(const HalfEdgeMesh& mesh, const Point2* points, KernelPredicates& predicates,
  HalfEdgeMesh::Index start, Point2 p);

} // namespace tipp

#endif
