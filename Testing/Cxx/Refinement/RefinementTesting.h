// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRefinementTesting_h
#define tippRefinementTesting_h

#include "Check/QualityChecker.h"
#include "InMemory/TriangulatePoints.h"
#include "PointSets.h"
#include "Refinement/Refine.h"

#include "Predicates/ExactPredicates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <string>
#include <vector>

namespace tipp
{
namespace test
{

/// Points and segments between them.
struct LineGraph
{
  Coordinates XY;
  std::vector<Constraint> Segments;

  void addPoint(double x, double y) { this->XY.insert(this->XY.end(), { x, y }); }
  void addSegment(PointId a, PointId b) { this->Segments.push_back({ a, b }); }
  PointId points() const { return PointId(this->XY.size() / 2); }

  /// Adds a closed line through the points from `first` on.
  void close(PointId first)
  {
    for (PointId i = first; i < this->points(); ++i)
    {
      this->addSegment(i, i + 1 < this->points() ? i + 1 : first);
    }
  }

  void addRectangle(double west, double south, double east, double north)
  {
    const PointId first = this->points();
    this->addPoint(west, south);
    this->addPoint(east, south);
    this->addPoint(east, north);
    this->addPoint(west, north);
    this->close(first);
  }
};

/// The refinement of a graph. XY and Mesh.Triangles are the mesh.
struct Refined
{
  Coordinates XY; ///< the points given, crossings, and the added points
  RefinedMesh Mesh;
};

/// `holes`: points in holes.
inline Refined refineGraph(
  const LineGraph& graph, const RefinementOptions& options, const std::vector<Point2>& holes = {})
{
  SourceConstraints source;
  source.Constraints = graph.Segments;
  source.PolygonBegin = graph.Segments.size();
  source.Holes = holes;
  std::vector<std::string> warnings;
  PointsRequest request;
  request.Options.Threads = options.Threads;
  request.Source = &source;
  const ConstrainedTriangulation start = triangulatePoints(
    PointsView(graph.XY.data(), std::size_t(graph.points()), 2), request, warnings);
  Refined refined;
  refined.XY = graph.XY;
  for (const CrossingPoint& crossing : start.Constraints.Crossings)
  {
    refined.XY.insert(refined.XY.end(), { crossing.Position.x, crossing.Position.y });
  }
  refined.Mesh = refine(PointsView(refined.XY.data(), refined.XY.size() / 2, 2), start, options);
  refined.XY.insert(refined.XY.end(), refined.Mesh.AddedXY.begin(), refined.Mesh.AddedXY.end());
  return refined;
}

/// Checks the mesh in exact arithmetic. `angle`: the bound, as text.
inline testing::AssertionResult isRight(const LineGraph& graph, const Refined& refined,
  const std::string& angle, double largestArea = 0, const std::vector<Point2>& holes = {})
{
  CheckedMesh checked;
  checked.XY = refined.XY;
  checked.Triangles.assign(refined.Mesh.Triangles.begin(), refined.Mesh.Triangles.end());
  checked.InputXY = graph.XY;
  for (const Constraint& segment : graph.Segments)
  {
    checked.Segments.push_back({ segment.A, segment.B });
  }
  for (const Point2 hole : holes)
  {
    checked.Holes.insert(checked.Holes.end(), { hole.x, hole.y });
  }
  checked.MinAngle = angle;
  if (largestArea > 0)
  {
    checked.MaxArea = [largestArea](check::Position) { return largestArea; };
  }
  checked.Listed.emplace();
  for (const TriangleOutside& outside : refined.Mesh.Outside)
  {
    if (outside.Angle < std::stod(angle) + 1e-6) // else it is too large
    {
      checked.Listed->push_back({ outside.Triangle, outside.Angle,
        outside.Why == TriangleOutside::Reason::InputAngle ? ThinReason::InputAngle
                                                           : ThinReason::ShortestEdge });
    }
  }
  const std::vector<std::string> faults = checkQuality(std::move(checked)).faults();
  return faults.empty() ? testing::AssertionSuccess() : testing::AssertionFailure() << faults[0];
}

/// The number of edges that are not locally Delaunay, besides the mesh's own subsegments, and of
/// triangles that are not counter-clockwise.
inline int countFaults(const Refined& refined)
{
  const auto at = [&](std::int32_t v) {
    return Point2{ refined.XY[2 * std::size_t(v)], refined.XY[2 * std::size_t(v) + 1] };
  };
  std::set<std::pair<PointId, PointId>> segments;
  for (const IdSegment& segment : refined.Mesh.Segments)
  {
    segments.insert(std::minmax(segment.A, segment.B));
  }
  std::map<std::pair<PointId, PointId>, std::int32_t> apexes;
  int faults = 0;
  for (std::size_t t = 0; t < refined.Mesh.triangleCount(); ++t)
  {
    const std::int32_t* const v = refined.Mesh.Triangles.data() + 3 * t;
    faults += orientation(at(v[0]), at(v[1]), at(v[2])) <= 0;
    for (int i = 0; i < 3; ++i)
    {
      const PointId a = v[(i + 1) % 3];
      const PointId b = v[(i + 2) % 3];
      apexes[{ a, b }] = v[i];
      const auto twin = apexes.find({ b, a });
      if (twin != apexes.end() && segments.count(std::minmax(a, b)) == 0)
      {
        faults += inCircle(at(v[0]), at(v[1]), at(v[2]), at(twin->second)) > 0;
      }
    }
  }
  for (const auto& [edge, apex] : apexes)
  {
    faults += apexes.count({ edge.second, edge.first }) == 0 &&
      segments.count(std::minmax(edge.first, edge.second)) == 0;
  }
  return faults;
}

/// Whether two refinements have the same bytes.
inline bool areSame(const Refined& a, const Refined& b)
{
  return a.XY == b.XY && a.Mesh.triangleCount() == b.Mesh.triangleCount() &&
    std::equal(a.Mesh.Triangles.begin(), a.Mesh.Triangles.end(), b.Mesh.Triangles.begin());
}

} // namespace test
} // namespace tipp

#endif
