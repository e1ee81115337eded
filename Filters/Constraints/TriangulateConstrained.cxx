// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/TriangulateConstrained.h"

#include "Constraints/Constrain.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Stopwatch.h"

#include <utility>

namespace tipp
{
namespace
{

/// The input's points and the crossings.
std::vector<Point2> allPoints(PointsView points, const std::vector<CrossingPoint>& crossings)
{
  std::vector<Point2> all;
  all.reserve(points.size() + crossings.size());
  points.forEach(0, points.size(), [&all](std::size_t, Point2 p) { all.push_back(p); });
  for (const CrossingPoint& crossing : crossings)
  {
    all.push_back(crossing.Position);
  }
  return all;
}

} // namespace

ConstrainedTriangulation triangulateConstrained(PointsView input,
  const std::vector<Constraint>& constraints, CrossingRule crossings,
  const TriangulationOptions& options)
{
  ConstrainedTriangulation result;
  const int threads = threadCount(options.Threads);
  Stopwatch watch;
  result.Constraints = resolveCrossings(input, constraints, crossings, threads);
  const double crossingSeconds = watch.restart();

  std::vector<Point2> room;
  PointsView points = input;
  if (!result.Constraints.Crossings.empty())
  {
    room = allPoints(input, result.Constraints.Crossings);
    points = PointsView(&room.front().x, room.size(), 2);
  }
  result.Mesh = triangulate(points, options);
  auto& phases = result.Mesh.Statistics.Phases;
  phases.insert(phases.begin(), { "crossings", crossingSeconds });
  if (!result.Mesh.Aborted)
  {
    watch.restart();
    constrain(points, result.Mesh, result.Constraints.Pieces, threads);
    phases.push_back({ "constraints", watch.seconds() });
  }
  return result;
}

} // namespace tipp
