// SPDX-License-Identifier: BSD-3-Clause
// Properties of every triangulation by the kernel, checked for many kinds of point sets.
#include "KernelTesting.h"

#include <algorithm>
#include <cmath>

namespace
{

using namespace tipp;
using namespace tipp::test;
using Index = DelaunayKernel::Index;

class Kernel : public testing::TestWithParam<std::string>
{
public:
  Kernel()
    : Points(pointSet(GetParam(), 1500))
  {
    insert(this->Made, this->Points);
  }

  Index vertexCount() const
  {
    return this->Made.vertexEnd() - 1 - static_cast<Index>(this->Made.duplicates().size());
  }

  std::vector<Point2> Points;
  DelaunayKernel Made;
};

TEST_P(Kernel, ATwinsTwinIsTheHalfEdgeItself)
{
  const HalfEdgeMesh& mesh = this->Made.mesh();
  ASSERT_LT(0, mesh.end());
  for (Index t = 0; t < mesh.end(); t += 8)
  {
    for (Index h = t; h < t + 3; ++h)
    {
      ASSERT_NE(h, mesh.twin(h));
      ASSERT_EQ(h, mesh.twin(mesh.twin(h)));
    }
  }
}

TEST_P(Kernel, TwinsHaveTheSameVerticesInReverseOrder)
{
  const HalfEdgeMesh& mesh = this->Made.mesh();
  for (Index t = 0; t < mesh.end(); t += 8)
  {
    for (Index h = t; h < t + 3; ++h)
    {
      const Index g = mesh.twin(h);
      ASSERT_EQ(mesh.vertex(nextOf(h)), mesh.vertex(previousOf(g)));
      ASSERT_EQ(mesh.vertex(previousOf(h)), mesh.vertex(nextOf(g)));
    }
  }
}

/// Euler's formula for a sphere whose vertices are the n points and the infinite one.
TEST_P(Kernel, TheNumberOfTrianglesFollowsEuler)
{
  EXPECT_EQ(2 * this->vertexCount() - 2, this->Made.mesh().end() / 8);
}

TEST_P(Kernel, FiniteTrianglesAreCounterClockwise)
{
  const HalfEdgeMesh& mesh = this->Made.mesh();
  for (Index t = 0; t < mesh.end(); t += 8)
  {
    if (!this->Made.isInfinite(t))
    {
      ASSERT_EQ(1,
        orientation(this->Made.point(mesh.vertex(t)), this->Made.point(mesh.vertex(t + 1)),
          this->Made.point(mesh.vertex(t + 2))));
    }
  }
}

/// A triangulation is Delaunay if it is so at each edge.
TEST_P(Kernel, NoNeighboursApexIsInATrianglesDisk)
{
  const HalfEdgeMesh& mesh = this->Made.mesh();
  for (Index t = 0; t < mesh.end(); t += 8)
  {
    for (Index h = t; h < t + 3 && !this->Made.isInfinite(t); ++h)
    {
      const Index apex = mesh.vertex(mesh.twin(h));
      ASSERT_TRUE(apex == DelaunayKernel::Infinite ||
        !inCirclePerturbed(this->Made.point(mesh.vertex(t)), this->Made.point(mesh.vertex(t + 1)),
          this->Made.point(mesh.vertex(t + 2)), this->Made.point(apex)));
    }
  }
}

/// A vertex beyond the hull edge (u, w) would be visible from the infinite vertex.
TEST_P(Kernel, NoVertexLiesBeyondAHullEdge)
{
  const HalfEdgeMesh& mesh = this->Made.mesh();
  for (Index t = 0; t < mesh.end(); t += 8)
  {
    for (Index h = t; h < t + 3; ++h)
    {
      if (mesh.vertex(h) == DelaunayKernel::Infinite)
      {
        const Point2 u = this->Made.point(mesh.vertex(nextOf(h)));
        const Point2 w = this->Made.point(mesh.vertex(previousOf(h)));
        ASSERT_TRUE(std::none_of(this->Points.begin(), this->Points.end(),
          [&](Point2 p) { return orientation(u, w, p) > 0; }));
      }
    }
  }
}

TEST_P(Kernel, TheTrianglesAreCgals)
{
  EXPECT_TRUE(isDelaunay(this->Made, this->Points));
}

TEST_P(Kernel, AClearedKernelMakesTheSameTrianglesInTheSameOrder)
{
  DelaunayKernel used;
  insert(used, pointSet("spiral", 3000));
  used.clear();
  insert(used, this->Points);
  ASSERT_EQ(this->Made.mesh().end(), used.mesh().end());
  for (Index t = 0; t < used.mesh().end(); t += 8)
  {
    for (Index h = t; h < t + 3; ++h)
    {
      ASSERT_EQ(this->Made.mesh().vertex(h), used.mesh().vertex(h));
      ASSERT_EQ(this->Made.mesh().twin(h), used.mesh().twin(h));
      ASSERT_EQ(
        this->Made.pointIndex(this->Made.mesh().vertex(h)), used.pointIndex(used.mesh().vertex(h)));
    }
  }
  EXPECT_EQ(representatives(this->Made), representatives(used));
}

INSTANTIATE_TEST_SUITE_P(PointSets, Kernel,
  testing::Values("uniform", "clustered", "kuzmin", "lattice-shuffled", "lattice-tenths",
    "lattice-jittered", "cocircular", "collinear-and-one", "survey-lines", "duplicates",
    "duplicate-lattice", "steps-at-1e12", "one-far-away", "two-clusters", "parabola", "spiral",
    "sorted"),
  [](const auto& info)
  {
    std::string name = info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
  });

} // namespace
