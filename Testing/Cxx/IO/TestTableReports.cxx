// SPDX-License-Identifier: BSD-3-Clause
#include "Points/ReadPoints.h"
#include "Points/TableColumns.h"

#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;
using Names = std::vector<std::string>;

class TableReports : public testing::Test
{
protected:
  PointTable read(const std::string& content, const PointOptions& options = {}) const
  {
    return readPoints(this->Folder.file("points.csv", content), options);
  }

  TableReport report(const std::string& content, const PointOptions& options = {}) const
  {
    return this->read(content, options).Reports.at(0);
  }

  const TemporaryFolder Folder;
};

} // namespace

TEST_F(TableReports, TellTheColumnsByName)
{
  EXPECT_EQ("x from 'POINT_X', y from 'POINT_Y', z from 'GRID_CODE'",
    this->report("OBJECTID,POINT_X,POINT_Y,GRID_CODE\n1,2,3,4\n").Columns);
  EXPECT_EQ("x from 'x', y from 'y', no heights", this->report("x,y\n1,2\n").Columns);
}

TEST_F(TableReports, TellTheColumnsByNumberWithoutNames)
{
  EXPECT_EQ(
    "x from column 0, y from column 1, z from column 2", this->report("1.5,2.5,3\n").Columns);
}

TEST_F(TableReports, SayThatADepthIsNotTurned)
{
  const PointTable table = this->read("lon,lat,Depth\n1,2,30\n");
  EXPECT_NE(std::string::npos, table.Reports[0].Columns.find("z from 'Depth' as it stands"));
  EXPECT_EQ((Names{ "z", "Depth" }), table.names());
}

TEST_F(TableReports, CountMissingHeightsAndNameTheFirst)
{
  const TableReport report =
    this->report("x,y,z\n0,0,1\n1,0,NULL\n2,0,12.3m\n3,0,4\n4,0,\n5,0,6\n6,0,7\n");
  ASSERT_EQ(1U, report.Warnings.size());
  EXPECT_EQ("2 values in column 'z' are missing, first 'NULL' in line 3.", report.Warnings[0]);
}

TEST_F(TableReports, NameTheFirstPointWithoutCoordinates)
{
  const TableReport report = this->report("x,y\n0,0\n,3\n1,\n");
  ASSERT_EQ(1U, report.Warnings.size());
  EXPECT_EQ("2 points have no x or y; the first is in line 3.", report.Warnings[0]);
}

TEST_F(TableReports, NameColumnsOfNumbersAndTextThatAreLeftOut)
{
  const PointTable table = this->read("x,y,z,code\n0,0,1,7\n1,0,2,EP\n2,0,3,TOP\n3,0,4,\n");
  EXPECT_EQ(Names{ "z" }, table.names());
  ASSERT_EQ(1U, table.Reports[0].Warnings.size());
  EXPECT_NE(std::string::npos,
    table.Reports[0].Warnings[0].find("'code' holds text, such as 'EP' in line 3"));
}

TEST_F(TableReports, AColumnThatIsAskedForMustNotHoldText)
{
  PointOptions options;
  options.Columns = { "code" };
  EXPECT_THROW(this->read("x,y,code\n0,0,7\n1,0,EP\n2,0,TOP\n", options), std::runtime_error);
}

TEST_F(TableReports, WarnOfHeightsThatMarkMissingOnes)
{
  const std::string text = "x,y,z\n0,0,1\n1,0,-9999\n2,0,-9999\n";
  const TableReport report = this->report(text);
  ASSERT_EQ(1U, report.Warnings.size());
  EXPECT_NE(std::string::npos, report.Warnings[0].find("2 heights in column 'z' look like"));
  PointOptions options;
  options.NoData = -9999;
  EXPECT_TRUE(this->report(text, options).Warnings.empty());
  EXPECT_TRUE(std::isnan(this->read(text, options).Columns[0].Values[1]));
}

