// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippKernelPredicates3_h
#define tippKernelPredicates3_h

#include "Kernel3D/TetrahedronMesh.h"
#include "Predicates/InSphere.h"
#include "Predicates/Points.h"

#include <cstddef>

namespace tipp
{

/// The kernel's exact predicates on vertices of a mesh whose vertex 0 is at infinity. If
/// coordinates are multiples of one unit, as those of lattices are, doubles are exact for near
/// points: that is found out when filters have failed a few times.
class KernelPredicates3
{
public:
  using Index = TetrahedronMesh::Index;

  /// Begins with new points; `count` includes the vertex at infinity.
  void restart(const Point3* points, std::size_t count);

  /// Whether p is in conflict with the finite tetrahedron of these vertices, ties decided.
  bool isInFiniteConflict(const Index* v, const Point3& p)
  {
    const InSphereValue value = inSphereValue(
      this->Points[v[0]], this->Points[v[1]], this->Points[v[2]], this->Points[v[3]], p);
    return __builtin_expect(isCertain(value), 1) ? value.determinant > 0
                                                 : this->isInFiniteConflict(v, p, value);
  }

  /// Whether p is in conflict with a tetrahedron at infinity: that of the points beyond its facet,
  /// and those in the facet's plane that its neighbour is in conflict with.
  bool isInInfiniteConflict(const Index* slots, Index cell, const Point3& p);

  /// As orientation3().
  int orientation(const Point3& a, const Point3& b, const Point3& c, const Point3& d);

private:
  bool isInFiniteConflict(const Index* v, const Point3& p, const InSphereValue& value);
  void countFailure();

  const Point3* Points = nullptr;
  std::size_t Count = 0;
  std::size_t Failures = 0;
  double ExactLifts = -1;     ///< in-sphere values are exact up to this sum of lifts,
  double ExactDifference = 0; ///< and orientations up to this largest difference
};

} // namespace tipp

#endif
