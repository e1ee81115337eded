// SPDX-License-Identifier: BSD-3-Clause
// The command 'tipp mesh'.
#include "RunTipp.h"

#include "Files/Formats.h"
#include "Meshes/MeshFiles.h"
#include "Points/ReadPoints.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

namespace
{

using namespace tipp::test;
using Words = std::vector<std::string>;

constexpr double lakeArea = 1150; // with the island
constexpr double islandArea = 32;

/// A lake with an island, as lines, and as a polygon of a GIS.
class TippMesh : public testing::Test
{
protected:
  TippMesh()
  {
    const std::string vertices =
      "12 2 0 0\n1 5 0\n2 35 0\n3 40 5\n4 40 25\n5 35 30\n6 5 30\n7 0 25\n8 0 5\n9 16 15\n"
      "10 20 19\n11 24 15\n12 20 11\n";
    const std::string segments = "12 0\n1 1 2\n2 2 3\n3 3 4\n4 4 5\n5 5 6\n6 6 7\n7 7 8\n8 8 1\n9 "
                                 "9 10\n10 10 11\n11 11 12\n12 12 9\n";
    this->Folder.file("lake.poly", vertices + segments + "1\n1 20 15\n");
    this->Folder.file("lines.poly", vertices + segments + "0\n");
    this->Folder.file("lake.geojson",
      R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {},
        "geometry": {"type": "Polygon", "coordinates": [
          [[5,0],[35,0],[40,5],[40,25],[35,30],[5,30],[0,25],[0,5],[5,0]],
          [[16,15],[20,19],[24,15],[20,11],[16,15]]]}}]})");
  }

  static Words with(Words words, const Words& more)
  {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  Outcome run(const Words& words) const { return runTipp(this->Folder, with({ "mesh" }, words)); }

  /// Meshes the lake, which must succeed. Returns what is printed to stdout and stderr.
  std::string make(
    const std::string& output, const Words& more = {}, const std::string& input = "lake.poly") const
  {
    const Outcome outcome = this->run(with({ input, "-o", output, "--stats", "stats.json" }, more));
    EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
    return outcome.Out + outcome.Err;
  }

  nlohmann::json stats() const
  {
    return nlohmann::json::parse(contentOf(this->Folder.path("stats.json")));
  }

  /// Expects that 'tipp check' proves the mesh with its list of exceptions. `files`: of points, if
  /// there are any, and the mesh.
  std::string prove(const Words& files, const Words& more = { "--constraints", "lake.poly" }) const
  {
    const Outcome outcome = runTipp(this->Folder,
      with(with({ "check" }, files), with({ "--quality", "30", "--listed", "stats.json" }, more)));
    EXPECT_EQ(0, outcome.ExitCode) << outcome.Out << outcome.Err;
    EXPECT_NE(std::string::npos, outcome.Out.find("correct")) << outcome.Out;
    return outcome.Out;
  }

  void expectFailure(int exitCode, const std::string& words, const Words& arguments) const
  {
    const Outcome outcome = this->run(arguments);
    EXPECT_EQ(exitCode, outcome.ExitCode) << outcome.Out << outcome.Err;
    EXPECT_NE(std::string::npos, outcome.Err.find(words)) << outcome.Err;
  }

  /// Expects that the options are refused, and that the message names one of them.
  void expectUsageError(const std::string& option, const std::string& words, const Words& more,
    const std::string& output = "out.vtu") const
  {
    const Words arguments = with({ "lake.poly", "-o", output }, more);
    this->expectFailure(2, option, arguments);
    this->expectFailure(2, words, arguments);
  }

  /// Corners of each triangle.
  std::vector<std::array<std::array<double, 2>, 3>> triangles(const std::string& name) const
  {
    const tipp::TriangleMesh mesh = tipp::readMesh(this->Folder.path(name));
    std::vector<std::array<std::array<double, 2>, 3>> triangles(mesh.Triangles.size() / 3);
    for (std::size_t i = 0; i < mesh.Triangles.size(); ++i)
    {
      const double* const p = &mesh.XY[2 * std::size_t(mesh.Triangles[i])];
      triangles[i / 3][i % 3] = { p[0], p[1] };
    }
    return triangles;
  }

  static double areaOf(const std::array<std::array<double, 2>, 3>& p)
  {
    return ((p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0])) /
      2;
  }

  double area(const std::string& name) const
  {
    double sum = 0;
    for (const auto& triangle : this->triangles(name))
    {
      sum += areaOf(triangle);
    }
    return sum;
  }

  /// The largest area of the triangles whose centroids are between two x.
  double largestArea(const std::string& name, double from, double to) const
  {
    double largest = 0;
    for (const auto& p : this->triangles(name))
    {
      const double x = (p[0][0] + p[1][0] + p[2][0]) / 3;
      largest = x > from && x < to ? std::max(largest, areaOf(p)) : largest;
    }
    return largest;
  }

  /// The largest area that a size allows.
  static double areaFor(double size) { return std::sqrt(3.0) / 4 * size * size; }

  std::vector<double> column(const std::string& name, const std::string& title) const
  {
    for (const auto& column : tipp::readPoints(this->Folder.path(name)).Columns)
    {
      if (column.Name == title)
      {
        return column.Values;
      }
    }
    return {};
  }

  /// Writes a raster of 10 x 8 pixels of 5 x 5 around the lake, with one value per column.
  template <typename Value>
  void writeRaster(const std::string& name, const Value& value) const
  {
    std::string text = "ncols 10\nnrows 8\nxllcorner -5\nyllcorner -5\ncellsize 5\nNODATA_value "
                       "-9999\n";
    for (int row = 0; row < 8; ++row)
    {
      for (int column = 0; column < 10; ++column)
      {
        text += fmt::format("{} ", value(-2.5 + 5 * column));
      }
      text += "\n";
    }
    this->Folder.file(name, text);
  }

  static bool hasGdal()
  {
    return tipp::formatOf("x.asc", tipp::Use::Rasters) &&
      tipp::formatOf("x.geojson", tipp::Use::Constraints);
  }

  const TemporaryFolder Folder;
};

