// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTetrahedralize_h
#define tippTetrahedralize_h

#include "Arrays/Buffer.h"
#include "Predicates/Geometry.h"
#include "Triangulation/Triangulate.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace tipp
{

/// Options of tetrahedralize(). The result does not depend on them.
struct TetrahedralizationOptions
{
  int Partitions = 0; ///< 0: chosen by the number of points and threads
  int Threads = 0;    ///< 0: defaultThreads()
  /// Called regularly with the finished fraction (0 to 1), by one thread at a time. Returns false
  /// to abort the run.
  std::function<bool(double)> Progress;
};

/// The Delaunay tetrahedra, as four point ids each: 32-bit indices into the input. orientation3()
/// of the corners is positive. The lowest id is first and the others ascend, except that the last
/// two are exchanged if the orientation requires it. Tetrahedra are in the lexicographic order of
/// their ascending ids.
struct Tetrahedralization : TriangulatedPoints
{
  Buffer<std::int32_t> Ids;
  /// The dimension of the finite points: -1 without any, 0 if all have the same coordinates, 1 if
  /// they are collinear, 2 if coplanar, else 3. Below 3 there are no tetrahedra.
  int Dimension = -1;

  std::size_t cellCount() const { return this->Ids.size() / 4; }
};

/// Throws std::length_error for 2^31 points or more, since ids have 32 bits.
void requireShortIds(std::size_t count);

/// Returns the Delaunay triangulation of the distinct finite points. Ties are broken by the points'
/// lexicographic order, so for all options the set of tetrahedra equals that of CGAL's
/// Delaunay_triangulation_3. Throws std::length_error for 2^31 points or more, and std::bad_alloc.
VTKTIPPFILTERS_EXPORT Tetrahedralization tetrahedralize(
  const Point3* points, std::size_t count, const TetrahedralizationOptions& options = {});

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

/// Returns a sentence that says why points of this dimension, below 3, have no tetrahedra.
std::string describeDimension(int dimension);

} // namespace tipp

#endif
