// SPDX-License-Identifier: BSD-3-Clause
// The command 'tipp dem', which makes a raster from points.
#include "TippDem.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <vector>

namespace
{

using namespace tipp::test;

TEST_F(TippDem, EqualsTriangulationAndResampling)
{
  this->makePoints(3000);
  ASSERT_EQ(0, this->run({ "delaunay", "points.csv", "-o", "mesh.vtu" }).ExitCode);
  const Words range = { "--bounds", "0.125", "100.125", "0.125", "100.125", "0", "0", "--delta",
    "0.25", "0.25", "0" };
  Words words{ "resample", "mesh.vtu", "-o", "steps.npy" };
  words.insert(words.end(), range.begin(), range.end());
  ASSERT_EQ(0, this->run(words).ExitCode);
  for (const char* const threads : { "1", "3" })
  {
    this->make("dem.npy",
      { "--resolution", "0.25", "--bounds", "0", "100.25", "0", "100.25", "--threads", threads });
    EXPECT_EQ(this->content("steps.npy"), this->content("dem.npy"));
  }
}

TEST_F(TippDem, EqualsResamplingAtDecimalPositions)
{
  // Pixel centres are on the long edge. No double is exactly 0.1.
  this->Folder.file("points.csv", "x,y,z\n0.05,0.05,1\n1.55,0.55,2\n0.05,1.15,4\n");
  ASSERT_EQ(0, this->run({ "delaunay", "points.csv", "-o", "mesh.vtu" }).ExitCode);
  ASSERT_EQ(0, this->run({ "partition", "mesh.vtu", "-o", "mesh.tipp" }).ExitCode);
  this->make("dem.npy", { "--resolution", "0.1" });
  this->make("small.npy", { "--resolution", "0.1", "--memory", "2M" });
  EXPECT_EQ(this->content("dem.npy"), this->content("small.npy"));
  const std::vector<double> values = this->valuesOf("dem.npy");
  ASSERT_EQ(16U * 12, values.size());
  EXPECT_EQ(
    93, std::count_if(values.begin(), values.end(), [](double v) { return !std::isnan(v); }));
  for (const char* const mesh : { "mesh.vtu", "mesh.tipp" })
  {
    ASSERT_EQ(0,
      this
        ->run({ "resample", mesh, "-o", "steps.npy", "--bounds", "0.05", "1.55", "0.05", "1.15",
          "0", "0", "--delta", "0.1", "0.1", "0" })
        .ExitCode);
    EXPECT_EQ(this->content("dem.npy"), this->content("steps.npy")) << mesh;
  }
}

TEST_F(TippDem, MakesTheSameFileForAnyMemoryAndDivisionOfTheInput)
{
  this->makePoints(30000);
  std::ifstream csv(this->Folder.path("points.csv"));
  std::ofstream first(this->Folder.path("a.csv"));
  std::ofstream second(this->Folder.path("b.csv"));
  std::string line;
  for (int i = 0; std::getline(csv, line); ++i)
  {
    (i < 12000 || i == 0 ? first : second) << line << "\n";
    if (i == 0)
    {
      second << line << "\n";
    }
  }
  first.close();
  second.close();
  const Words options = { "--resolution", "0.2", "--attributes",
    "elevation,intensity,slope,hillshade", "--max-edge", "2" };
  this->make("dem.npy", options);
  EXPECT_EQ(4U * 501 * 501, this->valuesOf("dem.npy").size() + 4 * (501 * 501 - 500 * 500));
  for (const Words& input : { Words{ "points.csv" }, Words{ "a.csv", "b.csv" } })
  {
    Words words{ "dem", "-o", "small.npy", "--memory", "2M", "--stats", "s.json" };
    words.insert(words.begin() + 1, input.begin(), input.end());
    words.insert(words.end(), options.begin(), options.end());
    const Outcome outcome = this->run(words);
    ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
    EXPECT_EQ(this->content("dem.npy"), this->content("small.npy")) << input.size();
  }
  EXPECT_FALSE(std::filesystem::exists(this->Folder.path(".small.npy.pixels.part")));
}

TEST_F(TippDem, MakesTheSameGeoTiffForAnyMemory)
{
  this->makePoints(30000);
  for (const Words& options : { Words{}, Words{ "--compress", "none", "--max-edge", "1.2" },
         Words{ "--type", "float64", "--attributes", "elevation,aspect,void" } })
  {
    Words words = { "--resolution", "0.1" };
    words.insert(words.end(), options.begin(), options.end());
    this->make("dem.tif", words);
    words.insert(words.end(), { "--memory", "2M", "--threads", "3" });
    this->make("small.tif", words);
    EXPECT_EQ(this->content("dem.tif"), this->content("small.tif")) << options.size();
  }
}

TEST_F(TippDem, MakesTheSamePixelsIfTheyAreAtPoints)
{
  std::ofstream csv(this->Folder.path("points.csv"));
  csv << "x,y,z\n";
  for (int i = 0; i < 120; ++i)
  {
    for (int j = 0; j < 120; ++j)
    {
      csv << i + 0.5 << "," << j + 0.5 << "," << i * j % 17 << "\n";
    }
  }
  csv.close();
  this->make("dem.npy", { "--resolution", "1" });
  this->make("small.npy", { "--resolution", "1", "--memory", "2M" });
  EXPECT_EQ(this->content("dem.npy"), this->content("small.npy"));
  const std::vector<double> values = this->valuesOf("dem.npy");
  ASSERT_EQ(120U * 120, values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    ASSERT_EQ(double(i % 120 * (i / 120) % 17), values[i]); // also on the far border
  }
}

TEST_F(TippDem, DerivesSlopeAspectAndHillshade)
{
  this->Folder.file("points.csv", "x,y,z\n0,0,10\n10,0,0\n0,10,10\n10,10,0\n"); // falls to the east
  this->make("dem.npy", { "--resolution", "5", "--attributes", "slope,aspect,hillshade" });
  const std::vector<double> values = this->valuesOf("dem.npy");
  ASSERT_EQ(12U, values.size());
  for (std::size_t i = 0; i < 4; ++i)
  {
    EXPECT_NEAR(45, values[i], 1e-12);
    EXPECT_NEAR(90, values[4 + i], 1e-12);
    EXPECT_NEAR(1 + 254 * (0.5 - std::sqrt(0.125)), values[8 + i], 1e-12);
  }
}

TEST_F(TippDem, DensityIsHalfAPointInEachTriangle)
{
  this->Folder.file("points.csv", "x,y\n0,0\n4,0\n0,4\n");
  this->make("dem.npy", { "--resolution", "2", "--attributes", "density" });
  EXPECT_EQ(1.0 / 16, this->valuesOf("dem.npy").front());
}

TEST_F(TippDem, LeavesOutTrianglesWithLongEdges)
{
  this->Folder.file("points.csv", "x,y,z\n0,0,1\n2,0,1\n0,2,1\n2,2,1\n9,1,1\n");
  this->make("dem.npy", { "--resolution", "1", "--max-edge", "3" });
  const std::vector<double> values = this->valuesOf("dem.npy");
  ASSERT_EQ(18U, values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    EXPECT_EQ(i % 9 >= 2, std::isnan(values[i])) << i;
  }
}

TEST_F(TippDem, AlignsPixelsToMultiplesOfTheResolution)
{
  this->Folder.file("points.csv", "x,y,z\n-3.5,7,1\n12,7,1\n-3.5,18,1\n");
  this->make("dem.npy", { "--resolution", "5", "--stats", "s.json" });
  nlohmann::json figures = nlohmann::json::parse(this->content("s.json"));
  EXPECT_EQ(-5, figures["west"]);
  EXPECT_EQ(5, figures["south"]);
  EXPECT_EQ(4, figures["columns"]);
  EXPECT_EQ(3, figures["rows"]);
  this->make("dem.npy", { "--resolution", "5", "--align", "bounds", "--stats", "s.json" });
  figures = nlohmann::json::parse(this->content("s.json"));
  EXPECT_EQ(-3.5, figures["west"]);
  EXPECT_EQ(7, figures["south"]);
  EXPECT_EQ(4, figures["columns"]);
  EXPECT_EQ(3, figures["rows"]);
}

TEST_F(TippDem, WritesAnImageThatResampleReadsBack)
{
  this->makePoints(500);
  this->make("dem.vti", { "--resolution", "2", "--attributes", "elevation,intensity" });
  const Outcome outcome =
    this->run({ "points", "--like", "dem.vti", "--count", "3", "-o", "p.npy" });
  EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
}

TEST_F(TippDem, InfoShowsCountsBoundsAndDuplicates)
{
  this->Folder.file("points.csv", "x,y,z\n0,0,1\n10,0,-2\n0,10,\n0,0,4\n,3,1\n");
  const Outcome outcome = this->run({ "info", "points.csv" });
  ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  for (const char* const line :
    { "points      5, 1 without finite coordinates\n", "x           0 to 10, 1 missing\n",
      "z           -2 to 4, 1 missing\n", "duplicates  1\n", "resolution  5," })
  {
    EXPECT_NE(std::string::npos, outcome.Out.find(line)) << line << outcome.Out;
  }
}

TEST_F(TippDem, RefusesMorePixelsThanTheMemoryHolds)
{
  this->Folder.file("points.csv", "x,y,z\n0,0,1\n1000000,0,1\n0,1000000,1\n");
  const Outcome outcome =
    this->run({ "dem", "points.csv", "-o", "dem.npy", "--resolution", "0.1" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("10000000 x 10000000 pixels")) << outcome.Err;
}

TEST_F(TippDem, VoidBandMarksPixelsWithoutATriangle)
{
  this->Folder.file("points.csv", "x,y\n0,0\n4,0\n0,4\n");
  for (const Words& more : { Words{}, Words{ "--memory", "2M" } })
  {
    Words words = { "--resolution", "2", "--attributes", "void" };
    words.insert(words.end(), more.begin(), more.end());
    this->make("dem.npy", words);
    EXPECT_EQ((std::vector<double>{ 0, 0, 0, 1 }), this->valuesOf("dem.npy"));
  }
}

TEST_F(TippDem, RefusesMorePixelsThanTheDiskHolds)
{
  this->makePoints(100);
  const Outcome outcome = this->run(
    { "dem", "points.csv", "-o", "dem.npy", "--resolution", "0.00001", "--memory", "2M" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("MB free")) << outcome.Err;
}

TEST_F(TippDem, RefusesMorePixelsThanAnyDiskHolds)
{
  this->makePoints(10);
  const Outcome outcome =
    this->run({ "dem", "points.csv", "-o", "dem.npy", "--resolution", "5e-8", "--memory", "8M" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("MB while it is made")) << outcome.Err;
}

TEST_F(TippDem, WarnsOfValuesThatEqualTheNumberForNoData)
{
  this->makePoints(100);
  for (const Words& more : { Words{}, Words{ "--memory", "8M" } })
  {
    Words words{ "dem", "points.csv", "-o", "dem.tif", "--resolution", "10", "--attributes",
      "elevation,void", "--nodata", "0" };
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = this->run(words);
    EXPECT_EQ(0, outcome.ExitCode);
    EXPECT_NE(std::string::npos, outcome.Err.find("100 values equal the number for no data, 0"))
      << outcome.Err;
  }
}

TEST_F(TippDem, RefusesANumberForNoDataThatItsTypeDoesNotHave)
{
  this->makePoints(10);
  Words words{ "dem", "points.csv", "-o", "dem.tif", "--resolution", "10", "--nodata", "1e300" };
  EXPECT_EQ(2, this->run(words).ExitCode);
  words.insert(words.end(), { "--type", "float64" });
  EXPECT_EQ(0, this->run(words).ExitCode);
}

TEST_F(TippDem, CountsPointsWithoutElevation)
{
  this->Folder.file("points.csv", "x,y,z\n0,0,1\n9,0,1\n0,9,1\n9,9,\n4,4,nan\n");
  for (const Words& more : { Words{}, Words{ "--memory", "8M" } })
  {
    Words words{ "dem", "points.csv", "-o", "dem.tif", "--resolution", "1" };
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = this->run(words);
    EXPECT_EQ(0, outcome.ExitCode);
    EXPECT_NE(std::string::npos, outcome.Err.find("2 points have no elevation")) << outcome.Err;
  }
}

TEST_F(TippDem, InfiniteHeightsAreMissingHeights)
{
  // Some points coincide, so that the rules for duplicates and thinning meet missing heights too.
  const auto write = [this](const char* name, const char* high, const char* low)
  {
    std::ofstream csv(this->Folder.path(name));
    csv << "x,y,z\n0,0,1\n20,0,2\n0,20,3\n20,20,4\n5,5,7\n5,5," << high << "\n15,5," << low
        << "\n15,5,2\n12,14," << high << "\n3,15," << low << "\n";
  };
  write("nan.csv", "nan", "nan");
  write("inf.csv", "inf", "-inf");
  this->Folder.file("inf-lines.csv", "1,1,inf,9,2,8\n");
  this->Folder.file("nan-lines.csv", "1,1,nan,9,2,8\n");
  const Words bands = { "--resolution", "1", "--attributes",
    "elevation,slope,aspect,hillshade,density,void" };
  for (const Words& choice : { Words{}, Words{ "--duplicates", "max" },
         Words{ "--duplicates", "min" }, Words{ "--duplicates", "mean" },
         Words{ "--thin", "6:max" }, Words{ "--thin", "6:min" }, Words{ "--breaklines" } })
  {
    for (const Words& memory : { Words{}, Words{ "--memory", "8M" } })
    {
      const auto make = [&](const std::string& kind)
      {
        Words words{ "dem", kind + ".csv", "-o", kind + ".npy" };
        for (const Words* const more : { &bands, &memory, &choice })
        {
          words.insert(words.end(), more->begin(), more->end());
        }
        words.insert(words.end(), choice.size() == 1, kind + "-lines.csv");
        const Outcome outcome = this->run(words);
        EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
      };
      make("nan");
      make("inf");
      EXPECT_EQ(this->content("nan.npy"), this->content("inf.npy"))
        << (choice.empty() ? "" : choice.back()) << " " << memory.size();
    }
  }
}

TEST_F(TippDem, PixelsWithoutElevationHaveNoHillshade)
{
  this->Folder.file("points.csv", "x,y,z\n0,0,1\n4,0,nan\n0,4,3\n4,4,4\n");
  this->make("dem.npy", { "--resolution", "1", "--attributes", "elevation,hillshade" });
  const std::vector<double> values = this->valuesOf("dem.npy");
  ASSERT_EQ(32U, values.size());
  for (std::size_t i = 0; i < 16; ++i)
  {
    EXPECT_EQ(std::isnan(values[i]), std::isnan(values[16 + i])) << i;
  }
}

TEST_F(TippDem, WarnsWhereNoPixelHasAValue)
{
  this->Folder.file("points.csv", "x,y,z\n0,0,1\n100,0,1\n0,100,1\n");
  const Outcome outcome = this->run({ "dem", "points.csv", "-o", "dem.npy", "--resolution", "1",
    "--bounds", "80", "90", "80", "90" });
  EXPECT_EQ(0, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("no pixel has a value")) << outcome.Err;
}

TEST_F(TippDem, RefusesBoundsOutsideOfThePoints)
{
  this->Folder.file("points.csv", "x,y,z\n0,0,1\n100,0,1\n0,100,1\n");
  for (const Words& more : { Words{}, Words{ "--memory", "2M" } })
  {
    Words words{ "dem", "points.csv", "-o", "dem.npy", "--resolution", "1", "--bounds", "200",
      "210", "0", "9" };
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = this->run(words);
    EXPECT_EQ(1, outcome.ExitCode);
    EXPECT_NE(std::string::npos,
      outcome.Err.find("the bounds, x from 200 to 210 and y from 0 to 9, do not meet those of the "
                       "points, x from 0 to 100 and y from 0 to 100; give bounds in the order xmin "
                       "xmax ymin ymax."))
      << outcome.Err;
  }
}

TEST_F(TippDem, LongTrianglesOverManyTilesAreTheSameForAnyMemory)
{
  // Points in a row and one point far away: thin triangles across most tiles.
  std::ofstream csv(this->Folder.path("points.csv"));
  csv << "x,y,z\n4000,3500,9\n";
  for (int i = 0; i < 4000; ++i)
  {
    csv << i / 1000.0 << "," << 7 * std::sin(i) << "," << i % 17 << "\n";
  }
  csv.close();
  this->make("whole.npy", { "--resolution", "2" });
  this->make("dem.npy", { "--resolution", "2", "--memory", "2M" });
  EXPECT_TRUE(this->content("whole.npy") == this->content("dem.npy"));
}

TEST_F(TippDem, ManyBandsAreTheSameForAnyMemory)
{
  this->makePoints(20000);
  const std::string bands = "elevation,intensity,slope,aspect,hillshade,density,void";
  this->make("whole.npy", { "--resolution", "0.2", "--attributes", bands });
  this->make("dem.npy", { "--resolution", "0.2", "--attributes", bands, "--memory", "4M" });
  EXPECT_TRUE(this->content("whole.npy") == this->content("dem.npy"));
}

TEST_F(TippDem, ReportsAMissingColumn)
{
  this->makePoints(50);
  const Outcome outcome = this->run(
    { "dem", "points.csv", "-o", "dem.npy", "--resolution", "1", "--attributes", "depth" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("no column 'depth'")) << outcome.Err;
  this->Folder.file("flat.csv", "x,y\n0,0\n1,0\n0,1\n");
  const Outcome flat = this->run({ "dem", "flat.csv", "-o", "dem.npy", "--resolution", "1" });
  EXPECT_EQ(1, flat.ExitCode);
  EXPECT_NE(std::string::npos, flat.Err.find("no column 'z'")) << flat.Err;
}

TEST_F(TippDem, ListsEndWithTheirWord)
{
  this->makePoints(50);
  const Outcome outcome = this->run({ "dem", "--attributes", "elevation,slope", "points.csv", "-o",
    "dem.npy", "--resolution", "50" });
  EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
  EXPECT_EQ(8U, this->valuesOf("dem.npy").size());
}

TEST_F(TippDem, RefusesConflictingOptions)
{
  EXPECT_EQ(2, this->run({ "dem", "points.csv", "-o", "dem.npy" }).ExitCode);
  EXPECT_EQ(2, this->run({ "dem", "points.csv", "-o", "dem.png", "--resolution", "1" }).ExitCode);
  EXPECT_EQ(2,
    this->run({ "dem", "points.csv", "-o", "dem.npy", "--resolution", "1", "--resume" }).ExitCode);
  for (const Words& more : { Words{ "--compress", "zstd" }, Words{ "--nodata", "0" },
         Words{ "--strict-crs" }, Words{ "--attributes", "elevation,void,elevation" } })
  {
    Words words{ "dem", "points.csv", "-o", "dem.npy", "--resolution", "1" };
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(2, this->run(words).ExitCode) << more.front();
  }
  for (const char* const number : { "nan", "inf", "0", "-1", "1m" })
  {
    EXPECT_EQ(
      2, this->run({ "dem", "points.csv", "-o", "dem.npy", "--resolution", number }).ExitCode);
    EXPECT_EQ(2,
      this->run({ "dem", "points.csv", "-o", "dem.npy", "--resolution", "1", "--max-edge", number })
        .ExitCode);
  }
}

TEST_F(TippDem, ResumesAKilledRun)
{
  this->makePoints(30000);
  this->make("whole.tif", { "--resolution", "0.2" });
  const Words words{ "dem", "points.csv", "-o", "dem.tif", "--resolution", "0.2", "--memory", "2M",
    "--threads", "2", "--resume" };
  const auto results = [&]
  {
    std::size_t count = 0;
    std::error_code ignored;
    for (const auto& entry :
      std::filesystem::directory_iterator(this->Folder.path(".dem.tif.pixels.part"), ignored))
    {
      (void)entry;
      ++count;
    }
    return count;
  };
  for (std::size_t files = 4; files < 10; files += 2)
  {
    const TippProcess process(this->Folder, words);
    process.waitUntil([&] { return results() >= files; });
    process.kill();
    process.wait();
  }
  const Outcome outcome = this->run(words);
  ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  EXPECT_EQ(this->content("whole.tif"), this->content("dem.tif"));
  EXPECT_EQ(0U, results());
}

TEST_F(TippDem, SaysThatAllTrianglesHaveTooLongEdges)
{
  this->Folder.file("points.csv", "x,y,z\n0,0,1\n10,0,1\n0,10,1\n10,10,1\n");
  const Outcome outcome =
    this->run({ "dem", "points.csv", "-o", "dem.npy", "--resolution", "1", "--max-edge", "5" });
  EXPECT_EQ(0, outcome.ExitCode);
  EXPECT_NE(std::string::npos,
    outcome.Err.find("each triangle has an edge longer than the 5 of --max-edge"))
    << outcome.Err;
}

TEST_F(TippDem, RefusesBoundsInTheOrderOfGdal)
{
  this->Folder.file("points.csv",
    "x,y,z\n500000,4900000,1\n500100,4900000,1\n500000,4900200,1\n500100,4900200,1\n");
  const Words words{ "dem", "points.csv", "-o", "dem.npy", "--resolution", "10", "--bounds" };
  Words gdal = words;
  gdal.insert(gdal.end(), { "500000", "4900000", "500100", "4900200" });
  const Outcome outcome = this->run(gdal);
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("in the order xmin xmax ymin ymax")) << outcome.Err;
  Words ours = words;
  ours.insert(ours.end(), { "500000", "500100", "4900000", "4900200" });
  EXPECT_EQ(0, this->run(ours).ExitCode);
}

} // namespace
