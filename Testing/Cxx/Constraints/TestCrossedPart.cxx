// SPDX-License-Identifier: BSD-3-Clause
// Jobs of crossed triangles, and parts of a triangulation, as in out-of-core runs and on ranks.
#include "Comparison.h"
#include "ConstrainedOracle.h"
#include "Constraints/ConstraintEdges.h"
#include "Constraints/Insertion/KeepInside.h"
#include "Constraints/Insertion/TriangulateConstrained.h"
#include "PointSets.h"

#include "Constraints/Insertion/ConstraintJobs.h"
#include "Constraints/Insertion/CrossedPart.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

namespace
{

using namespace tipp;
using namespace tipp::test;

TEST(ConstraintJobs, JoinPiecesThatCrossTheSameTriangle)
{
  CrossedTriangles crossed;
  crossed.Triangles = { 3, 8, 9, 20, 21 };
  crossed.Segments = { 1, 4, /**/ 2, /**/ 4, 5, /**/ 2, /**/ 5 };
  crossed.Starts = { 0, 2, 3, 5, 6, 7 };
  // Jobs are numbered by their first triangle: 1, 4 and 5 are job 0, 2 is job 1.
  EXPECT_EQ((std::vector<std::int64_t>{ 0, 1, 0, 1, 0 }), jobsOfTriangles(crossed));
}

TEST(ConstraintJobs, SplitPiecesAtTouchesAlongTheirDirection)
{
  const Coordinates xy{ 0, 0, 1, 0, 2, 0, 3, 0, 0, 5 };
  std::vector<IdSegment> idSegments{ { 0, 3, 7 }, { 3, 0, 8 }, { 0, 4, 9 } };
  const SplitSegments split =
    splitSegments(view(xy), idSegments, { { 0, 1 }, { 0, 2 }, { 1, 1 }, { 1, 2 } });
  EXPECT_EQ((std::vector<std::int64_t>{ 0, 3, 6, 7 }), split.Starts);
  std::vector<PointId> ends;
  for (const IdSegment& part : split.Parts)
  {
    ends.insert(ends.end(), { part.A, part.B });
  }
  EXPECT_EQ((std::vector<PointId>{ 0, 1, 1, 2, 2, 3, 3, 2, 2, 1, 1, 0, 0, 4 }), ends);
  EXPECT_EQ(7, split.Parts[2].Constraint);
  EXPECT_EQ(8, split.Parts[3].Constraint);
}

TEST(ConstraintJobs, LeavePiecesWithoutTouchesWhole)
{
  std::vector<IdSegment> idSegments{ { 0, 1, 0 } };
  const SplitSegments split = splitSegments(view({ 0, 0, 1, 0 }), idSegments, {});
  EXPECT_TRUE(split.Starts.empty());
  EXPECT_EQ(1u, split.Parts.size());
}

/// A Delaunay triangulation, and constraint segments that do not cross each other.
struct Scene
{
  explicit Scene(const std::string& set, unsigned seed, int count)
    : XY(makePointSet(set, 600))
  {
    std::mt19937_64 random(seed);
    const std::size_t points = this->XY.size() / 2;
    for (int i = 0; i < count; ++i)
    {
      this->Constraints.push_back(
        { std::int64_t(random() % points), std::int64_t(random() % points) });
    }
    this->Whole = triangulateConstrained(view(this->XY), this->Constraints);
    this->XY = withCrossings(this->XY, this->Whole);
    this->Mesh = trianglesOf(triangulate(view(this->XY)));
    for (const IdSegment& segment : this->Whole.Constraints.Segments)
    {
      this->Segments.push_back({ this->at(segment.A), this->at(segment.B), SegmentRole::Line });
    }
    // Adds a segment with points on it: a segment need not be split at the points on it.
    const Constraint& first = this->Constraints.front();
    if (this->Whole.Constraints.Crossings.empty())
    {
      this->Segments.push_back({ this->at(first.A), this->at(first.B), SegmentRole::Line });
    }
  }

  Point2 at(std::int64_t id) const
  {
    return { this->XY[2 * std::size_t(id)], this->XY[2 * std::size_t(id) + 1] };
  }

