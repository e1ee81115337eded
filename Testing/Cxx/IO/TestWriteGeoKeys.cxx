// SPDX-License-Identifier: BSD-3-Clause
#include "Crs/EpsgRanges.h"
#include "Crs/WriteGeoKeys.h"
#include "Files/IOError.h"
#include "Raster/RasterFile.h"

#include "ExpectIOError.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

/// The keys that say which system it is, and their values.
std::map<int, int> codesIn(const std::vector<TiffField>& fields)
{
  std::map<int, int> codes;
  for (const TiffField& field : fields)
  {
    for (std::size_t at = 8; field.Tag == 34735 && at < field.Bytes.size(); at += 8)
    {
      std::array<std::uint16_t, 4> key{};
      std::memcpy(key.data(), field.Bytes.data() + at, sizeof key);
      for (const int wanted : { 1024, 1025, 2048, 3072, 4096 })
      {
        if (key[0] == wanted)
        {
          codes[wanted] = key[3];
        }
      }
    }
  }
  return codes;
}

class WriteGeoKeys : public testing::Test
{
protected:
  ~WriteGeoKeys() override { crsTranslator() = {}; }
};

/// The horizontal system's code.
int horizontalOf(const std::map<int, int>& codes)
{
  const auto found = codes.find(codes.count(3072) > 0 ? 3072 : 2048);
  return found == codes.end() ? 0 : found->second;
}

TEST_F(WriteGeoKeys, CodesAndKindAreThoseThatGdalWrites)
{
  std::vector<std::string> systems = { "EPSG:25832+7837", "EPSG:4326+5773", "EPSG:4979" };
  int number = 0;
  const auto add = [&](int code)
  {
    if (++number % 17 == 0)
    {
      systems.push_back("EPSG:" + std::to_string(code));
    }
  };
  for (const EpsgRange& range : projectedCodes)
  {
    add(range.First);
  }
  for (const EpsgRange& range : geographicCodes)
  {
    add(range.Last);
  }
  int compared = 0;
  for (const std::string& system : systems)
  {
    std::vector<TiffField> ofGdal;
    try
    {
      ofGdal = geoKeysOf(system);
    }
    catch (const IOError&) // a newer code than GDAL's
    {
      continue;
    }
    // GDAL writes another system in place of a deprecated one, and one of the plane and one of
    // heights in place of a geographic system in space.
    const std::map<int, int> codes = codesIn(ofGdal);
    if (horizontalOf(codes) == std::stoi(system.substr(5)))
    {
      EXPECT_EQ(codes, codesIn(geoKeysWithoutGdal(system))) << system;
      ++compared;
    }
  }
  EXPECT_GT(compared, 20) << "GDAL is not there";
}

TEST_F(WriteGeoKeys, CodesOfWktAreThoseOfTheRoot)
{
  const std::string wkt = R"(PROJCRS["x", BASEGEOGCRS["y", ID["EPSG", 4258]], ID["EPSG", 25833]])";
  EXPECT_EQ(codesIn(geoKeysWithoutGdal("EPSG:25833")), codesIn(geoKeysWithoutGdal(wkt)));
  EXPECT_EQ(codesIn(geoKeysWithoutGdal("EPSG:25833")), codesIn(geoKeysWithoutGdal("epsg:25833")));
}

TEST_F(WriteGeoKeys, OtherTextsAreRefused)
{
  for (const char* const text :
    { "EPSG:99999", "EPSG:5773", "EPSG:25832+25833", "EPSG:25832x", "EPSG:25832+", "EPSG:-1",
      "EPSG:99999999999999999999", "EPSG:4294993128", "PROJCS[\"x\"]", "ESRI:102003",
      " COMPD_CS[\"c\",PROJCS[\"p\",AUTHORITY[\"EPSG\",\"25832\"]],VERT_CS[\"h\"]]",
      "COMPD_CS[\"c\",PROJCS[\"p\",AUTHORITY[\"EPSG\",\"25832\"]],VERT_CS[\"h\"]]" })
  {
    expectIOError(
      "The coordinate reference system", "give --crs EPSG:CODE", [&] { geoKeysWithoutGdal(text); });
  }
}

TEST_F(WriteGeoKeys, ATranslatorNamesTheCodes)
{
  crsTranslator().ToGeoKeys = [](const std::string& crs)
  { return crs == "mine" ? std::string("geographic:4326+5773") : std::string(); };
  EXPECT_EQ((std::map<int, int>{ { 1024, 2 }, { 1025, 1 }, { 2048, 4326 }, { 4096, 5773 } }),
    codesIn(geoKeysWithoutGdal("mine")));
  expectIOError(
    "The coordinate reference system 'other'", "no EPSG code", [] { geoKeysWithoutGdal("other"); });
}

} // namespace
