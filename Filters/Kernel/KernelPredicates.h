// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippKernelPredicates_h
#define tippKernelPredicates_h

#include "Kernel/HalfEdgeMesh.h"
#include "Predicates/CoordinateGrid.h"
#include "Predicates/Point2.h"

#include <cstddef>

namespace tipp
{

/// The kernel's vertex at infinity, whose coordinates are NaN.
constexpr HalfEdgeMesh::Index InfiniteVertex = 0;

// Bounds of the kernel's filters on the original doubles, for vectors from the inserted point (see
// Predicates/ for the proofs). The absolute term covers underflow; overflow and NaN fail every
// comparison and so go to the exact answers below.
constexpr double TurnFilterBound = 3.3306690738754716e-16;
constexpr double CircleFilterBound = 3.4 * 1.1102230246251565e-16;
constexpr double UnderflowBound = 1e-300;

/// The exact answers where the kernel's filters have none.
class KernelPredicates
{
public:
  KernelPredicates() = default;
  KernelPredicates(const Point2* points, std::size_t count) { this->restart(points, count); }

  /// With the coordinates of so many vertices, the infinite one first.
  void restart(const Point2* points, std::size_t count);

  int orientation(HalfEdgeMesh::Index a, HalfEdgeMesh::Index b, Point2 p);

  /// Whether p is inside the circumdisk of the triangle with these corners (three slots), ties
  /// broken. That of an infinite triangle is the open half-plane beyond its hull edge, and the open
  /// edge itself.
  bool isInConflict(const HalfEdgeMesh::Index* corners, Point2 p);

private:
  const CoordinateGrid& grid();

  const Point2* Points = nullptr;
  std::size_t Count = 0;
  CoordinateGrid Grid;
  bool GridIsCurrent = false;
  std::size_t Turns = 0; ///< asked for since restart()
};

} // namespace tipp

#endif
