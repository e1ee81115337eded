// SPDX-License-Identifier: BSD-3-Clause
// The check of constraints where rounding moves them.
#include "Check/DelaunayChecker.h"
#include "Constraints/ConstraintEdges.h"
#include "Constraints/Insertion/TriangulateConstrained.h"
#include "Constraints/ResolveCrossings.h"
#include "Constraints/TableConstraints.h"
#include "InMemory/TriangulateTable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <vector>

namespace
{

using namespace tipp;
using Random = std::mt19937_64;

/// Points and constraints, and a mesh of them.
struct Map
{
  std::vector<double> XY; ///< the input's points
  std::vector<FixedEdge> Constraints;
  std::vector<double> MeshXY; ///< with the crossings
  std::vector<std::int64_t> Triangles;

  std::int64_t add(double x, double y)
  {
    const auto [found, isNew] = this->Known.emplace(std::make_pair(x, y), this->XY.size() / 2);
    if (isNew)
    {
      this->XY.insert(this->XY.end(), { x, y });
    }
    return std::int64_t(found->second);
  }

  void triangulate()
  {
    std::vector<Constraint> constraints;
    for (const FixedEdge& edge : this->Constraints)
    {
      constraints.push_back({ PointId(edge[0]), PointId(edge[1]) });
    }
    TriangulationOptions options;
    options.Threads = 1;
    const ConstrainedTriangulation made =
      triangulateConstrained(PointsView(this->XY.data(), this->XY.size() / 2, 2), constraints,
        CrossingRule::Split, options);
    this->MeshXY = this->XY;
    for (const CrossingPoint& crossing : made.Constraints.Crossings)
    {
      this->MeshXY.insert(this->MeshXY.end(), { crossing.Position.x, crossing.Position.y });
    }
    this->Triangles.assign(made.Mesh.Ids32.begin(), made.Mesh.Ids32.end());
    this->Chains.clear();
    for (const IdSegment& segment : made.Constraints.Segments)
    {
      this->Chains.push_back({ std::min(segment.A, segment.B), std::max(segment.A, segment.B) });
    }
  }

  ConstraintsInMesh constraintsInMesh() const
  {
    ConstraintsInMesh constraints;
    constraints.Edges = this->Constraints;
    constraints.IsAdded = [this](std::int64_t id)
    { return id >= std::int64_t(this->XY.size() / 2); };
    constraints.IsCut = this->IsCut;
    constraints.TieRule = true;
    return constraints;
  }

  CheckReport check() const
  {
    const ConstraintChains chains =
      findConstraintChains(this->MeshXY, this->Triangles, this->constraintsInMesh());
    CheckOptions options;
    options.TieRule = true;
    options.IsCut = this->IsCut;
    options.Constraints = chains.Edges;
    CheckReport report = checkDelaunay(this->MeshXY, this->Triangles, options);
    report.LostConstraints = chains.Lost;
    report.UndecidedConstraints = chains.UndecidedConstraints;
    report.UndecidedEdges = chains.UndecidedEdges;
    return report;
  }

