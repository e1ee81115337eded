// SPDX-License-Identifier: BSD-3-Clause
// The checker finds each kind of error.
#include "PointsInSpace.h"

#include "Check/DelaunayChecker.h"
#include "InMemory/TriangulatePoints.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace
{

using namespace tipp;
using namespace tipp::test;

class TetrahedraCheckerTest : public testing::Test
{
protected:
  TetrahedraCheckerTest()
    : Points(pointsInSpace("lattice", 125))
    , Mesh(tetrahedralize(this->Points.data(), this->Points.size()))
    , XYZ(coordinatesOf(this->Points))
    , Ids(idsOf(this->Mesh))
  {
  }

  CheckReport check() const { return checkTetrahedra(this->XYZ, this->Ids, true); }

  std::vector<Point3> Points;
  Tetrahedralization Mesh;
  std::vector<double> XYZ;
  std::vector<std::int64_t> Ids;
};

} // namespace

TEST_F(TetrahedraCheckerTest, AcceptsATriangulation)
{
  const CheckReport report = this->check();
  EXPECT_TRUE(report.isCorrect());
  EXPECT_EQ(125, report.DistinctPoints);
  EXPECT_GT(report.Ties, 0);
}

TEST_F(TetrahedraCheckerTest, FindsAnInvertedTetrahedron)
{
  std::swap(this->Ids[0], this->Ids[1]);
  EXPECT_EQ(1, this->check().BadTurns);
}

TEST_F(TetrahedraCheckerTest, FindsAMissingTetrahedron)
{
  this->Ids.resize(this->Ids.size() - 4);
  const CheckReport report = this->check();
  EXPECT_GT(report.BadHullEdges + report.EulerMismatch, 0);
}

TEST_F(TetrahedraCheckerTest, FindsARepeatedTetrahedron)
{
  for (int i = 0; i < 4; ++i)
  {
    this->Ids.push_back(this->Ids[std::size_t(i)]);
  }
  EXPECT_GT(this->check().BadFacets, 0);
}

TEST_F(TetrahedraCheckerTest, FindsAnInvalidPointId)
{
  this->Ids[5] = 125;
  EXPECT_EQ(1, this->check().BadIds);
}

TEST_F(TetrahedraCheckerTest, FindsAPointThatIsNoVertex)
{
  this->XYZ.insert(this->XYZ.end(), { 0.5, 0.5, 0.25 });
  EXPECT_EQ(1, this->check().UnusedPoints);
}

TEST_F(TetrahedraCheckerTest, FindsAPointInsideASphere)
{
  // The eight corners of a cube are on a common sphere. After a corner has moved slightly inwards,
  // it is inside of some spheres.
  const Point3 middle{ 2, 2, 2 };
  const auto found = std::find(this->Points.begin(), this->Points.end(), middle);
  this->XYZ[3 * std::size_t(found - this->Points.begin())] += 0.01;
  const CheckReport report = this->check();
  EXPECT_GT(report.BadSpheres, 0);
  EXPECT_EQ(0, report.BadTurns);
}

TEST_F(TetrahedraCheckerTest, FindsTiesThatBreakTheTieRule)
{
  // Mirroring maps the lattice to itself, but not the tie rule.
  for (std::size_t i = 0; i < this->XYZ.size(); i += 3)
  {
    this->XYZ[i] = 4 - this->XYZ[i];
  }
  for (std::size_t i = 0; i < this->Ids.size(); i += 4)
  {
    std::swap(this->Ids[i], this->Ids[i + 1]);
  }
  EXPECT_TRUE(checkTetrahedra(this->XYZ, this->Ids, false).isCorrect());
  EXPECT_GT(this->check().BadTies, 0);
}

TEST_F(TetrahedraCheckerTest, ChecksNeighbours)
{
  const auto found = neighborIds(this->Mesh);
  std::vector<std::int64_t> neighbors(found.begin(), found.end());
  EXPECT_TRUE(checkTetrahedra(this->XYZ, this->Ids, true, neighbors).isCorrect());
  std::swap(neighbors[0], neighbors[1]);
  EXPECT_EQ(2, checkTetrahedra(this->XYZ, this->Ids, true, neighbors).BadNeighbors);
}

TEST_F(TetrahedraCheckerTest, PointsInAPlaneNeedNoTetrahedra)
{
  EXPECT_TRUE(checkTetrahedra({ 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1 }, {}, true).isCorrect());
  EXPECT_EQ(4, checkTetrahedra({ 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 0 }, {}, true).UnusedPoints);
}