TEST_F(TippMesh, EveryFormatHoldsAMeshThatIsProved)
{
  for (const std::string name : { "mesh.vtu", "mesh.vtp", "mesh.14", "mesh.grd", "mesh.gr3",
         "mesh.2dm", "mesh.msh", "mesh.node" })
  {
    this->make(name, { "--max-area", "9" });
    EXPECT_DOUBLE_EQ(lakeArea - islandArea, this->area(name)) << name;
    this->prove({ name }, { "--constraints", "lake.poly", "--max-area", "9" });
  }
}

TEST_F(TippMesh, FilesOfTriangleListTheSegments)
{
  this->make("mesh.node", { "--max-area", "9" });
  // The segments of the mesh, with the vertices in mesh.node, are segments of the lake.
  this->prove({ "mesh.node" }, { "--constraints", "mesh.poly" });
  EXPECT_EQ(
    this->make("again.vtu", { "--max-area", "9" }, "mesh.poly").find("warning"), std::string::npos);
}

TEST_F(TippMesh, PolygonsOfAGisAreTheDomain)
{
  if (!hasGdal())
  {
    GTEST_SKIP() << "built without GDAL";
  }
  this->make("mesh.vtu", {}, "lake.geojson");
  EXPECT_DOUBLE_EQ(lakeArea - islandArea, this->area("mesh.vtu"));
  this->prove({ "mesh.vtu" }, { "--constraints", "lake.geojson" });
}

TEST_F(TippMesh, LinesEncloseTheDomain)
{
  this->make("mesh.vtu", {}, "lines.poly");
  EXPECT_DOUBLE_EQ(lakeArea, this->area("mesh.vtu"));
}

TEST_F(TippMesh, HolesAreGivenByPoints)
{
  this->make("mesh.vtu", { "--hole", "20", "15" }, "lines.poly");
  EXPECT_DOUBLE_EQ(lakeArea - islandArea, this->area("mesh.vtu"));
  this->prove({ "mesh.vtu" });
}

TEST_F(TippMesh, ConvexHullIsTheDomainOnRequest)
{
  this->Folder.file("far.csv", "x,y\n60,15\n");
  this->make("mesh.vtu", { "--convex", "--points", "far.csv" }, "lines.poly");
  EXPECT_DOUBLE_EQ(1025 + 375, this->area("mesh.vtu"));
}

TEST_F(TippMesh, BoundaryCutsTheDomain)
{
  this->Folder.file("half.csv", "x1,y1,x2,y2\n2,8,30,8\n30,8,30,22\n30,22,2,22\n2,22,2,8\n");
  this->make("mesh.vtu", { "--boundary", "half.csv" });
  EXPECT_DOUBLE_EQ(28 * 14 - islandArea, this->area("mesh.vtu"));
}

TEST_F(TippMesh, GivenPointsAreVertices)
{
  this->Folder.file("wells.csv", "x,y\n10,10\n30.5,20.25\n20,15\n90,90\n");
  this->make("mesh.vtu", { "--points", "wells.csv" });
  EXPECT_EQ(2, this->stats()["points_left_out"]) << "one is on the island, one is far away";
  this->prove({ "wells.csv", "mesh.vtu" });
}

TEST_F(TippMesh, SeveralFilesOfPointsAreGivenBeforeTheInput)
{
  this->Folder.file("a.csv", "x,y\n10,10\n");
  this->Folder.file("b.csv", "x,y\n30,20\n");
  const Outcome outcome = this->run({ "--points", "a.csv", "--points", "b.csv", "lake.poly", "-o",
    "mesh.vtu", "--stats", "stats.json" });
  ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  EXPECT_EQ(14, this->stats()["points_given"]);
}

