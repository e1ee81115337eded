// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCoplanarPoints_h
#define tippCoplanarPoints_h

#include "Triangulation/Triangulate.h"
#include "Triangulation3D/Tetrahedralize.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>

namespace tipp
{

/// Triangulates points in one plane of space: those of which tetrahedralize() or
/// tetrahedralizeMerged() has found Dimension 2, in `mesh`. Sets the duplicates of `mesh`.
///
/// The result is the 2D Delaunay triangulation of the points' projection along a coordinate axis:
/// the axis in which the plane's normal is longest, z rather than y rather than x. This is decided
/// in exact arithmetic, and no two points have the same projection, so triangles share only whole
/// edges and the points' order plays no part. Where the plane is parallel to two axes, its own
/// Delaunay triangulation results; elsewhere the projection shortens distances along one direction.
///
/// Triangles have 32-bit ids, the lowest first, turn counter-clockwise seen against the axis, and
/// are in lexicographic order: the same for any number of threads. Aborted is set if Progress ended
/// the run.
VTKTIPPFILTERS_EXPORT Triangulation triangulateCoplanar(const Point3* points, std::size_t count,
  const TetrahedralizationOptions& options, Tetrahedralization& mesh);

} // namespace tipp

#endif
