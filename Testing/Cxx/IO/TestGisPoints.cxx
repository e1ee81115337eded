// SPDX-License-Identifier: BSD-3-Clause
#include "ExpectIOError.h"
#include "Files/IOError.h"
#include "Gis/GisFiles.h"
#include "Points/ReadPoints.h"
#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#ifdef TIPP_TEST_GDAL
#include <gdal.h>
#include <gdal_utils.h>
#endif

#include <cmath>
#include <string>
#include <vector>

#include <dlfcn.h>

namespace
{

using namespace tipp;
using namespace tipp::test;

using Values = std::vector<double>;

constexpr const char* start = R"({"type": "FeatureCollection", "features": [)";

std::string feature(const std::string& geometry, const std::string& properties = "")
{
  return R"({"type": "Feature", "properties": {)" + properties + R"(}, "geometry": )" + geometry +
    "}";
}

std::string point(const std::string& coordinates, const std::string& properties = "")
{
  return feature(R"({"type": "Point", "coordinates": [)" + coordinates + "]}", properties);
}

std::string collection(const std::vector<std::string>& features)
{
  std::string text = start;
  for (const std::string& one : features)
  {
    text += (text == start ? "" : ", ") + one;
  }
  return text + "]}";
}

const Values* valuesOf(const PointTable& table, const std::string& name)
{
  for (const PointTable::Column& column : table.Columns)
  {
    if (column.Name == name)
    {
      return &column.Values;
    }
  }
  return nullptr;
}

/// Tests are skipped if GDAL is missing.
class GisPoints : public testing::Test
{
protected:
  void SetUp() override
  {
    try
    {
      this->read("any.geojson", collection({ point("1, 2") }));
    }
    catch (const IOError& error)
    {
      const std::string text = error.what();
      ASSERT_TRUE(text.find("needs GDAL") != std::string::npos ||
        text.find("need the library GDAL") != std::string::npos)
        << text;
      GTEST_SKIP() << text;
    }
  }

  PointTable read(const std::string& name, const std::string& content) const
  {
    return readPoints(this->Folder.file(name, content), {});
  }

  static std::string warningsOf(const PointTable& table)
  {
    std::string text;
    for (const TableReport& report : table.Reports)
    {
      for (const std::string& warning : report.Warnings)
      {
        text += warning + "\n";
      }
    }
    return text;
  }

