// SPDX-License-Identifier: BSD-3-Clause
// description.json of a flat folder.
#include "ExpectIOError.h"
#include "FlatTesting.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

using namespace tipp;

namespace
{

class FlatDescription : public testing::Test
{
protected:
  FlatDescription() { this->Maker.writeSquare(); }

  MeshDescription read(const std::string& json) const
  {
    std::ofstream(this->Maker.path("description.json"), std::ios::binary) << json;
    return openFlatMesh(this->Maker.path()).Description;
  }

  void expectRefused(const std::string& json, const std::string& words) const
  {
    test::expectIOError(this->Maker.path("description.json"), words, [&] { this->read(json); });
  }

  const test::FlatFolderMaker Maker;
};

TEST_F(FlatDescription, IsOptional)
{
  EXPECT_TRUE(openFlatMesh(this->Maker.path()).Description.isEmpty());
}

TEST_F(FlatDescription, IsRead)
{
  const MeshDescription description = this->read(
    R"({"time_units": "hours since 2001-02-03", "calendar": "noleap", "crs": "EPSG:4326",
      "point_data": {"zeta": {"long_name": "level", "standard_name": "sea_level", "units": "m",
        "missing_value": -99999}, "wind": {"components": ["u", "v"]}},
      "cell_data": {"zone": {"units": "1"}}, "later": {"version": 2}})");
  EXPECT_EQ("hours since 2001-02-03", description.TimeUnits);
  EXPECT_EQ("noleap", description.Calendar);
  EXPECT_EQ("EPSG:4326", description.Crs);
  const ArrayDescription zeta = description.arrayOf("zeta", false);
  EXPECT_EQ("level", zeta.LongName);
  EXPECT_EQ("sea_level", zeta.StandardName);
  EXPECT_EQ("m", zeta.Units);
  EXPECT_EQ(-99999, zeta.Missing);
  EXPECT_EQ("v", description.arrayOf("wind", false).nameOf("wind", 1, 2));
  EXPECT_EQ("1", description.arrayOf("zone", true).Units);
  EXPECT_TRUE(description.arrayOf("zone", false).isEmpty());
}

TEST_F(FlatDescription, IsWrittenAndReadAgain)
{
  FlatContent content;
  const std::vector<double> points{ 0, 0, 1, 0, 0, 1 };
  content.Cells = { 0, 1, 2 };
  content.Points = { "points", Scalar::Float64, 2, 3, 0, points.data(), {} };
  content.Description.TimeUnits = "days since 1900-01-01";
  content.Description.Crs = "GEOGCS[\"WGS 84\"]";
  ArrayDescription heat;
  heat.LongName = "\xe9tat"; // Latin-1
  heat.Missing = 0.1;
  heat.Components = { "a", "b" };
  content.Description.add("heat \"1\"", true, heat);
  const std::string path = this->Maker.path("again");
  ASSERT_TRUE(writeFlatMesh(path, content));
  const MeshDescription read = openFlatMesh(path).Description;
  EXPECT_EQ(content.Description.TimeUnits, read.TimeUnits);
  EXPECT_EQ(content.Description.Crs, read.Crs);
  const ArrayDescription again = read.arrayOf("heat \"1\"", true);
  EXPECT_EQ("\xc3\xa9tat", again.LongName);
  EXPECT_EQ(0.1, again.Missing);
  EXPECT_EQ(heat.Components, again.Components);
}

TEST_F(FlatDescription, ThatIsEmptyIsNotWritten)
{
  FlatContent content;
  const std::vector<double> points{ 0, 0, 1, 0, 0, 1 };
  content.Cells = { 0, 1, 2 };
  content.Points = { "points", Scalar::Float64, 2, 3, 0, points.data(), {} };
  const std::string path = this->Maker.path("again");
  ASSERT_TRUE(writeFlatMesh(path, content));
  EXPECT_FALSE(std::filesystem::exists(path + "/description.json"));
}

TEST_F(FlatDescription, OfAWrongTypeIsRefused)
{
  for (const auto& [json, words] : std::vector<std::pair<std::string, std::string>>{
         { "", "is not JSON" }, { "{\"crs\": ", "is not JSON" }, { "\xff", "is not JSON" },
         { "[]", "is no object" }, { R"({"time_units": 5})", "'time_units' is no text" },
         { R"({"calendar": null})", "'calendar' is no text" },
         { R"({"time_units": "a\u0000b"})", "control characters" },
         { R"({"point_data": []})", "'point_data' is no object" },
         { R"({"point_data": {"zeta": 1}})", "of 'zeta' is no object" },
         { R"({"cell_data": {"a": {"units": []}}})", "'units' is no text" },
         { R"({"cell_data": {"a": {"missing_value": "x"}}})", "no finite number" },
         { R"({"cell_data": {"a": {"missing_value": 1e999}}})", "" },
         { R"({"cell_data": {"a": {"components": "u"}}})", "'components' is no list" },
         { R"({"cell_data": {"a": {"components": [""]}}})", "has an empty text" } })
  {
    this->expectRefused(json, words);
  }
}

TEST_F(FlatDescription, OfDeeplyNestedListsIsRefused)
{
  this->expectRefused("{\"crs\": " + std::string(1000000, '['), "is not JSON");
  this->expectRefused(
    "{\"crs\": " + std::string(100000, '[') + std::string(100000, ']') + "}", "'crs' is no text");
}

TEST_F(FlatDescription, DoesNotLetGdalOpenAFile)
{
  for (const char* crs : { "/etc/passwd", "https://example.org/a.prj", "a.prj", "WGS 84/[", "" })
  {
    const std::string json = std::string(R"({"crs": ")") + crs + "\"}";
    if (*crs == '\0')
    {
      EXPECT_EQ("", this->read(json).Crs);
      continue;
    }
    this->expectRefused(json, "'crs' that is neither");
  }
  for (const char* crs : { "EPSG:4326", "EPSG:25832+7837", "WGS84", "+proj=utm +zone=33",
         " PROJCS [...]", "{}", "urn:ogc:def:crs:EPSG::4326" })
  {
    EXPECT_EQ(crs, this->read(std::string(R"({"crs": ")") + crs + "\"}").Crs);
  }
}

} // namespace