  Coordinates XY;
  std::vector<Constraint> Constraints;
  ConstrainedTriangulation Whole;
  Triangles Mesh; ///< without constraints
  std::vector<ConstraintSegment> Segments;
};

/// Returns the triangles that no segment crosses, and moves the others to `part`.
Triangles takeFrom(
  const Scene& scene, const ConstraintSegments& segments, const Triangles& mesh, CrossedPart& part)
{
  std::vector<std::int64_t> corners;
  for (const Triangle& triangle : mesh)
  {
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  }
  const std::size_t kept =
    takeCrossed(view(scene.XY), segments, 0, corners.data(), mesh.size(), part);
  Triangles rest;
  for (std::size_t t = 0; t < kept; ++t)
  {
    rest.push_back({ corners[3 * t], corners[3 * t + 1], corners[3 * t + 2] });
  }
  return rest;
}

void addTo(const CrossedPart& part, Triangles& mesh)
{
  for (const CrossedPart::Corners& triangle : part.Triangles)
  {
    mesh.push_back(canonical(triangle[0], triangle[1], triangle[2]));
  }
}

class CrossedParts : public testing::TestWithParam<std::string>
{
};

TEST_P(CrossedParts, AreRetriangulatedAsAWhole)
{
  const Scene scene(GetParam(), 3, 12);
  const ConstraintSegments segments(scene.Segments);
  CrossedPart part;
  Triangles mesh = takeFrom(scene, segments, scene.Mesh, part);
  EXPECT_GT(part.Triangles.size(), 20u);
  EXPECT_EQ(part.Triangles.size(), part.SegmentEnds.size());
  retriangulate(part, 2);
  addTo(part, mesh);
  EXPECT_TRUE(sameTriangles(scene.XY, sorted(mesh), trianglesOf(scene.Whole.Mesh)));
}

/// Each part is a vertical stripe of triangles. First each stripe retriangulates what lies inside
/// it alone, then the rest of all stripes is retriangulated together.
TEST_P(CrossedParts, AreRetriangulatedInTwoSteps)
{
  const Scene scene(GetParam(), 5, 9);
  const ConstraintSegments segments(scene.Segments);
  constexpr std::size_t stripes = 4;
  Triangles byX = scene.Mesh;
  std::sort(byX.begin(), byX.end(),
    [&](const Triangle& a, const Triangle& b)
    { return scene.at(a[0]).x + scene.at(a[1]).x < scene.at(b[0]).x + scene.at(b[1]).x; });
  Triangles mesh;
  CrossedPart rest;
  std::size_t done = 0;
  for (std::size_t stripe = 0; stripe < stripes; ++stripe)
  {
    const auto begin = byX.begin() + std::ptrdiff_t(byX.size() * stripe / stripes);
    const auto end = byX.begin() + std::ptrdiff_t(byX.size() * (stripe + 1) / stripes);
    std::set<std::int64_t> elsewhere; // points of other stripes
    for (auto t = byX.begin(); t != byX.end(); ++t)
    {
      if (t < begin || t >= end)
      {
        elsewhere.insert(t->begin(), t->end());
      }
    }
    CrossedPart part;
    const Triangles kept = takeFrom(scene, segments, Triangles(begin, end), part);
    mesh.insert(mesh.end(), kept.begin(), kept.end());
    append(splitIncomplete(part, [&](std::int64_t id) { return elsewhere.count(id) == 0; }), rest);
    done += part.Triangles.size();
    retriangulate(part, 1);
    addTo(part, mesh);
  }
  EXPECT_GT(rest.Triangles.size(), 0u);
  EXPECT_GT(done, 0u);
  retriangulate(rest, 2);
  addTo(rest, mesh);
  EXPECT_TRUE(sameTriangles(scene.XY, sorted(mesh), trianglesOf(scene.Whole.Mesh)));
}

TEST_P(CrossedParts, MayBeRenumbered)
{
  const Scene scene(GetParam(), 3, 12);
  const ConstraintSegments segments(scene.Segments);
  CrossedPart part;
  takeFrom(scene, segments, scene.Mesh, part);
  CrossedPart renamed = part;
  renamed.rename([](std::int64_t id) { return 1000 - id; });
  ASSERT_EQ(part.Triangles.size(), renamed.Triangles.size());
  retriangulate(part, 1);
  retriangulate(renamed, 1);
  renamed.rename([](std::int64_t id) { return 1000 - id; });
  Triangles expected;
  Triangles actual;
  addTo(part, expected);
  addTo(renamed, actual);
  EXPECT_TRUE(sameTriangles(scene.XY, sorted(actual), sorted(expected)));
}

TEST_P(CrossedParts, MarkTheEdgesOfSegments)
{
  const Scene scene(GetParam(), 7, 10);
  const ConstraintSegments segments(scene.Segments);
  const Triangles mesh = trianglesOf(scene.Whole.Mesh);
  std::vector<std::int32_t> corners;
  for (const Triangle& triangle : mesh)
  {
    std::transform(triangle.begin(), triangle.end(), std::back_inserter(corners),
      [](std::int64_t id) { return std::int32_t(id); });
  }
  std::vector<std::uint8_t> marks(corners.size());
  markEdges(view(scene.XY), segments, corners.data(), mesh.size(), marks.data());
  const ConstraintEdges edges(scene.Whole.Constraints.Segments);
  for (std::size_t c = 0; c < corners.size(); ++c)
  {
    const std::int32_t a = corners[c % 3 == 2 ? c - 2 : c + 1];
    const std::int32_t b = corners[c % 3 == 0 ? c + 2 : c - 1];
    ASSERT_EQ(edges.contains(a, b), marks[c] != 0) << a << " " << b;
  }
}

INSTANTIATE_TEST_SUITE_P(
  PointSets, CrossedParts, testing::Values("uniform", "lattice", "cocircular", "clustered"));

/// Polygons, boundaries and holes keep the same triangles whether rays or walks across triangles
/// decide.
TEST(ConstraintSegments, KeepTheSameTrianglesAsInMemory)
{
  Coordinates xy = makePointSet("uniform", 400);
  std::vector<Constraint> constraints;
  const auto addRing = [&](double x, double y, double radius, int corners)
  {
    const auto first = PointId(xy.size() / 2);
    const int count = std::abs(corners);
    for (int i = 0; i < count; ++i)
    {
      const double angle = 6.283185307179586 * i / corners; // clockwise if negative
      xy.insert(xy.end(), { x + radius * std::cos(angle), y + radius * std::sin(angle) });
      constraints.push_back({ first + i, first + (i + 1) % count });
    }
  };
  addRing(0.5, 0.5, 0.45, 20);
  addRing(0.45, 0.5, 0.2, -7);
  const std::size_t polygonEnd = constraints.size();
  addRing(0.6, 0.5, 0.3, 9);
  const std::size_t boundaryEnd = constraints.size();
  addRing(0.8, 0.55, 0.1, 4); // lines around a hole
  ConstrainedTriangulation made = triangulateConstrained(view(xy), constraints);
  xy = withCrossings(xy, made);
  const std::vector<IdSegment>& idSegments = made.Constraints.Segments;
  const std::vector<Point2> seeds{ { 0.8, 0.55 } };
  Triangles all = trianglesOf(made.Mesh);
  keepInside(view(xy), made.Mesh, idSegments,
    { segmentsOf(idSegments, 0, polygonEnd), segmentsOf(idSegments, polygonEnd, boundaryEnd),
      seeds });
  std::vector<ConstraintSegment> segments;
  std::vector<PositionPair> lines;
  HullOfPoints hull;
  const auto at = [&](std::int64_t id) {
    return Point2{ xy[2 * std::size_t(id)], xy[2 * std::size_t(id) + 1] };
  };
  for (std::size_t i = 0; i < xy.size() / 2; ++i)
  {
    hull.add(at(std::int64_t(i)));
  }
  for (const IdSegment& segment : idSegments)
  {
    const auto constraint = std::size_t(segment.Constraint);
    segments.push_back({ at(segment.A), at(segment.B),
      constraint < polygonEnd      ? SegmentRole::Polygon
        : constraint < boundaryEnd ? SegmentRole::Boundary
                                   : SegmentRole::Line });
    lines.push_back({ at(segment.A), at(segment.B) });
  }
  for (const auto& [a, b] : edgesAroundHoles(hull.corners(), lines, seeds, 2))
  {
    segments.push_back({ a, b, SegmentRole::Hole });
  }
  const ConstraintSegments cutting(segments);
  Triangles kept;
  for (const Triangle& t : all)
  {
    if (cutting.keeps({ at(t[0]), at(t[1]), at(t[2]) }))
    {
      kept.push_back(t);
    }
  }
  EXPECT_TRUE(sameTriangles(xy, kept, trianglesOf(made.Mesh)));
  EXPECT_GT(kept.size(), 20u);
  EXPECT_LT(kept.size(), all.size());
  // Also with the segments that are saved and restored.
  const ConstraintSegments again(cutting.list());
  EXPECT_EQ(segments.size(), again.list().size());
  EXPECT_TRUE(std::all_of(kept.begin(), kept.end(),
    [&](const Triangle& t) {
      return again.keeps({ at(t[0]), at(t[1]), at(t[2]) });
    }));
}

TEST(HullOfPoints, HasTheCornersOfAllPoints)
{
  HullOfPoints hull;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> inside(-1, 1);
  for (int i = 0; i < 200000; ++i)
  {
    hull.add({ inside(random), inside(random) });
  }
  hull.add({ std::nan(""), 3 });
  for (const double x : { -2.0, 0.0, 2.0 })
  {
    for (const double y : { 2.0, 0.0, -2.0 })
    {
      hull.add({ x, y });
    }
  }
  const std::vector<Point2> expected{ { -2, -2 }, { 2, -2 }, { 2, 2 }, { -2, 2 } };
  EXPECT_TRUE(expected == hull.corners());
}

TEST(HullOfPoints, MayBeALineOrAPoint)
{
  HullOfPoints hull;
  EXPECT_TRUE(hull.corners().empty());
  hull.add({ 1, 1 });
  hull.add({ 1, 1 });
  EXPECT_EQ(1u, hull.corners().size());
  hull.add({ 2, 2 });
  hull.add({ 5, 5 });
  EXPECT_EQ(2u, hull.corners().size());
}

} // namespace
