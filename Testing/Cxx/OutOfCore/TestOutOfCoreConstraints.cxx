// SPDX-License-Identifier: BSD-3-Clause
// Constraints out of core give the triangles that are made in memory.
#include "Constraints/ConstraintEdges.h"
#include "Constraints/Insertion/TriangulateConstrained.h"
#include "Constraints/ResolveCrossings.h"
#include "Constraints/TableConstraints.h"
#include "InMemory/TriangulateTable.h"
#include "OutOfCore/OutOfCoreOptions.h"
#include "OutOfCore/OutOfCoreTriangulation.h"
#include "OutOfCore/SpilledSegments.h"
#include "OutOfCoreTesting.h"
#include "Triangulation/InputSurvey.h"

#include "Constraints/OnDisk/ConstrainedStream.h"
#include "ExpectIOError.h"
#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/PieceFile.h"
#include "Partitioned/ReadPiece.h"
#include "Predicates/ExactPredicates.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>
#include <set>

namespace
{

namespace fs = std::filesystem;
using namespace tipp;
using namespace tipp::test;

constexpr double Pi = 3.14159265358979323846;

/// Random segments between points of the input, and between new points.
ConstraintTable randomSegments(const Coordinates& xy, int count, unsigned seed)
{
  std::mt19937_64 random(seed);
  const std::size_t points = xy.size() / 2;
  ConstraintTable table;
  for (int i = 0; i < 2 * count; ++i)
  {
    const std::size_t p = random() % points;
    const std::size_t q = random() % points;
    const bool isNew = i % 8 < 2;
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      const double value = xy[2 * p + axis];
      table.XY.push_back(isNew ? value / 2 + xy[2 * q + axis] / 2 : value);
    }
    if (i % 2 == 1)
    {
      table.Edges.push_back({ i - 1, i });
    }
  }
  table.PolygonBegin = table.Edges.size();
  return table;
}

void addPolygon(double x, double y, double radius, int corners, ConstraintTable& table)
{
  const auto first = std::int64_t(table.XY.size() / 2);
  const int count = std::abs(corners); // negative for clockwise
  for (int i = 0; i < count; ++i)
  {
    const double angle = 2 * Pi * i / corners;
    table.XY.insert(table.XY.end(), { x + radius * std::cos(angle), y + radius * std::sin(angle) });
    table.Edges.push_back({ first + i, first + (i + 1) % count });
  }
}

class ConstrainedRun
{
public:
  ConstrainedRun(const Coordinates& xy, TableConstraints constraints)
    : Constraints(std::move(constraints))
  {
    this->All.XY = xy;
    writePoints(this->Folder.path("points.npy"), xy);
    this->Options.PiecePoints = 150;
    this->Options.PartitionPoints = 40;
    this->Options.Threads = 2;
  }

  void makeExpected()
  {
    TriangulationOptions plain;
    plain.MaximumEdge = this->Options.MaximumEdge;
    ConstrainedTriangulation made = triangulateTable(this->All, this->Constraints, plain);
    this->Expected = trianglesOf(made.Mesh);
    this->Segments = std::move(made.Constraints.Segments);
  }

  OutOfCoreStatistics run()
  {
    ConstrainedStream points(openPointStream({ this->Folder.path("points.npy") }),
      this->Constraints, "constraints.csv", 2);
    return triangulateOutOfCore(points, this->mesh(), this->Options);
  }

  testing::AssertionResult matches() const
  {
    return sameTriangles(this->All.XY, trianglesOfMesh(this->mesh()), this->Expected);
  }

  std::string mesh() const { return this->Folder.path("mesh.tipp"); }

  TableConstraints Constraints;
  PointTable All; ///< all points; makeExpected() adds those of the constraints
  OutOfCoreOptions Options;
  Triangles Expected;
  std::vector<IdSegment> Segments; ///< the expected mesh's edges on constraints
  TemporaryFolder Folder;
};

class OutOfCoreConstraints : public testing::TestWithParam<std::string>
{
};

TEST_P(OutOfCoreConstraints, GiveTheTrianglesMadeInMemoryForAllPiecesAndThreads)
{
  const Coordinates xy = makePointSet(GetParam(), 2000);
  for (const int count : { 3, 60 })
  {
    TableConstraints constraints;
    constraints.Lines = randomSegments(xy, count, unsigned(count));
    ConstrainedRun run(xy, constraints);
    run.makeExpected();
    for (const std::int64_t piece : { 0, 100, 700 })
    {
      for (const int threads : { 1, 3 })
      {
        run.Options.PiecePoints = piece;
        run.Options.PartitionPoints = piece / 4;
        run.Options.Threads = threads;
        const OutOfCoreStatistics statistics = run.run();
        ASSERT_TRUE(run.matches()) << count << " segments, " << piece << " points a piece";
        ASSERT_EQ(std::int64_t(run.Expected.size()), statistics.Triangles);
      }
    }
  }
}

