// SPDX-License-Identifier: BSD-3-Clause
// Commands that read only a part of the points: --bounds, --spacing and --preview.
#include "RunTipp.h"

#include "Arrays/Random.h"
#include "CopcText.h"
#include "Files/TextFile.h"
#include "LasText.h"
#include "Points/ReadPoints.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

using Words = std::vector<std::string>;

/// Integer coordinates in a square of this side; as coordinates 0.01 of that, y from 100 on.
constexpr std::int32_t side = CopcText::Side;
constexpr double width = 0.01 * side;

class TippRegion : public testing::Test
{
protected:
  Outcome run(Words words) const { return runTipp(this->Folder, words); }

  /// Runs a command that must succeed.
  Outcome make(const Words& words) const
  {
    Outcome outcome = this->run(words);
    EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
    return outcome;
  }

  /// Writes random points as all.copc.laz, and in the same order as all.csv.
  void makePoints(int count, const std::function<bool(double, double)>& isLeftOut = {}) const
  {
    CopcText copc;
    Random random(4);
    for (int i = 0; i < count; ++i)
    {
      const auto next = [&] { return std::int32_t(side / 64 * random.uniform()) * 64; };
      const std::int32_t x = next() + i % 64;
      const std::int32_t y = next() + i / 64 % 64;
      const std::int32_t z = next() / 16;
      if (!isLeftOut || !isLeftOut(0.01 * x, 0.01 * y))
      {
        copc.add(x, y, z, 1 + i % 2);
      }
    }
    this->Folder.file("all.copc.laz", copc.text());
    this->writeText("all.copc.laz", "all.csv");
  }

  void writeText(const std::string& from, const std::string& to) const
  {
    const PointTable points = readPoints(this->Folder.path(from));
    std::string text = "x,y,z\n";
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      text += exactText(points.XY[2 * i]) + "," + exactText(points.XY[2 * i + 1]) + "," +
        exactText(points.Columns[0].Values[i]) + "\n";
    }
    this->Folder.file(to, text);
  }

  /// Makes the same raster from files and from a text of their points, and expects the same bytes.
  /// Returns the statistics of the first run.
  nlohmann::json expectSameRaster(const Words& files, const Words& options) const
  {
    const auto words = [&](const Words& inputs, const std::string& output)
    {
      Words all{ "dem" };
      all.insert(all.end(), inputs.begin(), inputs.end());
      all.insert(all.end(), { "-o", output });
      all.insert(all.end(), options.begin(), options.end());
      return all;
    };
    Words part = words(files, "part.npy");
    part.insert(part.end(), { "--stats", "part.json" });
    this->make(part);
    this->make(words({ "all.csv" }, "all.npy"));
    EXPECT_EQ(contentOf(this->Folder.path("all.npy")), contentOf(this->Folder.path("part.npy")));
    return nlohmann::json::parse(contentOf(this->Folder.path("part.json")));
  }

  /// The option --bounds of a square, in parts of the whole one.
  static Words square(double x, double y, double part)
  {
    return { "--bounds", exactText(x * width), exactText((x + part) * width),
      exactText(100 + y * width), exactText(100 + (y + part) * width) };
  }

  static Words join(Words words, const Words& more)
  {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  TemporaryFolder Folder;
};

TEST_F(TippRegion, DemReadsOnlyThePointsThatItsPixelsDependOn)
{
  this->makePoints(6000);
  for (const double x : { 0.4, 0.55 })
  {
    const nlohmann::json statistics = this->expectSameRaster(
      { "all.copc.laz" }, join({ "--resolution", "20" }, square(x, 0.5, 0.1)));
    EXPECT_GT(statistics["not_read"]["points"], 4000);
    EXPECT_LT(statistics["points"], 1500);
  }
}

TEST_F(TippRegion, DemHasTheSameBandsAsOfAllPoints)
{
  this->makePoints(6000);
  for (const Words& more : { Words{ "--attributes", "elevation,slope,hillshade,density,void" },
         Words{ "--max-edge", "150" }, Words{ "--align", "bounds" }, Words{ "--threads", "3" } })
  {
    const nlohmann::json statistics = this->expectSameRaster(
      { "all.copc.laz" }, join(join({ "--resolution", "15" }, more), square(0.3, 0.45, 0.12)));
    EXPECT_GT(statistics["not_read"]["points"], 0);
  }
}