TEST_F(TableReports, EqualNamesAreMadeDifferent)
{
  const PointTable table = this->read("x,y,a,a,a_2,a\n0,1,2,3,4,5\n");
  EXPECT_EQ((Names{ "a", "a_3", "a_2", "a_4" }), table.names());
  ASSERT_EQ(2U, table.Reports[0].Remarks.size());
  EXPECT_NE(std::string::npos, table.Reports[0].Remarks[0].find("several columns are named 'a'"));
}

TEST_F(TableReports, NamesAreCleanUtf8)
{
  const PointTable table = this->read("x,y,b\xe9ton,\xc3\xa9t\xc3\xa9,a\x01"
                                      "b,\"5\"\" pipe\"\n0,1,2,3,4,5\n");
  EXPECT_EQ((Names{ "b\xc3\xa9ton", "\xc3\xa9t\xc3\xa9", "a b", "5\" pipe" }), table.names());
}

TEST_F(TableReports, HeightsKeepTheirNameBesideZ)
{
  const PointTable table = this->read("x,y,Elevation,q\n0,1,2,3\n");
  EXPECT_EQ((Names{ "z", "Elevation", "q" }), table.names());
  EXPECT_EQ(2, table.Columns[0].Values[0]);
  EXPECT_EQ(2, table.Columns[1].Values[0]);
}

TEST_F(TableReports, AChosenHeightReplacesTheColumnZ)
{
  PointOptions options;
  options.Z = "top";
  const PointTable table = this->read("x,y,z,top\n0,1,2,3\n", options);
  EXPECT_EQ((Names{ "z", "z_2", "top" }), table.names());
  EXPECT_EQ(3, table.Columns[0].Values[0]);
  EXPECT_EQ(2, table.Columns[1].Values[0]);
}

TEST_F(TableReports, AnIndexWithoutNameIsNotTheHeight)
{
  const PointTable table = this->read(",x,y,q\n0,1,2,3\n1,4,5,6\n");
  EXPECT_EQ((Names{ "column0", "q" }), table.names());
}

TEST(TableColumns, AreFoundByNamesInAnyCase)
{
  const std::vector<std::pair<Names, std::vector<std::size_t>>> tables = {
    { { "ID", "X", "Y", "Z" }, { 1, 2, 3 } },
    { { "z", "n", "e" }, { 2, 1, 0 } },
    { { "Northing", "Easting", "Elevation" }, { 1, 0, 2 } },
    { { "OBJECTID", "POINT_X", "POINT_Y", "POINT_Z" }, { 1, 2, 3 } },
    { { "lat", "lon", "height" }, { 1, 0, 2 } },
    { { "lon", "lat", "x", "y", "depth" }, { 2, 3, 4 } },
    { { "POINT_X", "POINT_Y", "x", "y", "z" }, { 2, 3, 4 } },
    { { "decimalLatitude", "decimalLongitude", "depth", "elevation" }, { 1, 0, 3 } },
    { { "x", "Northing", "alt" }, { 0, 1, 2 } },
    { { "UTM_E", "UTM_N", "Elev_ft" }, { 0, 1, 2 } },
  };
  for (const auto& [names, expected] : tables)
  {
    const auto choice = findCoordinates(names);
    ASSERT_TRUE(choice) << names[0];
    EXPECT_EQ(expected, (std::vector<std::size_t>{ choice->X, choice->Y, choice->Z.value_or(99) }))
      << names[0];
  }
}

TEST(TableColumns, NamesThatDoNotTellGiveNone)
{
  for (const Names& names : { Names{ "id", "a", "b" }, Names{ "n", "x", "value" },
         Names{ "start_x", "start_y", "end_x", "end_y" }, Names{ "x", "z" }, Names{ "time", "h" } })
  {
    EXPECT_FALSE(findCoordinates(names)) << names[0];
    EXPECT_THROW(requireCoordinates(names), std::invalid_argument) << names[0];
  }
}

TEST(TableColumns, TwoColumnsWithOneNameAreRefused)
{
  EXPECT_THROW(findCoordinates({ "x", "y", "z", "z" }), std::invalid_argument);
  EXPECT_THROW(findCoordinates({ "POINT_X", "GPS_X", "POINT_Y" }), std::invalid_argument);
}
