// SPDX-License-Identifier: BSD-3-Clause
// The command 'tipp points', which copies points or makes them.
#include "LasText.h"
#include "RunTipp.h"
#include "TippDem.h"

#include "Las/LasHeader.h"
#include "Points/ReadPoints.h"

#include <gtest/gtest.h>

#include <sys/resource.h>

namespace
{

using namespace tipp::test;

class TippPoints : public testing::Test
{
protected:
  /// Writes "tile.las": points of hilly terrain, of classes 1 and 2, some withheld.
  TippPoints()
  {
    LasText las(4, 7);
    tipp::Random random(3);
    for (int i = 0; i < 4000; ++i)
    {
      const double x = 100 * random.uniform();
      const double y = 100 * random.uniform();
      const double z = 20 + x / 5 + 4 * std::sin(y / 9) + (i % 3 == 0 ? 7 : 0);
      las.add(int(x * 100), int(y * 100), int(z * 100), i % 3 == 0 ? 1 : 2, i % 50 == 0 ? 4 : 0,
        1 + i % 2, 2);
    }
    this->Folder.file("tile.las", las.text());
  }

  Outcome run(const Words& words) const { return runTipp(this->Folder, words); }

  Outcome require(const Words& words) const
  {
    Outcome outcome = this->run(words);
    EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
    return outcome;
  }

  /// Expects one sentence, and that no file is written.
  void expectRefused(const Words& words, int exitCode, const std::string& sentence) const
  {
    const auto before = filesNow();
    const Outcome outcome = this->run(words);
    EXPECT_EQ(exitCode, outcome.ExitCode) << outcome.Err;
    EXPECT_NE(std::string::npos, outcome.Err.find(sentence)) << outcome.Err;
    EXPECT_EQ(outcome.Err.size() - 1, outcome.Err.find('\n')) << outcome.Err;
    EXPECT_EQ(before, filesNow());
  }

