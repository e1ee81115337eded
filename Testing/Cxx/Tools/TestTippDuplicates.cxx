// SPDX-License-Identifier: BSD-3-Clause
// The options --duplicates and --thin of the commands that read points.
#include "RunTipp.h"

#include "Arrays/Random.h"
#include "Points/ReadPoints.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <utility>
#include <vector>

namespace
{

using namespace tipp::test;

using Words = std::vector<std::string>;

class TippDuplicates : public testing::Test
{
protected:
  /// Runs the tool and expects success.
  Outcome run(const Words& words) const
  {
    Outcome outcome = runTipp(this->Folder, words);
    EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
    return outcome;
  }

  /// Random points of a coarse lattice: most positions have several points, with different heights.
  void makePlaces(int count) const
  {
    tipp::Random random(7);
    std::ofstream csv(this->Folder.path("points.csv"));
    csv << "x,y,z,intensity\n";
    for (int i = 0; i < count; ++i)
    {
      const int x = int(80 * random.uniform());
      const int y = int(80 * random.uniform());
      csv << x + 0.5 << "," << y + 0.5 << "," << 0.1 * int(100 * random.uniform()) << "," << i
          << "\n";
    }
  }

  std::string content(const std::string& name) const { return contentOf(this->Folder.path(name)); }
  nlohmann::json json(const std::string& name) const
  {
    return nlohmann::json::parse(this->content(name));
  }

