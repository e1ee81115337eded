// SPDX-License-Identifier: BSD-3-Clause
// The command 'tipp check' with --quality.
#include "NpyText.h"
#include "RunTipp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace
{

using namespace tipp::test;
using Words = std::vector<std::string>;

/// A square with a point so near to one side that the triangle 0 has two angles of 26.57 degrees.
class TippQuality : public testing::Test
{
protected:
  TippQuality()
  {
    this->Folder.file(
      "square.poly", "4 2 0 0\n1 0 0\n2 4 0\n3 4 4\n4 0 4\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n");
    this->Folder.file("mesh.vtk",
      "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET POLYDATA\nPOINTS 5 double\n0 0 0 4 0 0 4 4 "
      "0 0 4 0 2 1 0\nPOLYGONS 4 16\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n");
  }

  Outcome check(const Words& more, const Words& files = { "mesh.vtk" }) const
  {
    Words arguments{ "check" };
    arguments.insert(arguments.end(), files.begin(), files.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runTipp(this->Folder, arguments);
  }

  void expect(int exitCode, const std::string& words, const Words& more,
    const Words& files = { "mesh.vtk" }) const
  {
    const Outcome outcome = this->check(more, files);
    EXPECT_EQ(exitCode, outcome.ExitCode) << outcome.Err;
    const std::string all = outcome.Out + outcome.Err;
    EXPECT_NE(std::string::npos, all.find(words)) << all;
  }

  /// Expects that a file of this text is refused as a list.
  void expectBadList(const std::string& text, const std::string& words) const
  {
    this->Folder.file("bad.json", text);
    this->expect(1, words, { "--quality", "30", "--listed", "bad.json" });
  }

  void writeNpy(
    const std::string& name, const std::string& shape, const std::vector<double>& values) const
  {
    this->Folder.file(name, npyBytes(npyHeader("<f8", shape), bytesOf(values)));
  }

  const TemporaryFolder Folder;
};

TEST_F(TippQuality, ProvesAMeshAndPrintsFigures)
{
  const Words arguments{ "--quality", "26.5", "--max-area", "6", "--constraints", "square.poly" };
  this->expect(0, "5 points, 4 triangles, 4 segments: correct", arguments);
  this->expect(0, "smallest angle 26.5650512 degrees (triangle 0)", arguments);
  this->expect(0, "largest area 6, largest ratio of areas across an edge 2", arguments);
  this->expect(0, "    25 to 30            1\n", arguments);
}

TEST_F(TippQuality, RefusesAThinTriangle)
{
  this->expect(1, "1 triangles have an angle below 26.6 degrees and are not excused",
    { "--quality", "26.6", "--constraints", "square.poly" });
}

TEST_F(TippQuality, RefusesALargeTriangle)
{
  this->expect(1, "1 triangles are above the limit on areas; the first is triangle 2",
    { "--quality", "20", "--max-area", "5.9" });
}

TEST_F(TippQuality, ReadsTheListOfExceptions)
{
  this->Folder.file("listed.json",
    R"({"below_bound": [{"triangle": 0, "angle": 26.5650512, "reason": "shortest edge"}]})");
  this->expect(0, "0 by input angles (proved); as listed, 1 by the shortest edge, 0 by rounding",
    { "--quality", "30", "--listed", "listed.json", "--constraints", "square.poly" });
}

TEST_F(TippQuality, ExcusesListedTrianglesAboveTheArea)
{
  this->Folder.file("large.json",
    R"({"below_bound": [{"triangle": 0, "angle": 26.5650512, "reason": "shortest edge"}],
        "above_area": [{"triangle": 2, "angle": 33.7, "area": 6, "reason": "shortest edge"}]})");
  this->expect(0, "1 listed triangles above the limit on areas",
    { "--quality", "30", "--max-area", "5.9", "--listed", "large.json" });
  this->Folder.file(
    "beyond.json", R"({"below_bound": [], "above_area": [{"triangle": 4, "area": 6}]})");
  this->expect(
    1, "entries of the list name no triangle", { "--quality", "20", "--listed", "beyond.json" });
  this->expectBadList(
    R"({"below_bound": [], "above_area": [{"area": 6}]})", "entry 0 of 'above_area' lacks");
}

TEST_F(TippQuality, ComparesWithANumberAsSize)
{
  // The largest area is 6, that of an equilateral triangle with the edge 3.7224.
  this->expect(0, "correct", { "--quality", "20", "--size", "3.723" });
  this->expect(
    1, "1 triangles are above the limit on areas", { "--quality", "20", "--size", "3.722" });
  this->expect(0, "correct", { "--quality", "20", "--size", "1", "--min-size", "3.723" });
  this->expect(1, "above the limit", { "--quality", "20", "--size", "9", "--max-size", "3.722" });
  // A degree of latitude has 111,195 m.
  this->expect(0, "correct", { "--quality", "20", "--size", "414000", "--geographic" });
  this->expect(1, "above the limit", { "--quality", "20", "--size", "413000", "--geographic" });
}

TEST_F(TippQuality, ComparesWithARasterOfSizes)
{
  std::vector<double> sizes;
  for (int i = 0; i < 60 * 40; ++i)
  {
    sizes.push_back(0.2 + 0.03 * std::hypot(i % 60 - 30, i / 60 - 20));
  }
  this->writeNpy("sizes.npy", "(40, 60)", sizes);
  std::for_each(sizes.begin(), sizes.end(), [](double& size) { size *= 0.8; });
  this->writeNpy("smaller.npy", "(40, 60)", sizes);
  const Words make{ "mesh", "square.poly", "-o", "sized.vtu", "--size", "sizes.npy", "--npy-bounds",
    "0", "4", "0", "4" };
  ASSERT_EQ(0, runTipp(this->Folder, make).ExitCode);
  Words against{ "--quality", "30", "--constraints", "square.poly", "--npy-bounds", "0", "4", "0",
    "4", "--size", "sizes.npy" };
  this->expect(0, "correct", against, { "sized.vtu" });
  against.back() = "smaller.npy";
  this->expect(1, "above the limit on areas", against, { "sized.vtu" });
}

TEST_F(TippQuality, RefusesSizesThatProveNothing)
{
  const Words here{ "--quality", "20", "--size", "sizes.npy", "--npy-bounds", "0", "4", "0", "4" };
  this->writeNpy("sizes.npy", "(1, 2)", { std::nan(""), std::nan("") });
  this->expect(1, "has no size", here);
  this->writeNpy("sizes.npy", "(1, 2)", { 9, -9999 });
  this->expect(1, "has the size -9999", here);
  this->writeNpy("sizes.npy", "(1, 2)", { 9, 9 });
  this->expect(1, "lies outside of the mesh",
    { "--quality", "20", "--size", "sizes.npy", "--npy-bounds", "500", "504", "0", "4" });
  this->expect(2, "is empty", { "--quality", "20", "--size", "" });
  this->expect(2, "must not be above --max-size",
    { "--quality", "20", "--size", "9", "--min-size", "5", "--max-size", "1" });
  this->Folder.file("far.vtk",
    "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET POLYDATA\nPOINTS 3 double\n0 0 0 4 0 0 0 "
    "100 0\nPOLYGONS 1 4\n3 0 1 2\n");
  this->expect(
    1, "is no latitude", { "--quality", "1", "--size", "9", "--geographic" }, { "far.vtk" });
}

TEST_F(TippQuality, SizesOfNpyFilesNeedBounds)
{
  this->writeNpy("sizes.npy", "(1, 1)", { 3 });
  this->expect(2, "give --npy-bounds", { "--quality", "20", "--size", "sizes.npy" });
  this->expect(2, "needs --size with an .npy file",
    { "--quality", "20", "--size", "3", "--npy-bounds", "0", "1", "0", "1" });
  this->expect(1, "has no extension that tells a kind of raster",
    { "--quality", "20", "--size", "square.poly" });
}

TEST_F(TippQuality, CountsWhatTheUserHasForbidden)
{
  this->Folder.file("kept.json",
    R"({"below_bound": [{"triangle": 0, "angle": 26.5650512, "reason": "kept segments"}]})");
  this->expect(0, "1 by kept segments and 0 by the most points",
    { "--quality", "30", "--listed", "kept.json", "--constraints", "square.poly" });
  this->Folder.file("most.json",
    R"({"below_bound": [{"triangle": 0, "angle": 26.5650512, "reason": "most points"}]})");
  this->expect(0, "0 by kept segments and 1 by the most points",
    { "--quality", "30", "--listed", "most.json", "--constraints", "square.poly" });
}

TEST_F(TippQuality, RefusesADamagedList)
{
  this->expectBadList("{", "is no JSON with a list 'below_bound'");
  this->expectBadList("[]", "is no JSON with a list 'below_bound'");
  this->expectBadList(R"({"below_bound": 1})", "is no JSON with a list 'below_bound'");
  this->expectBadList(R"({"below_bound": [1]})", "entry 0 of 'below_bound' lacks a 'triangle'");
  this->expectBadList(R"({"below_bound": [{"triangle": 1.5, "angle": 1, "reason": "rounding"}]})",
    "entry 0 of 'below_bound' lacks a 'triangle'");
  this->expectBadList(R"({"below_bound": [{"triangle": 0, "angle": 1, "reason": "luck"}]})",
    "entry 0 of 'below_bound' has the reason 'luck'");
  this->expect(1, "none.json", { "--quality", "30", "--listed", "none.json" });
}

TEST_F(TippQuality, TakesPointsBeforeTheMesh)
{
  this->Folder.file("points.csv", "x,y\n0,0\n4,0\n4,4\n0,4\n3,2\n");
  this->expect(1,
    "1 points of the input are inside of the mesh, but no vertices; the first is "
    "point 4",
    { "--quality", "20" }, { "points.csv", "mesh.vtk" });
}

TEST_F(TippQuality, CombinesFilesOfConstraints)
{
  this->Folder.file("line.csv", "x1,y1,x2,y2\n0,0,4,4\n");
  this->expect(1, "1 segments are not chains of edges; the first is segment 4",
    { "--quality", "20", "--constraints", "square.poly", "--constraints", "line.csv" });
}

TEST_F(TippQuality, ConstraintsByNumberNeedPoints)
{
  this->Folder.file("ids.csv", "a,b\n0,1\n");
  this->expect(1, "give the file of these points before the mesh",
    { "--quality", "20", "--constraints", "ids.csv" });
  this->expect(1, "cannot be combined",
    { "--quality", "20", "--constraints", "square.poly", "--constraints", "ids.csv" });
}

TEST_F(TippQuality, SaysIfNoInputIsGiven)
{
  this->expect(0, "the mesh's border is not checked", { "--quality", "20" });
}

TEST_F(TippQuality, RefusesOtherAngles)
{
  this->expect(2, "is no number of degrees", { "--quality", "steep" });
  this->expect(2, "is above 60 degrees", { "--quality", "61" });
}

TEST_F(TippQuality, RefusesMisplacedOptions)
{
  this->expect(2, "--quality", { "--max-area", "1" });
  this->expect(2, "--quality", { "--listed", "listed.json" });
  this->expect(2, "--tie-rule", { "--quality", "20", "--tie-rule" });
  this->expect(2, "mesh is required", {});
}

TEST_F(TippQuality, RefusesOtherMeshes)
{
  std::filesystem::create_directory(this->Folder.path("mesh.tipp"));
  this->expect(1, "which --quality cannot read", { "--quality", "20" }, { "mesh.tipp" });
  this->Folder.file("tetrahedron.vtk",
    "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0 1 "
    "0 "
    "0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n");
  this->expect(1, "has tetrahedra", { "--quality", "20" }, { "tetrahedron.vtk" });
}

} // namespace
