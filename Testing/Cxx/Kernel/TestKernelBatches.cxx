// SPDX-License-Identifier: BSD-3-Clause
// Insertion in several batches, and degenerate input.
#include "KernelTesting.h"

#include "Predicates/Circumball.h"

#include <algorithm>
#include <cmath>

namespace
{

using namespace tipp;
using namespace tipp::test;
using Index = DelaunayKernel::Index;
using Points = std::vector<Point2>;

Points together(Points a, const Points& b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Points moved(Points points, double dx, double dy)
{
  for (Point2& p : points)
  {
    p = { p.x + dx, p.y + dy };
  }
  return points;
}

testing::AssertionResult batchesAreDelaunay(const std::vector<Points>& batches)
{
  DelaunayKernel kernel;
  Points all;
  for (const Points& batch : batches)
  {
    insert(kernel, batch);
    all = together(all, batch);
  }
  return isDelaunay(kernel, all);
}

Points onCircle(int count, double radius)
{
  Points points;
  for (int i = 0; i < count; ++i)
  {
    const double angle = 2 * 3.141592653589793 * i / count;
    points.push_back({ radius * std::cos(angle), radius * std::sin(angle) });
  }
  return points;
}

Points triangle()
{
  return { { 0, 0 }, { 4, 0 }, { 0, 4 } };
}

/// Index and vertices of each triangle whose vertices are among the first `vertices` and whose
/// circumdisk lies in the middle of the unit square, in the kernel's order.
std::vector<Index> placesInTheMiddle(const DelaunayKernel& kernel, Index vertices)
{
  const Box2 middle{ 0.2, 0.2, 0.8, 0.8 };
  std::vector<Index> places;
  const HalfEdgeMesh& mesh = kernel.mesh();
  for (Index t = 0; t < mesh.end(); t += 8)
  {
    const Index* v = mesh.slots() + t;
    if (!kernel.isInfinite(t) && *std::max_element(v, v + 3) <= vertices &&
      Circumdisk(kernel.point(v[0]), kernel.point(v[1]), kernel.point(v[2])).inside(middle))
    {
      places.insert(places.end(), { t, v[0], v[1], v[2] });
    }
  }
  return places;
}

TEST(KernelBatches, SeveralBatchesGiveTheTrianglesOfOne)
{
  const Points points = pointSet("uniform", 900);
  EXPECT_TRUE(batchesAreDelaunay(
    { Points(points.begin(), points.begin() + 5), Points(points.begin() + 5, points.begin() + 400),
      {}, Points(points.begin() + 400, points.end()) }));
}

/// A worker inserts its own points first, and then vertices of others. The order of its interior
/// triangles must not depend on the latter.
TEST(KernelBatches, LaterBatchesKeepTheOrderOfOtherTriangles)
{
  const Points own = pointSet("uniform", 2000);
  DelaunayKernel alone;
  insert(alone, own);
  const std::vector<Index> places = placesInTheMiddle(alone, 2000);
  ASSERT_LT(4 * 500U, places.size());
  for (const Points& foreign : { moved(pointSet("uniform", 500, 2), 1.1, 0),
         moved(pointSet("clustered", 900, 3), -0.3, 7), onCircle(50, 100) })
  {
    DelaunayKernel kernel;
    insert(kernel, own);
    insert(kernel, foreign);
    EXPECT_EQ(places, placesInTheMiddle(kernel, 2000));
  }
}

TEST(KernelBatches, PointIndicesContinueOverAllBatches)
{
  DelaunayKernel kernel;
  insert(kernel, triangle());
  insert(kernel, { { 1, 1 }, { 9, 9 } });
  std::vector<Point2> byPlace(5);
  for (Index v = 1; v < kernel.vertexEnd(); ++v)
  {
    byPlace[kernel.pointIndex(v)] = kernel.point(v);
  }
  const Points expected = together(triangle(), { { 1, 1 }, { 9, 9 } });
  for (std::size_t i = 0; i < 5; ++i)
  {
    EXPECT_EQ(expected[i], byPlace[i]) << i;
  }
}

TEST(KernelBatches, CollinearPointsHaveNoTriangles)
{
  DelaunayKernel kernel;
  insert(kernel, { { 0, 0 }, { 1, 1 }, { 2, 2 }, { 1, 1 } });
  EXPECT_FALSE(kernel.hasTriangles());
}

TEST(KernelBatches, ALaterPointCompletesCollinearOnes)
{
  Points line;
  for (int i = 0; i < 50; ++i)
  {
    line.push_back({ double(i * 7 % 50), 0 });
  }
  EXPECT_TRUE(batchesAreDelaunay({ line, { { 60, 0 }, { -3, 0 } }, { { 20, 5 }, { 20, -5 } } }));
}

TEST(KernelBatches, DuplicatesOnALineAreReportedOnceThereAreTriangles)
{
  DelaunayKernel kernel;
  insert(kernel, { { 1, 0 }, { 1, 0 }, { 2, 0 }, { 1, 0 }, { 2, 0 } });
  EXPECT_TRUE(kernel.duplicates().empty());
  insert(kernel, { { 0, 1 } });
  EXPECT_EQ(3U, kernel.duplicates().size());
  EXPECT_TRUE(isDelaunay(kernel, { { 1, 0 }, { 1, 0 }, { 2, 0 }, { 1, 0 }, { 2, 0 }, { 0, 1 } }));
}

TEST(KernelBatches, CopiesOfTwoPointsHaveNoTriangles)
{
  DelaunayKernel kernel;
  insert(kernel, Points(100, { 5, 5 }));
  insert(kernel, Points(100, { 6, 5 }));
  EXPECT_FALSE(kernel.hasTriangles());
}

TEST(KernelBatches, NothingInsertedHasNoTriangles)
{
  DelaunayKernel kernel;
  kernel.insert(nullptr, 0);
  EXPECT_FALSE(kernel.hasTriangles());
}

TEST(KernelBatches, ADuplicateOfAnEarlierBatchIsReportedWithItsVertex)
{
  DelaunayKernel kernel;
  insert(kernel, triangle());
  insert(kernel, { { 1, 1 }, { 4, 0 } });
  ASSERT_EQ(1U, kernel.duplicates().size());
  EXPECT_EQ(4U, kernel.duplicates()[0].Point);
  EXPECT_EQ((Point2{ 4, 0 }), kernel.point(kernel.duplicates()[0].Vertex));
}

TEST(KernelBatches, AClearedKernelForgetsDuplicates)
{
  DelaunayKernel kernel;
  insert(kernel, together(triangle(), triangle()));
  ASSERT_EQ(3U, kernel.duplicates().size());
  kernel.clear();
  insert(kernel, triangle());
  EXPECT_TRUE(kernel.duplicates().empty());
}

TEST(KernelBatches, APointInAnEmptyCircleOfAThousandReplacesAllTriangles)
{
  for (const int count : { 60, 61, 62, 63, 64, 65, 66, 126, 127, 128, 129, 1000 })
  {
    DelaunayKernel kernel;
    insert(kernel, onCircle(count, 1));
    insert(kernel, { { 0.001, 0.002 } });
    EXPECT_EQ(std::size_t(count), finiteTriangles(kernel).size());
    EXPECT_TRUE(isDelaunay(kernel, together(onCircle(count, 1), { { 0.001, 0.002 } })));
  }
}

TEST(KernelBatches, APointFarOutsideSeesHalfOfALargeCircle)
{
  for (const int count : { 124, 126, 128, 130, 1000 })
  {
    EXPECT_TRUE(batchesAreDelaunay({ onCircle(count, 1), { { 1e6, 3e6 } } }));
  }
}

/// The cavity includes finite and infinite triangles.
TEST(KernelBatches, APointJustOutsideAnEmptyArcTakesFiniteTrianglesToo)
{
  Points arc;
  for (int i = 0; i < 500; ++i)
  {
    const double angle = 3.141592653589793 * (0.01 + 0.98 * i / 499);
    arc.push_back({ std::cos(angle), std::sin(angle) });
  }
  EXPECT_TRUE(batchesAreDelaunay({ arc, { { 0, -0.3 } } }));
}

TEST(KernelBatches, PointsOutsideTheHullExtendIt)
{
  EXPECT_TRUE(batchesAreDelaunay({ triangle(), { { 5, 5 } }, { { -1, -1 } }, { { 2, -9 } } }));
}

TEST(KernelBatches, APointOnAHullEdgeSplitsIt)
{
  DelaunayKernel kernel;
  insert(kernel, triangle());
  insert(kernel, { { 1, 0 } });
  EXPECT_EQ(2U, finiteTriangles(kernel).size());
  EXPECT_TRUE(isDelaunay(kernel, together(triangle(), { { 1, 0 } })));
}

TEST(KernelBatches, PointsOnTheLineBeyondAHullEdgeLeaveTheEdge)
{
  for (const Point2 p : { Point2{ 7, 0 }, Point2{ -3, 0 }, Point2{ 0, 9 }, Point2{ 0, -2 },
         Point2{ 6, -2 }, Point2{ -2, 6 } })
  {
    EXPECT_TRUE(batchesAreDelaunay({ triangle(), { p } })) << p.x << " " << p.y;
  }
}

TEST(KernelBatches, APointOnAnInnerEdgeSplitsBothTriangles)
{
  EXPECT_TRUE(batchesAreDelaunay({ { { 0, 0 }, { 4, 1 }, { 4, 4 }, { 0, 3 } }, { { 2, 2 } } }));
}

/// Every insertion has co-circular and collinear vertices around it.
TEST(KernelBatches, ALatticeInAnyOrderIsTheSame)
{
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
  {
    const Points lattice = pointSet("lattice-shuffled", 100, seed);
    Points first(lattice.begin(), lattice.begin() + 30);
    EXPECT_TRUE(batchesAreDelaunay({ first, Points(lattice.begin() + 30, lattice.end()) }));
  }
}

/// Arithmetic that is exact for a lattice is not exact for the points that follow.
TEST(KernelBatches, PointsJustOffALatticeAreSeparatedFromIt)
{
  const Points lattice = pointSet("lattice-shuffled", 100);
  Points beside;
  for (std::size_t i = 0; i < lattice.size(); i += 3)
  {
    const double hair = std::ldexp(i % 2 ? 1.0 : -1.0, -52);
    beside.push_back({ lattice[i].x * (1 + hair), lattice[i].y * (1 - hair) });
  }
  EXPECT_TRUE(batchesAreDelaunay({ lattice, beside }));
}

TEST(KernelBatches, PointsAFractionOfAnUlpOffALineAreTriangulated)
{
  Points points;
  for (int i = 0; i < 200; ++i)
  {
    const double x = 1 + i * 0x1p-9;
    points.push_back({ x, i % 3 == 0 ? std::nextafter(x, 9) : x });
  }
  EXPECT_TRUE(batchesAreDelaunay({ points }));
}

TEST(KernelBatches, DuplicatesAreFoundIfDifferencesOverflow)
{
  const double most = 1.7e308;
  const Points corners{ { -most, -most }, { most, -most }, { most, most }, { -most, most } };
  DelaunayKernel kernel;
  insert(kernel, corners);
  insert(kernel, corners);
  EXPECT_EQ(4U, kernel.duplicates().size());
  EXPECT_EQ(6, kernel.mesh().end() / 8);
}

TEST(KernelBatches, ReservedMemoryIsEnoughForAllBatches)
{
  DelaunayKernel kernel;
  kernel.reserve(1000);
  const std::size_t bytes = kernel.bytes();
  insert(kernel, onCircle(600, 1));
  const HalfEdgeMesh::Index* const slots = kernel.mesh().slots();
  insert(kernel, moved(onCircle(400, 1), 0.5, 0));
  EXPECT_EQ(slots, kernel.mesh().slots());
  EXPECT_EQ(bytes, kernel.bytes());
}

} // namespace