  TemporaryFolder Folder;
};

TEST_F(TippDuplicates, EqualPointsHaveTheChosenValues)
{
  this->Folder.file("points.csv",
    "x,y,z,intensity\n0,0,5,10\n4,0,1,1\n0,0,2,40\n0,4,1,1\n0,0,8,70\n4,4,1,1\n4,4,1,2\n");
  const std::map<std::string, std::pair<double, double>> expected = { { "first", { 5, 10 } },
    { "min", { 2, 40 } }, { "max", { 8, 70 } }, { "mean", { 5, 40 } } };
  for (const auto& [rule, values] : expected)
  {
    const Outcome outcome =
      this->run({ "delaunay", "points.csv", "-o", "mesh.vtu", "--duplicates", rule });
    EXPECT_NE(
      std::string::npos, outcome.Out.find("3 duplicates, 1 location with different elevations,"))
      << outcome.Out;
    const tipp::PointTable points = tipp::readPoints(this->Folder.path("mesh.vtu"));
    ASSERT_EQ(7U, points.size());
    for (const tipp::PointTable::Column& column : points.Columns)
    {
      EXPECT_EQ(column.Name == "z" ? values.first : values.second, column.Values[0])
        << rule << " " << column.Name;
      EXPECT_EQ(column.Name == "z" ? 2 : 40, column.Values[2]) << "others keep their values";
    }
  }
}

TEST_F(TippDuplicates, ARasterIsTheSameWithinAMemoryLimit)
{
  this->makePlaces(30000);
  std::string first;
  for (const std::string rule : { "first", "min", "max", "mean" })
  {
    const Words words = { "dem", "points.csv", "--resolution", "0.5", "--attributes",
      "elevation,intensity", "--duplicates", rule, "--stats" };
    Words whole = words;
    whole.insert(whole.end(), { "whole.json", "-o", "whole.npy" });
    Words small = words;
    small.insert(small.end(), { "small.json", "-o", "small.npy", "--memory", "2M" });
    this->run(whole);
    this->run(small);
    EXPECT_EQ(this->content("whole.npy"), this->content("small.npy")) << rule;
    EXPECT_LT(6000, this->json("whole.json")["disagreeing_places"].get<int>());
    EXPECT_EQ(this->json("whole.json")["disagreeing_places"],
      this->json("small.json")["disagreeing_places"]);
    EXPECT_NE(first, this->content("whole.npy"));
    first = first.empty() ? this->content("whole.npy") : first;
  }
}

TEST_F(TippDuplicates, LowestAndHighestMayBeOfADepthOrTheOnlyColumn)
{
  this->Folder.file(
    "points.csv", "x,y,depth,speed\n0,0,4,1\n2,0,2,1\n0,2,3,1\n0,0,1,8\n0,0,9,2\n2,2,2,1\n");
  this->Folder.file("speeds.csv", "x,y,speed\n0,0,1\n2,0,1\n0,2,1\n0,0,8\n0,0,2\n2,2,1\n");
  const std::map<std::pair<std::string, std::string>, double> expected = {
    { { "depth", "min" }, 1 }, { { "depth", "max" }, 9 }, { { "speed", "min" }, 1 },
    { { "speed", "max" }, 8 }, { { "depth,speed", "max" }, 9 }
  };
  for (const auto& [request, value] : expected)
  {
    for (const Words& more : { Words{}, Words{ "--memory", "2M" } })
    {
      const std::string points = request.first == "speed" ? "speeds.csv" : "points.csv";
      Words words{ "dem", points, "-o", "dem.npy", "--resolution", "0.002", "--attributes",
        request.first, "--duplicates", request.second, "--bounds", "-0.001", "0.001", "-0.001",
        "0.001", "--align", "bounds" };
      words.insert(words.end(), more.begin(), more.end());
      this->run(words);
      const std::string content = this->content("dem.npy");
      const std::size_t bands = request.first == "depth,speed" ? 2 : 1;
      double first = 0;
      std::memcpy(&first, content.data() + content.size() - bands * sizeof first, sizeof first);
      EXPECT_EQ(value, first) << request.first << " " << request.second;
    }
  }
}

TEST_F(TippDuplicates, LowestAndHighestNeedAnElevation)
{
  this->Folder.file("points.csv", "x,y,a,b\n0,0,1,1\n1,0,1,1\n0,1,1,1\n0,0,1,1\n");
  for (const std::string output : { "mesh.vtu", "mesh.tipp" })
  {
    const Outcome outcome =
      runTipp(this->Folder, { "delaunay", "points.csv", "-o", output, "--duplicates", "min" });
    EXPECT_EQ(1, outcome.ExitCode);
    EXPECT_NE(std::string::npos, outcome.Err.find("no column z, elevation or depth"))
      << outcome.Err;
  }
}

TEST_F(TippDuplicates, ThinningKeepsOnePointOfASquare)
{
  this->Folder.file(
    "points.csv", "x,y,z\n0.1,0.1,5\n1.2,1.1,9\n1.9,0.2,3\n3,1,7\n2,2,1\n-0.5,-0.5,4\nnan,1,1\n");
  const std::map<std::string, std::vector<double>> expected = {
    { "min", { 1.9, 0.2, 3, 1, 2, 2, -0.5, -0.5 } },
    { "max", { 1.2, 1.1, 3, 1, 2, 2, -0.5, -0.5 } },
    { "nearest", { 1.2, 1.1, 3, 1, 2, 2, -0.5, -0.5 } },
  };
  for (const auto& [rule, places] : expected)
  {
    const Outcome outcome =
      this->run({ "delaunay", "points.csv", "-o", "mesh.vtu", "--thin", "2:" + rule });
    EXPECT_NE(std::string::npos, outcome.Err.find("2 points are left out by thinning"))
      << outcome.Err;
    EXPECT_NE(std::string::npos, outcome.Out.find("5 points, ")) << outcome.Out;
    std::vector<double> xy = tipp::readPoints(this->Folder.path("mesh.vtu")).XY;
    xy.resize(8); // the point that is not finite is the last
    EXPECT_EQ(places, xy) << rule;
  }
}

/// Each pair of points is equally far from the centre of its square, as the numbers are written.
TEST_F(TippDuplicates, ThinningKeepsTheFirstOfPointsEquallyNear)
{
  struct Tie
  {
    const char* Side;
    const char* Points; ///< the first two
  };
  const Tie ties[] = { { "3", "1,1.5\n2,1.5\n" }, { "3", "2,1.5\n1,1.5\n" },
    { "7", "499997,1\n500002,1\n" }, { "7", "500002,1\n499997,1\n" },
    { "0.1", "0.12,0.15\n0.18,0.15\n" }, { "0.1", "0.18,0.15\n0.12,0.15\n" },
    { "0.1", "0.31,0.32\n0.38,0.39\n" }, { "0.3", "-0.2,-0.15\n-0.1,-0.15\n" },
    { "0.7", "345678.43,5432100.4\n345678.67,5432100.4\n" } };
  for (const auto& [side, points] : ties)
  {
    this->Folder.file("points.csv", std::string("x,y\n") + points + "-900,-900\n900,-950\n0,900\n");
    this->run(
      { "delaunay", "points.csv", "-o", "mesh.vtu", "--thin", side + std::string(":nearest") });
    const tipp::PointTable all = tipp::readPoints(this->Folder.path("points.csv"));
    const tipp::PointTable kept = tipp::readPoints(this->Folder.path("mesh.vtu"));
    EXPECT_EQ(4U, kept.size()) << side << " " << points;
    EXPECT_EQ(all.XY[0], kept.XY[0]) << side << " " << points;
  }
}

TEST_F(TippDuplicates, ThinningIsTheSameWithinAMemoryLimit)
{
  this->makePlaces(40000);
  for (const std::string rule : { "min", "max", "nearest" })
  {
    const Words words = { "dem", "points.csv", "--resolution", "0.5", "--attributes",
      "elevation,intensity", "--thin", "1.5:" + rule };
    Words whole = words;
    whole.insert(whole.end(), { "-o", "whole.npy" });
    Words small = words;
    small.insert(small.end(), { "-o", "small.npy", "--memory", "2M" });
    const std::string left = this->run(whole).Err;
    EXPECT_NE(std::string::npos, left.find("are left out by thinning"));
    EXPECT_EQ(left, this->run(small).Err);
    EXPECT_EQ(this->content("whole.npy"), this->content("small.npy")) << rule;
  }
  for (const auto& entry : std::filesystem::directory_iterator(this->Folder.path("")))
  {
    EXPECT_EQ(std::string::npos, entry.path().string().find("squares")) << entry.path();
  }
}

TEST_F(TippDuplicates, RefusesThinningWithoutACellOrRule)
{
  for (const std::string text : { "2", "0:min", "-1:max", "nan:min", "2:mean", "x:min" })
  {
    const Outcome outcome =
      runTipp(this->Folder, { "delaunay", "points.csv", "-o", "mesh.vtu", "--thin=" + text });
    EXPECT_EQ(2, outcome.ExitCode) << text;
    EXPECT_NE(std::string::npos, outcome.Err.find("as 0.5:min")) << outcome.Err;
  }
}

} // namespace