TEST_F(TippMesh, ColumnsOfPointsAreInterpolated)
{
  this->Folder.file("wells.csv", "x,y,level\n0,5,2\n40,5,10\n40,25,10\n0,25,2\n");
  this->Folder.file("box.poly",
    "4 2 0 0\n1 0 5\n2 40 5\n3 40 25\n4 0 25\n4 0\n1 1 2\n2 2 3\n3 3 "
    "4\n4 4 1\n0\n");
  this->make("mesh.vtu", { "--points", "wells.csv", "--max-area", "9" }, "box.poly");
  const tipp::PointTable points = tipp::readPoints(this->Folder.path("mesh.vtu"));
  const std::vector<double> levels = this->column("mesh.vtu", "level");
  ASSERT_EQ(points.size(), levels.size());
  for (std::size_t i = 0; i < levels.size(); ++i)
  {
    EXPECT_NEAR(2 + points.XY[2 * i] / 5, levels[i], 1e-9);
  }
}

TEST_F(TippMesh, AreaLimitHoldsInARegion)
{
  this->Folder.file("halves.poly",
    "6 2 0 0\n1 0 0\n2 20 0\n3 40 0\n4 40 30\n5 20 30\n6 0 30\n7 0\n1 1 2\n2 2 3\n3 3 4\n4 4 5\n5 "
    "5 "
    "6\n6 6 1\n7 2 5\n0\n");
  this->make(
    "mesh.vtu", { "--region", "5", "5", "2", "--region", "30", "5", "inf" }, "halves.poly");
  EXPECT_LE(this->largestArea("mesh.vtu", 0, 20), 2);
  EXPECT_GT(this->largestArea("mesh.vtu", 20, 40), 2);
}

TEST_F(TippMesh, AreasOfRegionsAreReadFromPolyFiles)
{
  const std::string graph = "6 2 0 0\n1 0 0\n2 4 0\n3 8 0\n4 8 4\n5 4 4\n6 0 4\n"
                            "7 0\n1 1 2\n2 2 3\n3 3 4\n4 4 5\n5 5 6\n6 6 1\n7 2 5\n0\n";
  this->Folder.file("parts.poly", graph + "2\n1 1 1 7 0.1\n2 7 1 3 -1\n");
  this->make("parts.vtu", { "--regions", "parts.poly" }, "parts.poly");
  EXPECT_LE(this->largestArea("parts.vtu", 0, 4), 0.1);
  EXPECT_GT(this->largestArea("parts.vtu", 4, 8), 0.5);
  this->Folder.file("parts.poly", graph + "1\n1 7 1 0.2\n"); // an attribute that is the area
  this->make("parts.vtu", { "--regions", "parts.poly" }, "parts.poly");
  EXPECT_LE(this->largestArea("parts.vtu", 4, 8), 0.2);
  this->Folder.file("parts.csv", "x,y,size\n1,1,0.5\n7,1,inf\n");
  this->make("parts.vtu", { "--regions", "parts.csv" }, "parts.poly");
  EXPECT_LE(this->largestArea("parts.vtu", 0, 4), std::sqrt(3) / 4 * 0.25);
  EXPECT_GT(this->largestArea("parts.vtu", 4, 8), 0.5);
}

TEST_F(TippMesh, FilesOfRegionsMustHaveLimits)
{
  this->expectFailure(
    1, "lake.poly: lists no regions", { "lake.poly", "-o", "out.vtu", "--regions", "lake.poly" });
  this->Folder.file("regions.csv", "x,y,depth\n20,2,3\n");
  this->expectFailure(1, "regions.csv: has no column 'area' or 'size'",
    { "lake.poly", "-o", "out.vtu", "--regions", "regions.csv" });
  this->Folder.file("regions.csv", "x,y,area\n20,2,-1\n");
  this->expectFailure(1, "regions.csv: has the area -1 at point 0",
    { "lake.poly", "-o", "out.vtu", "--regions", "regions.csv" });
}

TEST_F(TippMesh, PolygonsThatCrossThemselvesAreAWarning)
{
  if (!hasGdal())
  {
    GTEST_SKIP() << "built without GDAL";
  }
  this->Folder.file(
    "bow.geojson", R"({"type": "Polygon", "coordinates": [[[0,0],[6,6],[6,0],[0,4],[0,0]]]})");
  EXPECT_NE(std::string::npos,
    this->make("bow.vtu", {}, "bow.geojson").find("repair it if it crosses itself"));
}

TEST_F(TippMesh, BorderIsKeptOnRequest)
{
  this->make("mesh.14", { "--max-area", "9", "--keep-border" });
  EXPECT_EQ(0, this->stats()["segment_splits"]);
  EXPECT_EQ("kept segments", this->stats()["below_bound"][0]["reason"]);
  const std::string text = this->prove({ "mesh.14" });
  EXPECT_EQ(std::string::npos, text.find("0 by kept segments")) << text;
}

TEST_F(TippMesh, SegmentsAreKeptOnRequest)
{
  this->make("mesh.vtu", { "--max-area", "9", "--keep-segments" });
  EXPECT_EQ(0, this->stats()["segment_splits"]);
  this->prove({ "mesh.vtu" });
}

