// SPDX-License-Identifier: BSD-3-Clause
#include "Crs/ReferenceSystem.h"

#include "ExpectIOError.h"
#include "LasText.h"
#include "Points/ReadPoints.h"
#include "Raster/RasterFile.h"
#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

constexpr const char* utmOfGdal =
  "PROJCS[\"ETRS89 / UTM zone "
  "32N\",GEOGCS[\"ETRS89\",DATUM[\"European_Terrestrial_Reference_System_"
  "1989\",SPHEROID[\"GRS 1980\",6378137,298.257222101,AUTHORITY[\"EPSG\",\"7019\"]],AUTHORITY["
  "\"EPSG\",\"6258\"]],PRIMEM[\"Greenwich\",0,AUTHORITY[\"EPSG\",\"8901\"]],UNIT[\"degree\",0."
  "0174532925199433,AUTHORITY[\"EPSG\",\"9122\"]],AUTHORITY[\"EPSG\",\"4258\"]],PROJECTION["
  "\"Transverse_Mercator\"],PARAMETER[\"latitude_of_origin\",0],PARAMETER[\"central_meridian\",9],"
  "PARAMETER[\"scale_factor\",0.9996],PARAMETER[\"false_easting\",500000],PARAMETER[\"false_"
  "northing\",0],UNIT[\"metre\",1,AUTHORITY[\"EPSG\",\"9001\"]],AXIS[\"Easting\",EAST],AXIS["
  "\"Northing\",NORTH],AUTHORITY[\"EPSG\",\"25832\"]]";

constexpr const char* utmOfEsri =
  "PROJCS[\"ETRS_1989_UTM_Zone_32N\",GEOGCS[\"GCS_ETRS_1989\",DATUM[\"D_ETRS_1989\",SPHEROID[\"GRS_"
  "1980\",6378137.0,298.257222101]],PRIMEM[\"Greenwich\",0.0],UNIT[\"Degree\",0.0174532925199433]],"
  "PROJECTION[\"Transverse_Mercator\"],PARAMETER[\"False_Easting\",500000.0],PARAMETER[\"False_"
  "Northing\",0.0],PARAMETER[\"Central_Meridian\",9.0],PARAMETER[\"Scale_Factor\",0.9996],"
  "PARAMETER[\"Latitude_Of_Origin\",0.0],UNIT[\"Meter\",1.0]]";

/// EPSG:31468, whose first axis is the northing; ESRI's WKT has no axes.
constexpr const char* gaussOfEsri =
  "PROJCS[\"DHDN_3_Degree_Gauss_Zone_4\",GEOGCS[\"GCS_Deutsches_Hauptdreiecksnetz\",DATUM[\"D_"
  "Deutsches_Hauptdreiecksnetz\",SPHEROID[\"Bessel_1841\",6377397.155,299.1528128]],PRIMEM["
  "\"Greenwich\",0.0],UNIT[\"Degree\",0.0174532925199433]],PROJECTION[\"Gauss_Kruger\"],PARAMETER["
  "\"False_Easting\",4500000.0],PARAMETER[\"False_Northing\",0.0],PARAMETER[\"Central_Meridian\","
  "12."
  "0],PARAMETER[\"Scale_Factor\",1.0],PARAMETER[\"Latitude_Of_Origin\",0.0],UNIT[\"Meter\",1.0]]";

CrsRecords keys(const std::vector<std::pair<int, int>>& values)
{
  CrsRecords records;
  records.Keys = keysOf(values);
  return records;
}

CrsRecords wkt(const std::string& text)
{
  CrsRecords records;
  records.Text = text;
  return records;
}

bool hasGdal()
{
  return !describeCrs("EPSG:25832").Words.empty();
}

/// Tests that need GDAL's knowledge of reference systems.
class ReferenceSystemOfGdal : public testing::Test
{
protected:
  void SetUp() override
  {
    if (!hasGdal())
    {
      GTEST_SKIP() << "GDAL is not there";
    }
  }
};

TEST(ReferenceSystem, KeysNameEpsgCodes)
{
  EXPECT_EQ(
    "EPSG:26910+5703", understandCrs(keys({ { 1024, 1 }, { 3072, 26910 }, { 4096, 5703 } })).Text);
  EXPECT_EQ("EPSG:4326", understandCrs(keys({ { 1024, 2 }, { 2048, 4326 } })).Text);
  EXPECT_EQ("", understandCrs({}).Text);
  EXPECT_EQ("", understandCrs({}).Problem);
}

