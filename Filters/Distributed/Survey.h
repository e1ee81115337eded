// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSurvey_h
#define tippSurvey_h

#include "Messages/Postbox.h"
#include "Predicates/Box2.h"
#include "Triangulation/PointsView.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// What all ranks know of all points after a first look.
struct Survey
{
  PointsView Points;                  ///< this rank's, at a moderate magnitude
  Box2 Bounds{};                      ///< of all ranks' finite points
  std::vector<std::int64_t> Rejected; ///< of this rank's points, those that are not finite
  bool IsCollinear = false;           ///< all finite points on one line, or fewer than three
};

/// Collective.
Survey surveyRanks(Postbox& ranks, PointsView points, int threads);

/// On the first rank about `wanted` of all ranks' points, evenly spaced on each. Collective.
std::vector<Point2> gatherSample(
  Postbox& ranks, PointsView points, std::int64_t allPoints, std::size_t wanted);

} // namespace tipp

#endif
