// SPDX-License-Identifier: BSD-3-Clause
#include "RunTipp.h"

#include "Npy/NpyFile.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

using namespace tipp;
using namespace tipp::test;

namespace
{

using Words = std::vector<std::string>;

/// A square of two triangles with heights x + 10 y, partitioned and as a file.
class TippQuery : public testing::Test
{
protected:
  TippQuery()
  {
    this->Folder.file("corners.csv", "x,y,height\n0,0,0\n4,0,4\n0,4,40\n4,4,44\n");
    EXPECT_EQ(0, this->run({ "delaunay", "corners.csv", "-o", "mesh.vtu" }).ExitCode);
    EXPECT_EQ(0,
      this->run({ "partition", "mesh.vtu", "-o", "mesh.tipp", "--tiling", "grid:2x2" }).ExitCode);
    this->Folder.file("asked.csv", "x,y\n1,0.5\n9,9\n2,2\n4,4\n");
  }

  Outcome run(const Words& words) const { return runTipp(this->Folder, words); }
  std::string content(const std::string& name) const { return contentOf(this->Folder.path(name)); }

  TemporaryFolder Folder;
};

} // namespace

TEST_F(TippQuery, WritesCellsAndArraysAsCsv)
{
  const Outcome outcome = this->run({ "query", "asked.csv", "mesh.tipp", "-o", "out.csv" });
  EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
  EXPECT_EQ("4 points, 1 outside of the mesh, in out.csv\n", outcome.Out);
  std::istringstream lines(this->content("out.csv"));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ("x,y,cell,elevation,height", line);
  std::getline(lines, line);
  EXPECT_EQ("1,0.5,", line.substr(0, 6));
  EXPECT_EQ(",6,6", line.substr(line.size() - 4));
  std::getline(lines, line);
  EXPECT_EQ("9,9,-1,,", line);
}

TEST_F(TippQuery, AnswersTheSameForAFileThatIsNotPartitioned)
{
  EXPECT_EQ(0, this->run({ "query", "asked.csv", "mesh.tipp", "-o", "a.csv" }).ExitCode);
  EXPECT_EQ(0, this->run({ "query", "asked.csv", "mesh.vtu", "-o", "b.csv" }).ExitCode);
  EXPECT_EQ(this->content("a.csv"), this->content("b.csv"));
}

TEST_F(TippQuery, WritesWeightsOnRequest)
{
  EXPECT_EQ(0,
    this
      ->run({ "query", "asked.csv", "mesh.tipp", "-o", "out.csv", "--arrays", "height", "--weights",
        "--memory", "1K", "--threads", "1" })
      .ExitCode);
  EXPECT_EQ("x,y,cell,weight_0,weight_1,weight_2,height\n",
    this->content("out.csv").substr(0, this->content("out.csv").find('\n') + 1));
  EXPECT_NE(std::string::npos, this->content("out.csv").find("9,9,-1,,,,\n"));
}

TEST_F(TippQuery, WritesRowsAsNpy)
{
  EXPECT_EQ(0,
    this->run({ "query", "asked.csv", "mesh.tipp", "-o", "out.npy", "--arrays", "height" })
      .ExitCode);
  NpyReader reader(this->Folder.path("out.npy"));
  ASSERT_EQ(4, reader.rows());
  ASSERT_EQ(1, reader.columns());
  double values[4];
  reader.read(values, sizeof values);
  EXPECT_DOUBLE_EQ(6, values[0]);
  EXPECT_TRUE(values[1] != values[1]);
  EXPECT_DOUBLE_EQ(22, values[2]);
  EXPECT_DOUBLE_EQ(44, values[3]);
}

TEST_F(TippQuery, WritesTheNearestLocationsOnRequest)
{
  EXPECT_EQ(0,
    this
      ->run(
        { "query", "asked.csv", "mesh.tipp", "-o", "out.csv", "--arrays", "height", "--closest" })
      .ExitCode);
  const std::string content = this->content("out.csv");
  EXPECT_EQ("x,y,cell,height,closest_cell,closest_x,closest_y,distance",
    content.substr(0, content.find('\n')));
  EXPECT_NE(std::string::npos, content.find("\n9,9,-1,,")) << content;
  EXPECT_NE(std::string::npos, content.find(",4,4,7.0710678118654755\n")) << content;
  EXPECT_NE(std::string::npos, content.find(",2,2,0\n")) << content;
}

