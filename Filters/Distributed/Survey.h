// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSurvey_h
#define tippSurvey_h

#include "Messages/Communicator.h"
#include "Predicates/Point2.h"
#include "Triangulation/PointsView.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// The result of the first pass over all ranks' points.
struct Survey
{
  PointsView Points;                  ///< this rank's, scaled to a moderate magnitude
  Box2 Bounds{};                      ///< of all ranks' finite points
  std::vector<std::int64_t> Rejected; ///< indices of this rank's points that are not finite
  bool IsCollinear = false;           ///< all finite points on one line, or fewer than three
};

/// Surveys all ranks' points. Collective.
Survey surveyRanks(Communicator& ranks, PointsView points, int threads);

/// Returns, on the first rank, about `wanted` of all ranks' points, evenly spaced on each rank.
/// Surveys all ranks' points. Collective.
std::vector<Point2> gatherSample(
  Communicator& ranks, PointsView points, std::int64_t allPoints, std::size_t wanted);

} // namespace tipp

#endif