/// In the gap and beside it, triangles are larger than the first margin around the pixels.
TEST_F(TippRegion, DemReadsMoreBesideAGap)
{
  constexpr int count = 20000;
  LasText las(2, 1);
  Random random(6);
  for (int i = 0; i < count; ++i)
  {
    const double x = random.uniform();
    const double y = random.uniform();
    if (std::hypot(x - 0.5, y - 0.5) > 0.075)
    {
      las.add(int(1e6 * x), int(1e6 * y), int(1000 * x * y), 2);
    }
  }
  las.header(179, 1e4);
  las.header(195, 1e4 + 100);
  this->Folder.file("all.las", las.text());
  this->writeText("all.las", "all.csv");
  const auto pointsFor = [&](double low)
  {
    return this
      ->expectSameRaster({ "all.las" },
        { "--resolution", "10", "--bounds", exactText(low), exactText(low + 150), "5000",
          "5150" })["points"]
      .get<int>();
  };
  const int far = pointsFor(2000);
  EXPECT_LT(far, 1000);
  for (const double low : { 4350.0, 4900.0 })
  {
    const int near = pointsFor(low);
    EXPECT_GT(near, 3 * far);
    EXPECT_LT(near, count / 3);
  }
}

TEST_F(TippRegion, DemIsTheSameBesideALargeGap)
{
  const auto isInGap = [](double x, double y)
  { return std::hypot(x - 0.63 * width, y - 0.5 * width) < 0.11 * width; };
  this->makePoints(9000, isInGap);
  for (const double x : { 0.42, 0.5 })
  {
    this->expectSameRaster(
      { "all.copc.laz" }, join({ "--resolution", "25" }, square(x, 0.45, 0.1)));
  }
}

TEST_F(TippRegion, DemIsTheSameAtTheBorderOfThePoints)
{
  this->makePoints(5000);
  for (const Words& bounds : { square(0, 0, 0.1), square(0.95, 0.5, 0.1), square(-0.05, 0.2, 0.1),
         square(0.45, 0.98, 0.03) })
  {
    const nlohmann::json statistics =
      this->expectSameRaster({ "all.copc.laz" }, join({ "--resolution", "30" }, bounds));
    EXPECT_EQ(0, statistics["not_read"]["points"]);
  }
}

/// Pixels' centres are at points, and many points lie on one circle.
TEST_F(TippRegion, DemIsTheSameForALattice)
{
  const auto latticeOf = [](int begin, int end)
  {
    LasText las(2, 1);
    for (int i = begin; i < end; ++i)
    {
      for (int j = 0; j < 80; ++j)
      {
        las.add(500 * i, 500 * j, (i * i + 7 * j) % 50, 2);
      }
    }
    las.header(179, 5.0 * (end - 1));
    las.header(187, 5.0 * begin);
    las.header(195, 100 + 5.0 * 79);
    las.header(203, 100.0);
    return las.text();
  };
  this->Folder.file("west.las", latticeOf(0, 40));
  this->Folder.file("east.las", latticeOf(40, 400));
  this->Folder.file("all.las", latticeOf(0, 400));
  this->writeText("all.las", "all.csv");
  const nlohmann::json statistics = this->expectSameRaster({ "west.las", "east.las" },
    { "--resolution", "5", "--align", "bounds", "--bounds", "1497.5", "1642.5", "247.5", "297.5" });
  EXPECT_EQ(1, statistics["not_read"]["files"]);
  EXPECT_EQ(40 * 80, statistics["not_read"]["points"]);
}

TEST_F(TippRegion, DemWithLinesThinningOrMemoryReadsAllPoints)
{
  this->makePoints(4000);
  this->Folder.file("line.csv", "x1,y1,x2,y2\n2000,3000,8000,6000\n");
  for (const Words& more :
    { Words{ "--breaklines", "line.csv" }, Words{ "--thin", "50:min" }, Words{ "--memory", "8M" } })
  {
    const nlohmann::json statistics = this->expectSameRaster(
      { "all.copc.laz" }, join(join({ "--resolution", "20" }, more), square(0.4, 0.4, 0.1)));
    EXPECT_EQ(0, statistics["not_read"]["points"]);
  }
}

