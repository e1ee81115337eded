// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSurveyPoints_h
#define tippSurveyPoints_h

#include "Flat/FlatMesh.h"
#include "Partition/BoxTiling.h"
#include "Partitioning/Ranks.h"
#include "Predicates/Point3.h"

#include <string>

namespace tipp
{

/// Returns the bounding box of all points in the cells' dimension; for triangles z is 0. Throws
/// IOError naming the first point with a coordinate that is not finite. Collective.
Box3 surveyPoints(const FlatMesh& mesh, const Ranks& ranks, int threads);

/// Writes each point's owner, the first partition whose closed box contains it, to a file of 4
/// bytes per point: the partition's index, or -1 - index if others contain the point, too.
/// Collective.
void writeHomes(const FlatMesh& mesh, const BoxTiling& tiling, const std::string& path,
  const Ranks& ranks, int threads);

} // namespace tipp

#endif
