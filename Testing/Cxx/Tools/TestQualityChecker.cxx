// SPDX-License-Identifier: BSD-3-Clause
#include "Check/QualityChecker.h"
#include "Constraints/Insertion/TriangulateConstrained.h"
#include "Constraints/ResolveCrossings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace
{

using tipp::CheckedMesh;
using tipp::checkQuality;
using tipp::QualityReport;
using tipp::ThinReason;
using tipp::check::Position;

constexpr double degree = 0.017453292519943295; // in radians

/// Four corners and the sides between them.
CheckedMesh squareInput()
{
  CheckedMesh mesh;
  mesh.InputXY = { 0, 0, 4, 0, 4, 4, 0, 4 };
  mesh.Segments = { { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 0 } };
  return mesh;
}

/// The square with a split point on each side and a point in the middle: eight halves of squares.
CheckedMesh grid()
{
  CheckedMesh mesh = squareInput();
  mesh.MinAngle = "45";
  mesh.XY = { 0, 0, 4, 0, 4, 4, 0, 4, 2, 0, 4, 2, 2, 4, 0, 2, 2, 2 };
  mesh.Triangles = { 0, 4, 8, 4, 1, 8, 1, 5, 8, 5, 2, 8, 2, 6, 8, 6, 3, 8, 3, 7, 8, 7, 0, 8 };
  return mesh;
}

/// The square with one point, so that the triangle 0 has two such angles, in degrees.
CheckedMesh lowered(double angle)
{
  CheckedMesh mesh = squareInput();
  mesh.MinAngle = "30";
  mesh.XY = mesh.InputXY;
  mesh.XY.insert(mesh.XY.end(), { 2, 2 * std::tan(angle * degree) });
  mesh.Triangles = { 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4 };
  return mesh;
}

/// Two segments that meet at 20 degrees, with split points at equal distances. The triangle 0 is
/// between them, and the others have no angle below 40 degrees.
CheckedMesh wedge()
{
  CheckedMesh mesh;
  const double x = std::cos(20 * degree);
  const double y = std::sin(20 * degree);
  mesh.InputXY = { 0, 0, 4, 0, 3.9 * x, 3.9 * y };
  mesh.Segments = { { 0, 1 }, { 0, 2 } };
  mesh.MinAngle = "10";
  mesh.XY = mesh.InputXY;
  mesh.XY.insert(mesh.XY.end(), { 3, 0, 3 * x, 3 * y });
  mesh.Triangles = { 0, 3, 4, 3, 1, 2, 3, 2, 4 };
  return mesh;
}

/// A segment whose split points were split off again and again, in any order, and a point above it.
CheckedMesh splitSegment(std::uint64_t seed)
{
  CheckedMesh mesh;
  mesh.InputXY = { 1e6 / 3, 4e6 / 7, 1.1e6 / 3, 4.3e6 / 7, 1e6 / 3, 4.3e6 / 7 };
  mesh.Segments = { { 0, 1 } };
  const auto at = [&mesh](std::size_t i) {
    return Position{ mesh.InputXY[2 * i], mesh.InputXY[2 * i + 1] };
  };
  std::vector<Position> chain{ at(0), at(1) };
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> part(1.0 / 3, 2.0 / 3);
  for (int i = 0; i < 200; ++i)
  {
    const std::size_t from = random() % (chain.size() - 1);
    const Position a = chain[from];
    const Position b = chain[from + 1];
    const double f = part(random);
    const Position split{ a.x + (b.x - a.x) * f, a.y + (b.y - a.y) * f };
    chain.insert(chain.begin() + std::ptrdiff_t(from) + 1, split);
  }
  mesh.XY = { at(2).x, at(2).y };
  for (std::size_t i = 0; i < chain.size(); ++i)
  {
    mesh.XY.insert(mesh.XY.end(), { chain[i].x, chain[i].y });
    if (i > 0)
    {
      mesh.Triangles.insert(mesh.Triangles.end(), { 0, std::int64_t(i), std::int64_t(i) + 1 });
    }
  }
  return mesh;
}

/// Points on a lattice or anywhere, and segments between any two: they cross, overlap, and pass
/// points.
CheckedMesh crossingSegments(std::uint64_t seed)
{
  std::mt19937_64 random(seed);
  const bool onLattice = seed % 2 == 0;
  const double origin = seed % 3 == 0 ? 0.0 : 1e5 / 3;
  std::uniform_real_distribution<double> anywhere(0, 8);
  CheckedMesh mesh;
  for (int i = 0; i < 2 * 40; ++i)
  {
    const double part = anywhere(random);
    mesh.InputXY.push_back(origin + (onLattice ? std::floor(part) / 3 : part));
  }
  std::vector<tipp::Constraint> constraints;
  for (int i = 0; i < 12; ++i)
  {
    mesh.Segments.push_back({ std::int64_t(random() % 40), std::int64_t(random() % 40) });
    const auto& [a, b] = mesh.Segments.back();
    constraints.push_back({ tipp::PointId(a), tipp::PointId(b) });
  }
  const tipp::ConstrainedTriangulation made =
    tipp::triangulateConstrained(tipp::PointsView(mesh.InputXY.data(), 40, 2), constraints,
      tipp::CrossingRule::Split, tipp::TriangulationOptions());
  mesh.XY = mesh.InputXY;
  for (const tipp::CrossingPoint& crossing : made.Constraints.Crossings)
  {
    mesh.XY.insert(mesh.XY.end(), { crossing.Position.x, crossing.Position.y });
  }
  mesh.Triangles.assign(made.Mesh.Ids32.begin(), made.Mesh.Ids32.end());
  return mesh;
}

void expectCorrect(const CheckedMesh& mesh)
{
  for (const std::string& fault : checkQuality(mesh).faults())
  {
    ADD_FAILURE() << fault;
  }
}

/// Expects one fault, and these words in its sentence.
void expectFault(const CheckedMesh& mesh, const std::string& words)
{
  const std::vector<std::string> faults = checkQuality(mesh).faults();
  ASSERT_EQ(1u, faults.size()) << (faults.empty() ? "" : faults[1]);
  EXPECT_NE(std::string::npos, faults[0].find(words)) << faults[0];
}

TEST(QualityChecker, AcceptsARefinedSquare)
{
  CheckedMesh mesh = grid();
  mesh.MaxArea = [](Position) { return 2.0; };
  expectCorrect(mesh);
}

TEST(QualityChecker, ReportsFigures)
{
  const QualityReport report = checkQuality(lowered(20));
  EXPECT_NEAR(20, report.LeastAngle, 1e-12);
  EXPECT_EQ(0, report.LeastAngleAt);
  EXPECT_EQ(1, report.Histogram[4]); // or beside it in bin 3
  EXPECT_EQ(1, report.Below);
  const double low = 4 * std::tan(20 * degree);
  EXPECT_NEAR(8 - low, report.LargestArea, 1e-12);
  EXPECT_NEAR(4 / low, report.Grading, 1e-12);
}

TEST(QualityChecker, RefusesAnAngleBelowTheBound)
{
  expectCorrect(lowered(30.1));
  expectFault(lowered(29.9),
    "1 triangles have an angle below 30 degrees and are not excused; the "
    "first is triangle 0, with 29.9");
}

TEST(QualityChecker, RefusesAnAreaAboveTheLimit)
{
  CheckedMesh mesh = grid();
  mesh.MaxArea = [](Position) { return std::nextafter(2.0, 0.0); };
  expectFault(mesh, "8 triangles are above the limit on areas; the first is triangle 0");
}

TEST(QualityChecker, EvaluatesTheAreaLimitAtCentroids)
{
  CheckedMesh mesh = grid();
  mesh.MaxArea = [](Position p) { return p.x > 3 && p.y < 1.5 ? 1.9 : HUGE_VAL; };
  expectFault(mesh, "1 triangles are above the limit on areas; the first is triangle 2");
}

TEST(QualityChecker, RefusesALimitThatIsNotANumber)
{
  CheckedMesh mesh = grid();
  mesh.MaxArea = [](Position) { return std::nan(""); };
  expectFault(mesh, "8 triangles are above the limit on areas");
}

TEST(QualityChecker, AcceptsRoundedSplitPoints)
{
  for (std::uint64_t seed = 0; seed < 20; ++seed)
  {
    expectCorrect(splitSegment(seed));
  }
}

TEST(QualityChecker, RefusesASplitPointMovedOutwards)
{
  CheckedMesh mesh = splitSegment(1);
  mesh.XY[101] -= 1e-5;
  const QualityReport report = checkQuality(mesh);
  EXPECT_EQ(1, report.LostSegments.Count);
  EXPECT_EQ(0, report.LostSegments.First);
}

/// Then the segment is outside of the mesh, and the mesh has a border that is no segment.
TEST(QualityChecker, RefusesASplitPointMovedInwards)
{
  CheckedMesh mesh = splitSegment(1);
  mesh.XY[101] += 1e-5;
  EXPECT_EQ(2, checkQuality(mesh).OpenBorder.Count);
}

TEST(QualityChecker, RefusesASplitPointMovedInside)
{
  CheckedMesh mesh = grid();
  mesh.Segments.push_back({ 0, 2 });
  mesh.XY[16] += 1e-9;
  const QualityReport report = checkQuality(mesh);
  EXPECT_EQ(1, report.LostSegments.Count);
  EXPECT_EQ(4, report.LostSegments.First);
}

TEST(QualityChecker, AcceptsASegmentThatIsNotDelaunay)
{
  CheckedMesh mesh;
  mesh.InputXY = { 0, 0, 4, -1, 8, 0, 4, 1 };
  mesh.Segments = { { 0, 2 } };
  mesh.XY = mesh.InputXY;
  mesh.Triangles = { 0, 1, 2, 0, 2, 3 };
  expectCorrect(mesh);
  mesh.Segments.clear();
  expectFault(mesh, "1 edges are not locally Delaunay");
}

TEST(QualityChecker, RefusesALostSegment)
{
  CheckedMesh mesh;
  mesh.InputXY = { 0, 0, 4, -1, 8, 0, 4, 1 };
  mesh.Segments = { { 0, 1 }, { 0, 2 } };
  mesh.XY = mesh.InputXY;
  mesh.Triangles = { 0, 1, 3, 1, 2, 3 };
  expectFault(mesh, "1 segments are not chains of edges; the first is segment 1");
}

TEST(QualityChecker, RefusesASegmentOfNoPoint)
{
  CheckedMesh mesh = grid();
  mesh.Segments.push_back({ 0, 4 });
  expectFault(mesh, "1 segments are not chains of edges; the first is segment 4");
}

TEST(QualityChecker, AcceptsCrossingSegments)
{
  CheckedMesh mesh = grid();
  mesh.Segments.insert(mesh.Segments.end(), { { 0, 2 }, { 1, 3 } });
  expectCorrect(mesh);
}

TEST(QualityChecker, AcceptsSegmentsOutsideOfTheMesh)
{
  CheckedMesh mesh = grid();
  mesh.InputXY.insert(mesh.InputXY.end(), { 6, 0, 8, 1 });
  mesh.Segments.insert(mesh.Segments.end(), { { 4, 5 }, { 4, 2 } });
  expectCorrect(mesh);
}

TEST(QualityChecker, RefusesASegmentThatRunsThroughTriangles)
{
  CheckedMesh mesh = grid();
  mesh.InputXY.insert(mesh.InputXY.end(), { -2, 1, 6, 1.5 });
  mesh.Segments.push_back({ 4, 5 });
  expectFault(mesh, "1 segments are not chains of edges; the first is segment 4");
}

TEST(QualityChecker, RefusesALostPoint)
{
  CheckedMesh mesh = grid();
  mesh.InputXY.insert(mesh.InputXY.end(), { 9, 9, 3, 3 }); // outside, and on an edge
  expectFault(
    mesh, "1 points of the input are inside of the mesh, but no vertices; the first is point 5");
}

TEST(QualityChecker, RefusesALostPointOnTheBorder)
{
  CheckedMesh mesh = grid();
  mesh.InputXY.insert(mesh.InputXY.end(), { 1, 0 });
  expectFault(
    mesh, "1 points of the input are inside of the mesh, but no vertices; the first is point 4");
}

TEST(QualityChecker, AcceptsABorderThatRoundingLedBeyondAPoint)
{
  CheckedMesh mesh; // point 3 is outside of the segment by less than half a unit
  mesh.InputXY = { 0.1001, 0.0001, 1.3001, 0.4001, 1, 0, 1.0001, 0.30010000000000003, 0.5, 0.9 };
  mesh.Segments = { { 0, 1 }, { 3, 4 } };
  mesh.XY = { 0.1001, 0.0001, 1.3001, 0.4001, 1, 0, 0.93727082451262844, 0.2791569415042095,
    1.1186854122563141, 0.33962847075210478 };
  mesh.Triangles = { 2, 1, 4, 2, 4, 3, 2, 3, 0 };
  expectCorrect(mesh);
  mesh.InputXY[7] -= 0x1p-35; // inside of the segment
  mesh.Segments.pop_back();
  expectFault(
    mesh, "1 points of the input are inside of the mesh, but no vertices; the first is point 3");
}

TEST(QualityChecker, RefusesAFilledHole)
{
  CheckedMesh mesh = grid();
  mesh.Holes = { 9, 9, 3, 2.5 };
  expectFault(mesh, "1 points of holes are in a triangle; the first is hole 1");
}

TEST(QualityChecker, RefusesALostTriangle)
{
  CheckedMesh mesh = grid();
  mesh.Triangles.erase(mesh.Triangles.begin(), mesh.Triangles.begin() + 3);
  expectFault(mesh, "2 border edges are neither on segments nor on the convex hull of the input");
}

TEST(QualityChecker, RefusesAMeshWithoutTriangles)
{
  CheckedMesh mesh = grid();
  mesh.Triangles.clear();
  EXPECT_FALSE(checkQuality(mesh).isCorrect());
}

TEST(QualityChecker, RefusesTrianglesOfNoPoint)
{
  CheckedMesh mesh = grid();
  mesh.Triangles[0] = 9;
  mesh.Triangles[4] = -1;
  EXPECT_EQ(2, checkQuality(mesh).Mesh.BadIds);
}

TEST(QualityChecker, RefusesTrianglesOfPointsThatAreNotFinite)
{
  CheckedMesh mesh = grid();
  mesh.XY[16] = std::nan("");
  EXPECT_EQ(8, checkQuality(mesh).Mesh.BadIds);
}

/// A constrained triangulation is a refined mesh that has no bounds.
TEST(QualityChecker, AcceptsConstrainedTriangulations)
{
  for (std::uint64_t seed = 0; seed < 300; ++seed)
  {
    SCOPED_TRACE(seed);
    expectCorrect(crossingSegments(seed));
  }
}

TEST(QualityChecker, WithoutInputLeavesTheBorderUnchecked)
{
  CheckedMesh mesh = grid();
  mesh.InputXY.clear();
  mesh.Segments.clear();
  mesh.Triangles.erase(mesh.Triangles.begin(), mesh.Triangles.begin() + 3);
  expectCorrect(mesh);
}

TEST(QualityChecker, HullIsTheBorderOfPoints)
{
  CheckedMesh mesh = grid();
  mesh.Segments.clear();
  expectCorrect(mesh);
}

TEST(QualityChecker, ExcusesInputAngles)
{
  CheckedMesh mesh = wedge();
  expectCorrect(mesh);
  mesh.MinAngle = "30";
  expectCorrect(mesh);
  EXPECT_EQ(1, checkQuality(mesh).Excused[std::size_t(ThinReason::InputAngle)]);
}

TEST(QualityChecker, AcceptsListedTriangles)
{
  for (const ThinReason reason : { ThinReason::ShortestEdge, ThinReason::Rounding,
         ThinReason::KeptSegments, ThinReason::MostPoints })
  {
    CheckedMesh mesh = lowered(29.9);
    mesh.Listed = { { 0, 29.9000004, reason } };
    expectCorrect(mesh);
    EXPECT_EQ(1, checkQuality(mesh).Excused[std::size_t(reason)]);
  }
}

TEST(QualityChecker, AcceptsAListedInputAngle)
{
  CheckedMesh mesh = wedge();
  mesh.MinAngle = "21";
  mesh.Listed = { { 0, 20, ThinReason::InputAngle } };
  expectCorrect(mesh);
}

TEST(QualityChecker, RefusesATriangleThatIsNotListed)
{
  CheckedMesh mesh = wedge();
  mesh.MinAngle = "21";
  mesh.Listed.emplace();
  expectFault(mesh, "1 triangles have an angle below 21 degrees and are not excused");
}

TEST(QualityChecker, RefusesAListedInputAngleThatIsNone)
{
  CheckedMesh mesh = lowered(29.9);
  mesh.Listed = { { 0, 29.9, ThinReason::InputAngle } };
  expectFault(mesh, "1 listed triangles are not between segments that meet below 60 degrees");
}

TEST(QualityChecker, RefusesAWrongListedAngle)
{
  CheckedMesh mesh = lowered(29.9);
  mesh.Listed = { { 0, 29.90001, ThinReason::Rounding } };
  expectFault(mesh, "1 listed triangles have another smallest angle; the first is triangle 0");
  mesh.Listed = { { 0, std::nan(""), ThinReason::Rounding } };
  expectFault(mesh, "1 listed triangles have another smallest angle");
}

TEST(QualityChecker, RefusesAListedTriangleAboveTheBound)
{
  CheckedMesh mesh = lowered(30.1);
  mesh.Listed = { { 0, 30.1, ThinReason::Rounding } };
  expectFault(mesh, "1 listed triangles have no angle below 30 degrees; the first is triangle 0");
}

TEST(QualityChecker, RefusesEntriesOfNoTriangle)
{
  CheckedMesh mesh = lowered(29.9);
  mesh.Listed = { { 0, 29.9, ThinReason::Rounding }, { 4, 20, ThinReason::Rounding },
    { -1, 20, ThinReason::Rounding }, { 0, 29.9, ThinReason::Rounding } };
  expectFault(mesh,
    "3 entries of the list name no triangle, or one that is listed before; the first is entry 1");
}

/// The shortest edge is on one side, although several segments have its ends.
TEST(QualityChecker, OverlappingSegmentsAreNoInputAngle)
{
  CheckedMesh mesh = squareInput();
  mesh.Segments.insert(mesh.Segments.end(), { { 0, 1 }, { 1, 0 } });
  mesh.MinAngle = "30";
  mesh.XY = { 0, 0, 4, 0, 4, 4, 0, 4, 1.9, 0, 2.1, 0, 2, 2 };
  mesh.Triangles = { 0, 4, 6, 4, 5, 6, 5, 1, 6, 1, 2, 6, 2, 3, 6, 3, 0, 6 };
  expectFault(mesh,
    "1 triangles have an angle below 30 degrees and are not excused; the first is "
    "triangle 1");
}

/// Points so far from the origin and so near that doubles cannot tell whether the limits hold.
TEST(QualityChecker, IsExactForTinyAndHugeCoordinates)
{
  for (const double scale : { 0x1p-1000, 0x1p-500, 0x1p500, 0x1p1000 })
  {
    CheckedMesh mesh = grid();
    for (std::vector<double>* const xy : { &mesh.XY, &mesh.InputXY })
    {
      for (double& coordinate : *xy)
      {
        coordinate *= scale;
      }
    }
    expectCorrect(mesh);
  }
}

} // namespace
