// SPDX-License-Identifier: BSD-3-Clause
// The command 'tipp dem' with --breaklines and --boundary.
#include "TippDem.h"

#include <nlohmann/json.hpp>

namespace
{

using namespace tipp::test;

/// Points of a valley between two slopes, without points on the line at its bottom.
class TippDemBreaklines : public TippDem
{
protected:
  TippDemBreaklines()
  {
    this->Folder.file("points.csv",
      "x,y,z\n0,0,10\n0,10,10\n10,0,10\n10,10,10\n0.5,3,9.5\n0.5,7,9.5\n9.5,3,9.5\n9.5,7,9.5\n");
    this->Folder.file("hard.csv", "x1,y1,z1,x2,y2,z2\n5,0,0,5,10,0\n");
    this->Folder.file("soft.csv", "x1,y1,x2,y2\n5,0,5,10\n");
    this->Folder.file("inside.csv", "x1,y1,x2,y2\n2,2,8,2\n8,2,8,8\n8,8,2,8\n2,8,2,2\n");
    this->Folder.file("open.csv", "x1,y1,x2,y2\n2,2,8,2\n8,2,8,8\n");
  }

  std::vector<double> values(const Words& more) const
  {
    Words words{ "--resolution", "1" };
    words.insert(words.end(), more.begin(), more.end());
    this->make("dem.npy", words);
    return this->valuesOf("dem.npy");
  }
};

TEST_F(TippDemBreaklines, OfGivenHeightShapeTheSurface)
{
  const std::vector<double> plain = this->values({});
  const std::vector<double> valley = this->values({ "--breaklines", "hard.csv" });
  EXPECT_GT(plain[54], 9) << "across";
  for (const std::size_t row : { 0, 4, 9 })
  {
    EXPECT_LT(valley[10 * row + 4], 2) << "beside the line";
    EXPECT_LT(valley[10 * row + 5], 2) << "beside the line";
  }
}

TEST_F(TippDemBreaklines, WithoutHeightTakeTheSurfacesHeight)
{
  for (const double value : this->values({ "--breaklines", "soft.csv" }))
  {
    EXPECT_GE(value, 9.5);
    EXPECT_LE(value, 10);
  }
}

TEST_F(TippDemBreaklines, BoundaryLeavesPixelsOutsideWithoutValue)
{
  const std::vector<double> plain = this->values({});
  const std::vector<double> inside = this->values({ "--boundary", "inside.csv" });
  for (std::size_t row = 0; row < 10; ++row)
  {
    for (std::size_t column = 0; column < 10; ++column)
    {
      const bool isInside = row >= 2 && row < 8 && column >= 2 && column < 8;
      const double value = inside[10 * row + column];
      EXPECT_EQ(!isInside, std::isnan(value)) << row << " " << column;
    }
  }
  EXPECT_GE(plain.size(), inside.size());
}

TEST_F(TippDemBreaklines, AndBoundariesBeyondThePointsDoNotEnlargeTheRaster)
{
  this->Folder.file("long.csv", "x1,y1,z1,x2,y2,z2\n5,2,0,100000,700,0\n");
  this->Folder.file(
    "around.csv", "x1,y1,x2,y2\n-5,-5,25,-5\n25,-5,25,25\n25,25,-5,25\n-5,25,-5,-5\n");
  for (const Words& lines :
    { Words{ "--breaklines", "long.csv" }, Words{ "--boundary", "around.csv" } })
  {
    const std::vector<double> expected = this->values(lines);
    EXPECT_EQ(100u, expected.size());
    Words within = lines;
    within.insert(within.end(), { "--memory", "64M" });
    const std::vector<double> made = this->values(within);
    ASSERT_EQ(expected.size(), made.size());
    EXPECT_EQ(0, std::memcmp(expected.data(), made.data(), 100 * sizeof(double)));
  }
}

TEST_F(TippDemBreaklines, RefusesABoundaryThatIsNotClosed)
{
  const Outcome outcome = this->run(
    { "dem", "points.csv", "-o", "dem.npy", "--resolution", "1", "--boundary", "open.csv" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("not closed: a line ends at (2, 2)"))
    << outcome.Err;
}

TEST_F(TippDemBreaklines, WithHeightsOfZeroFarFromTheSurfaceAreReported)
{
  const Words words{ "dem", "points.csv", "-o", "dem.npy", "--resolution", "1", "--breaklines",
    "hard.csv" };
  for (const Words& more : { Words{}, Words{ "--memory", "4M" } })
  {
    Words all = words;
    all.insert(all.end(), more.begin(), more.end());
    const Outcome outcome = this->run(all);
    EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
    EXPECT_NE(std::string::npos,
      outcome.Err.find("hard.csv: all heights are 0, but the surface at the lines is from"))
      << outcome.Err;
    EXPECT_NE(std::string::npos, outcome.Err.find("give --soft")) << outcome.Err;
    all.emplace_back("--soft");
    EXPECT_EQ(std::string::npos, this->run(all).Err.find("--soft"));
  }
}

TEST_F(TippDemBreaklines, WithHeightsOfZeroOnASurfaceAroundItAreNotReported)
{
  this->Folder.file("shore.csv", "x,y,z\n0,0,-1\n0,10,-1\n10,0,1\n10,10,1\n");
  this->Folder.file("line.csv", "x1,y1,z1,x2,y2,z2\n4,1,0,6,9,0\n");
  const Outcome outcome = this->run(
    { "dem", "shore.csv", "-o", "dem.npy", "--resolution", "1", "--breaklines", "line.csv" });
  EXPECT_EQ(0, outcome.ExitCode);
  EXPECT_EQ("", outcome.Err);
}

TEST_F(TippDemBreaklines, AreSoftOnRequest)
{
  EXPECT_EQ(this->values({ "--breaklines", "soft.csv" }),
    this->values({ "--breaklines", "hard.csv", "--soft" }));
  EXPECT_EQ(this->values({ "--breaklines", "soft.csv" }),
    this->values({ "--breaklines", "hard.csv", "--soft", "--memory", "4M" }));
}

TEST_F(TippDemBreaklines, NeedAFileForSoft)
{
  const Outcome outcome =
    this->run({ "dem", "points.csv", "-o", "dem.npy", "--resolution", "1", "--soft" });
  EXPECT_EQ(2, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("--soft: needs --breaklines")) << outcome.Err;
}

TEST_F(TippDemBreaklines, RefuseAFileWithoutLines)
{
  this->Folder.file("none.csv", "x1,y1,x2,y2\n");
  this->Folder.file("none.poly", "0 2 0 0\n0 0\n0\n");
  this->Folder.file("none.node", "1 2 0 0\n1 5 5\n");
  for (const char* const file : { "none.csv", "none.poly" })
  {
    for (const Words& more : { Words{ "--breaklines", file }, Words{ "--boundary", file },
           Words{ "--breaklines", file, "--memory", "4M" } })
    {
      Words words{ "dem", "points.csv", "-o", "dem.npy", "--resolution", "1" };
      words.insert(words.end(), more.begin(), more.end());
      const Outcome outcome = this->run(words);
      EXPECT_EQ(1, outcome.ExitCode) << file;
      EXPECT_NE(std::string::npos, outcome.Err.find(std::string(file) + ": holds no "))
        << outcome.Err;
    }
  }
}

TEST_F(TippDemBreaklines, RefuseABoundaryFarFromThePoints)
{
  this->Folder.file(
    "degrees.csv", "x1,y1,x2,y2\n-77,35,-76,35\n-76,35,-76,36\n-76,36,-77,36\n-77,36,-77,35\n");
  const Outcome outcome = this->run(
    { "dem", "points.csv", "-o", "dem.npy", "--resolution", "1", "--boundary", "degrees.csv" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(std::string::npos,
    outcome.Err.find("the boundary, x from -77 to -76 and y from 35 to 36, is nowhere near the "
                     "points, x from 0 to 10 and y from 0 to 10. Is it in another coordinate "
                     "reference system?"))
    << outcome.Err;
}

/// Points of a lattice and other points, some of them twice, with crossing lines and a boundary.
/// Their corners are points, lie on edges of triangles, or inside triangles.
class TippDemConstrained : public TippDem
{
protected:
  TippDemConstrained()
  {
    tipp::Random random(7);
    std::ofstream csv(this->Folder.path("points.csv"));
    csv << "x,y,z,intensity\n";
    const auto draw = [&random](int count) { return int(count * random.uniform()); };
    for (int i = 0; i < 60000; ++i)
    {
      csv << draw(400) / 4.0 << "," << draw(1600) / 16.0 << "," << draw(1000) / 7.0 << ","
          << draw(255) << "\n";
    }
    std::ofstream lines(this->Folder.path("lines.csv"));
    lines << "x1,y1,z1,x2,y2,z2\n";
    for (int i = 0; i < 40; ++i)
    {
      const auto corner = [&]
      {
        lines << draw(800) / 8.0 << "," << draw(800) / 8.0 << ",";
        if (i % 3 != 0)
        {
          lines << draw(100);
        }
      };
      corner();
      lines << ",";
      corner();
      lines << "\n";
    }
    this->Folder.file("ring.csv",
      "x1,y1,x2,y2\n3,4.0625,93.5,5\n93.5,5,60.03,50.01\n60.03,50.01,97,96\n97,96,3,4.0625\n");
  }

  std::string raster(const Words& more) const
  {
    Words words{ "--resolution", "0.3", "--attributes", "elevation,intensity,slope,void",
      "--duplicates", "max", "--max-edge", "40", "--breaklines", "lines.csv" };
    words.insert(words.end(), more.begin(), more.end());
    this->make("dem.npy", words);
    return this->content("dem.npy");
  }
};

TEST_F(TippDemConstrained, PixelsAreTheSameForAnyMemory)
{
  const std::string lines = this->raster({});
  const std::string cut = this->raster({ "--boundary", "ring.csv" });
  EXPECT_TRUE(lines != cut);
  for (const char* memory : { "2M", "3M", "8M", "100M" })
  {
    EXPECT_TRUE(lines == this->raster({ "--memory", memory, "--threads", "2" })) << memory;
    EXPECT_TRUE(cut == this->raster({ "--boundary", "ring.csv", "--memory", memory })) << memory;
  }
}

TEST_F(TippDemConstrained, SumsAreTheSameWithinALimitOfMemory)
{
  const auto figures = [&](const Words& more)
  {
    Words words{ "--stats", "run.json" };
    words.insert(words.end(), more.begin(), more.end());
    this->raster(words);
    auto json = nlohmann::json::parse(this->content("run.json"));
    for (const char* own : { "read_seconds", "make_seconds", "write_seconds", "peak_memory_bytes" })
    {
      json.erase(own);
    }
    return json.dump();
  };
  EXPECT_EQ(figures({}), figures({ "--memory", "3M" }));
}

TEST_F(TippDemConstrained, RefusesABoundaryThatIsNotClosedWithinALimitOfMemory)
{
  const Outcome outcome = this->run({ "dem", "points.csv", "-o", "dem.npy", "--resolution", "1",
    "--boundary", "lines.csv", "--memory", "8M" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("not closed")) << outcome.Err;
}

} // namespace