TEST_F(TippQuery, WritesStatisticsOfZones)
{
  this->Folder.file("zones.csv",
    "name,WKT\n\"low, west\",\"POLYGON ((0 0,2 0,2 2,0 2,0 0))\"\n"
    "ring,\"POLYGON ((0 0,4 0,4 4,0 4,0 0),(1 1,3 1,3 3,1 3,1 1))\"\n"
    "outside,\"POLYGON ((5 5,6 5,6 6,5 5))\"\n");
  const Outcome outcome = this->run({ "query", "mesh.tipp", "--zones", "zones.csv", "--zone-names",
    "name", "--arrays", "height", "--level", "0", "-o", "out.csv" });
  ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  EXPECT_EQ("3 zones, in out.csv\n", outcome.Out);
  EXPECT_EQ("zone,cells,area,height_min,height_max,height_mean,height_integral,height_above\n"
            "\"low, west\",1,4,0,22,11,44,44\n"
            "ring,2,12,0,44,22,264,264\n"
            "outside,0,0,,,,,\n",
    this->content("out.csv"));
}

TEST_F(TippQuery, ListsCellsAndPointsOfARegion)
{
  this->Folder.file("region.csv", "id,WKT\n1,\"POLYGON ((3 3,5 3,5 5,3 5,3 3))\"\n");
  const auto listed = [this](Words words)
  {
    words.insert(words.begin(), { "query", "mesh.tipp", "-o", "ids.csv" });
    const Outcome outcome = this->run(words);
    EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
    return this->content("ids.csv");
  };
  EXPECT_EQ("point\n3\n", listed({ "--ids", "points", "--polygons", "region.csv" }));
  EXPECT_EQ("point\n0\n1\n", listed({ "--ids", "points", "--bounds", "0", "4", "-1", "1" }));
  EXPECT_EQ("cell\n0\n1\n", listed({ "--ids", "cells", "--bounds", "0", "4", "0", "4" }));
  EXPECT_EQ("cell\n", listed({ "--ids", "cells", "--whole", "--bounds", "0", "3", "0", "3" }));
  EXPECT_EQ(0,
    this
      ->run(
        { "query", "mesh.vtu", "--ids", "points", "--bounds", "0", "4", "0", "0", "-o", "ids.npy" })
      .ExitCode);
  const std::string npy = this->content("ids.npy");
  EXPECT_NE(std::string::npos, npy.find("'<i8'"));
  EXPECT_EQ(std::string(8, '\0') + '\1' + std::string(7, '\0'), npy.substr(npy.size() - 16));
}

TEST_F(TippQuery, WritesDescentsAsLines)
{
  const Outcome outcome =
    this->run({ "query", "asked.csv", "mesh.tipp", "-o", "out.vtp", "--descend", "height" });
  ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  EXPECT_NE(std::string::npos, this->content("out.vtp").find("PitId"));
}

TEST_F(TippQuery, WritesADescentThatStartsAtAPit)
{
  this->Folder.file("pit.csv", "x,y\n0,0\n");
  const Outcome outcome =
    this->run({ "query", "pit.csv", "mesh.tipp", "-o", "out.vtp", "--descend", "height" });
  ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  const std::string vtp = this->content("out.vtp");
  EXPECT_NE(std::string::npos, vtp.find("NumberOfPoints=\"1\""));
  EXPECT_NE(std::string::npos, vtp.find("NumberOfLines=\"1\""));
}