class ConstrainedPieces : public testing::TestWithParam<std::string>
{
};

TEST_P(ConstrainedPieces, FollowTheFormat)
{
  const Coordinates xy = makePointSet(GetParam(), 1200);
  TableConstraints constraints;
  constraints.Lines = randomSegments(xy, 40, 7);
  ConstrainedRun run(xy, constraints);
  run.Options.Neighbors = true;
  run.makeExpected();
  run.run();
  ASSERT_TRUE(run.matches());
  expectBelongs(run.mesh(), sourceOf(run.mesh(), run.All.XY));
}

TEST_P(ConstrainedPieces, AreTheSameAfterInterruptedRuns)
{
  const Coordinates xy = makePointSet(GetParam(), 2000);
  TableConstraints constraints;
  constraints.Lines = randomSegments(xy, 30, 5);
  ConstrainedRun run(xy, constraints);
  run.run();
  const auto expected = filesOf(run.mesh());
  std::mt19937 random(1);
  run.Options.Resume = true;
  int resumed = 0;
  for (int round = 0; round < 4; ++round)
  {
    fs::remove_all(run.mesh());
    OutOfCoreStatistics statistics;
    int ended = 0;
    do
    {
      int calls = int(random() % 60) + 2 * ended++;
      run.Options.Progress = [&calls](double) { return calls-- > 0; };
      statistics = run.run();
      resumed += statistics.Resumed ? 1 : 0;
    } while (statistics.Aborted);
    ASSERT_TRUE(expected == filesOf(run.mesh())) << round;
  }
  EXPECT_GT(resumed, 4);
}

INSTANTIATE_TEST_SUITE_P(PointSets, ConstrainedPieces,
  testing::Values("uniform", "clustered", "lattice", "coast", "duplicates"));

INSTANTIATE_TEST_SUITE_P(PointSets, OutOfCoreConstraints,
  testing::Values("uniform", "clustered", "lattice", "lattice-tenths", "cocircular", "coast",
    "tiny-1e-300", "huge-1e300", "denormal", "steps-at-1e12", "duplicates", "one-far-away",
    "with-rejected", "parabola"),
  [](const auto& info)
  {
    std::string name = info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
  });

TEST(OutOfCoreConstraint, MayReferToPointIds)
{
  const Coordinates xy = makePointSet("duplicates", 1500);
  TableConstraints constraints;
  constraints.Lines.Edges = { { 0, 1499 }, { 3, 800 }, { 5, 5 }, { 900, 17 } };
  constraints.Lines.PolygonBegin = 4;
  ConstrainedRun run(xy, constraints);
  run.makeExpected();
  run.run();
  EXPECT_TRUE(run.matches());
}

/// Points with small integer coordinates: most positions have several points, many of them on
/// constraints.
Coordinates coincidingPoints(std::mt19937_64& random, int count, int side)
{
  Coordinates xy;
  for (int i = 0; i < 2 * count; ++i)
  {
    xy.push_back(double(random() % unsigned(side)));
  }
  return xy;
}

TEST(OutOfCoreConstraint, IsKeptWherePointsCoincide)
{
  for (unsigned seed = 0; seed < 25; ++seed)
  {
    std::mt19937_64 random(seed);
    const Coordinates xy = coincidingPoints(random, 2000, 40);
    TableConstraints constraints;
    constraints.Lines = randomSegments(xy, 12, seed);
    ConstrainedRun run(xy, constraints);
    run.Options.PartitionPoints = 0;
    run.Options.Columns = run.Options.Rows = 4;
    run.makeExpected();
    run.run();
    ASSERT_TRUE(run.matches()) << seed;
  }
}

/// Lines that cross at a point of the input, and a line that crosses them elsewhere.
TEST(OutOfCoreConstraint, CrossesAnotherAtAPointWithoutANewPoint)
{
  const Coordinates xy{ 3, 3, 0, 0, 6, 0, 6, 6, 0, 6, 3, 3, 1, 3 };
  TableConstraints constraints;
  constraints.Lines.XY = { 0, 3, 6, 3, 3, 0, 3, 6, 5, 1, 5, 5 };
  constraints.Lines.Edges = { { 0, 1 }, { 2, 3 }, { 4, 5 } };
  constraints.Lines.PolygonBegin = 3;
  for (const std::int64_t crossings : { 1, 0 })
  {
    ConstrainedRun run(xy, constraints);
    run.makeExpected();
    const OutOfCoreStatistics statistics = run.run();
    EXPECT_EQ(crossings, statistics.Constraints.Crossings);
    EXPECT_EQ(std::int64_t(run.All.size()), statistics.Points);
    EXPECT_TRUE(run.matches());
    constraints.Lines.Edges.pop_back();
    constraints.Lines.PolygonBegin = 2;
    constraints.Crossings = CrossingRule::Refuse; // there is nothing to refuse any more
  }
}