TEST_F(TippMesh, AddsAtMostSoManyPoints)
{
  this->make("mesh.vtu", { "--max-area", "1", "--max-points", "10" });
  EXPECT_EQ(10, this->stats()["points_added"]);
  EXPECT_EQ("most points", this->stats()["above_area"][0]["reason"]);
  this->prove({ "mesh.vtu" });
}

TEST_F(TippMesh, ShortestEdgeEndsRefinement)
{
  this->make("mesh.vtu", { "--max-area", "1", "--min-edge", "4" });
  EXPECT_EQ("shortest edge", this->stats()["above_area"][0]["reason"]);
  this->prove({ "mesh.vtu" });
}

TEST_F(TippMesh, SharpInputAnglesAreListed)
{
  this->Folder.file("wedge.poly", "3 2 0 0\n1 0 0\n2 40 0\n3 40 8\n3 0\n1 1 2\n2 2 3\n3 3 1\n0\n");
  const std::string text = this->make("mesh.vtu", {}, "wedge.poly");
  EXPECT_NE(std::string::npos, text.find("because segments of the input meet below 60")) << text;
  EXPECT_EQ("input angle", this->stats()["below_bound"][0]["reason"]);
  this->prove({ "mesh.vtu" }, { "--constraints", "wedge.poly" });
}

TEST_F(TippMesh, SizeIsTheEdgeOfAnEquilateralTriangle)
{
  this->make("mesh.vtu", { "--size", "2" });
  this->prove({ "mesh.vtu" }, { "--max-area", "1.7320508075688774" });
  this->make("coarse.vtu", { "--size", "2", "--max-area", "100" });
  EXPECT_EQ(this->triangles("mesh.vtu"), this->triangles("coarse.vtu")) << "the smaller one holds";
}

TEST_F(TippMesh, SizesOfARasterHoldWhereItIs)
{
  if (!hasGdal())
  {
    GTEST_SKIP() << "built without GDAL";
  }
  this->writeRaster("size.asc", [](double x) { return x < 20 ? 1 : 6; });
  this->make("mesh.vtu", { "--size", "size.asc" });
  EXPECT_LE(this->largestArea("mesh.vtu", 0, 15), 1.0001 * areaFor(1));
  EXPECT_GT(this->largestArea("mesh.vtu", 25, 40), areaFor(3));
}

TEST_F(TippMesh, NpyFilesAreRastersWithBounds)
{
  // 2 x 2 pixels from the south-west: sizes or depths.
  std::string bytes = "\x93NUMPY\x01";
  bytes += '\0';
  const std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2), }";
  bytes += std::string{ char(118), '\0' } + header + std::string(117 - header.size(), ' ') + "\n";
  const std::array<double, 4> values{ 2, 8, 2, 8 };
  bytes.append(reinterpret_cast<const char*>(values.data()), sizeof(values));
  this->Folder.file("west.npy", bytes);
  const Words bounds{ "--npy-bounds", "0", "40", "0", "30" };
  this->make("sized.vtu", with({ "--size", "west.npy" }, bounds));
  EXPECT_LE(this->largestArea("sized.vtu", 0, 10), std::sqrt(3) / 4 * 4 * 1.1);
  EXPECT_GT(this->largestArea("sized.vtu", 25, 40), std::sqrt(3) / 4 * 4 * 1.5);
  this->make("deep.14", with({ "--depth", "west.npy", "--depth-at-nodes" }, bounds));
  this->expectUsageError("--npy-bounds", "needs --size or --depth with an .npy file", bounds);
  this->expectUsageError("--npy-bounds", "which is no range",
    { "--size", "west.npy", "--npy-bounds", "40", "0", "0", "30" });
}

TEST_F(TippMesh, SizesOfPointsAreInAColumn)
{
  this->Folder.file("sizes.csv",
    "x,y,fine,coarse\n-1,-1,1,4\n19,-1,1,4\n41,-1,8,4\n-1,31,1,4\n19,31,1,4\n41,31,8,4\n");
  this->make("mesh.vtu", { "--size", "sizes.csv", "--size-column", "fine" });
  EXPECT_LE(this->largestArea("mesh.vtu", 0, 18), 1.0001 * areaFor(1));
  EXPECT_GT(this->largestArea("mesh.vtu", 30, 40), areaFor(3));
  this->expectFailure(1, "sizes.csv",
    { "lake.poly", "-o", "out.vtu", "--size", "sizes.csv", "--size-column", "none" });
}

TEST_F(TippMesh, SizesGrowFromTheShore)
{
  this->make("mesh.vtu", { "--dis", "0.3", "--min-size", "1", "--max-size", "3" });
  this->make("fine.vtu", { "--size", "1" });
  this->make("coarse.vtu", { "--size", "3" });
  const std::size_t count = this->triangles("mesh.vtu").size();
  EXPECT_LT(count, this->triangles("fine.vtu").size());
  EXPECT_GT(count, this->triangles("coarse.vtu").size());
  EXPECT_LE(this->largestArea("mesh.vtu", 0, 40), 1.0001 * areaFor(3));
  EXPECT_LE(this->largestArea("mesh.vtu", 0, 1), areaFor(1.4));
}

