// SPDX-License-Identifier: BSD-3-Clause
// Constraints that cross each other.
#include "Comparison.h"
#include "ConstrainedOracle.h"

#include "Constraints/NearSegments.h"
#include "Predicates/ExactPredicates.h"

#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <stdexcept>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

ConstrainedTriangulation triangulateSplit(const Coordinates& xy,
  const std::vector<Constraint>& constraints, CrossingRule crossings = CrossingRule::Split)
{
  return triangulateConstrained(view(xy), constraints, crossings);
}

TEST(SegmentCrossing, NeedsAPointInsideBoth)
{
  EXPECT_TRUE(crossProperly({ 0, 0 }, { 2, 2 }, { 0, 2 }, { 2, 0 }));
  EXPECT_FALSE(crossProperly({ 0, 0 }, { 2, 2 }, { 1, 1 }, { 2, 0 })) << "an end on the other one";
  EXPECT_FALSE(crossProperly({ 0, 0 }, { 2, 2 }, { 1, 1 }, { 3, 3 })) << "on one line";
  EXPECT_FALSE(crossProperly({ 0, 0 }, { 2, 2 }, { 5, 0 }, { 0, 5 })) << "beyond an end";
}

/// Expects that no other double is closer to the exact coordinate.
void expectNearest(double rounded, const mpq_class& exact)
{
  const auto off = [&exact](double value) -> mpq_class { return abs(mpq_class(value) - exact); };
  EXPECT_TRUE(off(rounded) <= off(std::nextafter(rounded, HUGE_VAL))) << rounded;
  EXPECT_TRUE(off(rounded) <= off(std::nextafter(rounded, -HUGE_VAL))) << rounded;
}

TEST(SegmentCrossing, IsRoundedToNearest)
{
  std::mt19937_64 random(5);
  for (const int exponent : { 0, -1040, -1070, 900 })
  {
    for (int i = 0; i < 2000; ++i)
    {
      const auto draw = [&] { return std::ldexp(double(random() % 4001) - 2000, exponent); };
      const Point2 a{ draw(), draw() };
      const Point2 b{ draw(), draw() };
      const Point2 c{ draw(), draw() };
      const Point2 d{ draw(), draw() };
      if (!crossProperly(a, b, c, d))
      {
        continue;
      }
      const mpq_class abX = mpq_class(b.x) - a.x;
      const mpq_class abY = mpq_class(b.y) - a.y;
      const mpq_class cdX = mpq_class(d.x) - c.x;
      const mpq_class cdY = mpq_class(d.y) - c.y;
      const mpq_class part =
        ((mpq_class(c.x) - a.x) * cdY - (mpq_class(c.y) - a.y) * cdX) / (abX * cdY - abY * cdX);
      const Point2 p = crossingPoint(a, b, c, d);
      expectNearest(p.x, mpq_class(a.x) + part * abX);
      expectNearest(p.y, mpq_class(a.y) + part * abY);
    }
  }
}

TEST(Crossings, BecomePoints)
{
  const Coordinates xy{ 0, 0, 4, 4, 0, 4, 4, 0, 2, 9 };
  const std::vector<Constraint> constraints{ { 0, 1 }, { 2, 3 } };
  const ConstrainedTriangulation result = triangulateSplit(xy, constraints);
  EXPECT_TRUE(isConstrained(xy, constraints, result));
  ASSERT_EQ(1u, result.Constraints.Crossings.size());
  const CrossingPoint& crossing = result.Constraints.Crossings.front();
  EXPECT_EQ((Point2{ 2, 2 }), crossing.Position);
  EXPECT_EQ(0, crossing.A);
  EXPECT_EQ(1, crossing.B);
  EXPECT_EQ(0.5, crossing.Fraction);
  EXPECT_EQ(1, result.Constraints.Rounds);
}

TEST(Crossings, OfManySegmentsAtOnePositionAreOnePoint)
{
  Coordinates xy;
  std::vector<Constraint> constraints;
  for (int i = 0; i < 5; ++i)
  {
    xy.insert(xy.end(), { -2.0 + i, -3, 2.0 - i, 3 });
    constraints.push_back({ 2 * i, 2 * i + 1 });
  }
  const ConstrainedTriangulation result = triangulateSplit(xy, constraints);
  EXPECT_TRUE(isConstrained(xy, constraints, result));
  EXPECT_EQ(1u, result.Constraints.Crossings.size());
}

TEST(Crossings, WithADelaunayEdgeAreFound)
{
  // The short segment is an edge of the Delaunay triangulation, and the other segment crosses it.
  const Coordinates xy{ 0, -1, 0, 1, -9, 0, 9, 0.5 };
  const std::vector<Constraint> constraints{ { 2, 3 }, { 0, 1 } };
  const ConstrainedTriangulation result = triangulateSplit(xy, constraints);
  EXPECT_TRUE(isConstrained(xy, constraints, result));
  EXPECT_EQ(1u, result.Constraints.Crossings.size());
}

