// SPDX-License-Identifier: BSD-3-Clause
// Meshes in the files of models and mesh generators.
#include "Constraints/ReadConstraintFile.h"
#include "ExpectIOError.h"
#include "Flat/FlatMesh.h"
#include "FlattenedSeries.h"
#include "Meshes/MeshFiles.h"
#include "Models/ModelMesh.h"
#include "Points/ReadPoints.h"
#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace
{

using Doubles = std::vector<double>;
using Ids = std::vector<std::int64_t>;
using tipp::ModelPart;
using tipp::test::contentOf;
using tipp::test::expectIOError;
using tipp::test::FlattenedSeries;

class ModelMeshes : public testing::Test
{
protected:
  ModelMeshes()
  {
    this->Points.XY = { 0, 0, 1, 0, 1, 1, 0, 1.1 };
    this->Points.Columns = { { "heat", { 0.1, 0.2, 0.3, 0.4 } }, { "z", { -5, 6.25, 1e-9, 8 } } };
    this->Options.Regions = this->Regions;
  }

  tipp::TrianglesView view() const { return { this->Triangles.data(), 2 }; }

  std::string written(const std::string& name) const
  {
    const std::string path = this->Folder.path(name);
    EXPECT_TRUE(tipp::writeMesh(path, this->Points, this->view(), this->Options));
    return path;
  }

  void expectError(
    const std::string& name, const std::string& content, const std::string& words) const
  {
    const std::string path = this->Folder.file(name, content);
    expectIOError(path, words, [&] { tipp::readModelMesh(path, ModelPart::Triangles); });
  }

  /// Expects an error for every beginning of the file, up to the line that starts with `end`.
  void expectTruncationsReported(
    const std::string& name, const std::string& whole, const std::string& end) const
  {
    const std::size_t last = whole.find("\n" + end);
    for (std::size_t at = whole.find('\n'); at < last; at = whole.find('\n', at + 1))
    {
      const std::string path = this->Folder.file(name, whole.substr(0, at + 1));
      EXPECT_THROW(tipp::readModelMesh(path, ModelPart::Triangles), tipp::IOError) << at;
    }
  }

  const tipp::test::TemporaryFolder Folder;
  const Ids Triangles{ 0, 1, 3, 1, 2, 3 };
  const std::vector<std::int32_t> Regions{ 7, 3 };
  tipp::PointTable Points;
  tipp::MeshOptions Options;
  const std::string Sms = "MESH2D\nMESHNAME \"a b\"\nE3T 1 30 7 9 2\n"
                          "ND 7 1 0 2.5\nND 30 0 0 -1\n\nNS 7 -9\nND 9 0 1 3\nBEGPARAMDEF\n";
  const std::string Gmsh = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n30 0 0 -1\n7 1 0 2.5\n"
                           "9 0 1 3\n$EndNodes\n$Elements\n3\n1 15 2 0 1 7\n2 1 2 0 1 7 9\n"
                           "3 2 3 4 1 0 30 7 9\n$EndElements\n";
  const std::string Gmsh4 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n1 1 1 0\n1 0 0 0 0\n1 0 0 0 1 1 0 0 2 1 -1\n"
    "5 0 0 0 1 1 0 1 4 1 1\n$EndEntities\n$Nodes\n2 3 7 30\n1 1 0 1\n30\n0 0 -1\n2 5 0 2\n7\n9\n"
    "1 0 2.5\n0 1 3\n$EndNodes\n$Elements\n2 2 1 2\n1 1 1 1\n1 30 7\n2 5 2 1\n2 30 7 9\n"
    "$EndElements\n";
};

TEST_F(ModelMeshes, NodesAndTrianglesOfSmsAreRead)
{
  const std::string path = this->Folder.file("a.2dm", this->Sms);
  const tipp::ModelMesh mesh = tipp::readModelMesh(path, ModelPart::Triangles);
  EXPECT_EQ((Doubles{ 1, 0, 0, 0, 0, 1 }), mesh.XY);
  EXPECT_EQ((Ids{ 1, 0, 2 }), mesh.Triangles);
  EXPECT_EQ((Doubles{ 2 }), mesh.Regions);
  ASSERT_EQ(1U, mesh.Columns.size());
  EXPECT_EQ("z", mesh.Columns[0].Name);
  EXPECT_EQ((Doubles{ 2.5, -1, 3 }), mesh.Columns[0].Values);
}

TEST_F(ModelMeshes, TrianglesOfSmsNeedNoMaterial)
{
  const std::string path = this->Folder.file(
    "a.2dm", "MESH2D\nE3T 1 1 2 3 5\nE3T 2 2 3 1\nND 1 0 0 0\nND 2 1 0 0\nND 3 0 1 0\n");
  const tipp::ModelMesh mesh = tipp::readModelMesh(path, ModelPart::Triangles);
  EXPECT_EQ(6U, mesh.Triangles.size());
  EXPECT_TRUE(mesh.Regions.empty());
}

TEST_F(ModelMeshes, DamagedMeshesOfSmsAreReportedWithTheLine)
{
  this->expectError("a.2dm", "ND 1 0 0 0\n", "has no line MESH2D");
  this->expectError("a.2dm", "", "has no line MESH2D");
  this->expectError("a.2dm", "MESH2D\nND 1 0 0\n", "line 2: has too few numbers for a node");
  this->expectError("a.2dm", "MESH2D\nND 1 x 0 0\n", "line 2: 'x' is not a number");
  this->expectError("a.2dm", "MESH2D\nND 1.5 0 0 0\n", "line 2: '1.5' is not an integer");
  this->expectError("a.2dm", "MESH2D\nND 1 0 0 0\nND 1 1 0 0\n", "line 3: node 1 is given twice");
  this->expectError("a.2dm", "MESH2D\nE3T 1 1 2\n", "line 2: has too few numbers for a triangle");
  this->expectError(
    "a.2dm", "MESH2D\nND 1 0 0 0\nE3T 1 1 1 2\n", "line 3: names node 2, which is not given");
  this->expectError("a.2dm", "MESH2D\nE8Q 1 1 2 3 4 1\n", "line 2: the element E8Q");
  this->expectError("a.2dm",
    "MESH2D\nE4Q 1 1 3 2 4 1\nND 1 0 0 0\nND 2 1 0 0\nND 3 1 1 0\nND 4 0 1 0\n",
    "line 2: gives a quadrilateral that crosses or touches itself");
  this->expectTruncationsReported("a.2dm", this->Sms, "BEGPARAMDEF");
}

TEST_F(ModelMeshes, QuadrilateralsOfSmsAreCutAlike)
{
  // The first corner and the direction differ; the rows are of one shape.
  const std::string nodes = "ND 11 0 0 5\nND 2 2 0 6\nND 30 2.5 1 7\nND 4 0 1 8\n";
  std::vector<std::set<std::set<std::int64_t>>> cuts;
  for (const std::string corners : { "11 2 30 4", "30 4 11 2", "4 30 2 11" })
  {
    const std::string path =
      this->Folder.file("a.2dm", "MESH2D\nE4Q 1 " + corners + " 9\n" + nodes);
    const tipp::ModelMesh mesh = tipp::readModelMesh(path, ModelPart::Triangles);
    ASSERT_EQ(6U, mesh.Triangles.size());
    EXPECT_EQ((Doubles{ 9, 9 }), mesh.Regions);
    EXPECT_EQ((std::vector<std::int64_t>{ 0, 0 }), mesh.OriginalCells);
    const std::int64_t* const t = mesh.Triangles.data();
    cuts.push_back({ { t[0], t[1], t[2] }, { t[3], t[4], t[5] } });
  }
  // The diagonal from (2, 0) to (0, 1) is the shorter one.
  EXPECT_EQ((std::set<std::set<std::int64_t>>{ { 0, 1, 3 }, { 1, 2, 3 } }), cuts[0]);
  EXPECT_EQ(cuts[0], cuts[1]);
  EXPECT_EQ(cuts[0], cuts[2]);
}

TEST_F(ModelMeshes, QuadrilateralsOfSmsHaveNodes)
{
  const std::string path =
    this->Folder.file("a.2dm", "MESH2D\nE4Q 1 1 2 3 4 1\nND 1 0 0 5\nND 2 1 0 6\n");
  EXPECT_EQ((Doubles{ 0, 0, 1, 0 }), tipp::readPoints(path).XY);
}

TEST_F(ModelMeshes, MeshesOfGmshAreReadInBothVersions)
{
  for (const std::string& content : { this->Gmsh, this->Gmsh4 })
  {
    const std::string path = this->Folder.file("a.msh", content);
    const tipp::ModelMesh mesh = tipp::readModelMesh(path, ModelPart::Triangles);
    EXPECT_EQ((Doubles{ 0, 0, 1, 0, 0, 1 }), mesh.XY);
    EXPECT_EQ((Ids{ 0, 1, 2 }), mesh.Triangles);
    EXPECT_EQ((Doubles{ 4 }), mesh.Regions);
    EXPECT_EQ((Doubles{ -1, 2.5, 3 }), mesh.Columns.at(0).Values);
  }
}

TEST_F(ModelMeshes, DamagedMeshesOfGmshAreReportedWithTheLine)
{
  const std::string start = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  const std::string nodes = start + "$Nodes\n1\n1 0 0 0\n$EndNodes\n";
  this->expectError("a.msh", "", "has no section $MeshFormat");
  this->expectError("a.msh", "$Nodes\n0\n$EndNodes\n", "line 1: has the section $Nodes before");
  this->expectError("a.msh", start + "$Nodes\n0\n1 0 0 0\n", "line 6: has more lines");
  this->expectError("a.msh", nodes, "has no section $Elements");
  this->expectError("a.msh", "$MeshFormat\n4.1 1 8\n", "line 2: is neither version 2.2 nor 4.1");
  this->expectError("a.msh", start + "$Nodes\n9999999999\n", "line 5: announces 9999999999 lines");
  this->expectError("a.msh", start + "$Nodes\n-1\n", "line 5: announces -1 lines");
  this->expectError(
    "a.msh", start + "$Nodes\n2\n1 0 0 0\n1 0 0 0\n", "line 7: node 1 is given twice");
  this->expectError(
    "a.msh", nodes + "$Elements\n1\n1 2 0 1 1 2\n", "line 10: names node 2, which is not given");
  this->expectError("a.msh", nodes + "$Elements\n1\n1 2 9223372036854775807 1 1 1\n",
    "line 10: announces 9223372036854775807 tags");
  this->expectError("a.msh", nodes + "$Elements\n1\n1 2 2 0 1 1\n", "line 10: has too few numbers");
  this->expectError(
    "a.msh", nodes + "$Elements\n1\n1 3 0 1 1 1 1\n", "line 10: the elements of type 3");
  this->expectTruncationsReported("a.msh", this->Gmsh, "$EndElements");
  this->expectTruncationsReported("a.msh", this->Gmsh4, "$EndElements");
}

TEST_F(ModelMeshes, BinaryMeshesOfGmshAreToBeConverted)
{
  const std::string one("\1\0\0\0", 4);
  this->expectError("a.msh", "$MeshFormat\n4.1 1 8\n" + one + "\n$EndMeshFormat\n",
    "line 2: is neither version 2.2 nor 4.1 in ASCII; convert it, as with 'gmsh -save");
}

TEST_F(ModelMeshes, MeshesOfFluentAreNotTakenForThoseOfGmsh)
{
  const std::string header = "(1 \"meshio 5.3.5\")\n(2 3)\n(10 (0 1 3 0))\n";
  for (const std::string& nodes :
    { std::string("(10 (1 1 3 1 3)(\n0 0 0\n"), "(3010 (1 1 3 1 3)(" + std::string(72, '\0') })
  {
    this->expectError("a.msh", header + nodes, "is a mesh of ANSYS Fluent, not of Gmsh");
  }
}

TEST_F(ModelMeshes, FilesOfTriangleAreReadByEitherName)
{
  for (const std::string first : { "0", "1" })
  {
    const auto number = [&](int i) { return std::to_string(std::stoi(first) + i); };
    this->Folder.file("a.node",
      "# made by hand\n3 2 2 1\n" + number(0) + " 0 0 5 1 1\n" + number(1) + " 1 0 6 2 1\n" +
        number(2) + " 0 1 7 3 1 # last\n");
    this->Folder.file(
      "a.ele", "1 3 1\n" + first + " " + number(2) + " " + number(0) + " " + number(1) + " 2.5\n");
    for (const std::string name : { "a.node", "a.ele" })
    {
      const tipp::ModelMesh mesh =
        tipp::readModelMesh(this->Folder.path(name), ModelPart::Triangles);
      EXPECT_EQ((Doubles{ 0, 0, 1, 0, 0, 1 }), mesh.XY);
      EXPECT_EQ((Ids{ 2, 0, 1 }), mesh.Triangles);
      EXPECT_EQ((Doubles{ 2.5 }), mesh.Regions);
    }
    const tipp::PointTable points = tipp::readPoints(this->Folder.path("a.node"));
    EXPECT_EQ((std::vector<std::string>{ "z", "attribute2" }), points.names());
    EXPECT_EQ((Doubles{ 5, 6, 7 }), points.Columns[0].Values);
  }
}

TEST_F(ModelMeshes, DamagedFilesOfTriangleAreReportedWithTheLine)
{
  const std::string nodes = this->Folder.file("a.node", "2 3 0 0\n1 0 0 0\n2 1 0 0\n");
  expectIOError(nodes, "line 1: has vertices of 3 coordinates", [&] { tipp::readPoints(nodes); });
  this->Folder.file("a.node", "1 2 4000000000000000000 0\n1 0 0\n");
  expectIOError(nodes, "line 2: has fewer attributes", [&] { tipp::readPoints(nodes); });
  this->Folder.file("a.node", "5 2 0 0\n1 0 0\n");
  expectIOError(nodes, "line 1: announces 5 lines", [&] { tipp::readPoints(nodes); });
  this->Folder.file("a.node", "1 2 -1 0\n1 0 0\n");
  expectIOError(nodes, "line 1: announces -1 attributes", [&] { tipp::readPoints(nodes); });
  this->Folder.file("a.node", "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n");
  this->expectError("a.ele", "1 3 0\n1 1 2 4\n", "line 2: names node 4");
  this->expectError("a.ele", "1 3 0\n1 0 2 3\n", "line 2: names node 0");
  this->expectError("a.ele", "1 3 0\n1 1 2\n", "line 2: has too few numbers for a triangle");
  this->expectError("a.ele", "1 3 1\n1 1 2 3\n", "line 2: has too few numbers for a triangle");
  this->expectError("a.ele", "1 6 0\n1 1 2 3 1 2 3\n", "line 1: has elements of 6 nodes");
  this->expectError("a.ele", "7 3 0\n1 1 2 3\n", "line 1: announces 7 lines");
  this->expectError("a.ele", "3\n1 1 2 3\n1 1 2 3\n1 1 2 3\n", "line 1: has too few numbers");
}

TEST_F(ModelMeshes, AGridOfSchismIsReadAsOneOfAdcirc)
{
  const std::string path = this->Folder.file("hgrid.gr3",
    "title\n1 3\n1 0 0 5\n2 1 0 -1\n3 0 1 2\n1 3 1 2 3\n1 = open\n2\n2\n1\n2\n1\n2\n2 0\n2\n3\n");
  EXPECT_EQ((Ids{ 0, 1, 2 }), tipp::readMesh(path).Triangles);
  EXPECT_EQ((Doubles{ 5, -1, 2 }), tipp::readPoints(path).Columns.at(0).Values);
  EXPECT_EQ(2U, tipp::readConstraintFile(path, 0).Edges.size());
}

TEST_F(ModelMeshes, EveryFormatIsReadAsItWasWritten)
{
  for (const std::string name : { "a.14", "a.gr3", "a.2dm", "a.msh", "a.node", "b.ele" })
  {
    SCOPED_TRACE(name);
    const std::string path = this->written(name);
    const tipp::ModelMesh mesh = tipp::readModelMesh(path, ModelPart::Triangles);
    EXPECT_EQ(this->Points.XY, mesh.XY);
    EXPECT_EQ(this->Triangles, mesh.Triangles);
    const bool isAdcirc = name == "a.14" || name == "a.gr3";
    EXPECT_EQ(isAdcirc ? Doubles{} : Doubles({ 7, 3 }), mesh.Regions);
    EXPECT_EQ(isAdcirc ? Doubles({ 5, -6.25, -1e-9, -8 }) : this->Points.Columns[1].Values,
      mesh.Columns.at(0).Values);
    EXPECT_EQ(isAdcirc ? "depth" : "z", mesh.Columns.at(0).Name);
    EXPECT_EQ(this->Triangles, tipp::readMesh(path).Triangles);
  }
}

TEST_F(ModelMeshes, DepthsBecomeElevationsInMeshesOfSmsAndGmsh)
{
  this->Points.Columns = { { "depth", { 1, 2, 3, -4 } } };
  for (const std::string name : { "a.2dm", "a.msh" })
  {
    EXPECT_EQ(
      (Doubles{ -1, -2, -3, 4 }), tipp::readPoints(this->written(name)).Columns.at(0).Values);
  }
}

TEST_F(ModelMeshes, RegionsOfGmshAreNamedPhysicalGroups)
{
  const std::string text = contentOf(this->written("a.msh"));
  EXPECT_NE(std::string::npos,
    text.find("$PhysicalNames\n2\n2 3 \"region 3\"\n2 7 \"region 7\"\n$EndPhysicalNames\n"))
    << text;
  EXPECT_NE(std::string::npos, text.find("\n1 2 2 7 7 1 2 4\n2 2 2 3 3 2 3 4\n")) << text;
}

TEST_F(ModelMeshes, GmshCannotHoldNegativeRegions)
{
  const std::vector<std::int32_t> regions{ 0, -2 };
  this->Options.Regions = regions;
  const std::string path = this->Folder.path("a.msh");
  expectIOError(path, "cannot hold the region -2",
    [&] { tipp::writeMesh(path, this->Points, this->view(), this->Options); });
  EXPECT_EQ(0U, this->Folder.fileCount());
}

TEST_F(ModelMeshes, SegmentsAreWrittenAsAPolyFileOfTheNodes)
{
  this->Options.Segments = { { 0, 1 }, { 3, 0 } };
  this->written("a.ele");
  EXPECT_EQ(3U, this->Folder.fileCount());
  const tipp::ConstraintTable table = tipp::readConstraintFile(this->Folder.path("a.poly"), 0);
  EXPECT_EQ(this->Points.XY, table.XY);
  EXPECT_EQ((std::vector<std::array<std::int64_t, 2>>{ { 0, 1 }, { 3, 0 } }), table.Edges);
  EXPECT_EQ(
    (std::vector<std::string>{ "x.ele", "x.node", "x.poly" }), tipp::filesOfMesh("x.ele", true));
}

TEST_F(ModelMeshes, BoundariesOfANewGridAreReadAsLines)
{
  this->Options.Boundaries.Open = { { 0, 1, 2 } };
  this->Options.Boundaries.Land = { { 20, { 2, 3, 0 } }, { 21, { 0, 1, 3 } } };
  const std::string path = this->written("a.14");
  const std::string text = contentOf(path);
  EXPECT_NE(std::string::npos, text.find("\n2 = number of land boundaries\n6 = total")) << text;
  using Edges = std::vector<std::array<std::int64_t, 2>>;
  EXPECT_EQ((Edges{ { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 0 }, { 0, 1 }, { 1, 3 }, { 3, 0 } }),
    tipp::readConstraintFile(path, 0).Edges);
}

TEST_F(ModelMeshes, AnAbortedRunLeavesTheOldFiles)
{
  const std::string nodes = this->Folder.file("a.node", "old");
  this->Options.Aborted = [] { return true; };
  this->Options.Segments = { { 0, 1 } };
  for (const std::string name : { "a.gr3", "a.2dm", "a.msh", "a.node", "a.ele" })
  {
    EXPECT_FALSE(
      tipp::writeMesh(this->Folder.path(name), this->Points, this->view(), this->Options));
  }
  EXPECT_EQ(1U, this->Folder.fileCount());
  EXPECT_EQ("old", contentOf(nodes));
}

TEST_F(ModelMeshes, PointsThatAreNotFiniteAreRefused)
{
  this->Points.XY[5] = std::numeric_limits<double>::infinity();
  for (const std::string name : { "a.gr3", "a.2dm", "a.msh", "a.node" })
  {
    const std::string path = this->Folder.path(name);
    expectIOError(path, "cannot hold point 2",
      [&] { tipp::writeMesh(path, this->Points, this->view(), this->Options); });
  }
  EXPECT_EQ(0U, this->Folder.fileCount());
}

TEST_F(ModelMeshes, FlatMeshesHaveTheValuesAndRegions)
{
  const FlattenedSeries flattened(this->written("a.2dm"));
  const tipp::FlatContent& content = flattened.Content;
  EXPECT_EQ(this->Triangles, content.Cells);
  EXPECT_EQ(4, content.Points.Tuples);
  ASSERT_EQ(1U, content.PointData.size());
  EXPECT_EQ("z", content.PointData[0].Name);
  ASSERT_EQ(1U, content.CellData.size());
  EXPECT_EQ("Region", content.CellData[0].Name);
  EXPECT_EQ(7, FlattenedSeries::valueAt(content.CellData[0], 0, 0));
}

} // namespace
