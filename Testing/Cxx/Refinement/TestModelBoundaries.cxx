// SPDX-License-Identifier: BSD-3-Clause
#include "GridMesh.h"
#include "Refinement/ModelBoundaries.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace tipp;
using tipp::test::GridMesh;

using Ids = std::vector<std::int64_t>;

const auto none = [](std::int64_t) { return false; };

/// Twice the area that a loop has on its left.
double areaOf(const GridMesh& mesh, const Ids& loop)
{
  double area = 0;
  for (std::size_t i = 0; i < loop.size(); ++i)
  {
    const auto a = std::size_t(loop[i]);
    const auto b = std::size_t(loop[(i + 1) % loop.size()]);
    area += mesh.XY[2 * a] * mesh.XY[2 * b + 1] - mesh.XY[2 * b] * mesh.XY[2 * a + 1];
  }
  return area;
}

/// A square of side 6 with an island of one square and one of two.
class SquareWithTwoIslands : public testing::Test
{
protected:
  /// The node at a position.
  static std::int64_t at(int column, int row) { return 7 * row + column; }

  const GridMesh Mesh{ 6, 6,
    [](int column, int row)
    { return !(column == 1 && row == 1) && !(column == 4 && (row == 2 || row == 3)); } };
};

TEST_F(SquareWithTwoIslands, HasAClosedMainlandAndTwoIslands)
{
  const ModelBoundaries found = findModelBoundaries(this->Mesh.XY, this->Mesh.view(), none);
  EXPECT_EQ(1, found.OuterLoops);
  EXPECT_EQ(2, found.Islands);
  EXPECT_EQ(0, found.TouchingNodes);
  EXPECT_TRUE(found.Lists.Open.empty());
  ASSERT_EQ(3U, found.Lists.Land.size());
  const Ids& mainland = found.Lists.Land[0].Nodes;
  EXPECT_EQ(20, found.Lists.Land[0].Kind);
  EXPECT_EQ(25U, mainland.size());
  EXPECT_EQ(0, mainland.front());
  EXPECT_EQ(1, mainland[1]);
  EXPECT_EQ(0, mainland.back());
  EXPECT_EQ(72, areaOf(this->Mesh, mainland));
  EXPECT_EQ(21, found.Lists.Land[1].Kind);
  EXPECT_EQ((Ids{ at(1, 1), at(1, 2), at(2, 2), at(2, 1) }), found.Lists.Land[1].Nodes);
  EXPECT_EQ(-2, areaOf(this->Mesh, found.Lists.Land[1].Nodes));
  EXPECT_EQ(6U, found.Lists.Land[2].Nodes.size());
  EXPECT_EQ(at(4, 2), found.Lists.Land[2].Nodes.front());
  EXPECT_EQ(-4, areaOf(this->Mesh, found.Lists.Land[2].Nodes));
}

TEST_F(SquareWithTwoIslands, HasTheKindsOfLandThatAModelWants)
{
  const ModelBoundaries found =
    findModelBoundaries(this->Mesh.XY, this->Mesh.view(), none, { 0, 1 });
  EXPECT_EQ(0, found.Lists.Land[0].Kind);
  EXPECT_EQ(1, found.Lists.Land[1].Kind);
}

TEST_F(SquareWithTwoIslands, IsOpenInAPolygon)
{
  // The eastern side, with its corners on the polygon's border.
  const OpenNodes east =
    nodesInside(this->Mesh.XY, { { { 5.5, 0 }, { 7, 0 }, { 7, 6 }, { 5.5, 6 } } });
  const ModelBoundaries found = findModelBoundaries(this->Mesh.XY, this->Mesh.view(), east);
  ASSERT_EQ(1U, found.Lists.Open.size());
  EXPECT_EQ((Ids{ at(6, 0), at(6, 1), at(6, 2), at(6, 3), at(6, 4), at(6, 5), at(6, 6) }),
    found.Lists.Open[0]);
  ASSERT_EQ(3U, found.Lists.Land.size());
  const Ids& mainland = found.Lists.Land[0].Nodes;
  EXPECT_EQ(at(6, 6), mainland.front());
  EXPECT_EQ(at(6, 0), mainland.back());
  EXPECT_EQ(19U, mainland.size());
}

