// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/ExactPredicates.h"

#include "NearDegenerate.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <gtest/gtest.h>

#include <set>
#include <utility>

namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel>;
using Points = NearDegenerate::Points;

bool distinctTriangle(Points& q)
{
  const int turn = tipp::orientation(q[0], q[1], q[2]);
  if (turn < 0)
  {
    std::swap(q[0], q[1]);
  }
  return turn != 0 && !(q[3] == q[0]) && !(q[3] == q[1]) && !(q[3] == q[2]);
}

bool insideForCgal(const Points& q)
{
  const auto point = [](tipp::Point2 p) { return Kernel::Point_2(p.x, p.y); };
  return Delaunay().side_of_oriented_circle(
           point(q[0]), point(q[1]), point(q[2]), point(q[3]), true) == CGAL::ON_POSITIVE_SIDE;
}

} // namespace

TEST(TieRule, AgreesWithCgalOnALattice)
{
  NearDegenerate draw(1);
  int ties[2] = { 0, 0 };
  for (int i = 0; i < 100000; ++i)
  {
    Points q = draw.lattice(5, 1.0, { -2, -2 });
    if (!distinctTriangle(q))
    {
      continue;
    }
    const bool expected = insideForCgal(q);
    ASSERT_EQ(expected, tipp::inCirclePerturbed(q[0], q[1], q[2], q[3]))
      << testing::PrintToString(q);
    if (tipp::inCircle(q[0], q[1], q[2], q[3]) == 0)
    {
      ASSERT_EQ(expected, tipp::tieIsInside(q[0], q[1], q[2], q[3])) << testing::PrintToString(q);
      ++ties[expected ? 1 : 0];
    }
  }
  EXPECT_GT(ties[0], 1000);
  EXPECT_GT(ties[1], 1000);
}

TEST(TieRule, AgreesWithCgalOnCircles)
{
  NearDegenerate draw(2);
  for (int i = 0; i < 50000; ++i)
  {
    Points q = draw.cocircular(0.25, { 1, -3 });
    if (distinctTriangle(q))
    {
      ASSERT_EQ(insideForCgal(q), tipp::inCirclePerturbed(q[0], q[1], q[2], q[3]))
        << testing::PrintToString(q);
    }
  }
}

TEST(TieRule, OneDiagonalWinsFromBothSides)
{
  // In a square a, b, c, d, d must be inside the circle of a, b, c exactly if b is inside that of
  // c, d, a. Otherwise flipping would never end.
  NearDegenerate draw(3);
  for (int i = 0; i < 1000; ++i)
  {
    const double x = draw.integer(-5, 5);
    const double y = draw.integer(-5, 5);
    const double w = draw.integer(1, 5);
    const double h = draw.integer(1, 5);
    const tipp::Point2 a{ x, y };
    const tipp::Point2 b{ x + w, y };
    const tipp::Point2 c{ x + w, y + h };
    const tipp::Point2 d{ x, y + h };
    EXPECT_EQ(tipp::tieIsInside(a, b, c, d), tipp::tieIsInside(c, d, a, b));
    EXPECT_NE(tipp::tieIsInside(a, b, c, d), tipp::tieIsInside(b, c, d, a));
  }
}

TEST(TieRule, ACornerOfTheTriangleIsOutside)
{
  const tipp::Point2 a{ 0, 0 };
  const tipp::Point2 b{ 1, 0 };
  const tipp::Point2 c{ 1, 1 };
  EXPECT_FALSE(tipp::inCirclePerturbed(a, b, c, a));
  EXPECT_FALSE(tipp::inCirclePerturbed(a, b, c, b));
  EXPECT_FALSE(tipp::inCirclePerturbed(a, b, c, c));
}