TEST_F(TippRegion, DemOutsideOfAllPointsIsRefused)
{
  this->makePoints(500);
  const Outcome outcome = this->run(
    join({ "dem", "all.copc.laz", "-o", "a.npy", "--resolution", "20" }, square(3, 3, 0.1)));
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("do not meet those of the points")) << outcome.Err;
}

TEST_F(TippRegion, PreviewReadsTheLevelsThatItsPixelsNeed)
{
  this->makePoints(5000);
  const Words dem{ "dem", "all.copc.laz", "-o", "a.npy", "--stats", "a.json", "--resolution" };
  const auto points = [&](const Words& more)
  {
    this->make(join(dem, more));
    return nlohmann::json::parse(contentOf(this->Folder.path("a.json")))["points"].get<int>();
  };
  const int coarse = points({ "41", "--preview" }); // the spacing of level 1 is 40.96
  EXPECT_EQ(coarse, points({ "41", "--spacing", "60" }));
  EXPECT_LE(coarse, 9);
  const int fine = points({ "11", "--preview" });
  EXPECT_GT(fine, coarse);
  EXPECT_LT(fine, 1000);
  EXPECT_EQ(5000, points({ "41" }));
  EXPECT_LT(points(join({ "11", "--preview" }, square(0.2, 0.2, 0.2))), fine);
}

TEST_F(TippRegion, PreviewOutsideOfAllPointsIsRefused)
{
  this->makePoints(500);
  const Outcome outcome = this->run(join(
    { "dem", "all.copc.laz", "-o", "a.npy", "--resolution", "20", "--preview" }, square(3, 3, 1)));
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("has no point with x from")) << outcome.Err;
}