TEST(Crossings, AreRefusedNamingTheFirst)
{
  const Coordinates xy{ 0, 0, 4, 4, 0, 4, 4, 0, 9, 0, 9, 1 };
  try
  {
    triangulateSplit(xy, { { 4, 5 }, { 0, 1 }, { 3, 2 } }, CrossingRule::Refuse);
    FAIL();
  }
  catch (const std::invalid_argument& error)
  {
    EXPECT_STREQ("constraint 1 (points 0 and 1) crosses constraint 2 (points 3 and 2) at (2, 2): "
                 "have crossings split, or remove one of the two.",
      error.what());
  }
}

TEST(Crossings, AreNotReportedIfThereAreNone)
{
  const Coordinates xy{ 0, 0, 4, 4, 0, 4, 2, 2 };
  const std::vector<Constraint> constraints{ { 0, 1 }, { 2, 3 } };
  EXPECT_TRUE(
    isConstrained(xy, constraints, triangulateSplit(xy, constraints, CrossingRule::Refuse)));
}

/// The ids of the chain of a constraint.
std::vector<PointId> chainOf(const ConstrainedTriangulation& result, std::int64_t constraint)
{
  std::vector<PointId> chain;
  for (const IdSegment& segment : result.Constraints.Segments)
  {
    if (segment.Constraint == constraint)
    {
      if (chain.empty())
      {
        chain.push_back(segment.A);
      }
      chain.push_back(segment.B);
    }
  }
  return chain;
}

/// Survey points on a line, and another line that crosses it between two of them. The crossing is
/// not exactly on the line.
TEST(Crossings, LeaveThePointsOnAConstraintInItsChain)
{
  Coordinates xy;
  for (int i = 0; i <= 10; ++i)
  {
    xy.insert(xy.end(), { double(i), 3.0 * i });
  }
  xy.insert(xy.end(), { 0, 9.5, 10, 9, 3, 17, 8, 1 });
  const std::vector<Constraint> constraints{ { 0, 10 }, { 11, 12 } };
  const ConstrainedTriangulation result = triangulateSplit(xy, constraints);
  EXPECT_TRUE(isConstrained(xy, constraints, result));
  EXPECT_EQ(1u, result.Constraints.Crossings.size());
  EXPECT_EQ((std::vector<PointId>{ 0, 1, 2, 3, 15, 4, 5, 6, 7, 8, 9, 10 }), chainOf(result, 0));
}

TEST(Crossings, AtAPointAreThisPointBesideOtherCrossings)
{
  const Coordinates xy{ 3, 3, 0, 3, 6, 3, 3, 0, 3, 6, 5, 0, 5, 6, 3, 3, 1, 1 };
  const std::vector<Constraint> constraints{ { 1, 2 }, { 3, 4 }, { 5, 6 } };
  const ConstrainedTriangulation result = triangulateSplit(xy, constraints);
  EXPECT_TRUE(isConstrained(xy, constraints, result));
  EXPECT_EQ(1u, result.Constraints.Crossings.size());
  EXPECT_EQ((std::vector<PointId>{ 1, 0, 9, 2 }), chainOf(result, 0));
  EXPECT_EQ((std::vector<PointId>{ 3, 0, 4 }), chainOf(result, 1));
}

/// The crossing is not a double, and the point is at the nearest one.
TEST(Crossings, ThatRoundToAPointAreThisPoint)
{
  Coordinates xy{ 0, 0, 1, 1, 0, 1, 0.5, 0, 2, 2 };
  const Point2 crossing = crossingPoint({ 0, 0 }, { 1, 1 }, { 0, 1 }, { 0.5, 0 });
  xy.insert(xy.end(), { crossing.x, crossing.y, crossing.x, crossing.y });
  const std::vector<Constraint> constraints{ { 0, 1 }, { 2, 3 } };
  const ConstrainedTriangulation result = triangulateSplit(xy, constraints);
  EXPECT_TRUE(isConstrained(xy, constraints, result));
  EXPECT_EQ(0u, result.Constraints.Crossings.size());
  EXPECT_EQ((std::vector<PointId>{ 2, 5, 3 }), chainOf(result, 1));
}

