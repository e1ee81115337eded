// SPDX-License-Identifier: BSD-3-Clause
#include "KernelTesting.h"

#include "Kernel/PointLocation.h"

#include <algorithm>

namespace
{

using namespace tipp;
using namespace tipp::test;
using Index = HalfEdgeMesh::Index;

/// A finished triangulation, in which points are located.
class PointLocationTest : public testing::TestWithParam<std::string>
{
public:
  PointLocationTest()
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

  /// Locates p. The predicates include p among their points, as during an insertion.
  Location find(Index start, Point2 p)
  {
    std::vector<Point2> points = this->Points;
    points.push_back(p);
    KernelPredicates predicates(points.data(), points.size());
    return PointLocation(this->Made.mesh(), points.data(), predicates).from(pairAt(&p.x), start);
  }

  Point2 corner(Index triangle, Index i) const
  {
    return this->Made.point(this->Made.mesh().vertex(triangle + i));
  }

  Point2 middle(Index triangle) const
  {
    const Point2 a = this->corner(triangle, 0);
    const Point2 b = this->corner(triangle, 1);
    const Point2 c = this->corner(triangle, 2);
    return { (a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3 };
  }

  bool isInConflict(Index triangle, Point2 p) const
  {
    std::vector<Point2> points = this->Points;
    points.push_back(p);
    return KernelPredicates(points.data(), points.size())
      .isInConflict(this->Made.mesh().slots() + triangle, p);
  }

  DelaunayKernel Made;
  std::vector<Point2> Points;
  std::vector<Index> Starts;
};

TEST_P(PointLocationTest, ATriangleInConflictIsFoundFromAnywhere)
{
  ASSERT_LT(3U, this->Starts.size());
  for (const Index target : this->Starts)
  {
    const Point2 p = this->middle(target);
    for (const Index start : this->Starts)
    {
      const Location at = this->find(start, p);
      ASSERT_EQ(InfiniteVertex, at.EqualTo);
      ASSERT_TRUE(this->isInConflict(at.Triangle, p));
    }
  }
}

TEST_P(PointLocationTest, AVertexAtThePointIsFound)
{
  for (std::size_t v = 1; v < this->Points.size(); v += 23)
  {
    for (const Index start : this->Starts)
    {
      ASSERT_EQ(Index(v), this->find(start, this->Points[v]).EqualTo);
    }
  }
}

TEST_P(PointLocationTest, AMidpointOfAnEdgeIsInConflictWithTheTriangleFound)
{
  for (const Index target : this->Starts)
  {
    const Point2 a = this->corner(target, 0);
    const Point2 b = this->corner(target, 1);
    const Point2 p{ (a.x + b.x) / 2, (a.y + b.y) / 2 };
    const Location at = this->find(this->Starts.back(), p);
    if (at.EqualTo == InfiniteVertex)
    {
      EXPECT_TRUE(this->isInConflict(at.Triangle, p));
    }
    else
    {
      EXPECT_EQ(p, this->Points[std::size_t(at.EqualTo)]); // a midpoint in a lattice
    }
  }
}

TEST_P(PointLocationTest, APointOutsideIsInConflictWithTheTriangleFound)
{
  for (const Point2 p : { Point2{ 1e7, 3e6 }, Point2{ -1e7, 2e6 }, Point2{ 50, -1e7 } })
  {
    for (const Index start : this->Starts)
    {
      ASSERT_TRUE(this->isInConflict(this->find(start, p).Triangle, p));
    }
  }
}

TEST_P(PointLocationTest, TheLastVisitedTriangleIsNotInConflict)
{
  std::size_t walked = 0;
  for (const Index target : this->Starts)
  {
    const Point2 p = this->middle(target);
    for (const Index start : this->Starts)
    {
      const Location at = this->find(start, p);
      if (at.LastIsOutside)
      {
        ++walked;
        ASSERT_FALSE(this->isInConflict(HalfEdgeMesh::triangleOf(at.LastOuter), p));
      }
    }
  }
  EXPECT_LT(0U, walked);
}

TEST_P(PointLocationTest, CornersEdgesAndNeighboursMatch)
{
  const Point2 p = this->middle(this->Starts[1]);
  const HalfEdgeMesh& mesh = this->Made.mesh();
  for (const Index start : this->Starts)
  {
    const Location at = this->find(start, p);
    const EdgePair& e = at.Edges;
    const Index corners[] = { e.Start, e.Middle, e.Stop };
    const Point2 seen[] = { { e.StartX[0], e.StartY[0] }, { e.StartX[1], e.StartY[1] },
      { e.StopX[1], e.StopY[1] } };
    const double crosses[] = { e.Cross[0], e.Cross[1], at.LastCross };
    const Index outers[] = { e.FirstOuter, e.SecondOuter, at.LastOuter };
    EXPECT_EQ(e.StartX[1], e.StopX[0]);
    EXPECT_EQ(e.StartY[1], e.StopY[0]);
    for (std::size_t i = 0; i < 3; ++i)
    {
      // The edge from corner i to the next one, reversed, belongs to the neighbour behind it.
      const std::size_t next = (i + 1) % 3;
      ASSERT_EQ(HalfEdgeMesh::triangleOf(mesh.twin(outers[i])), at.Triangle);
      ASSERT_EQ(mesh.vertex(previousOf(outers[i])), corners[i]);
      ASSERT_EQ(mesh.vertex(nextOf(outers[i])), corners[next]);
      EXPECT_EQ(p.x - this->Made.point(corners[i]).x, seen[i].x);
      EXPECT_EQ(p.y - this->Made.point(corners[i]).y, seen[i].y);
      EXPECT_DOUBLE_EQ(seen[i].x * seen[next].y - seen[i].y * seen[next].x, crosses[i]);
    }
    for (std::size_t i = 0; i < 2; ++i)
    {
      EXPECT_DOUBLE_EQ(seen[i].x * seen[i].x + seen[i].y * seen[i].y, e.StartLift[i]);
      EXPECT_DOUBLE_EQ(
        seen[i + 1].x * seen[i + 1].x + seen[i + 1].y * seen[i + 1].y, e.StopLift[i]);
    }
  }
}

TEST_P(PointLocationTest, TheClosingEdgeIsTheThird)
{
  const Point2 p = this->middle(this->Starts[2]);
  for (const Index start : this->Starts)
  {
    const Location at = this->find(start, p);
    const EdgePair closing = at.Edges.closing(at.LastCross, at.LastOuter);
    EXPECT_EQ(at.Edges.Stop, closing.Start);
    EXPECT_EQ(at.Edges.Start, closing.Middle);
    EXPECT_EQ(at.LastOuter, closing.FirstOuter);
    EXPECT_EQ(at.Edges.StopX[1], closing.StartX[0]);
    EXPECT_EQ(at.Edges.StopY[1], closing.StartY[0]);
    EXPECT_EQ(at.Edges.StopLift[1], closing.StartLift[0]);
    EXPECT_EQ(at.Edges.StartX[0], closing.StopX[0]);
    EXPECT_EQ(at.Edges.StartY[0], closing.StopY[0]);
    EXPECT_EQ(at.Edges.StartLift[0], closing.StopLift[0]);
    EXPECT_EQ(at.LastCross, closing.Cross[0]);
  }
}

INSTANTIATE_TEST_SUITE_P(PointSets, PointLocationTest,
  testing::Values("uniform", "lattice-shuffled", "clustered", "survey-lines"),
  [](const auto& info)
  {
    std::string name = info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
  });

} // namespace
