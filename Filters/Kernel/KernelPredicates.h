// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippKernelPredicates_h
#define tippKernelPredicates_h

#include "Kernel/HalfEdgeMesh.h"
#include "Kernel/TetrahedronMesh.h"
#include "Predicates/ExactPredicates.h"
#include "Predicates/ExactPredicates3.h"
#include "Predicates/Geometry.h"

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

/// The kernel's exact predicates on vertices of a mesh whose vertex 0 is at infinity. If all
/// coordinates are multiples of one unit, as in lattices, doubles are exact for points that are
/// close together. The object looks for such a unit once the filters have failed a few times.
class KernelPredicates3
{
public:
  using Index = TetrahedronMesh::Index;

  /// Prepares for new points, which are not copied; `count` includes the vertex at infinity.
  void restart(const Point3* points, std::size_t count);

  /// Returns whether p is in conflict with the finite tetrahedron of the vertices v[0..3]. Ties are
  /// broken by lexicographic order.
  bool isInFiniteConflict(const Index* v, const Point3& p)
  {
    const InSphereValue value = inSphereValue(
      this->Points[v[0]], this->Points[v[1]], this->Points[v[2]], this->Points[v[3]], p);
    return __builtin_expect(isCertain(value), 1) ? value.determinant > 0
                                                 : this->isInFiniteConflict(v, p, value);
  }

  /// Returns whether p is in conflict with an infinite tetrahedron: p is beyond its hull facet, or
  /// it is in the facet's plane and in conflict with the finite neighbour. `cell`: first slot of
  /// the tetrahedron.
  bool isInInfiniteConflict(const Index* slots, Index cell, const Point3& p);

  /// Returns the sign of orientation3(), with the same exactness.
  int orientation(const Point3& a, const Point3& b, const Point3& c, const Point3& d);

private:
  bool isInFiniteConflict(const Index* v, const Point3& p, const InSphereValue& value);
  void countFailure();

  const Point3* Points = nullptr;
  std::size_t Count = 0;
  std::size_t Failures = 0;
  double ExactLifts = -1; ///< in-sphere determinants are exact up to this sum of lifts; -1: unknown
  double ExactDifference = 0; ///< orientations are exact up to this largest coordinate difference
};

} // namespace tipp

#endif