TEST(Crossings, AtPointsAreNotRefusedAndOthersAreNamedByWholeConstraints)
{
  Coordinates xy{ 3, 3, 0, 3, 6, 3, 3, 0, 3, 6, 5, 0, 5, 6, 3, 5 };
  EXPECT_EQ(0, resolveCrossings(view(xy), { { 1, 2 }, { 3, 4 } }, CrossingRule::Refuse, 1).Rounds);
  try
  {
    resolveCrossings(view(xy), { { 1, 2 }, { 3, 4 }, { 5, 6 } }, CrossingRule::Refuse, 1);
    FAIL();
  }
  catch (const std::invalid_argument& error)
  {
    EXPECT_STREQ("constraint 0 (points 1 and 2) crosses constraint 2 (points 5 and 6) at (5, 3): "
                 "have crossings split, or remove one of the two.",
      error.what());
  }
}

TEST(NearSegments, AreFoundByPointsOnThemAndBesideThem)
{
  std::mt19937_64 random(3);
  for (const int range : { 20, 400 })
  {
    std::vector<SegmentTree::Item> segments;
    const auto draw = [&] { return double(std::int64_t(random() % unsigned(range)) - range / 2); };
    for (int i = 0; i < 60; ++i)
    {
      segments.push_back({ { draw(), draw() }, { draw(), draw() }, 0 });
    }
    const NearSegments exact(segments, 2);
    const NearSegments near(segments, 2, 1.0 / 4);
    for (int i = 0; i < 2000; ++i)
    {
      const Point2 p{ draw(), draw() };
      std::set<std::size_t> expected;
      for (std::size_t s = 0; s < segments.size(); ++s)
      {
        const auto& [a, b, id] = segments[s];
        const bool isOn = (b.x - a.x) * (p.y - a.y) == (b.y - a.y) * (p.x - a.x);
        const bool isInBox = std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) &&
          std::min(a.y, b.y) <= p.y && p.y <= std::max(a.y, b.y);
        if (isOn && isInBox)
        {
          expected.insert(s);
        }
      }
      std::set<std::size_t> found;
      exact.visitOn(p, [&found](std::size_t s) { found.insert(s); });
      ASSERT_EQ(expected, found);
      ASSERT_TRUE(expected.empty() || near.isNear({ p.x + 0.125, p.y - 0.125 }));
    }
  }
}

TEST(Crossings, OfLongSegmentsAreSplitUntilNothingCrosses)
{
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> coordinate(0, 1);
  Coordinates xy;
  std::vector<Constraint> constraints;
  for (int i = 0; i < 120; ++i)
  {
    for (int k = 0; k < 4; ++k)
    {
      xy.push_back(coordinate(random));
    }
    constraints.push_back({ 2 * i, 2 * i + 1 });
  }
  const ConstrainedTriangulation result = triangulateSplit(xy, constraints);
  EXPECT_TRUE(isConstrained(xy, constraints, result));
  EXPECT_GT(result.Constraints.Crossings.size(), 1000u);
}

/// The implementation compares short segments in groups, and long ones individually.
TEST(Crossings, OfShortAndLongSegmentsAreAllFound)
{
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> coordinate(0, 1);
  Coordinates xy;
  std::vector<Constraint> constraints;
  for (int i = 0; i < 1500; ++i)
  {
    const double x = coordinate(random);
    const double y = coordinate(random);
    const double length = i % 100 == 0 ? 1 : 0.03;
    xy.insert(xy.end(), { x, y, x + length * coordinate(random), y + length * coordinate(random) });
    constraints.push_back({ 2 * i, 2 * i + 1 });
  }
  const ResolvedConstraints resolved =
    resolveCrossings(view(xy), constraints, CrossingRule::Split, 2);
  ASSERT_EQ(resolved.Rounds, 1);
  std::size_t expected = 0;
  const auto at = [&xy](std::int64_t id) {
    return Point2{ xy[2 * std::size_t(id)], xy[2 * std::size_t(id) + 1] };
  };
  for (std::size_t i = 0; i < constraints.size(); ++i)
  {
    for (std::size_t k = 0; k < i; ++k)
    {
      expected += crossProperly(at(constraints[i].A), at(constraints[i].B), at(constraints[k].A),
                    at(constraints[k].B))
        ? 1
        : 0;
    }
  }
  EXPECT_EQ(resolved.Crossings.size(), expected);
}

/// Split segments cross again one unit farther, over twelve orders of magnitude. If crossings were
/// only rounded to doubles, this would take over 300 rounds.
TEST(Crossings, OfNearlyParallelSegmentsOverOrdersOfMagnitudeEnd)
{
  const Coordinates xy{ 0x1.d1a94a200cp+0, 0x1.d1a94a2004p+0, 0x1.d1a94a200ep+0, 0x1.d1a94a2006p+0,
    0x1.d1a94a201cp+0, 0x1.d1a94a200ap+39, 0x1.d1a94a2004p+39, 0x1.d1a94a2p+39, 0x1.d1a94a2012p+39,
    0x1.d1a94a2008p+39 };
  const std::vector<Constraint> constraints{ { 2, 1 }, { 3, 2 }, { 3, 0 }, { 1, 0 }, { 2, 0 },
    { 4, 1 }, { 4, 3 }, { 1, 3 } };
  const ConstrainedTriangulation result = triangulateSplit(xy, constraints);
  EXPECT_TRUE(isConstrained(xy, constraints, result));
  EXPECT_LT(result.Constraints.Rounds, 30);
}