/// GeoTIFF 1.0 names systems of heights by EPSG's codes of their datums.
TEST(ReferenceSystem, CodesOfGeoTiffForHeightsAreTranslated)
{
  const std::vector<std::pair<int, std::string>> codes = { { 5101, "5701" }, { 5102, "5702" },
    { 5103, "5703" }, { 5104, "5736" }, { 5105, "5705" }, { 5106, "5611" } };
  for (const auto& [old, epsg] : codes)
  {
    const ReferenceSystem system =
      understandCrs(keys({ { 1024, 1 }, { 3072, 2903 }, { 4096, old } }));
    EXPECT_EQ("EPSG:2903+" + epsg, system.Text);
    EXPECT_EQ("", system.Problem);
  }
}

/// The code alone would call heights in feet metres.
TEST(ReferenceSystem, UnitOfHeightsChoosesTheirSystem)
{
  const auto heights = [](int code, int unit) {
    return understandCrs(keys({ { 1024, 1 }, { 3072, 2903 }, { 4096, code }, { 4099, unit } }));
  };
  EXPECT_EQ("EPSG:2903+6360", heights(5103, 9003).Text);
  EXPECT_EQ("EPSG:2903+6360", heights(5703, 9003).Text);
  EXPECT_EQ("EPSG:2903+8228", heights(5103, 9002).Text);
  EXPECT_EQ("EPSG:2903+5703", heights(6360, 9001).Text);
  EXPECT_EQ("EPSG:2903+7968", heights(5102, 9001).Text);
  EXPECT_EQ("EPSG:2903", heights(5701, 9003).Text);
  EXPECT_NE("", heights(5701, 9003).Problem);
}

TEST(ReferenceSystem, HeightsAboveAnEllipsoidAreLeftOutWithAReason)
{
  const ReferenceSystem system =
    understandCrs(keys({ { 1024, 1 }, { 3072, 26910 }, { 4096, 5030 } }));
  EXPECT_EQ("EPSG:26910", system.Text);
  EXPECT_NE(std::string::npos, system.Problem.find("ellipsoid")) << system.Problem;
}

TEST(ReferenceSystem, DamagedKeysAreNoSystem)
{
  CrsRecords records;
  records.Keys = "x";
  EXPECT_EQ("", understandCrs(records).Text);
  records.Keys = std::string(4096, '\xff');
  EXPECT_EQ("", understandCrs(records).Text);
}

TEST(ReferenceSystem, CodesAreComparedByMeaning)
{
  EXPECT_TRUE(areSameCrs("EPSG:25832", utmOfGdal));
  EXPECT_TRUE(areSameCrs("EPSG:25832", "EPSG:25832+7837"));
  EXPECT_FALSE(areSameCrs("EPSG:25832+5703", "EPSG:25832+7837"));
  EXPECT_FALSE(areSameCrs("EPSG:25833", utmOfGdal));
}

TEST_F(ReferenceSystemOfGdal, AllWaysToWriteASystemAreTheSame)
{
  std::string lines = utmOfGdal;
  for (std::size_t at = 0; (at = lines.find("],", at)) != std::string::npos; at += 2)
  {
    lines.insert(at + 2, "\r\n    ");
  }
  for (const CrsRecords& records : { wkt(utmOfGdal), wkt(lines), wkt(utmOfEsri),
         keys({ { 1024, 1 }, { 3072, 25832 }, { 3076, 9001 } }) })
  {
    const ReferenceSystem system = understandCrs(records);
    EXPECT_EQ("EPSG:25832", system.Text);
    EXPECT_NE(std::string::npos, system.Words.find("ETRS89 / UTM zone 32N (EPSG:25832)"));
    EXPECT_NE(std::string::npos, system.Words.find("metre"));
  }
  EXPECT_EQ("EPSG:31468", understandCrs(wkt(gaussOfEsri)).Text);
}

/// EPSG:5513 and 5514 have the same projection, and axes that point in opposite directions.
TEST_F(ReferenceSystemOfGdal, ReversedAxesAreAnotherSystem)
{
  EXPECT_FALSE(areSameCrs("EPSG:5513", "EPSG:5514"));
}

