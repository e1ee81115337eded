// SPDX-License-Identifier: BSD-3-Clause
#include "RunTipp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

using namespace tipp;
using namespace tipp::test;

namespace
{

using Words = std::vector<std::string>;

/// Surfaces over the unit square: flat.vtu at z = 1, and wave.vtu.
class TippVolume : public testing::Test
{
protected:
  TippVolume()
  {
    this->makeMesh("flat", 11, 0, [](double, double) { return 1.0; });
    this->makeMesh("tilted", 7, 0, [](double x, double) { return x + 0.5; });
    this->makeMesh("wave", 40, 0, [](double x, double y) { return 1 + std::sin(9 * x) * y; });
  }

  template <typename Height>
  void makeMesh(const std::string& name, int side, double shift, const Height& height) const
  {
    std::ofstream csv(this->Folder.path(name + ".csv"));
    csv << "x,y,z\n";
    for (int i = 0; i < side * side; ++i)
    {
      const double x = double(i % side) / (side - 1);
      const double y = double(i / side) / (side - 1);
      csv << x + shift << "," << y << "," << height(x, y) << "\n";
    }
    csv.close();
    EXPECT_EQ(0, this->run({ "delaunay", name + ".csv", "-o", name + ".vtu" }).ExitCode);
  }

  Outcome run(const Words& words) const { return runTipp(this->Folder, words); }

  /// Cut, fill, net, area and the areas of one surface only.
  std::vector<double> numbersOf(const Words& words) const
  {
    Words all = { "volume" };
    all.insert(all.end(), words.begin(), words.end());
    const Outcome outcome = this->run(all);
    EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
    std::istringstream lines(outcome.Out);
    std::vector<double> numbers;
    for (std::string line; std::getline(lines, line);)
    {
      numbers.push_back(std::stod(line.substr(line.rfind(' '))));
    }
    EXPECT_EQ(6U, numbers.size()) << outcome.Out;
    numbers.resize(6);
    return numbers;
  }

  void expectNumbers(const Words& words, const std::vector<double>& expected) const
  {
    const std::vector<double> found = this->numbersOf(words);
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
      EXPECT_NEAR(expected[i], found[i], 1e-6) << i; // of heights that a text file rounds
    }
  }

  TemporaryFolder Folder;
};

} // namespace

TEST_F(TippVolume, OfAPlaneThatIsTiltedIsTwoWedges)
{
  this->expectNumbers({ "flat.vtu", "tilted.vtu" }, { 0.125, 0.125, 0, 1, 0, 0 });
  this->expectNumbers({ "flat.vtu", "tilted.vtu", "--bounds", "0.5", "1", "0.25", "0.75" },
    { 0, 0.0625, 0.0625, 0.25, 0, 0 });
}

TEST_F(TippVolume, OfExchangedSurfacesHasCutAndFillExchanged)
{
  const std::vector<double> there = this->numbersOf({ "flat.vtu", "wave.vtu" });
  const std::vector<double> back = this->numbersOf({ "wave.vtu", "flat.vtu" });
  EXPECT_GT(there[0], 0.01);
  EXPECT_NEAR(there[0], back[1], 1e-14);
  EXPECT_NEAR(there[1], back[0], 1e-14);
}

TEST_F(TippVolume, PrintsTheSameForAnyNumberOfThreads)
{
  const std::string one = this->run({ "volume", "flat.vtu", "wave.vtu", "--threads", "1" }).Out;
  EXPECT_NE(one.find("only after"), std::string::npos);
  EXPECT_EQ(one, this->run({ "volume", "flat.vtu", "wave.vtu", "--threads", "2" }).Out);
  EXPECT_EQ(one, this->run({ "volume", "flat.vtu", "wave.vtu", "--threads", "5" }).Out);
}

TEST_F(TippVolume, ReadsStoredMeshesInParts)
{
  const std::vector<double> whole = this->numbersOf({ "wave.vtu", "tilted.vtu" });
  for (const std::string name : { "wave", "tilted" })
  {
    ASSERT_EQ(0, this->run({ "partition", name + ".vtu", "-o", name + ".tipp" }).ExitCode);
  }
  for (const Words& words : { Words{ "wave.tipp", "tilted.vtu" },
         Words{ "wave.vtu", "tilted.tipp" }, Words{ "wave.tipp", "tilted.tipp" } })
  {
    const std::vector<double> found = this->numbersOf({ words[0], words[1], "--memory", "2K" });
    for (std::size_t i = 0; i < whole.size(); ++i)
    {
      EXPECT_NEAR(whole[i], found[i], 1e-12) << words[0] << " " << words[1] << " " << i;
    }
  }
}

TEST_F(TippVolume, ShowsTheRangesOfSurfacesThatDoNotMeet)
{
  this->makeMesh("far", 5, 100, [](double, double) { return 0.0; });
  const Outcome outcome = this->run({ "volume", "flat.vtu", "far.vtu" });
  EXPECT_NE(0, outcome.ExitCode);
  EXPECT_NE(outcome.Err.find("no area in common: flat.vtu has x from 0 to 1"), std::string::npos)
    << outcome.Err;
  EXPECT_NE(outcome.Err.find("far.vtu has x from 100 to 101"), std::string::npos) << outcome.Err;
  EXPECT_EQ("", outcome.Out);
}

TEST_F(TippVolume, RefusesBoundsWithoutArea)
{
  const Outcome outcome =
    this->run({ "volume", "flat.vtu", "wave.vtu", "--bounds", "1", "0", "0", "1" });
  EXPECT_NE(0, outcome.ExitCode);
  EXPECT_NE(outcome.Err.find("--bounds: has no area"), std::string::npos) << outcome.Err;
}

TEST_F(TippVolume, RefusesBoundsThatDoNotMeetTheSurface)
{
  const Outcome outcome =
    this->run({ "volume", "flat.vtu", "wave.vtu", "--bounds", "50", "51", "0", "1" });
  EXPECT_NE(0, outcome.ExitCode);
  EXPECT_NE(outcome.Err.find("do not meet"), std::string::npos) << outcome.Err;
}

TEST_F(TippVolume, RefusesAnImage)
{
  ASSERT_EQ(
    0, this->run({ "resample", "wave.vtu", "-o", "wave.vti", "--dims", "5", "5", "1" }).ExitCode);
  const Outcome outcome = this->run({ "volume", "flat.vtu", "wave.vti" });
  EXPECT_NE(0, outcome.ExitCode);
  EXPECT_NE(outcome.Err.find("wave.vti"), std::string::npos) << outcome.Err;
}
