// SPDX-License-Identifier: BSD-3-Clause
// Compares constraints that are matched and split on disk with those in memory.
#include "Constraints/ConstraintEdges.h"
#include "Constraints/PositionIndex.h"
#include "Constraints/ResolveCrossings.h"
#include "Constraints/TableConstraints.h"
#include "OutOfCoreTesting.h"

#include "Constraints/OnDisk/ConstrainedStream.h"
#include "ExpectIOError.h"

#include <array>
#include <cmath>
#include <cstring>
#include <random>

namespace
{

using namespace tipp;
using namespace tipp::test;

PointsView viewOf(const Coordinates& xy)
{
  return PointsView(xy.data(), xy.size() / 2, 2);
}

/// Compared instead of the numbers, since NaN is not equal to itself.
std::vector<std::uint64_t> bitsOf(const std::vector<double>& values)
{
  std::vector<std::uint64_t> bits;
  for (const double value : values)
  {
    std::memcpy(&bits.emplace_back(), &value, sizeof(value));
  }
  return bits;
}

/// The height of an input point.
double heightOf(std::size_t point)
{
  return 0.37 * double(point % 101);
}

/// The new points, and the parts of constraints as four coordinates each.
struct Outcome
{
  std::vector<double> XY;
  std::vector<double> Heights;
  std::vector<double> Parts;
};

Outcome outcomeInMemory(const Coordinates& xy, const ConstraintTable& table)
{
  Coordinates all = xy;
  std::vector<double> heights;
  for (std::size_t i = 0; 2 * i < xy.size(); ++i)
  {
    heights.push_back(heightOf(i));
  }
  std::vector<Constraint> constraints;
  if (table.XY.empty())
  {
    for (const auto& [a, b] : table.Edges)
    {
      constraints.push_back({ a, b });
    }
  }
  else
  {
    const MatchedPositions matched = matchPositions(viewOf(xy), viewOf(table.XY));
    for (const std::size_t i : matched.New)
    {
      all.insert(all.end(), { table.XY[2 * i], table.XY[2 * i + 1] });
      heights.push_back(table.Height[i]);
    }
    for (const auto& [a, b] : table.Edges)
    {
      constraints.push_back({ matched.Ids[std::size_t(a)], matched.Ids[std::size_t(b)] });
    }
  }
  const ResolvedConstraints resolved =
    resolveCrossings(viewOf(all), constraints, CrossingRule::Split, 1);
  Outcome outcome;
  for (const CrossingPoint& crossing : resolved.Crossings)
  {
    all.insert(all.end(), { crossing.Position.x, crossing.Position.y });
    heights.push_back((1 - crossing.Fraction) * heights[std::size_t(crossing.A)] +
      crossing.Fraction * heights[std::size_t(crossing.B)]);
  }
  for (const IdSegment& segment : resolved.Segments)
  {
    for (const PointId end : { segment.A, segment.B })
    {
      const auto at = 2 * std::size_t(end);
      outcome.Parts.insert(outcome.Parts.end(), { all[at], all[at + 1] });
    }
  }
  outcome.XY.assign(all.begin() + std::ptrdiff_t(xy.size()), all.end());
  outcome.Heights.assign(heights.begin() + std::ptrdiff_t(xy.size() / 2), heights.end());
  return outcome;
}

std::unique_ptr<PointStream> streamOf(const Coordinates& xy)
{
  PointTable points;
  points.XY = xy;
  points.Columns.push_back({ "z", {} });
  for (std::size_t i = 0; 2 * i < xy.size(); ++i)
  {
    points.Columns[0].Values.push_back(heightOf(i));
  }
  return streamTable(std::move(points));
}

Outcome outcomeOnDisk(const Coordinates& xy, const ConstraintTable& table, std::uint64_t memory)
{
  const TemporaryFolder folder;
  TableConstraints constraints;
  constraints.Lines = table;
  ConstrainedStream points(streamOf(xy), constraints, "lines.csv", 2);
  points.begin(folder.path("constraints"), memory);
  forEachBlock(points, 700, [](PointBlock&) {});
  Outcome outcome;
  points.forEach(
    [&outcome](const ConstraintSegment& part) {
      outcome.Parts.insert(outcome.Parts.end(), { part.A.x, part.A.y, part.B.x, part.B.y });
    });
  EXPECT_EQ(outcome.Parts.size(), 4 * std::size_t(points.count()));
  points.end();
  std::size_t count = 0;
  points.rewind();
  forEachBlock(points, 333,
    [&](PointBlock& block)
    {
      EXPECT_EQ(std::int64_t(count), block.First);
      for (std::size_t i = 0; i < block.size(); ++i, ++count)
      {
        if (2 * count >= xy.size())
        {
          outcome.XY.insert(outcome.XY.end(), { block.XY[2 * i], block.XY[2 * i + 1] });
          outcome.Heights.push_back(block.Columns[0][i]);
        }
      }
    });
  return outcome;
}

void expectSame(const Outcome& expected, const Outcome& made, const std::string& what)
{
  EXPECT_EQ(bitsOf(expected.XY), bitsOf(made.XY)) << what;
  EXPECT_EQ(bitsOf(expected.Heights), bitsOf(made.Heights)) << what;
  EXPECT_EQ(bitsOf(expected.Parts), bitsOf(made.Parts)) << what;
}

/// Segments between points, and some to new positions. The ends' indices differ by less than
/// `reach`. A small value makes few crossings in some point sets.
ConstraintTable randomSegments(const Coordinates& xy, int count, std::size_t reach, unsigned seed)
{
  std::mt19937_64 random(seed);
  const std::size_t points = xy.size() / 2;
  ConstraintTable table;
  for (int i = 0; i < count; ++i)
  {
    const std::size_t p = random() % points;
    const std::size_t q = (p + random() % reach) % points;
    const bool isNew = i % 4 == 0;
    table.XY.insert(table.XY.end(), { xy[2 * p], xy[2 * p + 1] });
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      table.XY.push_back(isNew ? xy[2 * p + axis] / 2 + xy[2 * q + axis] / 2 : xy[2 * q + axis]);
    }
    table.Height.insert(table.Height.end(), { double(i), i % 8 == 0 ? std::nan("") : -double(i) });
    table.Edges.push_back({ 2 * i, 2 * i + 1 });
  }
  table.PolygonBegin = table.Edges.size();
  return table;
}

