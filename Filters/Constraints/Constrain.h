// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstrain_h
#define tippConstrain_h

#include "Constraints/Constraint.h"
#include "Constraints/PartitionConstraints.h"
#include "Triangulation/PointsView.h"

#include <vector>

namespace tipp
{

/// Turns the triangulation of points, in which some of these pieces were inserted already, into the
/// constrained Delaunay triangulation of all, in place. No piece crosses another. Pieces come to
/// name the points that stand for their ends, and are split at vertices that lie on them.
///
/// Only triangles that a piece crosses change. Pieces that cross the same triangle form one job
/// with the triangles that they cross; jobs do not depend on each other. The new triangles of a job
/// take the positions of the old ones, both in their order, so that the result is the same for any
/// number of threads.
void constrain(PointsView points, Triangulation& triangulation,
  std::vector<ConstraintPiece>& pieces, PartitionConstraints& inserted, int threads);

} // namespace tipp

#endif
