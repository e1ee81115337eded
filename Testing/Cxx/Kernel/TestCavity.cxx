// SPDX-License-Identifier: BSD-3-Clause
// Each insertion of a point is checked against the circumdisks of all triangles.
#include "KernelTesting.h"

#include "Kernel/Cavity.h"
#include "Kernel/PointLocation.h"

#include <algorithm>

namespace
{

using namespace tipp;
using namespace tipp::test;
using Index = HalfEdgeMesh::Index;

/// A copy of a finished triangulation, into which one more point is inserted as the last vertex.
class CavityTest : public testing::TestWithParam<const char*>
{
public:
  void prepare(Point2 p)
  {
    DelaunayKernel made;
    insert(made, pointSet(GetParam(), 300));
    this->Points.clear();
    for (Index v = 0; v < made.vertexEnd(); ++v)
    {
      this->Points.push_back(made.point(v));
    }
    this->Points.push_back(p);
    const std::size_t triangles = std::size_t(made.mesh().end()) / 8;
    this->Mesh.clear();
    this->Mesh.reserve(triangles + 3);
    std::copy_n(made.mesh().slots(), 8 * triangles, this->Mesh.slots());
    this->Mesh.setEnd(made.mesh().end());
    this->Start = 0;
    while (made.isInfinite(this->Start))
    {
      this->Start += 8;
    }
  }

  using Corners = std::array<Index, 3>; // rotated so that the lowest vertex is first

  Corners corners(Index t) const
  {
    Corners c{ this->Mesh.vertex(t), this->Mesh.vertex(t + 1), this->Mesh.vertex(t + 2) };
    std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
    return c;
  }

  std::vector<Corners> all() const
  {
    std::vector<Corners> triangles;
    for (Index t = 0; t < this->Mesh.end(); t += 8)
    {
      triangles.push_back(this->corners(t));
    }
    std::sort(triangles.begin(), triangles.end());
    return triangles;
  }

  void insertLast()
  {
    KernelPredicates predicates(this->Points.data(), this->Points.size());
    const Point2 p = this->Points.back();
    const Location found =
      PointLocation(this->Mesh, this->Points.data(), predicates).from(pairAt(&p.x), this->Start);
    Cavity cavity;
    this->Returned = cavity.retriangulate(
      this->Mesh, this->Points.data(), predicates, found, Index(this->Points.size() - 1));
  }

  HalfEdgeMesh Mesh;
  std::vector<Point2> Points;
  Index Start = 0;
  Index Returned = 0;
};

const Point2 Places[] = { { 0.4, 0.6 }, { 3.25, 7.5 }, { 12, 8.5 }, { -1e4, 20 }, { 0.5, 1e6 } };

TEST_P(CavityTest, DestroysExactlyTheTrianglesInConflict)
{
  for (const Point2 p : Places)
  {
    this->prepare(p);
    KernelPredicates predicates(this->Points.data(), this->Points.size());
    std::vector<Corners> expected;
    for (Index t = 0; t < this->Mesh.end(); t += 8)
    {
      if (!predicates.isInConflict(this->Mesh.slots() + t, p))
      {
        expected.push_back(this->corners(t));
      }
    }
    std::sort(expected.begin(), expected.end());
    this->insertLast();
    std::vector<Corners> kept = this->all();
    const Index last = Index(this->Points.size() - 1);
    kept.erase(std::remove_if(kept.begin(), kept.end(),
                 [last](const Corners& c) { return std::count(c.begin(), c.end(), last) > 0; }),
      kept.end());
    EXPECT_EQ(expected, kept);
  }
}

TEST_P(CavityTest, LeavesEveryHalfEdgeWithItsTwin)
{
  for (const Point2 p : Places)
  {
    this->prepare(p);
    const Index before = this->Mesh.end();
    this->insertLast();
    ASSERT_EQ(before + 16, this->Mesh.end());
    for (Index t = 0; t < this->Mesh.end(); t += 8)
    {
      for (Index h = t; h < t + 3; ++h)
      {
        const Index g = this->Mesh.twin(h);
        ASSERT_EQ(h, this->Mesh.twin(g));
        ASSERT_EQ(this->Mesh.twin(nextOf(h)), HalfEdgeMesh::twinOfNext(this->Mesh.slots(), h));
        ASSERT_EQ(
          this->Mesh.twin(previousOf(h)), HalfEdgeMesh::twinOfPrevious(this->Mesh.slots(), h));
        ASSERT_EQ(this->Mesh.vertex(nextOf(h)), this->Mesh.vertex(previousOf(g)));
        ASSERT_EQ(this->Mesh.vertex(previousOf(h)), this->Mesh.vertex(nextOf(g)));
      }
    }
  }
}

TEST_P(CavityTest, ReturnsAFiniteTriangleAtTheVertex)
{
  for (const Point2 p : Places)
  {
    this->prepare(p);
    this->insertLast();
    const Corners c = this->corners(this->Returned);
    EXPECT_NE(InfiniteVertex, c[0]);
    EXPECT_EQ(1, std::count(c.begin(), c.end(), Index(this->Points.size() - 1)));
  }
}

INSTANTIATE_TEST_SUITE_P(
  PointSets, CavityTest, testing::Values("uniform", "lattice-shuffled", "cocircular"));

// All triangles of points on a circle conflict with the circle's centre. This is more than a cavity
// has space for at first.
TEST(Cavity, GrowsAsLargeAsNeeded)
{
  constexpr std::size_t count = 500;
  std::vector<Point2> points = pointSet("circle", count);
  Point2 low = points[0];
  Point2 high = points[0];
  for (const Point2 p : points)
  {
    low = { std::min(low.x, p.x), std::min(low.y, p.y) };
    high = { std::max(high.x, p.x), std::max(high.y, p.y) };
  }
  const Point2 centre{ (low.x + high.x) / 2, (low.y + high.y) / 2 };
  DelaunayKernel kernel;
  insert(kernel, points);
  insert(kernel, { centre });
  std::size_t atCentre = 0;
  for (const auto& triangle : finiteTriangles(kernel))
  {
    atCentre += std::count(triangle.begin(), triangle.end(), std::int64_t(count));
  }
  EXPECT_LT(400U, atCentre);
  points.push_back(centre);
  EXPECT_TRUE(isDelaunay(kernel, points));
}

} // namespace