/// The crossing is not a double. The nearest one is a point of the input, or a point of the
/// constraints' file that no constraint uses.
TEST(OutOfCoreConstraint, CrossesAnotherAtThePointToWhichTheCrossingRounds)
{
  const Coordinates corners{ 0, 0, 2, 0, 2, 2, 0, 2 };
  const Point2 at = crossingPoint({ 0, 0 }, { 1, 1 }, { 0, 1 }, { 0.5, 0 });
  for (const bool isGiven : { true, false })
  {
    Coordinates xy = corners;
    if (isGiven)
    {
      xy.insert(xy.end(), { at.x, at.y });
    }
    TableConstraints constraints;
    constraints.Lines.XY = { 0, 0, 1, 1, 0, 1, 0.5, 0 };
    if (!isGiven)
    {
      constraints.Lines.XY.insert(constraints.Lines.XY.end(), { at.x, at.y });
    }
    constraints.Lines.Edges = { { 0, 1 }, { 2, 3 } };
    constraints.Lines.PolygonBegin = 2;
    ConstrainedRun run(xy, constraints);
    run.makeExpected();
    const OutOfCoreStatistics statistics = run.run();
    EXPECT_EQ(0, statistics.Constraints.Crossings);
    EXPECT_EQ(8, statistics.Points);
    EXPECT_TRUE(run.matches());
  }
}

/// Points are on the constraints, and others round to their crossings.
TEST(OutOfCoreConstraint, LeavesPointsInItsChainIfOthersCrossIt)
{
  for (unsigned seed = 0; seed < 10; ++seed)
  {
    std::mt19937_64 random(seed);
    const Coordinates xy = coincidingPoints(random, 600, 15);
    TableConstraints constraints;
    for (int i = 0; i < 12; ++i)
    {
      constraints.Lines.Edges.push_back(
        { std::int64_t(random() % 600), std::int64_t(random() % 600) });
    }
    constraints.Lines.PolygonBegin = constraints.Lines.Edges.size();
    ConstrainedRun run(xy, constraints);
    run.makeExpected();
    const OutOfCoreStatistics statistics = run.run();
    EXPECT_GT(statistics.Constraints.Crossings, 0);
    EXPECT_EQ(std::int64_t(run.All.size()), statistics.Points);
    ASSERT_TRUE(run.matches()) << seed;
  }
}

TEST(OutOfCoreConstraint, MayLieOnOthers)
{
  std::mt19937_64 random(4);
  const Coordinates xy = makePointSet("lattice-shuffled", 900); // 30 x 30 points with spacing 1
  TableConstraints constraints;
  const auto draw = [&random] { return double(random() % 59) / 2; };
  for (int i = 0; i < 300; ++i)
  {
    const double from = draw();
    const double to = draw();
    i % 3 == 0
      ? constraints.Lines.XY.insert(constraints.Lines.XY.end(), { from, 7, to, 7 })
      : constraints.Lines.XY.insert(constraints.Lines.XY.end(), { from, from - 0.5, to, to - 0.5 });
    constraints.Lines.Edges.push_back({ 2 * i, 2 * i + 1 });
  }
  addPolygon(14.5, 7, 9, 4, constraints.Lines); // two of its corners are on the lines
  constraints.Lines.PolygonBegin = 300;
  for (const bool hasCrossing : { false, true })
  {
    hasCrossing ? constraints.Lines.Edges[0] = { 0, 4 } : constraints.Lines.Edges[0];
    ConstrainedRun run(xy, constraints);
    run.makeExpected();
    run.run();
    EXPECT_TRUE(run.matches()) << hasCrossing;
  }
}

TEST(OutOfCoreConstraint, RemovesTrianglesOutsidePolygonsAndInHoles)
{
  const Coordinates xy = makePointSet("uniform", 3000);
  for (const bool hasInside : { true, false })
  {
    TableConstraints constraints;
    constraints.Lines = randomSegments(xy, 10, 3);
    if (hasInside)
    {
      addPolygon(0.5, 0.5, 0.4, 30, constraints.Lines);
    }
    addPolygon(0.5, 0.5, 0.2, -13, constraints.Lines);
    addPolygon(0.55, 0.5, 0.1, 4, constraints.Lines);
    addPolygon(0.9, 0.9, 0.05, -5, constraints.Lines);
    ConstrainedRun run(xy, constraints);
    run.makeExpected();
    run.run();
    EXPECT_TRUE(run.matches()) << hasInside;
  }
}