TEST_F(TippMesh, GradationLimitsHowFastSizesGrow)
{
  this->Folder.file("jump.csv",
    "x,y,size\n-1,-1,1\n2,-1,1\n3,-1,9\n41,-1,9\n-1,31,1\n2,31,1\n3,31,9\n41,"
    "31,9\n");
  this->make("steep.vtu", { "--size", "jump.csv" });
  this->make("mild.vtu", { "--size", "jump.csv", "--g", "0.15" });
  EXPECT_GT(this->largestArea("steep.vtu", 8, 12), areaFor(1 + 0.15 * 12));
  EXPECT_LE(this->largestArea("mild.vtu", 8, 12), areaFor(1 + 0.15 * 12));
}

TEST_F(TippMesh, DeepWaterAllowsLongEdges)
{
  if (!hasGdal())
  {
    GTEST_SKIP() << "built without GDAL";
  }
  // 12.42 h * 3600 s/h * sqrt(9.81 m/s^2 * depth) is 140,042 m for 1 m of water.
  this->writeRaster("depth.asc", [](double x) { return x < 20 ? 1 : 16; });
  this->make("mesh.vtu", { "--wl", "100000", "--depth", "depth.asc" });
  EXPECT_LE(this->largestArea("mesh.vtu", 0, 15), areaFor(1.401));
  EXPECT_GT(this->largestArea("mesh.vtu", 25, 40), areaFor(2.5));
  EXPECT_LE(this->largestArea("mesh.vtu", 25, 40), areaFor(4 * 1.401));
}

TEST_F(TippMesh, SteepSlopesNeedShortEdges)
{
  if (!hasGdal())
  {
    GTEST_SKIP() << "built without GDAL";
  }
  this->writeRaster("depth.asc", [](double x) { return x < 20 ? 10 : 10 + 2 * (x - 20); });
  this->make(
    "mesh.vtu", { "--slp", "20", "--depth", "depth.asc", "--min-size", "1", "--max-size", "5" });
  EXPECT_GT(this->largestArea("mesh.vtu", 0, 15), areaFor(3));
  EXPECT_LE(this->largestArea("mesh.vtu", 25, 28), areaFor(5));
}

TEST_F(TippMesh, DepthsComeFromARaster)
{
  if (!hasGdal())
  {
    GTEST_SKIP() << "built without GDAL";
  }
  this->writeRaster("dem.asc", [](double x) { return -10 - x; });
  const Words more{ "--size", "3", "--depth", "dem.asc", "--positive-up", "--depth-at-nodes" };
  for (const std::string name : { "mesh.14", "mesh.vtu" })
  {
    this->make(name, more);
    const tipp::PointTable points = tipp::readPoints(this->Folder.path(name));
    const std::vector<double> depths = this->column(name, "depth");
    ASSERT_EQ(points.size(), depths.size());
    for (std::size_t i = 0; i < depths.size(); ++i)
    {
      EXPECT_NEAR(10 + points.XY[2 * i], depths[i], 1e-9);
    }
    EXPECT_EQ(depths.size(), this->stats()["depths"]["at_nodes"]);
  }
}

TEST_F(TippMesh, DepthsAreMeansOfPointsInCells)
{
  std::string soundings = "x,y,depth\n";
  for (int i = 0; i <= 80; ++i)
  {
    for (int k = 0; k <= 60; ++k)
    {
      soundings += fmt::format("{},{},{}\n", i / 2.0, k / 2.0, 5 + i / 2.0);
    }
  }
  this->Folder.file("soundings.csv", soundings);
  this->make("mesh.gr3", { "--size", "4", "--depth", "soundings.csv" });
  const tipp::PointTable points = tipp::readPoints(this->Folder.path("mesh.gr3"));
  const std::vector<double> depths = this->column("mesh.gr3", "depth");
  ASSERT_EQ(points.size(), depths.size());
  for (std::size_t i = 0; i < depths.size(); ++i)
  {
    EXPECT_NEAR(5 + points.XY[2 * i], depths[i], 2);
  }
  EXPECT_EQ(depths.size(), this->stats()["depths"]["from_cells"]);
}

TEST_F(TippMesh, DepthsElsewhereAreRefused)
{
  this->Folder.file("far.csv", "x,y,depth\n900,900,1\n901,900,2\n900,901,3\n");
  for (const std::string name : { "mesh.14", "mesh.vtu" })
  {
    this->expectFailure(
      1, "far.csv: has no depth at any node", { "lake.poly", "-o", name, "--depth", "far.csv" });
  }
  this->Folder.file("blank.csv", "x,y,z\n10,10,1\n11,10,2\n10,11,3\n");
  this->expectFailure(1,
    "blank.csv: has no column 'depth'; there are 'z'; name one by --depth-column",
    { "lake.poly", "-o", "mesh.14", "--depth", "blank.csv" });
}