TEST_F(SquareWithTwoIslands, IsOpenWhereItIsDeep)
{
  // Deep at the southern side from x = 1 to 3, at the western one from y = 2 on, and at one node.
  std::vector<double> depths(this->Mesh.nodes(), 10);
  for (const std::int64_t node : { at(1, 0), at(2, 0), at(3, 0), at(0, 2), at(0, 3), at(6, 3) })
  {
    depths[std::size_t(node)] = 10.5;
  }
  depths[std::size_t(at(5, 0))] = std::nan("");
  const ModelBoundaries found =
    findModelBoundaries(this->Mesh.XY, this->Mesh.view(), nodesDeeperThan(depths.data(), 10));
  EXPECT_EQ((std::vector<Ids>{ { at(1, 0), at(2, 0), at(3, 0) }, { at(0, 3), at(0, 2) } }),
    found.Lists.Open);
  ASSERT_EQ(4U, found.Lists.Land.size());
  EXPECT_EQ(at(3, 0), found.Lists.Land[0].Nodes.front());
  EXPECT_EQ(at(0, 3), found.Lists.Land[0].Nodes.back());
  EXPECT_EQ((Ids{ at(0, 2), at(0, 1), at(0, 0), at(1, 0) }), found.Lists.Land[1].Nodes);
  EXPECT_EQ(1, found.LoneOpenNodes);
}

TEST_F(SquareWithTwoIslands, AnOpenBoundaryMayGoThroughTheLowestNode)
{
  const OpenNodes corner =
    nodesInside(this->Mesh.XY, { { { -1, -1 }, { 1.5, -1 }, { 1.5, 1.5 }, { -1, 1.5 } } });
  const ModelBoundaries found = findModelBoundaries(this->Mesh.XY, this->Mesh.view(), corner);
  EXPECT_EQ((std::vector<Ids>{ { at(0, 1), at(0, 0), at(1, 0) } }), found.Lists.Open);
  EXPECT_EQ(at(1, 0), found.Lists.Land[0].Nodes.front());
  EXPECT_EQ(at(0, 1), found.Lists.Land[0].Nodes.back());
}

TEST_F(SquareWithTwoIslands, ABorderThatIsOpenAllAroundIsOneList)
{
  const ModelBoundaries found =
    findModelBoundaries(this->Mesh.XY, this->Mesh.view(), [](std::int64_t) { return true; });
  ASSERT_EQ(1U, found.Lists.Open.size());
  EXPECT_EQ(24U, found.Lists.Open[0].size());
  EXPECT_EQ(2U, found.Lists.Land.size());
}

TEST(ModelBoundaries, HolesOfAPolygonAreNotOpen)
{
  const GridMesh mesh(4, 4);
  const std::vector<Point2> whole{ { -1, -1 }, { 5, -1 }, { 5, 5 }, { -1, 5 } };
  const std::vector<Point2> hole{ { -1, 0.5 }, { 1, 0.5 }, { 1, 3.5 }, { -1, 3.5 } };
  const OpenNodes isOpen = nodesInside(mesh.XY, { whole, hole });
  EXPECT_TRUE(isOpen(0));
  EXPECT_FALSE(isOpen(5 * 2));    // (0, 2), in the hole
  EXPECT_TRUE(isOpen(5 * 2 + 1)); // (1, 2), on the hole's border
  EXPECT_TRUE(isOpen(5 * 2 + 2));
}

TEST(ModelBoundaries, IslandsThatTouchAreReportedAndNoMainland)
{
  // Two holes with a common corner, which is the lowest of neither.
  const GridMesh mesh(4, 4,
    [](int column, int row) { return !(column == 1 && row == 1) && !(column == 2 && row == 2); });
  const ModelBoundaries found = findModelBoundaries(mesh.XY, mesh.view(), none);
  EXPECT_EQ(1, found.OuterLoops);
  EXPECT_EQ(1, found.TouchingNodes);
}

TEST(ModelBoundaries, PartsOfAMeshHaveAMainlandEach)
{
  const GridMesh mesh(5, 1, [](int column, int) { return column != 2; });
  const ModelBoundaries found = findModelBoundaries(mesh.XY, mesh.view(), none);
  EXPECT_EQ(2, found.OuterLoops);
  EXPECT_EQ(0, found.Islands);
  ASSERT_EQ(2U, found.Lists.Land.size());
  EXPECT_EQ(0, found.Lists.Land[0].Nodes.front());
  EXPECT_EQ(3, found.Lists.Land[1].Nodes.front());
}

} // namespace
