// SPDX-License-Identifier: BSD-3-Clause
#include "LasText.h"
#include "RunTipp.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace
{

using namespace tipp::test;

using Words = std::vector<std::string>;

constexpr int wktRecord = 2112;
constexpr int keyRecord = 34735;

/// Runs on LAS files with records of reference systems.
class TippCrs : public testing::Test
{
protected:
  void makeLas(const std::string& name, int record, const std::string& content) const
  {
    LasText las(2, 1);
    las.addRecord(record, content);
    for (int i = 0; i < 25; ++i)
    {
      las.add(100 * (i % 5), 100 * (i / 5), i, 2);
    }
    this->Folder.file(name, las.text());
  }

  void makeLas(const std::string& name, const std::vector<std::pair<int, int>>& keys) const
  {
    this->makeLas(name, keyRecord, keysOf(keys));
  }

  Outcome run(const Words& words) const { return runTipp(this->Folder, words); }

  /// The text of a LAS file's reference system as `tipp info` prints it.
  std::string info(const Words& files) const
  {
    Words words{ "info" };
    words.insert(words.end(), files.begin(), files.end());
    const Outcome outcome = this->run(words);
    EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
    return outcome.Out + outcome.Err;
  }

  bool hasGdal() const
  {
    this->makeLas("utm.las", { { 1024, 1 }, { 3072, 25832 } });
    return this->info({ "utm.las" }).find("UTM zone 32N") != std::string::npos;
  }

  const TemporaryFolder Folder;
};

TEST_F(TippCrs, InfoNamesTheSystemAndItsUnits)
{
  if (!this->hasGdal())
  {
    GTEST_SKIP() << "GDAL is not there";
  }
  this->makeLas("a.las", { { 1024, 1 }, { 3072, 2903 }, { 4096, 5103 }, { 4099, 9003 } });
  const std::string text = this->info({ "a.las" });
  EXPECT_NE(std::string::npos, text.find("New Mexico Central (ftUS) (EPSG:2903)")) << text;
  EXPECT_NE(std::string::npos, text.find("NAVD88 height (ftUS) (EPSG:6360)")) << text;
}

TEST_F(TippCrs, DifferentSystemsNeedAnOverride)
{
  this->makeLas("a.las", { { 1024, 1 }, { 3072, 26910 } });
  this->makeLas("b.las", { { 1024, 1 }, { 3072, 26911 } });
  const Words words{ "dem", "a.las", "b.las", "-o", "a.npy", "--resolution", "1" };
  const Outcome refused = this->run(words);
  EXPECT_EQ(1, refused.ExitCode);
  EXPECT_NE(std::string::npos, refused.Err.find("--crs")) << refused.Err;
  Words more = words;
  more.insert(more.end(), { "--crs", "EPSG:26911" });
  EXPECT_EQ(0, this->run(more).ExitCode);
  const std::string text = this->info({ "a.las", "b.las" });
  EXPECT_NE(std::string::npos, text.find("another coordinate reference system")) << text;
}

TEST_F(TippCrs, SystemThatIsNotUnderstoodIsAWarning)
{
  if (!this->hasGdal())
  {
    GTEST_SKIP() << "GDAL is not there";
  }
  this->makeLas("a.las", { { 1024, 1 }, { 3072, 36564 } });
  Words words{ "dem", "a.las", "-o", "a.tif", "--resolution", "1" };
  const Outcome outcome = this->run(words);
  EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
  EXPECT_NE(std::string::npos, outcome.Err.find("36564")) << outcome.Err;
  words.emplace_back("--strict-crs");
  EXPECT_EQ(1, this->run(words).ExitCode);
}

/// A record with the path of a file that holds a system: the file must not be read.
TEST_F(TippCrs, RecordNamesNoFile)
{
  if (!this->hasGdal())
  {
    GTEST_SKIP() << "GDAL is not there";
  }
  const std::string path = this->Folder.file("system.prj",
    "GEOGCS[\"fromfile\",DATUM[\"d\","
    "SPHEROID[\"s\",6378137,298]],"
    "PRIMEM[\"p\",0],UNIT[\"degree\",0.0174]]");
  this->makeLas("a.las", wktRecord, path + '\0');
  const Outcome outcome = this->run({ "dem", "a.las", "-o", "a.tif", "--resolution", "1" });
  EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
  EXPECT_EQ(std::string::npos, contentOf(this->Folder.path("a.tif")).find("fromfile"));
}

/// A VRT names other files; it is not opened as the raster that its extension says.
TEST_F(TippCrs, LikeOpensNoVirtualRaster)
{
  if (!this->hasGdal())
  {
    GTEST_SKIP() << "GDAL is not there";
  }
  this->makeLas("a.las", { { 1024, 1 }, { 3072, 25832 } });
  const Outcome first = this->run({ "dem", "a.las", "-o", "a.tif", "--resolution", "1" });
  ASSERT_EQ(0, first.ExitCode) << first.Err;
  this->Folder.file("b.tif",
    "<VRTDataset rasterXSize=\"4\" rasterYSize=\"4\"><GeoTransform>0,1,0,4,0,-1</GeoTransform>"
    "<VRTRasterBand dataType=\"Float32\" band=\"1\"><SimpleSource><SourceFilename>a.tif"
    "</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>");
  EXPECT_EQ(1, this->run({ "dem", "a.las", "-o", "c.npy", "--like", "b.tif" }).ExitCode);
  const Outcome same = this->run({ "dem", "a.las", "-o", "a.tif", "--like", "a.tif" });
  EXPECT_EQ(1, same.ExitCode);
  EXPECT_NE(std::string::npos, same.Err.find("input")) << same.Err;
}

TEST_F(TippCrs, PointsOfAGisAreTheSameWithAMemoryLimit)
{
  std::string text = R"({"type": "FeatureCollection", "features": [)";
  for (int i = 0; i < 400; ++i)
  {
    text += std::string(i > 0 ? ", " : "") + R"({"type": "Feature", "properties": {"h": )" +
      std::to_string(i * 7 % 13) + R"(}, "geometry": {"type": "Point", "coordinates": [)" +
      std::to_string(i % 20) + ", " + std::to_string(i / 20) + "]}}";
  }
  this->Folder.file("a.geojson", text + "]}");
  const Words words{ "dem", "a.geojson", "--z", "h", "--resolution", "0.5", "-o" };
  Words one = words;
  one.emplace_back("a.npy");
  const Outcome outcome = this->run(one);
  if (outcome.Err.find("GDAL") != std::string::npos)
  {
    GTEST_SKIP() << outcome.Err;
  }
  ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  Words other = words;
  other.insert(other.end(), { "b.npy", "--memory", "1M" });
  const Outcome limited = this->run(other);
  ASSERT_EQ(0, limited.ExitCode) << limited.Err;
  EXPECT_EQ(contentOf(this->Folder.path("a.npy")), contentOf(this->Folder.path("b.npy")));
}

} // namespace
