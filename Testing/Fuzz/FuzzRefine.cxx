// SPDX-License-Identifier: BSD-3-Clause
// Draws small graphs of segments and options, refines them on one thread and on several, and checks
// the meshes in exact arithmetic. A seed and a number identify a case: 'fuzzRefine --seed S --case
// N' repeats it.
#include "DegeneratePoints.h"
#include "FuzzDriver.h"
#include "RefinementTesting.h"

#include <cmath>
#include <cstdio>
#include <exception>
#include <random>
#include <string>

namespace
{

using namespace tipp;
using namespace tipp::test;

struct RefinementCase
{
  LineGraph Graph;
  RefinementOptions Options;
  std::string Angle;
  double Area = 0; ///< 0: no limit
};

RefinementCase drawRefinementCase(std::mt19937_64& random)
{
  RefinementCase drawn;
  const auto below = [&](std::uint64_t end) { return int(random() % end); };
  drawn.Graph.XY = drawDegeneratePoints(random);
  while (drawn.Graph.XY.size() < 6)
  {
    drawn.Graph.addPoint(below(9), below(9));
  }
  if (drawn.Graph.XY.size() > 60)
  {
    drawn.Graph.XY.resize(60);
  }
  double side = 0;
  double largest = 0;
  for (const double coordinate : drawn.Graph.XY)
  {
    largest = std::isfinite(coordinate) ? std::max(largest, std::fabs(coordinate)) : largest;
  }
  // Sizes that refine() does not refuse.
  const bool isScaled = largest < 1e-20 || largest > 1e40;
  largest = 0;
  for (std::size_t i = 0; i < drawn.Graph.XY.size(); ++i)
  {
    if (!std::isfinite(drawn.Graph.XY[i]) || isScaled)
    {
      drawn.Graph.XY[i] = below(9);
    }
    // Points on a segment between such a coordinate and 0 have none of the numbers between them.
    constexpr double tiny = 1e-250;
    drawn.Graph.XY[i] = std::fabs(drawn.Graph.XY[i]) < tiny ? 0 : drawn.Graph.XY[i];
    side = std::max(side, std::fabs(drawn.Graph.XY[i] - drawn.Graph.XY[i % 2]));
    largest = std::max(largest, std::fabs(drawn.Graph.XY[i]));
  }
  const auto points = std::uint64_t(drawn.Graph.points());
  for (int i = below(12); i > 0; --i)
  {
    drawn.Graph.addSegment(PointId(random() % points), PointId(random() % points));
  }
  const int angle = below(34);
  drawn.Angle = std::to_string(angle);
  drawn.Options.MinimumAngle = angle;
  drawn.Options.IsEnclosed = below(3) == 0;
  drawn.Options.Threads = 1;
  // Features may be as small as rounding: a floor on edges bounds the number of triangles.
  drawn.Options.ShortestEdge = std::max(side * std::ldexp(1, -4 - below(5)), largest * 1e-12);
  if (below(2) == 0 && side > 0)
  {
    drawn.Area = side * side * std::ldexp(1, -below(10));
    drawn.Options.LargestArea = drawn.Area;
  }
  drawn.Options.KeepsBorder = below(8) == 0;
  drawn.Options.KeepsSegments = below(8) == 0;
  return drawn;
}

/// Whether a triangle is so narrow that a point on its edge, once rounded, may be beyond the
/// others: the exact checker cannot tell then which edges are those of a segment.
bool isNarrow(const Refined& refined)
{
  double largest = 0;
  for (const double coordinate : refined.XY)
  {
    largest = std::max(largest, std::fabs(coordinate));
  }
  for (std::size_t t = 0; t < refined.Mesh.triangleCount(); ++t)
  {
    const std::int32_t* const v = refined.Mesh.Triangles.data() + 3 * t;
    const auto along = [&](int i, int axis)
    {
      return refined.XY[2 * std::size_t(v[i]) + std::size_t(axis)] -
        refined.XY[2 * std::size_t(v[0]) + std::size_t(axis)];
    };
    const double twice = along(1, 0) * along(2, 1) - along(1, 1) * along(2, 0);
    const double side = std::max(std::hypot(along(1, 0), along(1, 1)),
      std::max(std::hypot(along(2, 0), along(2, 1)),
        std::hypot(along(2, 0) - along(1, 0), along(2, 1) - along(1, 1))));
    if (twice < side * largest * 0x1p-36)
    {
      return true;
    }
  }
  return false;
}

testing::AssertionResult check(const RefinementCase& drawn)
{
  try
  {
    const Refined one = refineGraph(drawn.Graph, drawn.Options);
    RefinementOptions options = drawn.Options;
    options.Threads = 3;
    if (!areSame(one, refineGraph(drawn.Graph, options)))
    {
      return testing::AssertionFailure() << "three threads make another mesh";
    }
    if (const int faults = countFaults(one))
    {
      return testing::AssertionFailure() << faults << " edges or triangles are wrong";
    }
    // A limit of areas may be missed where edges would be too short: such triangles are listed.
    return one.Mesh.triangleCount() == 0 || isNarrow(one) ? testing::AssertionSuccess()
                                                          : isRight(drawn.Graph, one, drawn.Angle);
  }
  catch (const std::exception& error)
  {
    return testing::AssertionFailure() << "an exception: " << error.what();
  }
}

/// Runs one case, and prints it if it fails.
bool passes(std::uint64_t seed, std::uint64_t number)
{
  std::seed_seq both{ seed, number };
  std::mt19937_64 random(both);
  const RefinementCase drawn = drawRefinementCase(random);
  const auto outcome = check(drawn);
  if (!outcome)
  {
    std::printf(
      "case %llu of seed %llu, angle %s, area %g, shortest edge %g, enclosed %d, keeps %d "
      "%d: %s\n",
      (unsigned long long)number, (unsigned long long)seed, drawn.Angle.c_str(), drawn.Area,
      drawn.Options.ShortestEdge, drawn.Options.IsEnclosed, drawn.Options.KeepsBorder,
      drawn.Options.KeepsSegments, outcome.message());
    for (std::size_t i = 0; i < drawn.Graph.XY.size(); i += 2)
    {
      std::printf("%.17g %.17g\n", drawn.Graph.XY[i], drawn.Graph.XY[i + 1]);
    }
    for (const Constraint& segment : drawn.Graph.Segments)
    {
      std::printf("%lld - %lld\n", (long long)segment.A, (long long)segment.B);
    }
  }
  return bool(outcome);
}

} // namespace

int main(int argc, char** argv)
{
  return fuzz("fuzzRefine", argc, argv, passes);
}