TEST_F(TippQuery, RefusesConflictingOptions)
{
  const auto expect = [this](const Words& words, const std::string& message)
  {
    const Outcome outcome = this->run(words);
    EXPECT_EQ(2, outcome.ExitCode);
    EXPECT_NE(std::string::npos, outcome.Err.find(message)) << outcome.Err;
  };
  expect({ "query", "mesh.tipp", "-o", "out.csv" }, "mesh");
  expect({ "query", "asked.csv", "mesh.tipp", "-o", "out.csv", "--zones", "zones.csv" }, "zones");
  expect(
    { "query", "asked.csv", "mesh.tipp", "-o", "out.npy", "--closest" }, "does not end in .csv");
  expect({ "query", "asked.csv", "mesh.tipp", "-o", "out.csv", "--descend", "height" },
    "does not end in .vtp");
  expect({ "query", "mesh.tipp", "-o", "ids.csv", "--ids", "cells" }, "--ids needs a region");
  expect({ "query", "mesh.tipp", "-o", "ids.csv", "--ids", "cells", "--bounds", "0", "1", "2", "3",
           "4" },
    "four numbers");
  expect({ "query", "asked.csv", "mesh.tipp", "-o", "ids.csv", "--ids", "cells", "--bounds", "0",
           "1", "0", "1" },
    "give only the mesh");
}

TEST_F(TippQuery, RefusesInvalidQueries)
{
  const auto expect = [this](const Words& words, int exitCode, const std::string& message)
  {
    const Outcome outcome = this->run(words);
    EXPECT_EQ(exitCode, outcome.ExitCode);
    EXPECT_NE(std::string::npos, outcome.Err.find(message)) << outcome.Err;
    EXPECT_FALSE(std::filesystem::exists(this->Folder.path("out.csv")));
  };
  expect({ "query", "asked.csv", "mesh.tipp", "-o", "out.csv", "--arrays", "depth" }, 1,
    "tipp: mesh.tipp: has no array 'depth'");
  expect({ "query", "asked.csv", "nowhere.tipp", "-o", "out.csv" }, 1, "nowhere.tipp");
  expect({ "query", "asked.csv", "mesh.tipp", "-o", "out.csv", "--memory", "100" }, 1,
    "but the limit is 100 bytes; raise it, or partition the mesh into smaller pieces.");
  this->Folder.file("none.csv", "x,y\n1,1\n");
  expect({ "query", "mesh.tipp", "--zones", "none.csv", "-o", "out.csv" }, 1, "has no polygons");
  expect({ "query", "asked.csv", "mesh.tipp", "-o", "out.csv", "--step", "-1" }, 2, "--step");
  expect({ "query", "asked.csv", "mesh.tipp", "-o", "out.csv", "--step", "1" }, 1,
    "mesh.tipp: has no time step 1; there are 0, counted from 0.");
  expect({ "query", "asked.csv", "mesh.vtu", "-o", "out.csv", "--step", "1" }, 1,
    "mesh.vtu: has no time step 1; there are 0, counted from 0.");
  expect({ "query", "asked.csv", "mesh.tipp", "-o", "out.csv", "--step", "0:4:0" }, 2,
    "the stride of '0:4:0' must be at least 1");
  this->Folder.file("overlap.csv",
    "name,WKT\na,\"POLYGON ((0 0,2 0,2 2,0 0))\"\nb,\"POLYGON ((1 -1,3 -1,1 1.5,1 -1))\"\n");
  expect({ "query", "mesh.tipp", "--ids", "cells", "--polygons", "overlap.csv", "-o", "out.csv" },
    1, "overlaps another one");
  this->Folder.file("fort.14", "");
  expect({ "query", "asked.csv", "fort.14", "-o", "out.csv" }, 1, "fort.14, line 0: the file ends");
  expect({ "query", "asked.csv", "mesh.tipp", "-o", "out.vtu" }, 2, "does not end in .csv or .npy");
  expect({ "query", "asked.csv", "mesh.tipp", "-o", "asked.csv" }, 1, "asked.csv");
  std::filesystem::remove(this->Folder.path("mesh.tipp/pieces/000000.vtu"));
  expect({ "query", "asked.csv", "mesh.tipp", "-o", "out.csv" }, 1, "000000.vtu");
}