  const TemporaryFolder Folder;
};

TEST_F(GisPoints, CoordinatesHeightsAndNumbersAreColumns)
{
  const PointTable table = this->read("a.geojson",
    collection({ point("1, 2, 3", R"("count": 7, "depth": 1.5, "name": "a")"),
      point("4, 5, 6", R"("count": 8, "depth": null, "name": "b")") }));
  EXPECT_EQ((Values{ 1, 2, 4, 5 }), table.XY);
  ASSERT_NE(nullptr, valuesOf(table, "z"));
  EXPECT_EQ((Values{ 3, 6 }), *valuesOf(table, "z"));
  EXPECT_EQ((Values{ 7, 8 }), *valuesOf(table, "count"));
  EXPECT_EQ(1.5, valuesOf(table, "depth")->at(0));
  EXPECT_TRUE(std::isnan(valuesOf(table, "depth")->at(1)));
  EXPECT_EQ(nullptr, valuesOf(table, "name"));
  EXPECT_EQ("EPSG:4326", table.Crs.substr(0, 9));
}

TEST_F(GisPoints, HeightsAreTakenFromAnAttribute)
{
  const std::string content = collection({ point("1, 2, 0", R"("level": 7.5)") });
  PointOptions options;
  options.Z = "level";
  const PointTable table = readPoints(this->Folder.file("a.geojson", content), options);
  EXPECT_EQ((Values{ 7.5 }), *valuesOf(table, "z"));
  options.Z = "hight";
  const std::string path = this->Folder.path("a.geojson");
  expectIOError(path, "has no attribute 'hight' of numbers; there are 'level'",
    [&] { readPoints(path, options); });
}

TEST_F(GisPoints, UsualAttributeIsTheHeightOfFlatPoints)
{
  const PointTable table =
    this->read("a.geojson", collection({ point("1, 2", R"("Elevation": 9)") }));
  EXPECT_EQ((Values{ 9 }), *valuesOf(table, "z"));
}

TEST_F(GisPoints, HeightsThatAreAllZeroAreReported)
{
  const PointTable table = this->read("a.geojson", collection({ point("1, 2, 0", R"("h": 9)") }));
  EXPECT_NE(std::string::npos, warningsOf(table).find("--z")) << warningsOf(table);
}

TEST_F(GisPoints, PartsOfMultipointsArePoints)
{
  const PointTable table = this->read("a.geojson",
    collection({ feature(
      R"({"type": "MultiPoint", "coordinates": [[1, 2, 3], [4, 5, 6]]})", R"("v": 7)") }));
  EXPECT_EQ((Values{ 1, 2, 4, 5 }), table.XY);
  EXPECT_EQ((Values{ 3, 6 }), *valuesOf(table, "z"));
  EXPECT_EQ((Values{ 7, 7 }), *valuesOf(table, "v"));
}

TEST_F(GisPoints, FeaturesWithoutPointsAreCounted)
{
  const PointTable table = this->read("a.geojson",
    collection({ point("1, 2, 3"), feature("null"),
      feature(R"({"type": "LineString", "coordinates": [[1, 2], [4, 5]]})") }));
  EXPECT_EQ((Values{ 1, 2 }), table.XY);
  EXPECT_NE(std::string::npos, warningsOf(table).find("2 features have no point"));
}

TEST_F(GisPoints, FileWithoutPointsIsRefused)
{
  const std::string path = this->Folder.file("a.geojson",
    collection({ feature(R"({"type": "LineString", "coordinates": [[1, 2], [4, 5]]})") }));
  expectIOError(path, "has no points", [&] { readPoints(path, {}); });
}

TEST_F(GisPoints, BlocksGiveTheSamePointsInEveryPass)
{
  std::vector<std::string> features;
  for (int i = 0; i < 100; ++i)
  {
    features.push_back(
      feature(R"({"type": "MultiPoint", "coordinates": [)" + std::string("[") + std::to_string(i) +
        ", 0, 1], [" + std::to_string(i) + ", 1, 2], [" + std::to_string(i) + ", 2, 3]]}"));
  }
  const std::string path = this->Folder.file("a.geojson", collection(features));
  const PointTable whole = readPoints(path, {});
  ASSERT_EQ(300U, whole.size());
  const auto stream = openPointStream({ path });
  for (int pass = 0; pass < 2; ++pass)
  {
    PointTable table;
    table.Columns.push_back({ "z", {} });
    forEachBlock(*stream, 7, [&table](const PointBlock& block) { append(block, table); });
    EXPECT_EQ(whole.XY, table.XY);
    EXPECT_EQ(whole.Columns[0].Values, table.Columns[0].Values);
  }
}

TEST_F(GisPoints, LargeCoordinatesAreNoDegrees)
{
  const PointTable table = this->read("a.geojson", collection({ point("500000, 5400000, 3") }));
  EXPECT_EQ("", table.Crs);
  EXPECT_NE("", table.CrsProblem);
}

TEST_F(GisPoints, DrawingsHavePointsAndLayers)
{
  const auto entity = [](const std::string& kind, const std::string& layer, const std::string& x,
                        const std::string& more)
  { return "0\n" + kind + "\n8\n" + layer + "\n10\n" + x + "\n20\n2\n30\n3\n" + more; };
  const std::string path = this->Folder.file("a.dxf",
    "0\nSECTION\n2\nENTITIES\n" + entity("POINT", "ground", "1", "") +
      entity("POINT", "trees", "4", "") + entity("TEXT", "ground", "9", "40\n1\n1\n12.5\n") +
      "0\nENDSEC\n0\nEOF\n");
  EXPECT_EQ((Values{ 1, 2, 4, 2 }), readPoints(path, {}).XY);
  PointOptions options;
  options.Layer = "trees";
  const PointTable trees = readPoints(path, options);
  EXPECT_EQ((Values{ 4, 2 }), trees.XY);
  EXPECT_EQ((Values{ 3 }), *valuesOf(trees, "z"));
}

TEST_F(GisPoints, PlacemarksArePoints)
{
  const PointTable table = this->read("a.kml",
    "<?xml version=\"1.0\"?><kml xmlns=\"http://www.opengis.net/kml/2.2\"><Document>"
    "<Placemark><Point><coordinates>1,2,3</coordinates></Point></Placemark>"
    "</Document></kml>");
  EXPECT_EQ((Values{ 1, 2 }), table.XY);
  EXPECT_EQ((Values{ 3 }), *valuesOf(table, "z"));
}

/// A VRT names another file, and would be read if the extension did not choose the driver.
TEST_F(GisPoints, VirtualFilesAreNotOpenedUnderAnotherName)
{
  const std::string target = this->Folder.file("target.geojson", collection({ point("1, 2, 3") }));
  const std::string path = this->Folder.file("a.gpkg",
    "<OGRVRTDataSource><OGRVRTLayer name=\"target\"><SrcDataSource>" + target +
      "</SrcDataSource></OGRVRTLayer></OGRVRTDataSource>");
  expectIOError(path, "cannot be read", [&] { readPoints(path, {}); });
}

/// A system given by an address must not be fetched, and does not stop the points.
TEST_F(GisPoints, AddressesInFilesAreNotFetched)
{
  std::string content = collection({ point("1, 2, 3") });
  content.insert(1,
    R"("crs": {"type": "link", "properties": {"href": "http://127.0.0.1:9/crs", "type": "ogcwkt"}}, )");
  try
  {
    EXPECT_EQ((Values{ 1, 2 }), this->read("a.geojson", content).XY);
  }
  catch (const IOError& error)
  {
    EXPECT_NE(std::string::npos, std::string(error.what()).find("does not use the network"))
      << error.what();
  }
}

TEST_F(GisPoints, PathsOfOtherFileSystemsAreRefused)
{
  expectIOError("/vsicurl/http://127.0.0.1:9/a.gpkg", "cannot be opened",
    [] { readPoints("/vsicurl/http://127.0.0.1:9/a.gpkg", {}); });
}

/// The farthest that the corners' edges of a circle round the origin are from it.
double deviationOf(const std::vector<NamedZone>& zones, double radius)
{
  double most = 0;
  const std::vector<Point2>& corners = zones.at(0).Polygons.at(0).Corners;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i)
  {
    const double x = (corners[i].x + corners[i + 1].x) / 2;
    const double y = (corners[i].y + corners[i + 1].y) / 2;
    most = std::max(most, radius - std::hypot(x, y));
  }
  return most;
}

TEST_F(GisPoints, CurvesAreAsCloseAsTheTolerance)
{
  const std::string path = this->Folder.file(
    "a.csv", "WKT,name\n\"CURVEPOLYGON(CIRCULARSTRING(0 -100,100 0,0 100,-100 0,0 -100))\",a\n");
  EXPECT_NEAR(
    100 * (1 - std::cos(std::acos(-1) / 90)), deviationOf(readZones(path, ""), 100), 1e-3);
  for (const double tolerance : { 1.0, 0.01, 0.0001 })
  {
    setCurveTolerance(tolerance);
    const double deviation = deviationOf(readZones(path, ""), 100);
    EXPECT_LE(deviation, tolerance * (1 + 1e-6));
    EXPECT_GE(deviation, tolerance / 3);
  }
  setCurveTolerance(0);
}

#ifdef TIPP_TEST_GDAL
/// Converts a file with GDAL, which the test opens itself.
class ConvertedGisPoints : public GisPoints
{
protected:
  std::string convert(const std::string& from, const std::string& to, const char* driver) const
  {
    void* const library = dlopen(TIPP_TEST_GDAL, RTLD_NOW | RTLD_LOCAL);
    const auto find = [library](const char* name, auto& function)
    { function = reinterpret_cast<std::decay_t<decltype(function)>>(dlsym(library, name)); };
    decltype(&GDALAllRegister) start = nullptr;
    decltype(&GDALOpenEx) open = nullptr;
    decltype(&GDALVectorTranslateOptionsNew) make = nullptr;
    decltype(&GDALVectorTranslate) translate = nullptr;
    decltype(&GDALVectorTranslateOptionsFree) release = nullptr;
    decltype(&GDALClose) close = nullptr;
    find("GDALAllRegister", start);
    find("GDALOpenEx", open);
    find("GDALVectorTranslateOptionsNew", make);
    find("GDALVectorTranslate", translate);
    find("GDALVectorTranslateOptionsFree", release);
    find("GDALClose", close);
    start();
    const std::string path = this->Folder.path(to);
    std::vector<std::string> words = { "-f", driver, "-t_srs", "EPSG:32632" };
    std::vector<char*> arguments;
    for (std::string& word : words)
    {
      arguments.push_back(word.data());
    }
    arguments.push_back(nullptr);
    GDALVectorTranslateOptions* const options = make(arguments.data(), nullptr);
    GDALDatasetH source = open(from.c_str(), GDAL_OF_VECTOR, nullptr, nullptr, nullptr);
    GDALDatasetH target = translate(path.c_str(), nullptr, 1, &source, options, nullptr);
    release(options);
    EXPECT_NE(nullptr, target) << to;
    if (target)
    {
      close(target);
    }
    close(source);
    return path;
  }
};

TEST_F(ConvertedGisPoints, EveryFormatHasTheSamePoints)
{
  std::vector<std::string> features;
  for (int i = 0; i < 50; ++i)
  {
    features.push_back(point("9." + std::to_string(i) + ", 48, " + std::to_string(100 + i),
      "\"number\": " + std::to_string(i)));
  }
  const std::string from = this->Folder.file("from.geojson", collection(features));
  for (const auto& [name, driver] : { std::make_pair("a.gpkg", "GPKG"),
         std::make_pair("a.shp", "ESRI Shapefile"), std::make_pair("a.fgb", "FlatGeobuf") })
  {
    const PointTable table = readPoints(this->convert(from, name, driver), {});
    ASSERT_EQ(50U, table.size()) << name;
    EXPECT_EQ("EPSG:32632", table.Crs) << name;
    ASSERT_NE(nullptr, valuesOf(table, "number")) << name;
    for (std::size_t i = 0; i < table.size(); ++i) // FlatGeobuf sorts its features
    {
      const double number = valuesOf(table, "number")->at(i);
      EXPECT_NEAR(100 + number, valuesOf(table, "z")->at(i), 1e-6) << name;
      EXPECT_NEAR(5.3e6, table.XY[2 * i + 1], 1e5) << name;
    }
  }
}
#endif

} // namespace
