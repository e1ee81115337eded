// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDistributedTriangulation_h
#define tippDistributedTriangulation_h

#include "Arrays/Buffer.h"
#include "Distributed/CellExchange.h"
#include "Distributed/DistributedStatistics.h"
#include "Distributed/Plan.h"
#include "Distributed/PointExchange.h"
#include "Ranks/Communicator.h"
#include "Triangulation/InputSurvey.h"
#include "Triangulation/PointsView.h"
#include "Triangulation/Triangulate.h"
#include "vtkTIPPFiltersModule.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Makes a Run on each rank, calls its run(), and returns the result that run() has set.
/// Collective. Throws RankFailure.
template <typename Run, typename Result, typename Points, typename Options>
Result runTogether(Communicator& ranks, const Points& points, const Options& options)
{
  Result result;
  ranks.together([&]() { Run(ranks, points, options, result).run(); });
  return result;
}

/// Numbers all ranks' points and surveys them. Scales this rank's, `input.Points`, to a moderate
/// magnitude if all ranks can do so. Adds those that are not finite to `result`. Collective.
template <int D, typename Result>
InputSurveyOf<D> surveyRanks(
  Communicator& ranks, RankPointsOf<D>& input, Result& result, int threads)
{
  const auto count = std::int64_t(input.Points.size());
  const std::vector<std::int64_t> firsts = firstIndices(ranks, count);
  input.FirstId = firsts[std::size_t(ranks.rank())];
  result.AllPoints = firsts.back();
  const PointSurveyOf<D> found = surveyPoints(input.Points, threads);
  for (const std::int64_t i : found.Rejected)
  {
    result.Rejected.push_back(input.globalId(std::size_t(i)));
  }
  InputSurveyOf<D> own;
  own.Points = count;
  own.Rejected = std::int64_t(found.Rejected.size());
  own.Bounds = found.Bounds;
  DimensionTest<D> dimension;
  for (std::size_t i = 0; !dimension.isFull() && i < input.Points.size(); ++i)
  {
    dimension.add(input.Points[i]);
  }
  own.Simplex = dimension.simplex();
  std::vector<InputSurveyOf<D>> parts = ranks.allGather(own);
  InputSurveyOf<D> survey = joinSurveys(parts);
  survey.Bounds = survey.finite() == 0 ? Box<D>{} : survey.Bounds;
  // All ranks must scale, or none.
  const PointsViewOf<D> moderate = withModerateMagnitude(input.Points, survey.Bounds);
  if (!isTrueOnAny(ranks, moderate.factor() == 1))
  {
    input.Points = moderate;
    applyFactor(survey, moderate.factor());
  }
  return survey;
}

using PointTuples = PointTuplesOf<Point2>;
using IdTriangle = IdCell<3>;
using GhostTriangles = GhostCells<3, Point2>;

/// A rank's part of a triangulation. Corners are local indices (see DistributedPoints).
struct DistributedTriangulation : DistributedPoints<Point2>
{
  Buffer<std::int32_t> Ids32; ///< used if every index fits
  Buffer<std::int64_t> Ids64; ///< used otherwise; one of the two is empty
  DistributedStatistics Statistics;

  std::size_t triangleCount() const { return (this->Ids32.size() + this->Ids64.size()) / 3; }

  /// Calls visit(local index) for the corners of all triangles.
  template <typename Visit>
  void forEachCorner(const Visit& visit) const
  {
    std::for_each(this->Ids32.begin(), this->Ids32.end(), visit);
    std::for_each(this->Ids64.begin(), this->Ids64.end(), visit);
  }
};

/// Returns this rank's part of the Delaunay triangulation of all ranks' points: together the ranks
/// have the triangles that triangulate() returns. Of coincident points, on any ranks, the one with
/// the lowest global id represents all. Collective; throws RankFailure on all ranks if any rank
/// fails or its Progress stops the run.
VTKTIPPFILTERS_EXPORT DistributedTriangulation triangulateDistributed(
  Communicator& ranks, const RankPoints& points, const DistributedOptions& options = {});

/// Leaves out the triangles with an edge longer than the first rank's `longest`; 0: none. Lengths
/// are those in the plane. Collective.
VTKTIPPFILTERS_EXPORT void leaveOutLong(
  Communicator& ranks, double longest, DistributedTriangulation& mine);

/// Returns the ghosts of this rank's triangles. Collective.
VTKTIPPFILTERS_EXPORT GhostTriangles fetchGhosts(
  Communicator& ranks, const DistributedTriangulation& mine);

/// Returns the neighbours of this rank's triangles and ghosts; see neighborIdsOf(). Collective.
VTKTIPPFILTERS_EXPORT Buffer<std::int64_t> neighborIds(
  Communicator& ranks, const DistributedTriangulation& mine, const GhostTriangles& ghosts);

/// A rank's triangles by internal ids: indices among all ranks' owned points.
VTKTIPPFILTERS_EXPORT std::vector<IdTriangle> trianglesByIds(
  const DistributedTriangulation& mine, int rank);

/// Moves everything to the first rank; the others return an empty triangulation. Collective.
VTKTIPPFILTERS_EXPORT DistributedTriangulation gatherOnFirst(
  Communicator& ranks, DistributedTriangulation mine);

/// Returns all ranks' triangles, duplicates and rejected points, by global ids, on the first rank;
/// an empty triangulation on the others. Collective.
VTKTIPPFILTERS_EXPORT Triangulation gatherTriangles(
  Communicator& ranks, const DistributedTriangulation& mine);

} // namespace tipp

#endif