  std::vector<FixedEdge> Chains; ///< parts of the constraints
  bool IsCut = false;

private:
  std::map<std::pair<double, double>, std::size_t> Known;
};

double rounded(double value, double unit)
{
  return std::round(value / unit) * unit;
}

/// Parcels in rows and columns, whose corners are in cm. Both neighbours have their own vertices on
/// the edge between them, which are rounded to cm or to doubles, so that the edges nearly coincide.
Map parcels(std::uint64_t seed)
{
  Random random(seed);
  Map map;
  const double wests[] = { 0, 500'000, 345'678.12, -712'345.67 };
  const double souths[] = { 0, 5'000'000, 5'432'109.87, -4'987'654.32 };
  const double west = wests[random() % 4];
  const double south = souths[random() % 4];
  const auto part = [&random] { return std::uniform_real_distribution<double>(0, 1)(random); };
  const int columns = 2 + int(random() % 5);
  const int rows = 2 + int(random() % 5);
  constexpr double cm = 0.01;
  std::vector<std::array<double, 2>> corners;
  for (int row = 0; row <= rows; ++row)
  {
    for (int column = 0; column <= columns; ++column)
    {
      corners.push_back({ rounded(west + 30 * column + 12 * part(), cm),
        rounded(south + 40 * row + 15 * part(), cm) });
    }
  }
  const bool isInCm = random() % 4 == 0;
  const auto addEdge = [&](std::array<double, 2> a, std::array<double, 2> b)
  {
    std::vector<double> parts(random() % 4);
    std::generate(parts.begin(), parts.end(), part);
    std::sort(parts.begin(), parts.end());
    std::int64_t from = map.add(a[0], a[1]);
    for (const double t : parts)
    {
      const double x = a[0] + t * (b[0] - a[0]);
      const double y = a[1] + t * (b[1] - a[1]);
      const std::int64_t to = isInCm ? map.add(rounded(x, cm), rounded(y, cm)) : map.add(x, y);
      map.Constraints.push_back({ from, to });
      from = to;
    }
    map.Constraints.push_back({ from, map.add(b[0], b[1]) });
  };
  for (int row = 0; row < rows; ++row)
  {
    for (int column = 0; column < columns; ++column)
    {
      const int first = row * (columns + 1) + column;
      const int ring[] = { first, first + 1, first + columns + 2, first + columns + 1, first };
      for (int i = 0; i < 4; ++i)
      {
        addEdge(corners[std::size_t(ring[i])], corners[std::size_t(ring[i + 1])]);
      }
    }
  }
  for (int i = 0; i < 50; ++i)
  {
    map.add(west + 30 * columns * part(), south + 40 * rows * part());
  }
  map.triangulate();
  return map;
}

std::string textOf(const CheckReport& report)
{
  std::string text;
  for (const auto& lines : { report.faults(), report.undecided() })
  {
    for (const std::string& line : lines)
    {
      text += line + "\n";
    }
  }
  return text;
}

/// Moves a coordinate by up to three units in the last place.
double nudged(double value, Random& random)
{
  for (std::uint64_t steps = random() % 4; steps > 0; --steps)
  {
    value = std::nextafter(value, random() % 2 == 0 ? HUGE_VAL : -HUGE_VAL);
  }
  return value;
}

/// Chains of segments that run along each other, a few units in the last place apart.
Map bundle(std::uint64_t seed)
{
  Random random(seed);
  Map map;
  const auto part = [&random] { return std::uniform_real_distribution<double>(0, 1)(random); };
  const double scales[] = { 1, 100, 5e5, 1e-5 };
  const double scale = scales[random() % 4];
  const double offset = random() % 3 == 0 ? 0 : scale * part();
  const double ax = offset;
  const double ay = random() % 4 == 0 ? 0 : 10 * offset;
  const double dx = scale * (part() - 0.3);
  const double dy = random() % 5 == 0 ? 0 : scale * (part() - 0.3);
  const int chains = 2 + int(random() % 6);
  for (int chain = 0; chain < chains; ++chain)
  {
    std::vector<double> parts(2 + random() % 6);
    std::generate(parts.begin(), parts.end(), part);
    std::sort(parts.begin(), parts.end());
    std::int64_t from = -1;
    for (const double t : parts)
    {
      const std::int64_t to = map.add(nudged(ax + t * dx, random), nudged(ay + t * dy, random));
      if (from >= 0)
      {
        map.Constraints.push_back({ from, to });
      }
      from = to;
    }
  }
  for (int i = 0; i < 20; ++i)
  {
    map.add(ax + 2 * scale * (part() - 0.5), ay + 2 * scale * (part() - 0.5));
  }
  map.triangulate();
  return map;
}

/// Lines across a ring, outside of which there are no triangles.
Map cutMap(std::uint64_t seed)
{
  Random random(seed);
  const auto part = [&random] { return std::uniform_real_distribution<double>(0, 1)(random); };
  const auto draw = [&] {
    return std::array<double, 2>{ 500'000 + 100 * part(), 5'000'000 + 100 * part() };
  };
  PointTable points;
  for (int i = 0; i < 60; ++i)
  {
    const auto [x, y] = draw();
    points.XY.insert(points.XY.end(), { x, y });
  }
  const std::size_t given = points.XY.size();
  TableConstraints constraints;
  const auto addLine = [](ConstraintTable& table, std::array<double, 2> a, std::array<double, 2> b)
  {
    const auto id = std::int64_t(table.XY.size() / 2);
    table.XY.insert(table.XY.end(), { a[0], a[1], b[0], b[1] });
    table.Edges.push_back({ id, id + 1 });
    table.PolygonBegin = table.Edges.size();
  };
  const int corners = 3 + int(random() % 8);
  std::vector<std::array<double, 2>> ring;
  for (int i = 0; i < corners; ++i)
  {
    const double angle = 6.28 * i / corners;
    const double radius = 15 + 30 * part();
    ring.push_back({ 500'050 + radius * std::cos(angle), 5'000'050 + radius * std::sin(angle) });
  }
  for (std::size_t i = 0; i < ring.size(); ++i)
  {
    addLine(constraints.Boundary, ring[i], ring[(i + 1) % ring.size()]);
  }
  for (int i = 0; i < 12; ++i)
  {
    addLine(constraints.Lines, draw(), draw());
  }
  TriangulationOptions options;
  options.Threads = 1;
  const ConstrainedTriangulation made = triangulateTable(points, constraints, options);
  Map map;
  map.IsCut = true;
  map.XY.assign(points.XY.begin(), points.XY.begin() + std::ptrdiff_t(given));
  map.MeshXY = points.XY;
  map.Triangles.assign(made.Mesh.Ids32.begin(), made.Mesh.Ids32.end());
  std::map<std::array<double, 2>, std::int64_t> ids;
  for (std::size_t i = 0; i < points.XY.size(); i += 2)
  {
    ids.emplace(std::array{ points.XY[i], points.XY[i + 1] }, std::int64_t(i / 2));
  }
  for (const ConstraintTable* const table : { &constraints.Lines, &constraints.Boundary })
  {
    for (const auto& edge : table->Edges)
    {
      const auto idOf = [&](std::int64_t end) {
        return ids.at({ table->XY[2 * std::size_t(end)], table->XY[2 * std::size_t(end) + 1] });
      };
      map.Constraints.push_back({ idOf(edge[0]), idOf(edge[1]) });
    }
  }
  for (const IdSegment& segment : made.Constraints.Segments)
  {
    map.Chains.push_back({ std::min(segment.A, segment.B), std::max(segment.A, segment.B) });
  }
  return map;
}

TEST(ConstraintChains, ParcelsAreNeverFaulty)
{
  int undecided = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed)
  {
    const CheckReport report = parcels(seed).check();
    ASSERT_TRUE(report.faults().empty()) << "seed " << seed << ": " << textOf(report);
    undecided += report.isCorrect() ? 0 : 1;
  }
  EXPECT_EQ(0, undecided);
}

TEST(ConstraintChains, BundlesOfNearlyEqualLinesAreNeverFaulty)
{
  int undecided = 0;
  constexpr int maps = 1000;
  for (std::uint64_t seed = 0; seed < maps; ++seed)
  {
    const CheckReport report = bundle(seed).check();
    ASSERT_TRUE(report.faults().empty()) << "seed " << seed << ": " << textOf(report);
    undecided += report.isCorrect() ? 0 : 1;
  }
  EXPECT_LE(undecided, maps / 20);
}

TEST(ConstraintChains, CutMeshesAreNeverFaulty)
{
  int undecided = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed)
  {
    const CheckReport report = cutMap(seed).check();
    ASSERT_TRUE(report.faults().empty()) << "seed " << seed << ": " << textOf(report);
    undecided += report.isCorrect() ? 0 : 1;
  }
  EXPECT_LE(undecided, 2);
}

/// Five places of which three are nearly on one line, and constraints between all of them. Nearly
/// equal constraints cross each other in 23 rounds.
Map crossedInManyRounds()
{
  Map map;
  const double places[5][2] = { { 0x1.74876e8014ccdp+32, 0x1.74876e8008p+32 },
    { 0x1.74876e800cccdp+32, 0x1.74876e8p+32 }, { 0x1.74876e800cccdp+32, 0x1.74876e800199ap+36 },
    { 0x1.74876e800e666p+36, 0x1.74876e8003333p+36 },
    { 0x1.74876e801b333p+36, 0x1.74876e800999ap+36 } };
  for (const auto& [x, y] : places)
  {
    map.add(x, y);
  }
  map.Constraints = { { 4, 0 }, { 0, 1 }, { 3, 4 }, { 3, 1 }, { 3, 0 }, { 0, 2 }, { 4, 2 },
    { 2, 1 }, { 2, 3 }, { 4, 1 } };
  map.triangulate();
  return map;
}

TEST(ConstraintChains, ManyRoundsOfRoundingAreNoFault)
{
  const CheckReport report = crossedInManyRounds().check();
  EXPECT_TRUE(report.faults().empty()) << textOf(report);
  EXPECT_FALSE(report.undecided().empty());
}

TEST(ConstraintChains, AFlippedEdgeIsAFaultAfterManyRoundsOfRounding)
{
  Map map = crossedInManyRounds();
  map.Constraints.erase(map.Constraints.begin() + 5); // from 0 to 2, far from the others
  const CheckReport report = map.check();
  EXPECT_EQ(1, report.BadSpheres) << textOf(report);
}

TEST(ConstraintChains, OfPiecesAreThoseOfTheWhole)
{
  for (std::uint64_t seed = 0; seed < 20; ++seed)
  {
    const Map map = parcels(seed);
    const ConstraintChains whole =
      findConstraintChains(map.MeshXY, map.Triangles, map.constraintsInMesh());
    const std::size_t half = map.Triangles.size() / 6 * 3;
    const auto read = [&](std::size_t number)
    {
      CheckedPiece piece;
      piece.XY = map.MeshXY;
      piece.Ids.resize(map.MeshXY.size() / 2);
      std::iota(piece.Ids.begin(), piece.Ids.end(), std::int64_t(0));
      const auto middle = map.Triangles.begin() + std::ptrdiff_t(half);
      number == 0 ? piece.Triangles.assign(map.Triangles.begin(), middle)
                  : piece.Triangles.assign(middle, map.Triangles.end());
      piece.OwnTriangles = std::int64_t(piece.Triangles.size() / 3);
      return piece;
    };
    const ConstraintChains pieces = findConstraintChains(2, read, map.XY, map.constraintsInMesh());
    EXPECT_EQ(0, pieces.Lost);
    EXPECT_EQ(0, pieces.UndecidedConstraints + pieces.UndecidedEdges);
    EXPECT_EQ(whole.Edges, pieces.Edges) << "seed " << seed;
  }
}

/// Replaces an edge by the other diagonal of its two triangles. Returns false if this is not a
/// convex quadrilateral, or if one of its other corners is within 0.001 of the edge.
bool flip(Map& map, const FixedEdge& edge)
{
  std::vector<std::size_t> corners; // opposite to the edge
  for (std::size_t i = 0; i < map.Triangles.size(); ++i)
  {
    const std::size_t first = i / 3 * 3;
    const auto [low, high] =
      std::minmax(map.Triangles[first + (i + 1) % 3], map.Triangles[first + (i + 2) % 3]);
    if (low == edge[0] && high == edge[1])
    {
      corners.push_back(i);
    }
  }
  if (corners.size() != 2)
  {
    return false;
  }
  const auto at = [&map](std::int64_t id) {
    return check::Position{ map.MeshXY[2 * std::size_t(id)], map.MeshXY[2 * std::size_t(id) + 1] };
  };
  std::int64_t ids[2];
  std::int64_t next[2];
  for (std::size_t i = 0; i < 2; ++i)
  {
    const std::size_t first = corners[i] / 3 * 3;
    ids[i] = map.Triangles[corners[i]];
    next[i] = map.Triangles[first + (corners[i] + 1) % 3];
  }
  const check::Position a = at(next[0]);
  const check::Position b = at(next[1]);
  for (const std::int64_t id : ids)
  {
    const check::Position p = at(id);
    const double off = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    if (std::fabs(off) < 0.001 * std::hypot(b.x - a.x, b.y - a.y))
    {
      return false;
    }
  }
  if (check::turn(at(ids[0]), a, at(ids[1])) <= 0 || check::turn(at(ids[1]), b, at(ids[0])) <= 0)
  {
    return false;
  }
  for (std::size_t i = 0; i < 2; ++i)
  {
    std::int64_t* const triangle = &map.Triangles[corners[i] / 3 * 3];
    triangle[0] = ids[i];
    triangle[1] = next[i];
    triangle[2] = ids[1 - i];
  }
  return true;
}

/// Flips edges of constraints in 60 meshes, and expects a fault each time. Returns the number of
/// flips.
int expectFaultsOfFlips(Map (*mapOf)(std::uint64_t))
{
  int flips = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed)
  {
    const Map right = mapOf(seed);
    Random random(seed);
    for (int i = 0; i < 5; ++i)
    {
      Map wrong = right;
      const FixedEdge edge = right.Chains[random() % right.Chains.size()];
      if (flip(wrong, edge))
      {
        ++flips;
        EXPECT_FALSE(wrong.check().faults().empty()) << "seed " << seed << " edge " << edge[0];
      }
    }
  }
  return flips;
}

TEST(ConstraintChains, FlippedEdgesAreFaults)
{
  EXPECT_GT(expectFaultsOfFlips(parcels), 50);
}

TEST(ConstraintChains, FlippedEdgesOfCutMeshesAreFaults)
{
  EXPECT_GT(expectFaultsOfFlips(cutMap), 30);
}

/// The corners of all triangles, by their coordinates, in an order that does not depend on ids.
std::set<std::array<double, 6>> trianglesOf(const Map& map)
{
  std::set<std::array<double, 6>> triangles;
  for (std::size_t i = 0; i < map.Triangles.size(); i += 3)
  {
    std::array<std::array<double, 2>, 3> corners;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const auto id = 2 * std::size_t(map.Triangles[i + k]);
      corners[k] = { map.MeshXY[id], map.MeshXY[id + 1] };
    }
    std::sort(corners.begin(), corners.end());
    triangles.insert(
      { corners[0][0], corners[0][1], corners[1][0], corners[1][1], corners[2][0], corners[2][1] });
  }
  return triangles;
}

/// A mesh for other constraints: one of them makes a detour over a point that is far from it.
TEST(ConstraintChains, DetoursAreFaults)
{
  int detours = 0;
  int faulty = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed)
  {
    Map map = parcels(seed);
    const auto right = trianglesOf(map);
    Random random(seed);
    const std::vector<FixedEdge> given = map.Constraints;
    const FixedEdge edge = given[random() % given.size()];
    const auto detour = std::int64_t(map.XY.size() / 2 - 1 - random() % 50);
    map.Constraints.erase(
      std::remove_if(map.Constraints.begin(), map.Constraints.end(),
        [&](const FixedEdge& other)
        { return std::minmax(other[0], other[1]) == std::minmax(edge[0], edge[1]); }),
      map.Constraints.end());
    map.Constraints.push_back({ edge[0], detour });
    map.Constraints.push_back({ detour, edge[1] });
    map.triangulate();
    map.Constraints = given;
    if (trianglesOf(map) != right)
    {
      ++detours;
      const CheckReport report = map.check();
      EXPECT_FALSE(report.isCorrect()) << "seed " << seed;
      faulty += report.faults().empty() ? 0 : 1;
    }
  }
  EXPECT_GT(detours, 30);
  EXPECT_GE(
    faulty, detours - 2); // one may run within a rounding of the constraint that is left out
}

/// The point m is on the line from a to b but for rounding. No constraint crosses the line, so it
/// need not pass m.
class LineBesideAPoint : public testing::Test
{
protected:
  LineBesideAPoint()
  {
    const std::int64_t a = this->Lines.add(0, 0);
    const std::int64_t b = this->Lines.add(3, 1);
    const std::int64_t m = this->Lines.add(1, 1.0 / 3); // below the line
    const std::int64_t below = this->Lines.add(1, -2);
    this->Lines.add(1, 2);
    this->Lines.Constraints = { { a, b }, { m, below } };
    this->Lines.triangulate();
  }

  Map Lines;
};

TEST_F(LineBesideAPoint, IsCorrectAsAnEdge)
{
  EXPECT_TRUE(this->Lines.check().isCorrect()) << textOf(this->Lines.check());
}

TEST_F(LineBesideAPoint, IsUndecidedIfItPassesThePoint)
{
  this->Lines.Triangles = { 0, 2, 4, 2, 1, 4, 0, 3, 2, 2, 3, 1 };
  const CheckReport report = this->Lines.check();
  EXPECT_TRUE(report.faults().empty()) << textOf(report);
  EXPECT_EQ(1, report.UndecidedConstraints);
}

} // namespace
