// SPDX-License-Identifier: BSD-3-Clause
#include "KernelTesting.h"

#include "Kernel/KernelPredicates.h"

#include <cmath>
#include <limits>
#include <random>

namespace
{

using namespace tipp;
using namespace tipp::test;
using Index = HalfEdgeMesh::Index;

std::vector<Point2> withInfinite(const std::vector<Point2>& points)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<Point2> all{ { nan, nan } };
  all.insert(all.end(), points.begin(), points.end());
  return all;
}

/// The infinite triangle at the hull edge from vertex 2 = (4, 0) to vertex 1 = (0, 0). The hull is
/// above the edge.
class InfiniteTriangle : public testing::Test
{
public:
  bool conflicts(Point2 p)
  {
    bool first = true;
    bool result = false;
    // The result must not depend on which corner is the infinite vertex.
    for (const auto& corners : std::vector<std::array<Index, 3>>{
           { InfiniteVertex, 2, 1 }, { 1, InfiniteVertex, 2 }, { 2, 1, InfiniteVertex } })
    {
      const bool now = this->Predicates.isInConflict(corners.data(), p);
      EXPECT_TRUE(first || now == result);
      result = now;
      first = false;
    }
    return result;
  }

  std::vector<Point2> Points = withInfinite({ { 0, 0 }, { 4, 0 }, { 1, 3 } });
  KernelPredicates Predicates{ Points.data(), Points.size() };
};

TEST_F(InfiniteTriangle, HoldsTheHalfPlaneBeyondItsEdge)
{
  EXPECT_TRUE(this->conflicts({ 2, -1 }));
  EXPECT_TRUE(this->conflicts({ 1e9, -1e-300 }));
}

TEST_F(InfiniteTriangle, DoesNotHoldTheHullsSide)
{
  EXPECT_FALSE(this->conflicts({ 2, 1 }));
  EXPECT_FALSE(this->conflicts({ -1e9, 4.9406564584124654e-324 }));
}

TEST_F(InfiniteTriangle, HoldsItsOpenEdge)
{
  EXPECT_TRUE(this->conflicts({ 2, 0 }));
  EXPECT_TRUE(this->conflicts({ 4.9406564584124654e-324, 0 }));
}

TEST_F(InfiniteTriangle, DoesNotHoldItsEdgesEnds)
{
  EXPECT_FALSE(this->conflicts({ 0, 0 }));
  EXPECT_FALSE(this->conflicts({ 4, 0 }));
}

TEST_F(InfiniteTriangle, DoesNotHoldTheLineBeyondItsEdge)
{
  EXPECT_FALSE(this->conflicts({ 5, 0 }));
  EXPECT_FALSE(this->conflicts({ -1, 0 }));
}

TEST(KernelPredicates, AFiniteTrianglesDiskIsExactWithTiesBroken)
{
  const std::vector<Point2> points =
    withInfinite({ { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 }, { 0.5, std::nextafter(1.2, 2) } });
  KernelPredicates predicates(points.data(), points.size());
  const Index lower[] = { 1, 2, 3 };
  const Index other[] = { 2, 3, 4 };
  // Two triangles of a square: their circles pass through all four corners, so the tie rule
  // decides.
  EXPECT_EQ(inCirclePerturbed(points[1], points[2], points[3], points[4]),
    predicates.isInConflict(lower, points[4]));
  EXPECT_EQ(inCirclePerturbed(points[2], points[3], points[4], points[1]),
    predicates.isInConflict(other, points[1]));
  EXPECT_FALSE(predicates.isInConflict(lower, points[1]));
}

/// After some calls, the predicates look for faster arithmetic that is exact for these points.
TEST(KernelPredicates, TheThousandthTurnIsAsExactAsTheFirst)
{
  std::mt19937_64 random(3);
  std::vector<Point2> points;
  for (int i = 0; i < 1000; ++i)
  {
    const double x = 1 + double(random() % 1000) * 0x1p-52;
    points.push_back({ x, x + double(random() % 3) * 0x1p-52 });
  }
  points = withInfinite(points);
  KernelPredicates predicates(points.data(), points.size());
  for (Index i = 1; i + 2 < Index(points.size()); ++i)
  {
    const Point2 p = points[std::size_t(i + 2)];
    ASSERT_EQ(orientationExact(points[std::size_t(i)], points[std::size_t(i + 1)], p),
      predicates.orientation(i, i + 1, p));
  }
}

/// The new points are no multiples of the unit that the first points have.
TEST(KernelPredicates, PointsAddedLaterAreSeenAfterARestart)
{
  std::vector<Point2> points = withInfinite({ { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } });
  KernelPredicates predicates(points.data(), points.size());
  const Index corners[] = { 1, 2, 3 };
  predicates.isInConflict(corners, points[4]);
  for (int i = 0; i < 40; ++i)
  {
    predicates.orientation(1, 2, points[3]);
  }
  points.push_back({ 0x1p-60, 1 });
  points.push_back({ -0x1p-60, 1 });
  points.push_back({ 0x1p-60, 0x1p-60 });
  predicates.restart(points.data(), points.size());
  EXPECT_TRUE(predicates.isInConflict(corners, points[5]));
  EXPECT_FALSE(predicates.isInConflict(corners, points[6]));
  for (int i = 0; i < 40; ++i)
  {
    EXPECT_EQ(0, predicates.orientation(1, 3, points[7]));
    EXPECT_EQ(1, predicates.orientation(1, 2, points[7]));
  }
}

} // namespace
