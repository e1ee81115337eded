// SPDX-License-Identifier: BSD-3-Clause
#include "RefinementTesting.h"

#include "Refinement/Smooth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

/// A square with a wedge of 11 degrees and a line that ends inside, with sizes that grow eastwards.
LineGraph wedgeInSquare()
{
  LineGraph graph;
  graph.addRectangle(0, 0, 10, 10);
  graph.addPoint(2, 3);
  graph.addPoint(7, 3);
  graph.addPoint(7, 4);
  graph.addSegment(4, 5);
  graph.addSegment(4, 6);
  return graph;
}

RefinementOptions graded(int threads = 2)
{
  RefinementOptions options;
  options.LargestArea = 0.2;
  options.AreaAt = [](Point2 p, double) { return 0.01 + 0.02 * std::fabs(p.x); };
  options.LeastArea = 0.01;
  options.Threads = threads;
  return options;
}

/// Smooths a refined graph, whose points are those of the graph.
Refined smoothed(const LineGraph& graph, RefinementOptions options, int rounds)
{
  Refined refined = refineGraph(graph, options);
  const std::size_t given = refined.XY.size() - refined.Mesh.AddedXY.size();
  smooth(PointsView(refined.XY.data(), given / 2, 2), options, rounds, refined.Mesh);
  std::copy(refined.Mesh.AddedXY.begin(), refined.Mesh.AddedXY.end(),
    refined.XY.begin() + std::ptrdiff_t(given));
  return refined;
}

/// The mean of the smallest angles, in degrees.
double meanLeastAngle(const Refined& refined)
{
  double sum = 0;
  const auto at = [&](std::size_t slot)
  {
    const auto id = std::size_t(refined.Mesh.Triangles[slot]);
    return Point2{ refined.XY[2 * id], refined.XY[2 * id + 1] };
  };
  for (std::size_t slot = 0; slot < refined.Mesh.Triangles.size(); slot += 3)
  {
    double least = 180;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const Point2 u = at(slot + (i + 1) % 3) - at(slot + i);
      const Point2 v = at(slot + (i + 2) % 3) - at(slot + i);
      least = std::min(
        least, 57.29577951308232 * std::atan2(u.x * v.y - u.y * v.x, u.x * v.x + u.y * v.y));
    }
    sum += least;
  }
  return sum / double(refined.Mesh.triangleCount());
}

TEST(Smooth, SmallAnglesGrowAndBoundsHold)
{
  const LineGraph graph = wedgeInSquare();
  const Refined before = refineGraph(graph, graded());
  const Refined after = smoothed(graph, graded(), 5);
  EXPECT_GT(after.Mesh.Statistics.Moves, 0);
  EXPECT_GT(meanLeastAngle(after), meanLeastAngle(before) + 1);
  EXPECT_TRUE(isRight(graph, after, "30", 0.2));
  EXPECT_EQ(countFaults(after), 0);
}

TEST(Smooth, AreasFollowTheFunction)
{
  const RefinementOptions options = graded();
  const Refined after = smoothed(wedgeInSquare(), options, 5);
  for (std::size_t t = 0; t < after.Mesh.triangleCount(); ++t)
  {
    Point2 p[3];
    for (std::size_t i = 0; i < 3; ++i)
    {
      const auto id = std::size_t(after.Mesh.Triangles[3 * t + i]);
      p[i] = { after.XY[2 * id], after.XY[2 * id + 1] };
    }
    const Point2 u = p[1] - p[0];
    const Point2 v = p[2] - p[0];
    const Point2 centre{ (p[0].x + p[1].x + p[2].x) / 3, (p[0].y + p[1].y + p[2].y) / 3 };
    EXPECT_LE((u.x * v.y - u.y * v.x) / 2, options.AreaAt(centre, 0) * (1 + 1e-12));
  }
}

TEST(Smooth, PointsOnSegmentsAndTrianglesStay)
{
  const Refined before = refineGraph(wedgeInSquare(), graded());
  const Refined after = smoothed(wedgeInSquare(), graded(), 5);
  EXPECT_TRUE(std::equal(before.Mesh.Triangles.begin(), before.Mesh.Triangles.end(),
    after.Mesh.Triangles.begin(), after.Mesh.Triangles.end()));
  for (const IdSegment& segment : after.Mesh.Segments)
  {
    for (const PointId id : { segment.A, segment.B })
    {
      EXPECT_EQ(before.XY[2 * std::size_t(id)], after.XY[2 * std::size_t(id)]);
      EXPECT_EQ(before.XY[2 * std::size_t(id) + 1], after.XY[2 * std::size_t(id) + 1]);
    }
  }
}

TEST(Smooth, IsTheSameForAnyNumberOfThreads)
{
  const Refined one = smoothed(wedgeInSquare(), graded(1), 5);
  for (const int threads : { 2, 3, 8 })
  {
    EXPECT_EQ(one.XY, smoothed(wedgeInSquare(), graded(threads), 5).XY) << threads;
  }
}

TEST(Smooth, ProgressCanStopIt)
{
  const LineGraph graph = wedgeInSquare();
  RefinementOptions options = graded();
  Refined refined = refineGraph(graph, options);
  options.Progress = [](double) { return false; };
  smooth(PointsView(graph.XY.data(), std::size_t(graph.points()), 2), options, 5, refined.Mesh);
  EXPECT_TRUE(refined.Mesh.Aborted);
}

} // namespace
