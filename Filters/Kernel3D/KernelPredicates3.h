// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippKernelPredicates3_h
#define tippKernelPredicates3_h

#include "Kernel3D/TetrahedronMesh.h"
#include "Predicates/InSphere.h"
#include "Predicates/Points.h"

#include <cstddef>

namespace tipp
{

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
