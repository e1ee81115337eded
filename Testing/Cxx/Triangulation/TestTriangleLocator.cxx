// SPDX-License-Identifier: BSD-3-Clause
#include "Arrays/FindNeighbors.h"
#include "Triangulation/TriangleLocator.h"
#include "Triangulation/Triangulate.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace
{

using namespace tipp;

/// Random points, or points of a lattice, where a point may lie on an edge.
class TriangleLocatorTest : public testing::TestWithParam<bool>
{
public:
  TriangleLocatorTest()
  {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> anywhere(0, 20);
    std::uniform_int_distribution<int> onLattice(0, 20);
    for (int i = 0; i < 1000; ++i)
    {
      this->XY.push_back(GetParam() ? double(onLattice(random)) : anywhere(random));
    }
    this->Mesh = triangulate(this->points());
    this->Neighbors.resize(this->Mesh.Ids32.size());
    findNeighbors(this->Mesh.Ids32.data(), this->Mesh.triangleCount(), this->Neighbors.data());
  }

  PointsView points() const { return { this->XY.data(), this->XY.size() / 2, 2 }; }

  TriangleLocator locator() const
  {
    return { this->points(), this->Mesh.Ids32.data(), this->Neighbors.data(),
      this->Mesh.triangleCount() };
  }

  Point2 corner(std::int64_t triangle, int i) const
  {
    return this->points()[std::size_t(this->Mesh.Ids32[std::size_t(3 * triangle + i)])];
  }

  std::vector<double> XY;
  Triangulation Mesh;
  std::vector<std::int32_t> Neighbors;
};

} // namespace

TEST_P(TriangleLocatorTest, FindsTheTriangleOfEachCentre)
{
  const auto locator = this->locator();
  for (std::int64_t t = 0; t < std::int64_t(this->Mesh.triangleCount()); ++t)
  {
    const Point2 a = this->corner(t, 0);
    const Point2 b = this->corner(t, 1);
    const Point2 c = this->corner(t, 2);
    EXPECT_EQ(t, locator.find({ (a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3 }));
  }
}

TEST_P(TriangleLocatorTest, FindsATriangleAtEachPointAndItsWeights)
{
  const auto locator = this->locator();
  for (std::size_t i = 0; i < this->points().size(); ++i)
  {
    const Point2 p = this->points()[i];
    const std::int64_t triangle = locator.find(p);
    ASSERT_GE(triangle, 0);
    double weights[3];
    locator.weights(triangle, p, weights);
    for (int corner = 0; corner < 3; ++corner)
    {
      const Point2 q = this->corner(triangle, corner);
      EXPECT_EQ(q.x == p.x && q.y == p.y ? 1 : 0, weights[corner]);
    }
  }
}

TEST_P(TriangleLocatorTest, FindsNothingOutsideAndForNumbersThatAreNotFinite)
{
  const auto locator = this->locator();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Point2 p : { Point2{ -1, 5 }, Point2{ 30, 30 }, Point2{ 1e308, -1e308 },
         Point2{ infinity, 5 }, Point2{ 5, std::numeric_limits<double>::quiet_NaN() } })
  {
    EXPECT_EQ(-1, locator.find(p)) << p.x << " " << p.y;
  }
}

INSTANTIATE_TEST_SUITE_P(RandomAndLattice, TriangleLocatorTest, testing::Bool());

TEST(TriangleLocator, WithoutTrianglesThereIsNothingToFind)
{
  const TriangleLocator locator({}, nullptr, nullptr, 0);
  EXPECT_EQ(-1, locator.find({ 0, 0 }));
}
