// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippStartMesh_h
#define tippStartMesh_h

#include "Constraints/Insertion/TriangulateConstrained.h"
#include "Refinement/RefinementMesh.h"
#include "Refinement/RefinementOptions.h"
#include "Triangulation/PointsView.h"

namespace tipp
{

/// Fills an empty mesh with the triangles of the domain, whose border becomes segments, and sets
/// their regions: 0, or 1 and the index of a region in the options. Throws as refine() does.
void startMesh(PointsView points, const ConstrainedTriangulation& triangulation,
  const RefinementOptions& options, RefinementMesh& mesh);

} // namespace tipp

#endif