TEST_F(TippMesh, ModelsNeedADepthAtEveryNode)
{
  this->Folder.file("ponds.poly",
    "8 2 0 0\n1 0 0\n2 9 0\n3 9 9\n4 0 9\n5 20 0\n6 29 0\n7 29 9\n8 20 9\n8 0\n1 1 2\n2 2 3\n3 3 "
    "4\n4 4 "
    "1\n5 5 6\n6 6 7\n7 7 8\n8 8 5\n0\n");
  this->Folder.file("one.csv", "x,y,depth\n4,4,1\n5,4,2\n4,5,3\n");
  this->expectFailure(1, "has no depths in the parts of the mesh of",
    { "ponds.poly", "-o", "mesh.14", "--depth", "one.csv" });
  const std::string text = this->make("mesh.vtu", { "--depth", "one.csv" }, "ponds.poly");
  EXPECT_NE(std::string::npos, text.find("nodes have the depth NaN")) << text;
  EXPECT_GT(this->stats()["depths"]["missing"], 0);
}

TEST_F(TippMesh, ShoresBecomeMainlandAndIslands)
{
  this->make("mesh.14", { "--size", "3" });
  const std::string text = contentOf(this->Folder.path("mesh.14"));
  EXPECT_NE(std::string::npos, text.find("\n0 = number of open boundaries"));
  EXPECT_NE(std::string::npos, text.find("\n2 = number of land boundaries"));
  EXPECT_NE(std::string::npos, text.find(" 20 = number of nodes and kind of this land boundary"));
  EXPECT_NE(std::string::npos, text.find(" 21 = number of nodes and kind of this land boundary"));
}

TEST_F(TippMesh, PolygonChoosesTheOpenBoundary)
{
  this->Folder.file("sea.poly",
    "4 2 0 0\n1 39 -1\n2 41 -1\n3 41 31\n4 39 31\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n");
  for (const std::string name : { "mesh.14", "mesh.gr3" })
  {
    this->make(name, { "--size", "3", "--open", "sea.poly" });
    const std::string text = contentOf(this->Folder.path(name));
    EXPECT_NE(std::string::npos, text.find("\n1 = number of open boundaries")) << name;
  }
}

/// The lines may come in any order and direction.
TEST_F(TippMesh, ClosedLinesChooseTheOpenBoundary)
{
  this->Folder.file("sea.csv", "x1,y1,x2,y2\n39,-1,41,-1\n39,31,39,-1\n41,31,41,-1\n39,31,41,31\n");
  const std::string text = this->make("mesh.14", { "--size", "3", "--open", "sea.csv" });
  EXPECT_EQ(std::string::npos, text.find("warning")) << text;
  EXPECT_NE(std::string::npos,
    contentOf(this->Folder.path("mesh.14")).find("\n1 = number of open boundaries"));
}

TEST_F(TippMesh, NoOpenBoundaryIsAWarning)
{
  this->Folder.file("far.csv", "x1,y1,x2,y2\n90,0,99,0\n99,0,90,9\n90,9,90,0\n");
  const std::string text = this->make("mesh.14", { "--size", "3", "--open", "far.csv" });
  EXPECT_NE(std::string::npos, text.find("there is no open boundary")) << text;
}

TEST_F(TippMesh, DeepBorderIsOpen)
{
  if (!hasGdal())
  {
    GTEST_SKIP() << "built without GDAL";
  }
  this->writeRaster("depth.asc", [](double x) { return x; });
  this->make("mesh.14", { "--size", "3", "--depth", "depth.asc", "--open-deeper", "36" });
  const std::string text = contentOf(this->Folder.path("mesh.14"));
  EXPECT_NE(std::string::npos, text.find("\n1 = number of open boundaries"));
}

TEST_F(TippMesh, OrderIsKeptOnRequest)
{
  this->make("mesh.vtu", { "--size", "2", "--keep-order" });
  const std::int64_t before = this->stats()["bandwidth"];
  const tipp::PointTable points = tipp::readPoints(this->Folder.path("mesh.vtu"));
  EXPECT_EQ((std::vector<double>{ 5, 0, 35, 0, 40, 5 }),
    std::vector<double>(points.XY.begin(), points.XY.begin() + 6));
  this->make("ordered.vtu", { "--size", "2" });
  EXPECT_LT(this->stats()["bandwidth"], before);
  this->prove({ "ordered.vtu" });
}

