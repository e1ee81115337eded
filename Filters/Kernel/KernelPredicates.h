// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippKernelPredicates_h
#define tippKernelPredicates_h

#include "Kernel/HalfEdgeMesh.h"
#include "Predicates/CoordinateGrid.h"
#include "Predicates/Points.h"

#include <cstddef>

namespace tipp
{

/// The vertex at infinity; its coordinates are NaN.
constexpr HalfEdgeMesh::Index InfiniteVertex = 0;

// Error bounds of the kernel's floating-point filters on the original doubles, for vectors from the
// inserted point (see Predicates/ for the proofs). The absolute term covers underflow. Overflow and
// NaN fail every comparison, so that the exact predicates below decide.
constexpr double TurnFilterBound = 3.3306690738754716e-16;
constexpr double CircleFilterBound = 3.4 * 1.1102230246251565e-16;
constexpr double UnderflowBound = 1e-300;

/// Exact predicates for what the kernel's floating-point filters cannot decide.
class KernelPredicates
{
public:
  KernelPredicates() = default;
  KernelPredicates(const Point2* points, std::size_t count) { this->restart(points, count); }

  /// Sets the coordinates of `count` vertices, the infinite one first. The caller owns them.
  void restart(const Point2* points, std::size_t count);

  /// The sign of the orientation of the vertices a, b and the point p: positive if p is to the
  /// left.
  int orientation(HalfEdgeMesh::Index a, HalfEdgeMesh::Index b, Point2 p);

  /// Whether p is inside the circumdisk of the triangle with these corners (an array of three
  /// vertices), ties broken (Lemma 4). The circumdisk of an infinite triangle is the open
  /// half-plane beyond its hull edge, and that edge without its ends.
  bool isInConflict(const HalfEdgeMesh::Index* corners, Point2 p);

private:
  const CoordinateGrid& grid();

  const Point2* Points = nullptr;
  std::size_t Count = 0;
  CoordinateGrid Grid;
  bool GridIsCurrent = false;
  std::size_t Turns = 0; ///< calls of orientation() since restart()
};

} // namespace tipp

#endif
