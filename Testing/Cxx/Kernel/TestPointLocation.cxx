// SPDX-License-Identifier: BSD-3-Clause
#include "KernelTesting.h"

#include "Kernel/PointLocation.h"

#include <algorithm>

namespace
{

using namespace tipp;
using namespace tipp::test;
using Index = HalfEdgeMesh::Index;

/// A finished triangulation to walk in.
class PointLocation : public testing::TestWithParam<std::string>
{
public:
  PointLocation()
  {
    insert(this->Made, pointSet(GetParam(), 400));
    for (Index v = 0; v < this->Made.vertexEnd(); ++v)
    {
      this->Points.push_back(this->Made.point(v));
    }
    for (Index t = 0; t < this->Made.mesh().end(); t += 8 * 37)
    {
      if (!this->Made.isInfinite(t))
      {
        this->Starts.push_back(t);
      }
    }
  }

  /// The predicates know the point, as they do for one that is being inserted.
  Location find(Index start, Point2 p)
  {
    std::vector<Point2> points = this->Points;
    points.push_back(p);
    KernelPredicates predicates(points);
    return locate(this->Made.mesh(), points.data(), predicates, start, p);
  }

  Point2 corner(Index triangle, Index i) const
  {
    return this->Made.point(this->Made.mesh().vertex(triangle + i));
  }

  bool holds(Index triangle, Point2 p) const
  {
    bool inside = true;
    for (Index i = 0; i < 3; ++i)
    {
      inside = inside &&
        orientation(this->corner(triangle, i), this->corner(triangle, (i + 1) % 3), p) >= 0;
    }
    return inside;
  }

  DelaunayKernel Made;
  std::vector<Point2> Points;
  std::vector<Index> Starts;
};

TEST_P(PointLocation, APointInsideIsFoundFromAnywhere)
{
  ASSERT_LT(3U, this->Starts.size());
  for (const Index target : this->Starts)
  {
    const Point2 a = this->corner(target, 0);
    const Point2 b = this->corner(target, 1);
    const Point2 c = this->corner(target, 2);
    const Point2 p{ (a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3 };
    for (const Index start : this->Starts)
    {
      const Location at = this->find(start, p);
      ASSERT_FALSE(this->Made.isInfinite(at.Triangle));
      ASSERT_TRUE(this->holds(at.Triangle, p));
    }
  }
}

TEST_P(PointLocation, AVertexIsACornerOfTheTriangleFound)
{
  for (std::size_t v = 1; v < this->Points.size(); v += 23)
  {
    for (const Index start : this->Starts)
    {
      const Location at = this->find(start, this->Points[v]);
      ASSERT_TRUE(std::any_of(
        at.Corner, at.Corner + 3, [](const Direction& d) { return d.X == 0 && d.Y == 0; }));
    }
  }
}

TEST_P(PointLocation, AMidpointOfAnEdgeIsFoundInAClosedTriangle)
{
  for (const Index target : this->Starts)
  {
    const Point2 a = this->corner(target, 0);
    const Point2 b = this->corner(target, 1);
    const Point2 p{ (a.x + b.x) / 2, (a.y + b.y) / 2 };
    const Location at = this->find(this->Starts.back(), p);
    if (!this->Made.isInfinite(at.Triangle))
    {
      EXPECT_TRUE(this->holds(at.Triangle, p));
    }
    else
    {
      // Rounding may bring the middle of a hull edge outside.
      EXPECT_FALSE(this->holds(target, p));
    }
  }
}

TEST_P(PointLocation, APointOutsideEndsAtAHullEdgeItLiesBeyond)
{
  for (const Point2 p : { Point2{ 1e7, 3e6 }, Point2{ -1e7, 2e6 }, Point2{ 50, -1e7 } })
  {
    for (const Index start : this->Starts)
    {
      const Location at = this->find(start, p);
      ASSERT_TRUE(this->Made.isInfinite(at.Triangle));
      std::vector<Point2> points = this->Points;
      points.push_back(p);
      KernelPredicates predicates(points);
      ASSERT_TRUE(predicates.isInConflict(this->Made.mesh().slots() + at.Triangle, p));
    }
  }
}

TEST_P(PointLocation, CornersEdgesAndNeighboursGoTogether)
{
  const Point2 a = this->corner(this->Starts[1], 0);
  const Point2 b = this->corner(this->Starts[1], 1);
  const Point2 c = this->corner(this->Starts[1], 2);
  const Point2 p{ (a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3 };
  const HalfEdgeMesh& mesh = this->Made.mesh();
  for (const Index start : this->Starts)
  {
    const Location at = this->find(start, p);
    for (std::size_t i = 0; i < 3; ++i)
    {
      // Behind edge i, from corner i to the next, lies the triangle with that edge reversed.
      const Direction& from = at.Corner[i];
      const Direction& to = at.Corner[(i + 1) % 3];
      const Point2 begin = this->Made.point(mesh.vertex(HalfEdgeMesh::previous(at.Outer[i])));
      const Point2 end = this->Made.point(mesh.vertex(HalfEdgeMesh::next(at.Outer[i])));
      ASSERT_EQ(HalfEdgeMesh::triangleOf(mesh.twin(at.Outer[i])), at.Triangle);
      EXPECT_EQ(begin.x - p.x, from.X);
      EXPECT_EQ(begin.y - p.y, from.Y);
      EXPECT_EQ(end.x - p.x, to.X);
      EXPECT_EQ(end.y - p.y, to.Y);
      EXPECT_DOUBLE_EQ(from.X * to.Y - from.Y * to.X, at.Cross[i]);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(PointSets, PointLocation,
  testing::Values("uniform", "lattice-shuffled", "clustered", "survey-lines"),
  [](const auto& info)
  {
    std::string name = info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
  });

} // namespace