TEST_F(TippMesh, StatisticsHaveAllFigures)
{
  this->make("mesh.vtu", { "--max-area", "3" });
  const nlohmann::json stats = this->stats();
  for (const char* const name :
    { "points", "triangles", "points_given", "points_left_out", "points_added", "segment_splits",
      "levels", "rounds", "blocks", "bandwidth", "mesh_seconds", "peak_memory_bytes" })
  {
    EXPECT_TRUE(stats[name].is_number()) << name;
  }
  EXPECT_EQ("lake.poly", stats["input"]);
  EXPECT_EQ("mesh.vtu", stats["output"]);
  EXPECT_EQ(12, stats["points_given"]);
  EXPECT_EQ(stats["points"], 12 + stats["points_added"].get<int>());
  EXPECT_EQ(stats["triangles"], this->triangles("mesh.vtu").size());
  EXPECT_TRUE(stats["below_bound"].is_array());
  EXPECT_TRUE(stats["above_area"].is_array());
}

TEST_F(TippMesh, SmoothedMeshesAreProvedAndTheSameForAnyThreads)
{
  this->make("one.vtu", { "--max-area", "1", "--smooth", "5", "--threads", "1" });
  this->make("four.vtu", { "--max-area", "1", "--threads", "4", "--smooth" }); // 5 by default
  EXPECT_GT(this->stats()["moves"], 0);
  this->prove({ "four.vtu" }, { "--constraints", "lake.poly", "--max-area", "1" });
  EXPECT_EQ(contentOf(this->Folder.path("one.vtu")), contentOf(this->Folder.path("four.vtu")));
  this->expectUsageError("--smooth", "--smooth", { "--smooth", "0" });
}

TEST_F(TippMesh, ResultIsTheSameForAnyNumberOfThreads)
{
  this->Folder.file("sizes.csv", "x,y,size\n-1,-1,.1\n41,-1,.5\n-1,31,.5\n41,31,.1\n30,20,.3\n");
  const Words more{ "--size", "sizes.csv", "--depth", "sizes.csv", "--depth-column", "size" };
  this->make("one.14", with(more, { "--threads", "1" }));
  for (const char* const threads : { "2", "5" })
  {
    this->make("more.14", with(more, { "--threads", threads }));
    EXPECT_EQ(contentOf(this->Folder.path("one.14")), contentOf(this->Folder.path("more.14")))
      << threads;
  }
}

TEST_F(TippMesh, NothingEnclosedWritesNoFile)
{
  this->Folder.file("open.csv", "x1,y1,x2,y2\n0,0,9,0\n9,0,9,9\n9,9,1,9\n");
  this->expectFailure(1, "open.csv: leaves nothing to mesh", { "open.csv", "-o", "mesh.vtu" });
  EXPECT_FALSE(std::ifstream(this->Folder.path("mesh.vtu")));
}

TEST_F(TippMesh, AnotherGraphIsNotReplaced)
{
  this->Folder.file("mine.poly", "0 2 0 0\n0 0\n0\n");
  this->expectFailure(1, "mine.poly: would be replaced", { "lake.poly", "-o", "mine.node" });
}

TEST_F(TippMesh, HolesOfPolygonsAreInTheGraph)
{
  if (!hasGdal())
  {
    GTEST_SKIP() << "built without GDAL";
  }
  // Three holes, two of which touch at a corner, and an island in the third one.
  this->Folder.file("holes.geojson",
    R"({"type": "MultiPolygon", "coordinates": [
      [[[0,0],[40,0],[40,30],[0,30],[0,0]], [[4,4],[8,6],[4,8],[4,4]], [[8,6],[12,4],[12,8],[8,6]],
       [[20,10],[36,10],[36,26],[20,26],[20,10]]],
      [[[24,14],[32,14],[32,22],[24,22],[24,14]]]]})");
  this->make("again.node", {}, "holes.geojson");
  EXPECT_NEAR(1200 - 8 - 8 - 256 + 64, this->area("again.node"), 1e-9);
  this->make("second.node", {}, "again.poly");
  EXPECT_NEAR(this->area("again.node"), this->area("second.node"), 1e-9);
  this->prove({ "second.node" }, { "--constraints", "again.poly" });
}

TEST_F(TippMesh, PointsInHolesAreInTheGraph)
{
  this->make("again.node");
  this->make("second.node", {}, "again.poly");
  this->prove({ "second.node" }, { "--constraints", "again.poly" });
  EXPECT_NEAR(this->area("again.node"), this->area("second.node"), 1e-9);
}

TEST_F(TippMesh, AreasThatCannotFitAreRefusedAtOnce)
{
  this->expectFailure(
    1, "ask for about", { "lake.poly", "-o", "mesh.vtu", "--max-area", "1e-300" });
  this->expectFailure(1, "ask for about", { "lake.poly", "-o", "mesh.vtu", "--size", "1e-300" });
}

TEST_F(TippMesh, OptionsOfSizesNeedASize)
{
  for (const std::string option : { "--min-size", "--max-size", "--g" })
  {
    this->expectUsageError(option, "needs a size", { option, "1" });
  }
  this->expectUsageError("--geographic", "needs a size", { "--geographic" });
  this->expectUsageError("--size-column", "needs --size with a file", { "--size-column", "h" });
  this->expectUsageError(
    "--size-column", "needs --size with a file", { "--size", "2", "--size-column", "h" });
  this->expectUsageError("--dis", "needs --min-size", { "--dis", "0.2" });
  this->expectUsageError(
    "--min-size", "above --max-size", { "--size", "2", "--min-size", "3", "--max-size", "1" });
}