TEST_F(TippRegion, BoundsThatMakeNoRasterNameTheFile)
{
  this->makePoints(10);
  const Outcome outcome = this->run({ "dem", "all.copc.laz", "-o", "a.npy", "--resolution", "20",
    "--preview", "--bounds", "5", "4", "0", "1" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("all.copc.laz: ")) << outcome.Err;
}

TEST_F(TippRegion, PointsInTheBoundsAreCopied)
{
  this->makePoints(1000);
  const Words bounds = square(0.2, 0.3, 0.3);
  this->make(join({ "points", "all.csv", "-o", "a.npy" }, bounds));
  const Outcome outcome = this->make(join({ "points", "all.copc.laz", "-o", "b.npy" }, bounds));
  EXPECT_EQ(contentOf(this->Folder.path("a.npy")), contentOf(this->Folder.path("b.npy")));
  EXPECT_NE(std::string::npos, outcome.Err.find("not read, because not needed")) << outcome.Err;
  this->make(join({ "points", "all.copc.laz", "-o", "c.laz" }, bounds));
  this->make({ "points", "c.laz", "-o", "c.npy" });
  EXPECT_EQ(contentOf(this->Folder.path("a.npy")), contentOf(this->Folder.path("c.npy")));
}

TEST_F(TippRegion, PreviewNeedsLevels)
{
  LasText las(2, 1);
  las.add(1, 2, 3, 2);
  this->Folder.file("a.las", las.text());
  const Outcome outcome =
    this->run({ "dem", "a.las", "-o", "a.npy", "--resolution", "1", "--preview" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("a.las: is no COPC file")) << outcome.Err;
  const Outcome both = this->run(
    { "dem", "a.las", "-o", "a.npy", "--resolution", "1", "--preview", "--spacing", "3" });
  EXPECT_NE(0, both.ExitCode);
  EXPECT_NE(std::string::npos, both.Err.find("cannot be combined")) << both.Err;
}

TEST_F(TippRegion, DelaunayTriangulatesThePointsInTheBounds)
{
  this->makePoints(4000);
  const Words bounds = square(0.2, 0.3, 0.3);
  for (const char* const output : { "a.vtu", "a.tipp" })
  {
    this->make(join({ "delaunay", "all.copc.laz", "-o", output }, bounds));
    this->make(join({ "check", "all.csv", output }, bounds));
  }
  const auto triangles = [&](const std::string& input, const std::string& output)
  {
    this->make(join({ "delaunay", input, "-o", output }, bounds));
    return contentOf(this->Folder.path(output));
  };
  EXPECT_EQ(triangles("all.csv", "a.npy"), triangles("all.copc.laz", "b.npy"));
}

TEST_F(TippRegion, BoundsWithoutPointsAreRefused)
{
  this->makePoints(100);
  for (const Words& command : { Words{ "delaunay", "all.copc.laz", "-o", "a.vtu" },
         Words{ "delaunay", "all.copc.laz", "-o", "a.tipp" },
         Words{ "delaunay3d", "all.copc.laz", "-o", "a.tipp" },
         Words{ "delaunay3d", "all.csv", "-o", "a.vtu" }, Words{ "info", "all.copc.laz" } })
  {
    const Outcome outcome = this->run(join(command, square(2, 2, 0.1)));
    EXPECT_EQ(1, outcome.ExitCode);
    EXPECT_NE(std::string::npos, outcome.Err.find("has no point with x from")) << outcome.Err;
  }
  const Outcome swapped =
    this->run({ "delaunay", "all.csv", "-o", "a.vtu", "--bounds", "5", "4", "0", "1" });
  EXPECT_NE(0, swapped.ExitCode);
  EXPECT_NE(std::string::npos, swapped.Err.find("give xmin xmax ymin ymax")) << swapped.Err;
}

TEST_F(TippRegion, BoundsInTheOrderOfGdalAreRefusedWithThoseOfThePoints)
{
  this->Folder.file(
    "utm.csv", "x,y,z\n500000,4900000,1\n500100,4900000,1\n500000,4900200,1\n500100,4900200,1\n");
  this->make({ "points", "utm.csv", "-o", "utm.las" });
  for (const char* const input : { "utm.csv", "utm.las" })
  {
    for (const Words& command :
      { Words{ "delaunay", input, "-o", "a.vtu" }, Words{ "delaunay3d", input, "-o", "a.vtu" },
        Words{ "info", input }, Words{ "points", input, "-o", "a.npy" } })
    {
      const Outcome outcome =
        this->run(join(command, { "--bounds", "500000", "4900000", "500100", "4900200" }));
      EXPECT_EQ(1, outcome.ExitCode);
      EXPECT_NE(std::string::npos,
        outcome.Err.find("more than ten times as long along x as those of the points, x from "))
        << outcome.Err;
    }
  }
}

TEST_F(TippRegion, InfoPrintsTheLevels)
{
  this->makePoints(300);
  const Outcome outcome = this->make({ "info", "all.copc.laz" });
  EXPECT_NE(
    std::string::npos, outcome.Out.find("COPC: 300 nodes with points; octree x 0 to 10485.76"))
    << outcome.Out;
  EXPECT_NE(std::string::npos, outcome.Out.find("level 0: spacing 81.9, 1 nodes, 1 points"))
    << outcome.Out;
  const Outcome part = this->make(join({ "info", "all.copc.laz" }, square(0, 0, 0.5)));
  EXPECT_NE(std::string::npos, part.Err.find("of 300 points, ")) << part.Err;
}

TEST_F(TippRegion, InfoNamesADamagedHierarchy)
{
  this->makePoints(300);
  std::string text = contentOf(this->Folder.path("all.copc.laz"));
  putAt(text, CopcText::RootOffset, std::uint64_t(1) << 50);
  this->Folder.file("b.copc.laz", text);
  const Outcome outcome = this->make({ "info", "b.copc.laz" });
  EXPECT_NE(std::string::npos, outcome.Out.find("b.copc.laz: has a damaged COPC hierarchy"));
  EXPECT_NE(std::string::npos, outcome.Out.find("points      300"));
  const Outcome part = this->run(join({ "info", "b.copc.laz" }, square(0, 0, 0.5)));
  EXPECT_EQ(1, part.ExitCode);
  EXPECT_NE(std::string::npos, part.Err.find("has a damaged COPC hierarchy")) << part.Err;
  this->make({ "dem", "b.copc.laz", "-o", "a.npy", "--resolution", "100" });
}

} // namespace