  std::vector<std::string> filesNow() const
  {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(this->Folder.path("")))
    {
      const std::string name = entry.path().filename().string();
      if (name != ".out" && name != ".err")
      {
        names.push_back(name);
      }
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  std::string content(const std::string& name) const { return contentOf(this->Folder.path(name)); }

  tipp::PointTable points(const std::string& name) const
  {
    return tipp::readPoints(this->Folder.path(name));
  }

  TemporaryFolder Folder;
};

/// A copy of chosen points gives the raster that the same options give on the source.
TEST_F(TippPoints, CopyGivesTheRasterOfTheOptions)
{
  const std::vector<Words> choices = { {}, { "--class", "2" }, { "--returns", "last" },
    { "--class", "2", "--thin", "3:min" }, { "--keep", "withheld", "--thin", "2:nearest" } };
  for (const Words& choice : choices)
  {
    for (const char* const copy : { "copy.las", "copy.laz" })
    {
      const auto with = [&choice](Words words)
      {
        words.insert(words.end(), choice.begin(), choice.end());
        return words;
      };
      const Words keep = { "--keep", "withheld" };
      this->require(with({ "points", "tile.las", "-o", copy }));
      this->require(with({ "dem", "tile.las", "-o", "direct.tif", "--resolution", "1",
        "--attributes", "elevation,intensity,red" }));
      Words dem = { "dem", copy, "-o", "copy.tif", "--resolution", "1", "--attributes",
        "elevation,intensity,red" };
      if (!choice.empty() && choice.front() == "--keep")
      {
        dem.insert(dem.end(), keep.begin(), keep.end());
      }
      this->require(dem);
      EXPECT_TRUE(this->content("direct.tif") == this->content("copy.tif")) << copy;
    }
  }
}

TEST_F(TippPoints, SaysWhatIsWritten)
{
  const Outcome outcome = this->require({ "points", "tile.las", "-o", "a.laz", "--class", "2" });
  EXPECT_EQ(outcome.Out, "2613 points, format 7, scales 0.01 0.01 0.01, in a.laz\n");
  EXPECT_NE(std::string::npos, outcome.Err.find("1387 points of LAS files are not used"));
}

TEST_F(TippPoints, ThreadsDoNotChangeTheFile)
{
  this->require({ "points", "tile.las", "-o", "a.laz", "--threads", "1" });
  this->require({ "points", "tile.las", "-o", "b.laz", "--threads", "3" });
  EXPECT_TRUE(this->content("a.laz") == this->content("b.laz"));
}

TEST_F(TippPoints, CopyOfACopyIsTheSame)
{
  this->require({ "points", "tile.las", "-o", "a.laz" });
  this->require({ "points", "a.laz", "-o", "a.las" });
  this->require({ "points", "a.las", "-o", "b.laz" });
  EXPECT_TRUE(this->content("a.laz") == this->content("b.laz"));
}

TEST_F(TippPoints, TextBecomesLas)
{
  this->Folder.file("survey.csv", "x,y,z,intensity,code\n500000.25,1,2.5,7,-1\n500001.5,2,3,8,2\n");
  const Outcome outcome = this->require({ "points", "survey.csv", "-o", "survey.las" });
  EXPECT_EQ(outcome.Out, "2 points, format 6, scales 0.01 1 0.1, in survey.las\n");
  const tipp::PointTable points = this->points("survey.las");
  EXPECT_EQ(points.XY, (std::vector<double>{ 500000.25, 1, 500001.5, 2 }));
  EXPECT_EQ(points.Columns[0].Values, (std::vector<double>{ 2.5, 3 }));
  EXPECT_EQ(points.Columns[1].Values, (std::vector<double>{ 7, 8 }));
  const tipp::LasHeader header = tipp::readLasHeader(this->Folder.path("survey.las"));
  ASSERT_EQ(1U, header.Extras.size());
  EXPECT_EQ("code", header.Extras[0].name());
}

TEST_F(TippPoints, OnePointThatIsLeftOutIsSingular)
{
  this->Folder.file("survey.csv", "x,y,z\n1,1,-9999\n2,2,2\n");
  const Outcome outcome =
    this->require({ "points", "survey.csv", "-o", "survey.las", "--input-nodata=-9999" });
  EXPECT_NE(std::string::npos, outcome.Err.find("warning: 1 point is left out, since"))
    << outcome.Err;
}

TEST_F(TippPoints, PointsBecomeNpy)
{
  const Outcome outcome = this->require({ "points", "tile.las", "-o", "a.npy", "--class", "2" });
  EXPECT_EQ(outcome.Out, "2613 points in a.npy\n");
  EXPECT_NE(std::string::npos,
    outcome.Err.find("no room for these columns: intensity, classification, gps_time, red, green, "
                     "blue"))
    << outcome.Err;
  this->require({ "points", "tile.las", "-o", "a.las", "--class", "2" });
  EXPECT_TRUE(this->points("a.npy").XY == this->points("a.las").XY);
  EXPECT_TRUE(this->points("a.npy").Columns[0].Values == this->points("a.las").Columns[0].Values);
}

TEST_F(TippPoints, MadePointsBecomeLas)
{
  const Words kind = { "--distribution", "coast", "--count", "1000", "--seed", "7" };
  for (const char* const name : { "a.npy", "a.laz" })
  {
    Words words = { "points", "-o", name };
    words.insert(words.end(), kind.begin(), kind.end());
    this->require(words);
  }
  const tipp::PointTable made = this->points("a.npy");
  const tipp::PointTable points = this->points("a.laz");
  ASSERT_EQ(made.XY.size(), points.XY.size());
  for (std::size_t i = 0; i < made.XY.size(); ++i)
  {
    EXPECT_NEAR(made.XY[i], points.XY[i], 1e-9); // they have six decimals
  }
  EXPECT_EQ(std::vector<double>(1000, 0), points.Columns[0].Values);
}

TEST_F(TippPoints, ScaleRoundsCoordinates)
{
  this->require({ "points", "tile.las", "-o", "a.laz", "--scale", "1,1,0.1" });
  const tipp::LasHeader header = tipp::readLasHeader(this->Folder.path("a.laz"));
  EXPECT_EQ((std::array<double, 3>{ 1, 1, 0.1 }), header.Scale);
  const tipp::PointTable fine = this->points("tile.las");
  const tipp::PointTable coarse = this->points("a.laz");
  ASSERT_EQ(fine.size(), coarse.size());
  for (std::size_t i = 0; i < fine.size(); ++i)
  {
    ASSERT_NEAR(fine.XY[2 * i], coarse.XY[2 * i], 0.5 + 1e-9);
    ASSERT_NEAR(fine.Columns[0].Values[i], coarse.Columns[0].Values[i], 0.05 + 1e-9);
  }
}

TEST_F(TippPoints, MisuseIsOneSentence)
{
  constexpr int usage = 2;
  constexpr int failure = 1;
  const auto refuse = [this](Words words, int exitCode, const std::string& sentence)
  {
    words.insert(words.begin(), "points");
    this->expectRefused(words, exitCode, sentence);
  };
  refuse({ "-o", "a.laz" }, usage, "files of points, --distribution or --like");
  refuse({ "tile.las", "--like", "tile.las", "--count", "5", "-o", "a.laz" }, usage,
    "cannot be combined");
  refuse({ "--like", "tile.las", "-o", "a.laz" }, usage, "--count");
  refuse({ "tile.las", "-o", "a.laz", "--count", "5" }, usage, "--count: needs --distribution");
  refuse({ "tile.las", "-o", "a.laz", "--seed", "5" }, usage, "--seed: needs --distribution");
  refuse({ "--distribution", "coast", "--count", "5", "-o", "a.laz", "--class", "2" }, usage,
    "--class: needs files");
  refuse({ "--distribution", "coast", "--count", "5", "-o", "a.npy", "--threads", "2" }, usage,
    "--threads: needs files");
  refuse({ "tile.las", "-o", "a.npy", "--scale", "1" }, usage, "--scale: needs an output");
  refuse({ "tile.las", "-o", "a.laz", "--scale", "0" }, usage, "--scale");
  refuse({ "tile.las", "-o", "a.laz", "--scale", "1,2" }, usage, "is one number, or three");
  refuse({ "tile.las", "-o", "a.csv" }, usage, "does not end in .npy, .las or .laz");
  refuse({ "tile.las", "-o", "tile.las" }, failure, "tile.las");
  refuse({ "tile.las", "-o", "absent/a.laz" }, failure, "its folder does not exist");
  refuse({ "absent.las", "-o", "a.laz" }, failure, "absent.las");
  this->Folder.file("wide.csv", "x,y,z\n0,0,0\n1e15,1,1\n");
  refuse({ "wide.csv", "-o", "a.las" }, failure, "give a coarser one, such as --scale 1e+06");
  refuse({ "tile.las", "-o", "a.laz", "--scale", "1e-9" }, failure, "such as --scale 1e-07");
  refuse({ "tile.las", "-o", "a.laz", "--class", "99" }, failure, "there are no points");
  refuse({ "tile.las", "-o", "a.npy", "--class", "99" }, failure, "there are no points");
}

TEST_F(TippPoints, FullDiskLeavesNoFile)
{
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{ 20000, before.rlim_max };
  setrlimit(RLIMIT_FSIZE, &small);
  this->expectRefused({ "points", "tile.las", "-o", "a.laz" }, 1, "cannot be written");
  setrlimit(RLIMIT_FSIZE, &before);
}

} // namespace
