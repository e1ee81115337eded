// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellBox_h
#define tippCellBox_h

#include "Predicates/Points.h"
#include "vtkTIPPAcceleratorsModule.h"

namespace tipp
{

// Two convex sets are disjoint if and only if a line, or in 3D a plane, that is parallel to a side
// of one of them or to an edge of each lies strictly between them (the separating axes of
// Gottschalk, Lin and Manocha, OBBTree, 1996). Each axis takes a few orientation tests, which are
// exact.

/// Whether the closed triangle and the closed box share a point, in x and y; touching counts. Exact
/// for finite coordinates, also if the triangle or the box is a segment or a point.
VTKTIPPACCELERATORS_EXPORT bool triangleMeetsBox(Point2 a, Point2 b, Point2 c, const Box3& box);

/// Whether the closed tetrahedron and the closed box share a point; touching counts. Exact for
/// finite coordinates, also if one is flat: with c = d this is a triangle in space.
VTKTIPPACCELERATORS_EXPORT bool tetrahedronMeetsBox(
  const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Box3& box);

} // namespace tipp

#endif
