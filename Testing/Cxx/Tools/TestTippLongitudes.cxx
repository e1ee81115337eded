// SPDX-License-Identifier: BSD-3-Clause
// Points with longitudes on both sides of 180 degrees, and the option --wrap.
#include "RunTipp.h"

#include "Arrays/Random.h"

#include <gtest/gtest.h>

#include <fstream>
#include <vector>

namespace
{

using namespace tipp::test;

using Words = std::vector<std::string>;

class TippLongitudes : public testing::Test
{
protected:
  /// Writes points from 170 to 190 degrees as given.csv, and with longitudes from -180 to 180 as
  /// points.csv.
  void makePoints(int count) const
  {
    tipp::Random random(7);
    std::ofstream given(this->Folder.path("given.csv"));
    std::ofstream turned(this->Folder.path("points.csv"));
    given << "lon,lat,z\n";
    turned << "lon,lat,z\n";
    for (int i = 0; i < count; ++i)
    {
      // Multiples of 1/64, so that the difference of 360 is exact.
      const double x = 170 + double(int(20 * 64 * random.uniform())) / 64;
      const double y = double(int(10 * 64 * random.uniform())) / 64;
      given << x << "," << y << "," << i % 17 << "\n";
      turned << (x < 180 ? x : x - 360) << "," << y << "," << i % 17 << "\n";
    }
  }

  Outcome run(Words words, const Words& more = {}) const
  {
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = runTipp(this->Folder, words);
    EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
    return outcome;
  }

  std::string content(const std::string& name) const { return contentOf(this->Folder.path(name)); }

  TemporaryFolder Folder;
};

constexpr const char* warning = "both sides of 180 degrees of longitude";

} // namespace

TEST_F(TippLongitudes, AcrossTheDateLineAreWrapped)
{
  this->makePoints(3000);
  for (const Words& memory : { Words{}, Words{ "--memory", "1M" } })
  {
    const Words options = { "--resolution", "0.25", "--attributes", "elevation,slope" };
    Words words = options;
    words.insert(words.end(), memory.begin(), memory.end());
    this->run({ "dem", "given.csv", "-o", "given.npy" }, words);
    words.insert(words.end(), { "--wrap", "360" });
    const Outcome outcome = this->run({ "dem", "points.csv", "-o", "wrapped.npy" }, words);
    EXPECT_EQ(this->content("given.npy"), this->content("wrapped.npy"));
    EXPECT_EQ(std::string::npos, outcome.Err.find(warning)) << outcome.Err;
  }
  this->run({ "delaunay", "given.csv", "-o", "given.npy" });
  for (const Words& how : { Words{}, Words{ "--masters", "multi" } })
  {
    Words words{ "--wrap", "360" };
    words.insert(words.end(), how.begin(), how.end());
    this->run({ "delaunay", "points.csv", "-o", "wrapped.npy" }, words);
    this->run({ "check", "points.csv", "wrapped.npy", "--wrap", "360" });
    this->run({ "check", "given.csv", "wrapped.npy" });
  }
  this->run({ "delaunay", "points.csv", "-o", "mesh.tipp", "--wrap", "360" });
  this->run({ "check", "given.csv", "mesh.tipp" });
}

TEST_F(TippLongitudes, ConstraintsAreWrappedToo)
{
  this->makePoints(500);
  this->Folder.file("given-lines.csv", "171,1,189,9\n181,8,172,3\n");
  this->Folder.file("lines.csv", "171,1,-171,9\n-179,8,172,3\n");
  this->Folder.file("ring.csv", "171,1,176,4\n-176,5,-174,5\n-174,5,-175,7\n-175,7,-176,5\n");
  this->Folder.file("ids.csv", "1,2\n3,4\n");
  this->Folder.file("area.csv", "170.5,1,-171,1\n-171,1,-175,9\n-175,9,170.5,1\n");
  this->Folder.file("given-area.csv", "170.5,1,189,1\n189,1,185,9\n185,9,170.5,1\n");
  for (const std::string output : { "", "--memory" })
  {
    const auto make = [&](const std::string& points, const Words& more)
    {
      Words words = more;
      words.insert(words.end(), { "--resolution", "0.25" });
      if (!output.empty())
      {
        words.insert(words.end(), { output, "1M" });
      }
      this->run({ "dem", points, "-o", "dem.npy" }, words);
      return this->content("dem.npy");
    };
    EXPECT_EQ(
      make("given.csv", { "--breaklines", "given-lines.csv", "--boundary", "given-area.csv" }),
      make(
        "points.csv", { "--breaklines", "lines.csv", "--boundary", "area.csv", "--wrap", "360" }));
    EXPECT_EQ(make("given.csv", { "--breaklines", "ids.csv" }),
      make("points.csv", { "--breaklines", "ids.csv", "--wrap", "360" }));
  }
  for (const char* const output : { "mesh.vtu", "mesh.tipp" })
  {
    this->run({ "delaunay", "points.csv", "-o", output, "--constraints", "ring.csv", "--boundary",
      "area.csv", "--hole", "-175", "5.5", "--wrap", "360" });
    this->Folder.file("all.csv", this->content("ring.csv") + this->content("area.csv"));
    this->run(
      { "check", "points.csv", output, "--constraints", "all.csv", "--cut", "--wrap", "360" });
  }
}

TEST_F(TippLongitudes, AcrossTheDateLineAreWarnedOf)
{
  this->makePoints(3000);
  for (const Words& words : { Words{ "delaunay", "points.csv", "-o", "mesh.npy" },
         Words{ "delaunay", "points.csv", "-o", "mesh.npy", "--masters", "multi" },
         Words{ "delaunay", "points.csv", "-o", "mesh.tipp" },
         Words{ "dem", "points.csv", "-o", "dem.npy", "--resolution", "1" },
         Words{ "dem", "points.csv", "-o", "dem.npy", "--resolution", "1", "--memory", "1M" } })
  {
    const Outcome outcome = this->run(words);
    EXPECT_NE(std::string::npos, outcome.Err.find(warning)) << words.back() << outcome.Err;
    EXPECT_NE(std::string::npos, outcome.Err.find("--wrap 360")) << words.back() << outcome.Err;
  }
}

TEST_F(TippLongitudes, AreDegrees)
{
  this->Folder.file("metres.csv", "x,y,z\n500000,0,1\n500001,0,1\n500000,1,1\n");
  const Outcome outcome =
    runTipp(this->Folder, { "delaunay", "metres.csv", "-o", "mesh.npy", "--wrap", "360" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("no longitude in degrees")) << outcome.Err;
}
