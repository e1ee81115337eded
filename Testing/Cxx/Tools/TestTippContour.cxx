// SPDX-License-Identifier: BSD-3-Clause
#include "RunTipp.h"

#include <gtest/gtest.h>

#include <filesystem>

using namespace tipp;
using namespace tipp::test;

namespace
{

/// A square of two triangles, with heights x + 10 y.
class TippContour : public testing::Test
{
protected:
  TippContour()
  {
    this->Folder.file("corners.csv", "x,y,height\n0,0,0\n4,0,4\n0,4,40\n4,4,44\n");
    EXPECT_EQ(0, this->run({ "delaunay", "corners.csv", "-o", "mesh.vtu" }).ExitCode);
    EXPECT_EQ(0,
      this->run({ "partition", "mesh.vtu", "-o", "mesh.tipp", "--tiling", "grid:2x2" }).ExitCode);
  }

  Outcome run(const std::vector<std::string>& words) const { return runTipp(this->Folder, words); }
  std::string content(const std::string& name) const { return contentOf(this->Folder.path(name)); }

  TemporaryFolder Folder;
};

} // namespace

TEST_F(TippContour, WritesTheSameLinesOfStoredAndOtherMeshes)
{
  const Outcome outcome =
    this->run({ "contour", "mesh.tipp", "-o", "a.vtp", "--array", "height", "--interval", "10" });
  EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
  EXPECT_EQ(0U, outcome.Out.find("4 lines of ")) << outcome.Out;
  EXPECT_EQ(0,
    this
      ->run(
        { "contour", "mesh.vtu", "-o", "b.vtp", "--array", "height", "--levels", "10,20,30,40" })
      .ExitCode);
  EXPECT_EQ(this->content("a.vtp"), this->content("b.vtp"));
}

TEST_F(TippContour, WritesGeoPackages)
{
  const Outcome outcome = this->run({ "contour", "mesh.tipp", "-o", "lines.gpkg", "--array",
    "height", "--levels", "7.5", "--crs", "EPSG:25832" });
  if (outcome.ExitCode != 0 && outcome.Err.find("needs a TIPP with GDAL") != std::string::npos)
  {
    GTEST_SKIP() << "built without GDAL";
  }
  EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
  EXPECT_EQ("SQLite format 3", this->content("lines.gpkg").substr(0, 15));
  // The written lines can be read as constraints.
  const Outcome constrained =
    this->run({ "delaunay", "corners.csv", "--constraints", "lines.gpkg", "-o", "again.vtu" });
  EXPECT_EQ(0, constrained.ExitCode) << constrained.Err;
  const Outcome checked =
    this->run({ "check", "corners.csv", "again.vtu", "--constraints", "lines.gpkg" });
  EXPECT_EQ(0, checked.ExitCode) << checked.Err;
}

TEST_F(TippContour, RefusesMeshesWithoutLines)
{
  const auto expect =
    [this](const std::vector<std::string>& more, int exitCode, const std::string& message)
  {
    std::vector<std::string> words{ "contour", "mesh.tipp", "-o", "out.vtp" };
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = this->run(words);
    EXPECT_EQ(exitCode, outcome.ExitCode);
    EXPECT_NE(std::string::npos, outcome.Err.find(message)) << outcome.Err;
    EXPECT_FALSE(std::filesystem::exists(this->Folder.path("out.vtp")));
  };
  expect({ "--array", "depth", "--levels", "1" }, 1, "has no array 'depth'");
  expect({ "--array", "height", "--interval", "nan" }, 2, "is not a number above 0");
  expect({ "--array", "height", "--interval", "1e-9" }, 1, "more than 1000000 levels");
  expect({ "--array", "height" }, 2, "");
}