class StoredConstraintSets : public testing::TestWithParam<std::string>
{
};

TEST_P(StoredConstraintSets, AreSplitAsInMemoryForAnyMemoryLimit)
{
  const Coordinates xy = makePointSet(GetParam(), 1000);
  unsigned seed = 1;
  for (const int count : { 2, 20, 150 })
  {
    for (const std::size_t reach : { 2, 30, 1000 })
    {
      const ConstraintTable table = randomSegments(xy, count, reach, seed++);
      const Outcome expected = outcomeInMemory(xy, table);
      for (const std::uint64_t memory : { std::uint64_t(1) << 12, std::uint64_t(1) << 30 })
      {
        expectSame(expected, outcomeOnDisk(xy, table, memory),
          std::to_string(count) + " of " + std::to_string(reach));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(PointSets, StoredConstraintSets,
  testing::Values("uniform", "clustered", "lattice", "lattice-tenths", "coast", "tiny-1e-300",
    "huge-1e300", "denormal", "steps-at-1e12", "duplicates", "with-rejected"),
  [](const auto& info)
  {
    std::string name = info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
  });

/// Segments between a few points along a diagonal that spans twelve orders of magnitude: the parts
/// of split segments cross again after rounding. Also segments far from these.
ConstraintTable nearlyParallelSegments(unsigned seed)
{
  std::mt19937_64 random(seed);
  const auto value = [&random](double unit, int exponent)
  { return std::ldexp(0x1.d1a94a2p+0 + (unit + 2 * double(random() % 2)) * 0x1p-40, exponent); };
  Coordinates diagonal;
  for (const double unit : { 12, 4, 14, 6, 28 })
  {
    diagonal.push_back(value(unit, 0));
  }
  for (const double unit : { 10, 4, 0, 18, 8 })
  {
    diagonal.push_back(value(unit, 39));
  }
  ConstraintTable table;
  const auto add = [&table](const double* a, const double* b)
  {
    const auto first = std::int64_t(table.XY.size() / 2);
    table.XY.insert(table.XY.end(), { a[0], a[1], b[0], b[1] });
    table.Height.insert(table.Height.end(), { double(first), 7 });
    table.Edges.push_back({ first, first + 1 });
  };
  const std::array<int, 2> edges[]{ { 2, 1 }, { 3, 2 }, { 3, 0 }, { 1, 0 }, { 2, 0 }, { 4, 1 },
    { 4, 3 }, { 1, 3 } };
  for (const auto& [a, b] : edges)
  {
    add(&diagonal[2 * std::size_t(a)], &diagonal[2 * std::size_t(b)]);
    const double from[]{ -1e11 * double(table.Edges.size()), 1 };
    const double to[]{ from[0], 2 };
    add(from, to);
  }
  table.PolygonBegin = table.Edges.size();
  return table;
}

TEST(StoredConstraint, IsSplitAsInMemoryInManyRounds)
{
  int several = 0;
  int most = 0;
  for (unsigned seed = 0; seed < 60; ++seed)
  {
    const ConstraintTable table = nearlyParallelSegments(seed);
    const Coordinates xy(table.XY.begin(), table.XY.begin() + 12);
    expectSame(outcomeInMemory(xy, table), outcomeOnDisk(xy, table, 1 << 12), std::to_string(seed));
    std::vector<Constraint> constraints;
    for (const auto& [a, b] : table.Edges)
    {
      constraints.push_back({ a, b });
    }
    const int rounds =
      resolveCrossings(viewOf(table.XY), constraints, CrossingRule::Split, 1).Rounds;
    several += rounds > 1 ? 1 : 0;
    most = std::max(most, rounds);
  }
  EXPECT_GT(several, 5);
  EXPECT_GT(most, RoundsOfDoubles);
}

TEST(StoredConstraint, MayNamePointsByIds)
{
  const Coordinates xy = makePointSet("duplicates", 900);
  std::mt19937_64 random(3);
  for (const int count : { 3, 40, 200 })
  {
    ConstraintTable table;
    for (int i = 0; i < count; ++i)
    {
      table.Edges.push_back({ std::int64_t(random() % 900), std::int64_t(random() % 900) });
    }
    table.PolygonBegin = table.Edges.size();
    const Outcome expected = outcomeInMemory(xy, table);
    for (const std::uint64_t memory : { std::uint64_t(1) << 12, std::uint64_t(1) << 30 })
    {
      expectSame(expected, outcomeOnDisk(xy, table, memory), std::to_string(count));
    }
  }
}

TEST(StoredConstraint, IsRefusedIfItCrossesOthersOrNamesAnUnknownPoint)
{
  const Coordinates xy{ 0, 0, 4, 4, 0, 4, 4, 0, 9, 1 };
  const auto run = [&](ConstraintTable table)
  {
    const TemporaryFolder folder;
    TableConstraints constraints;
    constraints.Lines = std::move(table);
    constraints.Lines.PolygonBegin = constraints.Lines.Edges.size();
    constraints.Crossings = CrossingRule::Refuse;
    ConstrainedStream points(streamOf(xy), constraints, "lines.csv", 1);
    points.begin(folder.path("constraints"), 1 << 12);
    forEachBlock(points, 3, [](PointBlock&) {});
  };
  ConstraintTable named;
  named.Edges = { { 1, 4 }, { 0, 1 }, { 2, 3 } };
  expectIOError("lines.csv",
    "constraint 1 (points 0 and 1) crosses constraint 2 (points 2 and 3) at (2, 2)",
    [&] { run(named); });
  ConstraintTable own; // the third point is new, and gets the id 5
  own.XY = { 9, 1, 0, 0, 1, 5, 3, -1, 4, 4 };
  own.Height = { 0, 0, 0, 0, 0 };
  own.Edges = { { 0, 1 }, { 2, 3 }, { 1, 4 } };
  expectIOError("lines.csv",
    "constraint 0 (points 4 and 0) crosses constraint 1 (points 5 and 6) at (", [&] { run(own); });
  ConstraintTable many; // the same constraints after 5000 other new points
  for (int i = 0; i < 5000; ++i)
  {
    many.XY.insert(many.XY.end(), { 10.0 + i, 7 });
  }
  many.XY.insert(many.XY.end(), own.XY.begin(), own.XY.end());
  for (const auto& [a, b] : own.Edges)
  {
    many.Edges.push_back({ 5000 + a, 5000 + b });
  }
  expectIOError("lines.csv",
    "constraint 0 (points 4 and 0) crosses constraint 1 (points 5005 and 5006) at (",
    [&] { run(many); });
  named.Edges = { { 0, 4 }, { 7, 1 }, { 6, 1 } };
  expectIOError(
    "lines.csv", "a constraint names point 6, but there are 5 points", [&] { run(named); });
}

} // namespace
