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

/// The triangles that one insertion destroys, and those that take their place (Bowyer 1981, Watson
/// 1981).
class Cavity
{
public:
  using Index = HalfEdgeMesh::Index;

  Cavity();

  /// Destroys the triangles in conflict with the vertex, beginning with the one found, and joins it
  /// to every edge around them; the new triangles are in the places of those destroyed, two more at
  /// the end. The mesh has room for three more. Returns one of the new triangles, a finite one.
  Index retriangulate(HalfEdgeMesh& mesh, const Point2* points, KernelPredicates& predicates,
    const Location& found, Index vertex);

private:
  /// The apexes of the triangles behind a pair.
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
  /// New triangles side by side, counter-clockwise around p.
  struct Fan
  {
    Index First;
    Index Last;
  };
  /// A pair to go on with later, and the new triangles that follow those behind it.
  struct Deferred
  {
    EdgePair Edges;
    Fan After;
  };

  class Growth;
  void grow();

  // Larger than any insertion has needed yet.
  std::vector<Index> Places; ///< for new triangles: the two at the end, then the destroyed ones'
  std::vector<Deferred> Stack;
};

} // namespace tipp

#endif
