// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCoplanarPoints_h
#define tippCoplanarPoints_h

#include "Triangulation/Triangulate.h"
#include "Triangulation3D/Tetrahedralize.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>

namespace tipp
{

/// Triangulates points that lie in one plane of space. `mesh` is the result of tetrahedralize() or
/// tetrahedralizeMerged() for them, with Dimension 2; this function sets its duplicates.
///
/// The result is the 2D Delaunay triangulation of the points' projection along a coordinate axis:
/// the axis in which the plane's normal is longest, z if there is a tie, then y. The choice is made
/// in exact arithmetic. No two points have the same projection, so the triangles form a valid mesh,
/// and the order of the points has no influence. If the plane is perpendicular to an axis, the
/// result is the Delaunay triangulation in the plane; otherwise the projection shortens distances
/// in one direction.
///
/// Triangles have 32-bit ids (Ids32), which are indices into `points`. The lowest id is first, the
/// triangles are counter-clockwise when seen against the axis, and they are in lexicographic order.
/// So the result is the same for any number of threads. Aborted is set if Progress stopped the run.
VTKTIPPFILTERS_EXPORT Triangulation triangulateCoplanar(const Point3* points, std::size_t count,
  const TetrahedralizationOptions& options, Tetrahedralization& mesh);

} // namespace tipp

#endif
