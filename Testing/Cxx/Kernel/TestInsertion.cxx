// SPDX-License-Identifier: BSD-3-Clause
// The instruction set changes only the speed of insertion, not the mesh.
#include "KernelTesting.h"

#include "Kernel/Cavity.h"

#include <algorithm>

namespace
{

using namespace tipp;
using namespace tipp::test;

std::vector<HalfEdgeMesh::Index> meshOf(const std::vector<Point2>& points, Instructions allowed)
{
  DelaunayKernel kernel(allowed);
  insert(kernel, points);
  const HalfEdgeMesh& mesh = kernel.mesh();
  std::vector<HalfEdgeMesh::Index> slots;
  for (HalfEdgeMesh::Index t = 0; t < mesh.end(); t += 8)
  {
    for (HalfEdgeMesh::Index i = 0; i < 3; ++i)
    {
      slots.insert(slots.end(), { mesh.vertex(t + i), mesh.twin(t + i) });
    }
  }
  return slots;
}

class InsertionTest : public testing::TestWithParam<const char*>
{
};

TEST_P(InsertionTest, InstructionsDoNotChangeTheMesh)
{
  const std::vector<Point2> points = pointSet(GetParam(), 3000);
  const std::vector<HalfEdgeMesh::Index> common = meshOf(points, Instructions::Common);
  ASSERT_LT(0U, common.size());
  EXPECT_EQ(common, meshOf(points, Instructions::Avx2));
  EXPECT_EQ(common, meshOf(points, Instructions::Best));
}

INSTANTIATE_TEST_SUITE_P(PointSets, InsertionTest,
  testing::Values("uniform", "clustered", "lattice", "circle", "parabola", "collinear-and-one"));

TEST(Insertion, CommonInstructionsGiveTheDelaunayTriangulation)
{
  DelaunayKernel kernel(Instructions::Common);
  const std::vector<Point2> points = pointSet("lattice-jittered", 2500);
  insert(kernel, points);
  EXPECT_TRUE(isDelaunay(kernel, points));
}

TEST(Insertion, DuplicatesAreReportedWithAllInstructions)
{
  std::vector<Point2> points = pointSet("uniform", 500);
  const std::vector<Point2> copy = points;
  points.insert(points.end(), copy.begin(), copy.end());
  for (const Instructions allowed :
    { Instructions::Common, Instructions::Avx2, Instructions::Best })
  {
    DelaunayKernel kernel(allowed);
    insert(kernel, points);
    EXPECT_EQ(500U, kernel.duplicates().size());
    EXPECT_TRUE(isDelaunay(kernel, points));
  }
}

} // namespace
