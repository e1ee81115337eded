// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/TriangulateConstrained.h"

#include "Constraints/Constrain.h"
#include "Constraints/PartitionConstraints.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Stopwatch.h"
#include "Triangulation/LongTriangles.h"

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
  const TriangulationOptions& options, const std::function<void(ConstrainedTriangulation&)>& cut)
{
  ConstrainedTriangulation result;
  const int threads = threadCount(options.Threads);
  Stopwatch watch;
  result.Constraints = resolveCrossings(input, constraints, crossings, threads);
  std::vector<TriangulationStatistics::Phase> phases{ { "crossings", watch.restart() } };

  std::vector<Point2> room;
  PointsView points = input;
  if (!result.Constraints.Crossings.empty())
  {
    room = allPoints(input, result.Constraints.Crossings);
    points = PointsView(&room.front().x, room.size(), 2);
  }
  PartitionConstraints inserted(points, result.Constraints.Pieces);
  TriangulationOptions own = options;
  own.MaximumEdge = 0; // triangles are left out at the end
  own.MakeEditor = [&inserted](double factor) { return inserted.makeEditor(factor); };
  phases.push_back({ "pieces", watch.restart() });
  result.Mesh = triangulate(points, own);
  auto& all = result.Mesh.Statistics.Phases;
  all.insert(all.begin(), phases.begin(), phases.end());
  if (!result.Mesh.Aborted)
  {
    watch.restart();
    constrain(points, result.Mesh, result.Constraints.Pieces, inserted, threads);
    if (cut)
    {
      cut(result);
    }
    leaveOutLong(points, options.MaximumEdge, result.Mesh);
    all.push_back({ "constraints", watch.seconds() });
  }
  return result;
}

void leaveOutLong(PointsView points, double longest, Triangulation& mesh)
{
  const auto pointOf = [&points](auto id) { return points[std::size_t(id)]; };
  const auto drop = [&](auto& ids)
  { ids.truncate(3 * dropLongTriangles(ids.data(), ids.size() / 3, longest, pointOf)); };
  if (longest > 0)
  {
    drop(mesh.Ids32);
    drop(mesh.Ids64);
    mesh.Blocks.clear();
  }
}

} // namespace tipp
