// SPDX-License-Identifier: BSD-3-Clause
#include "Adcirc/AdcircGrid.h"
#include "ExpectIOError.h"
#include "Meshes/MeshFiles.h"
#include "Points/ReadPoints.h"
#include "SharedData.h"
#include "TemporaryFolder.h"

namespace
{

using Ids = std::vector<std::int64_t>;

class AdcircGrid : public testing::Test
{
protected:
  std::string file(const std::string& content) const
  {
    return this->Folder.file("fort.14", content);
  }

  void expectError(const std::string& content, const std::string& words) const
  {
    const std::string path = this->file(content);
    tipp::test::expectIOError(path, words, [&]() { tipp::readAdcircGrid(path); });
  }

  const tipp::test::TemporaryFolder Folder;
  const std::string Nodes = "1 0 0 5.5\n2 1 0 -1\n3 0 1 2\n";
};

} // namespace

TEST_F(AdcircGrid, NodesDepthsAndTrianglesAreRead)
{
  const std::string path =
    this->file("title\n1 3 ! numbers\n" + this->Nodes + "1 3 1 2 3\n0 = open boundaries\n");
  const tipp::PointTable points = tipp::readPoints(path);
  EXPECT_EQ((std::vector<double>{ 0, 0, 1, 0, 0, 1 }), points.XY);
  ASSERT_EQ(1U, points.Columns.size());
  EXPECT_EQ("depth", points.Columns[0].Name);
  EXPECT_EQ((std::vector<double>{ 5.5, -1, 2 }), points.Columns[0].Values);
  const tipp::TriangleMesh mesh = tipp::readMesh(path);
  EXPECT_EQ((Ids{ 0, 1, 2 }), mesh.Triangles);
  EXPECT_EQ(points.XY, mesh.XY);
}

TEST_F(AdcircGrid, NodeNumbersMayHaveGapsAndAnyOrder)
{
  const std::string path = this->file("\n1 3\n70 0 0 0\n-2 1 0 0\n9 0 1 0\n1 3 -2 9 70\n");
  EXPECT_EQ((Ids{ 1, 2, 0 }), tipp::readMesh(path).Triangles);
}

TEST_F(AdcircGrid, RealGridIsReadCompletely)
{
  TIPP_REQUIRE_DATA(path, "adcirc/ec95d/ec95d.grd");
  const tipp::AdcircGrid grid = tipp::readAdcircGrid(path);
  EXPECT_EQ(2U * 31435U, grid.XY.size());
  EXPECT_EQ(3U * 58369U, grid.Triangles.size());
}

TEST_F(AdcircGrid, CountsThatTheFileCannotHoldAreReported)
{
  const std::string words = "lines follow";
  this->expectError("title\n1 -3\n" + this->Nodes, words);
  this->expectError("title\n-1 3\n" + this->Nodes, words);
  this->expectError("title\n1 9223372036854775807\n" + this->Nodes, words);
  this->expectError("title\n9223372036854775807 9223372036854775807\n" + this->Nodes, words);
  this->expectError("title\n1 99999999999999999999\n" + this->Nodes, "is not an integer");
}

TEST_F(AdcircGrid, EveryTruncationOfTheLinesIsReported)
{
  const std::string whole = "title\n1 3\n" + this->Nodes + "1 3 1 2 3";
  for (std::size_t end = whole.find('\n'); end != std::string::npos;
       end = whole.find('\n', end + 1))
  {
    const std::string path = this->file(whole.substr(0, end + 1));
    EXPECT_THROW(tipp::readAdcircGrid(path), tipp::IOError) << end;
  }
  EXPECT_THROW(tipp::readAdcircGrid(this->file("")), tipp::IOError);
}

TEST_F(AdcircGrid, TextWhereNumbersBelongIsReportedWithItsLine)
{
  this->expectError("title\nmany nodes\n", "line 2: 'many' is not an integer");
  this->expectError("title\n0 1\n1 zero 0 0\n", "line 3: 'zero' is not a number");
  this->expectError("title\n0 1\n1 0 0\n", "line 3: has too few numbers for a node");
}

TEST_F(AdcircGrid, InvalidElementsAreReported)
{
  this->expectError("title\n1 3\n" + this->Nodes + "1 4 1 2 3 1\n", "not a triangle");
  this->expectError("title\n1 3\n" + this->Nodes + "1 3 1 2 4\n", "names node 4");
  this->expectError("title\n0 2\n1 0 0 0\n1 1 0 0\n", "node 1 is given twice");
}

