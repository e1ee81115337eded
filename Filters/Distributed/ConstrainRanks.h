// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstrainRanks_h
#define tippConstrainRanks_h

#include "Constraints/ConstraintSegments.h"
#include "Distributed/DistributedTriangulation.h"
#include "Ranks/Communicator.h"
#include "vtkTIPPFiltersModule.h"

namespace tipp
{

/// Turns all ranks' triangulation into the constrained Delaunay triangulation with these segments,
/// the same on all ranks, and cuts it to polygons and boundary. Each rank inserts the segments that
/// are complete in its own triangles, and the first rank the others. Collective; call it within
/// Communicator::together(). `threads`: of each rank.
VTKTIPPFILTERS_EXPORT void constrainRanks(Communicator& ranks, const ConstraintSegments& segments,
  int threads, DistributedTriangulation& mine);

} // namespace tipp

#endif