/// In one round, each vertex of a chain is a point of the constraint, rounded to the nearest
/// double. At a power of two, the larger of the two units counts. Many vertices are near such, or
/// near 0.
TEST(Crossings, MoveEachVertexByAtMostHalfAUnit)
{
  std::mt19937_64 random(17);
  const auto draw = [&random]
  {
    const double powers[] = { -1, -0.5, -0x1p-10, 0, 0x1p-20, 0x1p-3, 0.5, 1 };
    return powers[random() % 8] + (double(random() % 2001) - 1000) * 0x1p-53;
  };
  const auto half = [](double value) -> mpq_class
  {
    const double size = std::fabs(value);
    return (mpq_class(std::nextafter(size, HUGE_VAL)) - mpq_class(size)) / 2;
  };
  int vertices = 0;
  for (int round = 0; round < 400; ++round)
  {
    Coordinates xy;
    for (int i = 0; i < 16; ++i)
    {
      xy.push_back(i % 4 < 2 ? draw() : 3 * draw());
    }
    const std::vector<Constraint> constraints{ { 0, 1 }, { 2, 3 }, { 4, 5 }, { 6, 7 } };
    const ResolvedConstraints resolved =
      resolveCrossings(view(xy), constraints, CrossingRule::Split, 1);
    if (resolved.Rounds > 1)
    {
      continue;
    }
    for (const CrossingPoint& crossing : resolved.Crossings)
    {
      xy.insert(xy.end(), { crossing.Position.x, crossing.Position.y });
    }
    const auto at = [&xy](PointId id, std::size_t axis)
    { return mpq_class(xy[2 * std::size_t(id) + axis]); };
    for (const IdSegment& segment : resolved.Segments)
    {
      const auto& [a, b] = constraints[std::size_t(segment.Constraint)];
      const PointId p = segment.B;
      const mpq_class dx = at(b, 0) - at(a, 0);
      const mpq_class dy = at(b, 1) - at(a, 1);
      const mpq_class off = dx * (at(p, 1) - at(a, 1)) - dy * (at(p, 0) - at(a, 0));
      EXPECT_TRUE(abs(off) <=
        abs(dx) * half(xy[2 * std::size_t(p) + 1]) + abs(dy) * half(xy[2 * std::size_t(p)]))
        << round;
      vertices += p >= 8 ? 1 : 0;
    }
  }
  EXPECT_GT(vertices, 500);
}

/// The line passes the box of all points that round to a vertex at a ten-thousandth of its size, so
/// it must not be bent to this vertex.
TEST(Crossings, DoNotMoveConstraintsByMoreThanRounding)
{
  const Coordinates xy = { 0x1.d6f0382099999p+38, 0x1.d6f0382099997p+38, 0x1.977420dc00001p+42,
    0x1.977420dc00001p+42, 6987684863091.4062, 6987684863091.4072, 1e12, 9e12, 1e12, 3e12, 3e12,
    1e12 };
  const ResolvedConstraints resolved =
    resolveCrossings(view(xy), { { 0, 1 }, { 2, 3 }, { 4, 5 } }, CrossingRule::Split, 1, {});
  EXPECT_EQ(1u, resolved.Crossings.size());
  ASSERT_EQ(5u, resolved.Segments.size());
  EXPECT_EQ(6, resolved.Segments[0].B);
  EXPECT_EQ(1, resolved.Segments[1].B);
}

/// The segments are one unit in the last place apart, so a rounded crossing may be far along them.
TEST(Crossings, OfNearlyParallelSegmentsEnd)
{
  Coordinates xy;
  std::vector<Constraint> constraints;
  for (int i = 0; i < 12; ++i)
  {
    const double low = 1 + i * 0x1p-52;
    const double high = 1 + (11 - i) * 0x1p-52;
    xy.insert(xy.end(), { 0.5, low, 1.5, high });
    constraints.push_back({ 2 * i, 2 * i + 1 });
  }
  xy.insert(xy.end(), { 1, 1, 1, 3, 1, 1 + 0x1p-52 });
  const ConstrainedTriangulation result = triangulateSplit(xy, constraints);
  EXPECT_TRUE(isConstrained(xy, constraints, result));
  EXPECT_GT(result.Constraints.Crossings.size() + 1, 1u);
}

} // namespace