/// Lattice points lie on the edges of polygons, some of which are vertical.
TEST(OutOfCoreConstraint, CutsAlongLatticeLines)
{
  const Coordinates xy = makePointSet("lattice", 2500);
  std::array<double, 2> low{ HUGE_VAL, HUGE_VAL };
  std::array<double, 2> high{ -HUGE_VAL, -HUGE_VAL };
  for (std::size_t i = 0; i < xy.size(); ++i)
  {
    low[i % 2] = std::min(low[i % 2], xy[i]);
    high[i % 2] = std::max(high[i % 2], xy[i]);
  }
  const auto at = [&](double x, double y) // fractions of the bounding box
  {
    return std::array<double, 2>{ low[0] + x * (high[0] - low[0]),
      low[1] + y * (high[1] - low[1]) };
  };
  const auto middle = at(0.5, 0.5);
  TableConstraints constraints;
  constraints.Lines = randomSegments(xy, 40, 3);
  const double radius = 0.2 * std::min(high[0] - low[0], high[1] - low[1]);
  addPolygon(middle[0], middle[1], radius, 9, constraints.Lines);
  constraints.Lines.PolygonBegin = constraints.Lines.Edges.size(); // all are lines
  // One seed is the end of a line. Some lines end at the hull.
  const auto end = std::array<double, 2>{ constraints.Lines.XY[0], constraints.Lines.XY[1] };
  for (const auto& seeds : { std::vector<std::array<double, 2>>{ at(0.5, 0.51) },
         { at(0.6, 0.62), at(0.47, 0.5), at(0.501, 0.75) }, { end } })
  {
    constraints.Lines.Holes.clear();
    for (const auto& seed : seeds)
    {
      constraints.Lines.Holes.insert(constraints.Lines.Holes.end(), seed.begin(), seed.end());
    }
    ConstrainedRun run(xy, constraints);
    run.makeExpected();
    run.run();
    EXPECT_TRUE(run.matches()) << seeds.size();
    EXPECT_FALSE(run.Expected.empty());
  }
}

/// Whether a triangle is inside a polygon must not depend on a hole's border around it.
TEST(OutOfCoreConstraint, CutsHolesInsideOfPolygonsAndBoundaries)
{
  const Coordinates xy = makePointSet("lattice-shuffled", 900); // 30 x 30 points with spacing 1
  const auto addSquare = [](double low, double high, ConstraintTable& table)
  {
    const auto first = std::int64_t(table.XY.size() / 2);
    table.XY.insert(table.XY.end(), { low, low, high, low, high, high, low, high });
    for (std::int64_t i = 0; i < 4; ++i)
    {
      table.Edges.push_back({ first + i, first + (i + 1) % 4 });
    }
  };
  TableConstraints constraints;
  addSquare(9, 15, constraints.Lines);
  constraints.Lines.PolygonBegin = constraints.Lines.Edges.size();
  addSquare(3, 21, constraints.Lines);
  addSquare(2, 18, constraints.Boundary);
  constraints.Lines.Holes = { 10.5, 12.25 };
  ConstrainedRun run(xy, constraints);
  run.makeExpected();
  EXPECT_EQ(std::size_t(2 * (15 * 15 - 6 * 6)), run.Expected.size()); // two triangles per square
  run.run();
  EXPECT_TRUE(run.matches());
  run.Constraints.Lines.Holes = { -4, 1 };
  expectIOError("constraints.csv", "the hole at (-4, 1) is in no triangle", [&] { run.run(); });
}