TEST_F(TippMesh, OptionsOfDepthsNeedDepths)
{
  this->expectUsageError("--wl", "needs --depth", { "--wl", "100" });
  this->expectUsageError("--slp", "needs --depth", { "--slp", "20" });
  this->expectUsageError("--slp", "needs --min-size and --max-size",
    { "--slp", "20", "--depth", "depth.asc", "--min-size", "1" });
  this->expectUsageError("--depth-at-nodes", "needs --depth", { "--depth-at-nodes" });
  this->expectUsageError("--depth-at-nodes", "needs --depth with a raster",
    { "--depth-at-nodes", "--depth", "soundings.csv" });
  this->expectUsageError("--positive-up", "needs --depth", { "--positive-up" });
  this->expectUsageError("--depth-column", "needs --depth", { "--depth-column", "z" });
  this->expectUsageError("--open-deeper", "needs --depth", { "--open-deeper", "9" }, "out.14");
}

TEST_F(TippMesh, OpenBoundariesNeedAnOutputWithLists)
{
  const std::string words = "needs an output named .14, .grd or .gr3";
  this->expectUsageError("--open", words, { "--open", "lake.poly" });
  this->expectUsageError("--open-deeper", words, { "--open-deeper", "9", "--depth", "d.csv" });
  this->expectUsageError("--open-deeper", "cannot be combined with --open",
    { "--open", "lake.poly", "--open-deeper", "9", "--depth", "d.csv" }, "out.14");
  this->expectUsageError("--open-deeper", "not a number",
    { "--depth", "soundings.csv", "--open-deeper", "nan" }, "out.14");
}

TEST_F(TippMesh, OutputsThatLosePointsAreRefused)
{
  this->expectUsageError("--output", "does not store the points that are added", {}, "out.npy");
}

TEST_F(TippMesh, KeptSegmentsIncludeTheBorder)
{
  this->expectUsageError("--keep-border", "has no effect", { "--keep-border", "--keep-segments" });
}

TEST_F(TippMesh, WrongNumbersAreUsageErrors)
{
  for (const std::string option : { "--max-area", "--min-edge", "--max-points", "--size", "--dis",
         "--wl", "--slp", "--min-size", "--max-size", "--g" })
  {
    this->expectUsageError(option, option, { option, "0" });
    this->expectUsageError(option, option, { option, "-1" });
  }
  for (const std::string angle : { "-1", "35", "wide" })
  {
    this->expectUsageError("--min-angle", "--min-angle", { "--min-angle", angle });
  }
  this->expectUsageError("--region", "--region", { "--region", "1", "2" });
  this->expectUsageError("--threads", "--threads", { "--threads", "-1" });
  this->expectFailure(
    1, "largest area of a region", { "lake.poly", "-o", "out.vtu", "--region", "5", "15", "0" });
  this->expectFailure(1, "(99, 99)", { "lake.poly", "-o", "out.vtu", "--region", "99", "99", "1" });
  this->expectFailure(1, "(99, 99)", { "lake.poly", "-o", "out.vtu", "--hole", "99", "99" });
}

TEST_F(TippMesh, MissingFilesAreNamed)
{
  const Words mesh{ "lake.poly", "-o", "out.14" };
  this->expectFailure(1, "lost.poly", { "lost.poly", "-o", "out.vtu" });
  this->expectFailure(1, "lost.csv", with(mesh, { "--points", "lost.csv" }));
  this->expectFailure(1, "lost.csv", with(mesh, { "--boundary", "lost.csv" }));
  this->expectFailure(1, "lost.csv", with(mesh, { "--size", "lost.csv" }));
  this->expectFailure(1, "lost.csv", with(mesh, { "--depth", "lost.csv" }));
  this->expectFailure(1, "lost.poly", with(mesh, { "--open", "lost.poly" }));
  this->expectFailure(1, "nowhere", { "lake.poly", "-o", "nowhere/out.vtu" });
  this->expectFailure(1, "nowhere", with(mesh, { "--stats", "nowhere/stats.json" }));
}

TEST_F(TippMesh, InputsAreNeverReplaced)
{
  const std::string lake = contentOf(this->Folder.path("lake.poly"));
  this->expectFailure(1, "lake.poly", { "lake.poly", "-o", "lake.node" });
  this->expectFailure(1, "lake.poly", { "lake.poly", "-o", "out.vtu", "--stats", "lake.poly" });
  EXPECT_EQ(lake, contentOf(this->Folder.path("lake.poly")));
  this->make("sizes.vtu", { "--max-area", "50" });
  for (const char* const option : { "--size", "--depth", "--points" })
  {
    this->expectFailure(1, "sizes.vtu", { "lake.poly", "-o", "sizes.vtu", option, "sizes.vtu" });
  }
}

} // namespace
