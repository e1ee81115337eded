// SPDX-License-Identifier: BSD-3-Clause
#include "Crs/StatedCodes.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace
{

using namespace tipp;

using Codes = std::pair<int, int>;

/// The codes of the system and of its heights.
Codes codes(const std::string& text)
{
  const StatedCodes found = codesOf(text);
  return { found.Horizontal, found.Heights };
}

const std::string compound = "COMPD_CS[\"c\",PROJCS[\"p\",GEOGCS[\"g\",AUTHORITY[\"EPSG\",\"4258\"]"
                             "],AUTHORITY[\"EPSG\",\"25832\"]],VERT_CS[\"h\",AUTHORITY[\"EPSG\","
                             "\"7837\"]],AUTHORITY[\"EPSG\",\"1\"]]";

TEST(StatedCodes, AreThoseAfterEpsg)
{
  EXPECT_EQ(Codes(25832, 0), codes("EPSG:25832"));
  EXPECT_EQ(Codes(25832, 0), codes("epsg:25832"));
  EXPECT_EQ(Codes(25832, 7837), codes("EPSG:25832+7837"));
}

TEST(StatedCodes, AreNoneIfTheTextHasMore)
{
  for (const char* const text :
    { "", "EPSG:", "EPSG:x", "EPSG:25832x", "EPSG:25832 ", "EPSG:25832+", "EPSG:25832+7837+1",
      "EPSG:99999999999999999999", "ESRI:102003", "PROJCS[\"x\"]" })
  {
    EXPECT_EQ(Codes(0, 0), codes(text)) << text;
  }
}

TEST(StatedCodes, OfWktAreThoseOfTheWholeSystem)
{
  EXPECT_EQ(Codes(25833, 0),
    codes(R"(PROJCRS["x", BASEGEOGCRS["y", ID["EPSG", 4258]], ID["EPSG", 25833]])"));
  EXPECT_EQ(Codes(0, 0), codes(R"(PROJCRS["x, ID[\"EPSG\",1]", BASEGEOGCRS["y", ID["EPSG", 2]]])"));
}

TEST(StatedCodes, OfCompoundWktAreThoseOfItsParts)
{
  EXPECT_EQ(Codes(25832, 7837), codes(compound));
  EXPECT_EQ(Codes(25832, 7837), codes(" \n" + compound));
}

TEST(StatedCodes, OfWktBeyondTheLargestNumberAreNone)
{
  EXPECT_EQ(Codes(0, 0), codes("PROJCS[\"x\",AUTHORITY[\"EPSG\",\"99999999999999999999\"]]"));
  EXPECT_EQ(Codes(0, 0), codes("PROJCS[\"x\",ID[\"EPSG\","));
}

TEST(StatedCodes, ASystemOfHeightsIsFound)
{
  for (const std::string& text : { std::string("EPSG:25832+7837"), std::string("epsg:25832+7837"),
         compound, " " + compound, std::string("COMPOUNDCRS[\"c\"]") })
  {
    EXPECT_TRUE(hasHeightSystem(text)) << text;
  }
  for (const char* const text : { "", " ", "EPSG:25832", "PROJCS[\"a+b\"]" })
  {
    EXPECT_FALSE(hasHeightSystem(text)) << text;
  }
}

} // namespace