TEST(SpilledSegments, AreReadByPieceAndNearBoxes)
{
  const Coordinates xy = makePointSet("clustered", 4000);
  const ConstraintTable table = randomSegments(xy, 300, 9);
  std::vector<ConstraintSegment> segments;
  for (std::size_t i = 0; i < table.XY.size(); i += 4)
  {
    const bool isLine = i % 3 == 0;
    segments.push_back({ { table.XY[i], table.XY[i + 1] }, { table.XY[i + 2], table.XY[i + 3] },
      isLine ? SegmentRole::Line : SegmentRole::Polygon });
  }
  constexpr double factor = 0.25;
  InputSurvey survey;
  survey.Points = std::int64_t(xy.size() / 2);
  survey.Factor = factor;
  survey.Bounds = Box2::empty();
  for (std::size_t i = 0; i < xy.size(); i += 2)
  {
    const Point2 p{ factor * xy[i], factor * xy[i + 1] };
    survey.Sample.push_back({ std::int64_t(i / 2), p });
    survey.Bounds.extend(p);
  }
  OutOfCoreOptions options;
  options.PiecePoints = 150;
  const PiecePlan plan(survey, options, MemoryPlan(options, 3, true), 3, 1);
  ASSERT_GT(plan.pieces(), 10);
  TemporaryFolder folder;
  SaveArchive saved;
  const auto forEach = [&segments](const VisitSegment& visit)
  { std::for_each(segments.begin(), segments.end(), visit); };
  SpilledSegments(folder.path("points"), plan, factor, forEach, 2).save(saved);
  const Bytes bytes = saved.take();
  LoadArchive archive(bytes);
  const SpilledSegments stored(folder.path("points"), plan, factor, archive);

  const auto namesOf = [&](const ConstraintSegments& read)
  {
    std::set<std::int64_t> names;
    for (const SegmentTree::Item& item : read.tree().items())
    {
      const std::int64_t name = read.nameOf(item.Id);
      EXPECT_TRUE(
        item.A == segments[std::size_t(name)].A && item.B == segments[std::size_t(name)].B);
      EXPECT_TRUE(names.insert(name).second) << "twice";
    }
    return names;
  };
  std::size_t all = 0;
  for (PartitionIndex piece = 0; piece < plan.pieces(); ++piece)
  {
    const Box2 box = scaled(plan.Pieces.box(piece), 1 / factor);
    std::set<std::int64_t> expected;
    std::set<std::int64_t> overlapping;
    for (std::size_t i = 0; i < segments.size(); ++i)
    {
      if (box.meets(Box2::of(segments[i].A, segments[i].B)))
      {
        overlapping.insert(std::int64_t(i));
        if (lineMayMeet(segments[i].A, segments[i].B, box))
        {
          expected.insert(std::int64_t(i));
        }
      }
    }
    EXPECT_EQ(expected, namesOf(stored.read(piece)));
    EXPECT_EQ(std::int64_t(expected.size()), stored.count(piece));
    const std::set<std::int64_t> near = namesOf(stored.readNear({ box }));
    EXPECT_TRUE(std::includes(near.begin(), near.end(), expected.begin(), expected.end()));
    EXPECT_TRUE(std::includes(overlapping.begin(), overlapping.end(), near.begin(), near.end()));
    all += expected.size();
  }
  EXPECT_GT(all, segments.size()); // some segments are in several pieces
  EXPECT_TRUE(stored.readNear({}).tree().items().empty());
  EXPECT_EQ(200u, stored.cutting().list().size());
}

/// Only the constraints of loaded pieces must fit into memory, not all constraints.
TEST(OutOfCoreConstraint, MayExceedTheMemoryLimit)
{
  const Coordinates xy = makePointSet("uniform", 20000);
  TableConstraints constraints;
  constexpr int side = 70;
  for (int i = 0; i < side * side; ++i)
  {
    const double x = double(i % side) / side;
    const double y = double(i / side) / side;
    constraints.Lines.XY.insert(
      constraints.Lines.XY.end(), { x, y, x + 0.9 / side, y + 0.7 / side });
    constraints.Lines.Edges.push_back({ 2 * i, 2 * i + 1 });
  }
  constraints.Lines.PolygonBegin = constraints.Lines.Edges.size();
  ConstrainedRun run(xy, constraints);
  run.makeExpected();
  run.Options.PiecePoints = run.Options.PartitionPoints = 0;
  run.Options.MemoryLimit = 4 * side * side * sizeof(ConstraintSegment) / 5;
  EXPECT_GT(run.run().Pieces, 4);
  EXPECT_TRUE(run.matches());
}

TEST(OutOfCoreConstraint, RefusesCrossings)
{
  const Coordinates xy = makePointSet("uniform", 500);
  TableConstraints constraints;
  constraints.Lines.XY = { 0.1, 0.1, 0.9, 0.9, 0.1, 0.9, 0.9, 0.1 };
  constraints.Lines.Edges = { { 0, 1 }, { 2, 3 } };
  constraints.Lines.PolygonBegin = 2;
  constraints.Crossings = CrossingRule::Refuse;
  ConstrainedRun run(xy, constraints);
  expectIOError("constraints.csv",
    "constraint 0 (points 500 and 501) crosses constraint 1 (points 502 and 503) at (0.5, 0.5)",
    [&] { run.run(); });
}

} // namespace
