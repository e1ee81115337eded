// SPDX-License-Identifier: BSD-3-Clause
// Constraints between a few points; each test is about one kind.
#include "Comparison.h"
#include "ConstrainedOracle.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace
{

using namespace tipp;
using namespace tipp::test;

const Coordinates Square{ 0, 0, 4, 0, 4, 4, 0, 4, 1, 2, 3, 2.5 };

ConstrainedTriangulation run(const Coordinates& xy, const std::vector<Constraint>& constraints,
  CrossingRule crossings = CrossingRule::Split)
{
  return triangulateConstrained(view(xy), constraints, crossings);
}

TEST(Constrain, IsDelaunayWithoutConstraints)
{
  EXPECT_TRUE(sameTriangles(Square, trianglesOf(run(Square, {}).Mesh), reference(Square).Mesh));
}

TEST(Constrain, FlipsADiagonal)
{
  const Coordinates xy{ 0, 0, 2, -1, 4, 0, 2, 1 };
  const std::vector<Constraint> constraints{ { 0, 2 } };
  ASSERT_FALSE(sameTriangles(xy, constrainedDelaunay(xy, constraints), reference(xy).Mesh));
  EXPECT_TRUE(isConstrained(xy, constraints, run(xy, constraints)));
}

TEST(Constrain, KeepsAnExistingEdge)
{
  const std::vector<Constraint> constraints{ { 0, 1 }, { 4, 5 } };
  const ConstrainedTriangulation result = run(Square, constraints);
  EXPECT_TRUE(isConstrained(Square, constraints, result));
  EXPECT_TRUE(sameTriangles(Square, trianglesOf(result.Mesh), reference(Square).Mesh));
}

TEST(Constrain, SplitsAtAPointOnTheSegment)
{
  Coordinates xy = Square;
  xy.insert(xy.end(), { 2, 2 });
  const std::vector<Constraint> constraints{ { 0, 2 } };
  const ConstrainedTriangulation result = run(xy, constraints);
  EXPECT_TRUE(isConstrained(xy, constraints, result));
  ASSERT_EQ(2u, result.Constraints.Segments.size());
  EXPECT_EQ(6, result.Constraints.Segments[0].B);
}

TEST(Constrain, AcceptsOverlappingRepeatedAndReversedSegments)
{
  const Coordinates xy{ 0, 0, 1, 0, 2, 0, 3, 0, 1.5, 0.25, 1.5, -0.25, 0, 3, 3, -3 };
  const std::vector<Constraint> constraints{ { 0, 2 }, { 1, 3 }, { 3, 0 }, { 0, 2 }, { 4, 4 } };
  const ConstrainedTriangulation result = run(xy, constraints);
  EXPECT_TRUE(isConstrained(xy, constraints, result));
}

TEST(Constrain, MapsEndsToRepresentatives)
{
  Coordinates xy = Square;
  xy.insert(xy.end(), { 0, 0, 4, 4 });
  const std::vector<Constraint> constraints{ { 6, 7 }, { 0, 6 } };
  const ConstrainedTriangulation result = run(xy, constraints);
  EXPECT_TRUE(isConstrained(xy, constraints, result));
  EXPECT_EQ(0, result.Constraints.Segments.front().A);
}

TEST(Constrain, LeavesOutEndsThatAreNotFinite)
{
  Coordinates xy = Square;
  xy.insert(xy.end(), { std::nan(""), 1, 1, HUGE_VAL });
  const std::vector<Constraint> constraints{ { 0, 6 }, { 7, 2 }, { 0, 5 } };
  const ConstrainedTriangulation result = run(xy, constraints);
  EXPECT_TRUE(isConstrained(xy, constraints, result));
  EXPECT_EQ(2, result.Constraints.NotFinite);
}

TEST(Constrain, CollinearPointsHaveNoTriangles)
{
  const Coordinates xy{ 0, 0, 1, 1, 2, 2 };
  EXPECT_EQ(0u, run(xy, { { 0, 2 } }).Mesh.triangleCount());
}

TEST(Constrain, RefusesAnInvalidPointId)
{
  for (const Constraint& constraint : { Constraint{ 0, 6 }, Constraint{ -1, 2 } })
  {
    try
    {
      run(Square, { { 0, 1 }, constraint });
      FAIL();
    }
    catch (const std::invalid_argument& error)
    {
      EXPECT_NE(std::string::npos, std::string(error.what()).find("constraint 1 names point"))
        << error.what();
    }
  }
}

/// Segments from the first point to all points of the outer ring, across the inner ring.
TEST(Constrain, InsertsAStarOfAThousandSegments)
{
  constexpr int rays = 1000;
  Coordinates xy{ 0, 0 };
  std::vector<Constraint> constraints;
  for (int i = 0; i < rays; ++i)
  {
    const double angle = 2 * std::acos(-1.0) * i / rays;
    xy.insert(xy.end(), { std::cos(angle), std::sin(angle) });
    constraints.push_back({ 0, i + 1 });
  }
  for (int i = 0; i < rays; ++i)
  {
    const double angle = 2 * std::acos(-1.0) * (i + 0.5) / rays;
    const double radius = 0.001 * (1 + i % 7);
    xy.insert(xy.end(), { radius * std::cos(angle), radius * std::sin(angle) });
  }
  EXPECT_TRUE(isConstrained(xy, constraints, run(xy, constraints)));
}

/// The constraint passes between the long teeth of two combs. Edges of the teeth end inside the
/// cavity.
TEST(Constrain, EdgesMayEndInsideTheCavity)
{
  Coordinates xy{ 0, 0, 100, 0 };
  for (int i = 1; i < 20; ++i)
  {
    xy.insert(xy.end(), { 5.0 * i, 0.01 + 0.03 * (i % 3), 5.0 * i + 0.001, 40.0 + i % 4 });
    xy.insert(xy.end(), { 5.0 * i + 2, -0.02 * (1 + i % 2), 5.0 * i + 2.001, -30.0 - i % 5 });
  }
  std::vector<Constraint> constraints{ { 0, 1 } };
  EXPECT_TRUE(isConstrained(xy, constraints, run(xy, constraints)));
  for (std::int64_t i = 2; i + 1 < std::int64_t(xy.size() / 2); i += 2)
  {
    constraints.insert(constraints.begin(), { i, i + 1 });
  }
  EXPECT_TRUE(isConstrained(xy, constraints, run(xy, constraints)));
}

/// Segments along, across and diagonal to the lines of a lattice, through many of its points.
TEST(Constrain, InsertsSegmentsThroughLatticePoints)
{
  constexpr int side = 12;
  for (const double scale : { 1.0, 0.1, 1e-300, 1e300, 0x1p-1074 })
  {
    Coordinates xy;
    for (int i = 0; i < side * side; ++i)
    {
      xy.insert(xy.end(), { scale * (i % side), scale * double(i / side) });
    }
    const auto id = [](int x, int y) { return std::int64_t(y * side + x); };
    const std::vector<Constraint> constraints{ { id(0, 0), id(11, 11) }, { id(0, 5), id(11, 5) },
      { id(3, 0), id(3, 11) }, { id(0, 1), id(11, 3) }, { id(11, 8), id(0, 6) },
      { id(5, 5), id(10, 9) } };
    const ConstrainedTriangulation result = run(xy, constraints);
    EXPECT_TRUE(isConstrained(xy, constraints, result)) << scale;
  }
}

} // namespace
