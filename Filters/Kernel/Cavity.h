// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCavity_h
#define tippCavity_h

#include "Kernel/HalfEdgeMesh.h"
#include "Kernel/KernelPredicates.h"
#include "Kernel/Lanes.h"
#include "Kernel/PointLocation.h"

#include <cstddef>
#include <vector>

namespace tipp
{

/// The triangles that one insertion destroys, and the edges around them (Bowyer 1981, Watson 1981).
class Cavity
{
public:
  using Index = HalfEdgeMesh::Index;

  Cavity();

  /// Collects the triangles in conflict with p, from the one that holds it.
  void open(const HalfEdgeMesh& mesh, const Point2* points, KernelPredicates& predicates,
    const Location& location, Point2 p);

  /// Joins the vertex to every edge of the ring, in the places of the destroyed triangles and two
  /// new ones at the end. Returns one of the new triangles, a finite one.
  Index fill(HalfEdgeMesh& mesh, Index vertex);

private:
  /// Two edges side by side, (first, second) in every pair, counter-clockwise around p.
  struct EdgePair
  {
    Pair StartX; ///< from p
    Pair StartY;
    Pair StartLift;
    Pair StopX;
    Pair StopY;
    Pair StopLift;
    Pair Cross; ///< start x stop
    // The half-edges on their other sides; no array, which would keep all this out of registers.
    Index FirstOuter;
    Index SecondOuter;
  };
  /// The apexes of the triangles behind a pair.
  struct ApexPair
  {
    Pair X;
    Pair Y;
    Pair Lift;
    Pair StartCross; ///< start x apex
    Pair CrossStop;  ///< apex x stop
  };
  struct RingEdge
  {
    Index Outer;
    Index Start;
  };
  /// What is left to do while the cavity grows: another pair, or an edge of the ring.
  struct Deferred
  {
    EdgePair Edges;
    bool IsPair;
  };

  class Growth;
  void grow();

  // All of one size, larger than any insertion has needed yet.
  std::vector<Index> Triangles;
  std::vector<RingEdge> Ring; ///< counter-clockwise
  std::vector<Deferred> Stack;
  std::size_t RingSize = 0;
};

} // namespace tipp

#endif
