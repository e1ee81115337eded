// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSurveyPoints_h
#define tippSurveyPoints_h

#include "Flat/FlatMesh.h"
#include "Partition/BoxTiling.h"
#include "Partitioning/Ranks.h"
#include "Predicates/Box3.h"

#include <string>

namespace tipp
{

/// The bounding box of all points, in as many dimensions as the cells have; 0 in the third of
/// triangles. Throws IOError naming the first point with a coordinate that is not finite. A call of
/// all ranks.
Box3 surveyPoints(const FlatMesh& mesh, const Ranks& ranks, int threads);

/// Writes each point's home, the first partition whose closed box holds it, to a file of 4 bytes a
/// point: its id, or -1 - id if others hold the point too. A call of all ranks.
void writeHomes(const FlatMesh& mesh, const BoxTiling& tiling, const std::string& path,
  const Ranks& ranks, int threads);

} // namespace tipp

#endif