TEST_F(ReferenceSystemOfGdal, ProjectionWithParametersIsUnderstood)
{
  CrsRecords records; // a transverse Mercator projection of its own on WGS 84
  std::vector<std::uint16_t> numbers = { 1, 1, 0, 10, 1024, 0, 1, 1, 2048, 0, 1, 4326, 3072, 0, 1,
    32767, 3074, 0, 1, 32767, 3075, 0, 1, 1, 3076, 0, 1, 9001, 3080, 34736, 1, 0, 3081, 34736, 1, 1,
    3082, 34736, 1, 2, 3092, 34736, 1, 3 };
  records.Keys = { reinterpret_cast<const char*>(numbers.data()), 2 * numbers.size() };
  const std::vector<double> doubles = { 13, 0, 250000, 0.99995 };
  records.Doubles = { reinterpret_cast<const char*>(doubles.data()), 8 * doubles.size() };
  const ReferenceSystem system = understandCrs(records);
  EXPECT_EQ("", system.Problem);
  EXPECT_NE(std::string::npos, system.Text.find("250000")) << system.Text;
  EXPECT_NE(std::string::npos, system.Text.find("0.99995")) << system.Text;
}

TEST_F(ReferenceSystemOfGdal, UnknownCodeIsNamed)
{
  const ReferenceSystem system = understandCrs(keys({ { 1024, 1 }, { 3072, 36564 } }));
  EXPECT_EQ("", system.Text);
  EXPECT_NE(std::string::npos, system.Problem.find("36564")) << system.Problem;
}

TEST_F(ReferenceSystemOfGdal, UnitsOfHeightsAreInWords)
{
  const std::string words = describeCrs("EPSG:2903+6360").Words;
  EXPECT_NE(std::string::npos, words.find("NAVD88 height (ftUS) (EPSG:6360)")) << words;
  EXPECT_NE(std::string::npos, words.find("US survey foot")) << words;
}

/// A record with the path of a file that holds a system: the file must not be read.
TEST_F(ReferenceSystemOfGdal, RecordsNameNoFiles)
{
  const TemporaryFolder folder;
  const std::string path = folder.file("system.prj", utmOfGdal);
  for (const std::string& text : std::vector<std::string>{ path, "file://" + path,
         "http://127.0.0.1:9/system.prj", "ESRI::" + path, "/vsicurl/http://127.0.0.1:9/a",
         "EPSG:" + path, "{\"type\": \"ProjectedCRS\", \"name\": \"/../../.." + path + "\"}" })
  {
    const ReferenceSystem system = understandCrs(wkt(text));
    EXPECT_EQ("", system.Text) << text;
    EXPECT_NE("", system.Problem) << text;
  }
}

class CrsOfFiles : public testing::Test
{
protected:
  /// A LAS file of one point and a record of its reference system.
  std::string las(const std::string& name, int record, const std::string& content) const
  {
    LasText las(2, 1);
    las.addRecord(record, content);
    las.add(1, 2, 3, 2);
    return this->Folder.file(name, las.text());
  }

  const TemporaryFolder Folder;
};

constexpr int wktRecord = 2112;
constexpr int keyRecord = 34735;

TEST_F(CrsOfFiles, SameSystemWrittenDifferentlyIsMixed)
{
  const std::vector<std::string> paths = { this->las("a.las", keyRecord,
                                             keysOf({ { 1024, 1 }, { 3072, 25832 } })),
    this->las("b.las", wktRecord, utmOfGdal) };
  EXPECT_EQ(2U, readPoints(paths, {}).size());
}

TEST_F(CrsOfFiles, DifferentSystemsAreRefusedUnlessOneIsNamed)
{
  const std::string second =
    this->las("b.las", keyRecord, keysOf({ { 1024, 1 }, { 3072, 26911 } }));
  const std::vector<std::string> paths = {
    this->las("a.las", keyRecord, keysOf({ { 1024, 1 }, { 3072, 26910 } })), second
  };
  expectIOError(second, "another coordinate reference system", [&] { openPointStream(paths); });
  PointOptions options;
  options.Crs = "EPSG:26911";
  const PointTable table = readPoints(paths, options);
  EXPECT_EQ(2U, table.size());
  EXPECT_EQ("EPSG:26911", table.Crs);
}

TEST_F(CrsOfFiles, SystemOfHeightsIsKeptWhicheverFileHasIt)
{
  const std::vector<std::string> paths = { this->las("a.las", keyRecord,
                                             keysOf({ { 1024, 1 }, { 3072, 25832 } })),
    this->las("b.las", keyRecord, keysOf({ { 1024, 1 }, { 3072, 25832 }, { 4096, 7837 } })) };
  EXPECT_EQ("EPSG:25832+7837", readPoints(paths, {}).Crs);
  EXPECT_EQ("EPSG:25832+7837", readPoints({ paths[1], paths[0] }, {}).Crs);
}

} // namespace