TEST_F(AdcircGrid, NewNodesNeedNumbersThatTheFormatCanHold)
{
  tipp::PointTable points;
  points.XY = { 0, 0, 1, 0, 0, 1, 1, 1 };
  tipp::MeshOptions options;
  const std::string path = this->Folder.path("out.14");
  options.AdcircLike = this->file("title\n0 1\n9223372036854775804 0 0 0\n");
  EXPECT_TRUE(tipp::writeMesh(path, points, {}, options));
  EXPECT_EQ(1U, tipp::readAdcircGrid(path).IndexOf.count(9223372036854775807));
  options.AdcircLike = this->file("title\n0 1\n9223372036854775805 0 0 0\n");
  tipp::test::expectIOError(options.AdcircLike, "new nodes cannot be numbered",
    [&]() { tipp::writeMesh(path, points, {}, options); });
}

TEST_F(AdcircGrid, NumbersAreReadAsFortranReadsThem)
{
  const std::pair<const char*, double> numbers[] = { { "1.5D+01", 15 }, { "1.5d1", 15 },
    { "-1.5+01", -15 }, { "1.5-002", 0.015 }, { "25.Q-1", 2.5 }, { "+.5E+0", 0.5 }, { "7", 7 } };
  for (const auto& [text, value] : numbers)
  {
    const std::string path = this->file("\n0 1\n1 " + std::string(text) + " 0 0\n");
    EXPECT_EQ(value, tipp::readPoints(path).XY[0]) << text;
  }
  for (const std::string text : { "1.5D", "1.5D+", "D+01", "1.5m", "1-2-3", "***" })
  {
    this->expectError("\n0 1\n1 " + text + " 0 0\n", "'" + text + "' is not a number");
  }
}

TEST_F(AdcircGrid, RowsMayHaveCommasRepeatsBlankLinesAndSlashes)
{
  const std::string grids[] = { "t\n1, 3\n1, 0 , 0,5.5\n2,1,0,-1,\n3 0, 1 2\n1,3,1,2,3\n",
    "t\n\n1 3\n\n1 2*0 5.5\n \t\n2 1 0 -1\n3 0 1 2 \n\n1 3 1 2 3\n",
    "t\r\n1 3 / sizes\r\n1 0 0 5.5/x, y\r\n2 1 0 -1\r\n\r\n3 0 1 2 'a, b'\r\n1 3 1 2 3\r\n",
    "t\n1 3\n1 0.0\n 0.0 5.5\n2 1 0\n,-1\n3,\n0,1\n2\n1 3 1\n2 3\n" };
  for (const std::string& grid : grids)
  {
    const tipp::AdcircGrid read = tipp::readAdcircGrid(this->file(grid));
    EXPECT_EQ((std::vector<double>{ 0, 0, 1, 0, 0, 1 }), read.XY) << grid;
    EXPECT_EQ((std::vector<double>{ 5.5, -1, 2 }), read.Depth) << grid;
    EXPECT_EQ((Ids{ 0, 1, 2 }), read.Triangles) << grid;
  }
}

TEST_F(AdcircGrid, ValuesThatFortranWouldLeaveUnchangedAreRefused)
{
  this->expectError("t\n0 1\n1 ,,0 5\n", "line 3: gives no value where a number is needed");
  this->expectError("t\n0 1\n1 2* 5\n", "line 3: gives no value where a number is needed");
  this->expectError("t\n0 1\n1 0 0 /\n", "line 3: has too few numbers for a node");
  this->expectError("t\n0 1\n1 0 0 ,,\n", "line 3: gives no value where a number is needed");
  this->expectError("t\n0 1\n1 99999999999*0 0 0\n", "'99999999999*0' is not a number");
}

TEST_F(AdcircGrid, ARowThatLacksANumberDoesNotTakeThoseOfTheNext)
{
  this->expectError(
    "t\n0 3\n1 0 0 5.5\n2 1 0\n3 0 1 2\n", "line 4: has too few numbers for a node");
}

TEST_F(AdcircGrid, QuadrilateralsHaveNodesButAreNoMesh)
{
  const std::string path =
    this->file("t\n2 4\n" + this->Nodes + "4 1 1 0\n1 4 1 2 4 3\n2 3 1 2 3\n0\n0\n0\n0\n");
  EXPECT_EQ(4U, tipp::readPoints(path).size());
  tipp::test::expectIOError(
    path, "line 7: the element is not a triangle but has 4 corners", [&] { tipp::readMesh(path); });
  this->expectError("t\n1 3\n" + this->Nodes + "1 5 1 2 3 1 2\n", "has 5 corners");
  const std::string cut = this->file("t\n1 3\n" + this->Nodes + "1 4 1 2 3\n");
  tipp::test::expectIOError(
    cut, "line 6: has too few numbers for an element", [&] { tipp::readPoints(cut); });
}

TEST_F(AdcircGrid, ColumnsCannotBeChosen)
{
  const std::string path = this->file("title\n0 3\n" + this->Nodes);
  tipp::test::expectIOError(path, "fixed coordinates",
    [&]() {
      tipp::readPoints(path, { "x", "y" });
    });
}
