// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSmooth_h
#define tippSmooth_h

#include "Refinement/Refine.h"
#include "Refinement/RefinementOptions.h"
#include "Triangulation/PointsView.h"
#include "vtkTIPPFiltersModule.h"

namespace tipp
{

/// Moves points of a mesh that refine() made so that the smallest angles around them grow. Each
/// round visits all points once, and proposes the mean of a point's neighbours. A move is accepted
/// only if
/// - the smallest angle at its triangles grows, and none falls below Options.MinimumAngle,
/// - no area is above its limit, and no edge shorter than Options.ShortestEdge,
/// - the triangles remain constrained Delaunay, in exact arithmetic, without a change of edges.
///
/// Only points that refinement added inside the domain move: points given, those on segments and
/// corners of RefinedMesh::Outside stay. So triangles, segments and Outside do not change.
///
/// `points` are those of refine(). Points that do not see each other's moves have the same colour,
/// and move at once: the result is the same for any number of threads. Ends early when nothing
/// moves. Adds to RefinementStatistics::Moves; sets Aborted if options.Progress stopped it.
VTKTIPPFILTERS_EXPORT void smooth(
  PointsView points, const RefinementOptions& options, int rounds, RefinedMesh& mesh);

} // namespace tipp

#endif
