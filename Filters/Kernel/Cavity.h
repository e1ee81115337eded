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

/// Replaces the triangles in conflict with an inserted vertex, its cavity (Bowyer 1981, Watson
/// 1981).
class Cavity
{
public:
  using Index = HalfEdgeMesh::Index;

  Cavity();

  /// Removes the triangles in conflict with `vertex`, starting at `found`, and connects the vertex
  /// to every edge of the cavity's boundary. The new triangles reuse the indices of the removed
  /// ones; two more are appended to the mesh, which must have capacity for three more. Returns a
  /// new triangle that is finite.
  Index retriangulate(HalfEdgeMesh& mesh, const Point2* points, KernelPredicates& predicates,
    const Location& found, Index vertex);

private:
  /// The apexes of the triangles across the two edges of a pair.
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
  /// Consecutive new triangles, counter-clockwise around p.
  struct Fan
  {
    Index First;
    Index Last;
  };
  /// A pair of edges to process later, and the new triangles that follow those found across it.
  struct Deferred
  {
    EdgePair Edges;
    Fan After;
  };

  class Growth;
  void grow();

  // Kept larger than any insertion so far has needed.
  std::vector<Index> Places; ///< indices for new triangles: the two appended, then the removed
  std::vector<Deferred> Stack;
};

} // namespace tipp

#endif
