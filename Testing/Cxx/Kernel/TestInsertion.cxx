// SPDX-License-Identifier: BSD-3-Clause
// The instruction set changes only the speed of insertion, not the mesh.
#include "KernelTesting.h"

#include "Kernel/Cavity.h"

#include <algorithm>

namespace
{

using namespace tipp;
using namespace tipp::test;

std::vector<HalfEdgeMesh::Index> meshOf(const DelaunayKernel& kernel)
{
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

std::vector<HalfEdgeMesh::Index> meshOf(
  const std::vector<Point2>& points, Instructions allowed = Instructions::Best)
{
  DelaunayKernel kernel(allowed);
  insert(kernel, points);
  return meshOf(kernel);
}

/// Inserts both sets in turn, and compares the meshes with those of each alone.
void expectMeshesOfEachAlone(const std::vector<Point2>& one, const std::vector<Point2>& other)
{
  for (const Instructions allowed :
    { Instructions::Common, Instructions::Avx2, Instructions::Best })
  {
    DelaunayKernel first(allowed);
    DelaunayKernel second(allowed);
    DelaunayKernel::insertTwo(
      { first, one.data(), one.size() }, { second, other.data(), other.size() });
    EXPECT_EQ(meshOf(one), meshOf(first));
    EXPECT_EQ(meshOf(other), meshOf(second));
  }
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

TEST_P(InsertionTest, TwoKernelsInTurnMakeTheMeshesOfEachAlone)
{
  expectMeshesOfEachAlone(pointSet(GetParam(), 3000), pointSet("uniform", 2000));
  expectMeshesOfEachAlone(pointSet("clustered", 1000), pointSet(GetParam(), 3000));
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

TEST(Insertion, TwoKernelsInTurnMayHaveNoTriangles)
{
  const std::vector<Point2> line{ { 0, 0 }, { 1, 1 }, { 2, 2 } };
  expectMeshesOfEachAlone(line, pointSet("uniform", 100));
  expectMeshesOfEachAlone(pointSet("uniform", 100), line);
  expectMeshesOfEachAlone({}, line);
}

TEST(Insertion, TwoKernelsInTurnReportTheirOwnDuplicates)
{
  std::vector<Point2> points = pointSet("uniform", 500);
  const std::vector<Point2> copy = points;
  points.insert(points.end(), copy.begin(), copy.end());
  DelaunayKernel first;
  DelaunayKernel second;
  DelaunayKernel::insertTwo(
    { first, points.data(), points.size() }, { second, points.data(), 700 });
  EXPECT_EQ(500U, first.duplicates().size());
  EXPECT_EQ(200U, second.duplicates().size());
}

TEST(Insertion, AKernelTakesMorePointsAfterTwoInTurn)
{
  const std::vector<Point2> points = pointSet("uniform", 1000);
  DelaunayKernel first;
  DelaunayKernel second;
  DelaunayKernel::insertTwo({ first, points.data(), 800 }, { second, points.data(), 300 });
  first.insert(points.data() + 800, 200);
  EXPECT_TRUE(isDelaunay(first, points));
}

} // namespace
