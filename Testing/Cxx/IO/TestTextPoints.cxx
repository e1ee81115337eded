// SPDX-License-Identifier: BSD-3-Clause
#include "ExpectIOError.h"
#include "Points/ReadPoints.h"
#include "TemporaryFolder.h"

#include <cmath>
#include <limits>

namespace
{

using tipp::PointTable;
using tipp::readPoints;
using Values = std::vector<double>;

class TextPoints : public testing::Test
{
protected:
  PointTable read(const std::string& content, const tipp::PointOptions& options = {}) const
  {
    return readPoints(this->Folder.file("points.csv", content), options);
  }

  void expectError(const std::string& content, const std::string& words,
    const tipp::PointOptions& options = {}) const
  {
    const std::string path = this->Folder.file("points.csv", content);
    tipp::test::expectIOError(path, words, [&]() { readPoints(path, options); });
  }

  const tipp::test::TemporaryFolder Folder;
};

} // namespace

TEST_F(TextPoints, DelimitersAreFound)
{
  const Values expected{ 1.5, 2, -3, 4e-3 };
  EXPECT_EQ(expected, this->read("1.5,2\n-3,4e-3\n").XY);
  EXPECT_EQ(expected, this->read("1.5;2\n-3;4e-3\n").XY);
  EXPECT_EQ(expected, this->read("1.5\t2\n-3\t4e-3\n").XY);
  EXPECT_EQ(expected, this->read("  1.5   2 \n\t-3 4e-3\n").XY);
  EXPECT_EQ(expected, this->read("1.5, 2\n -3 , 4e-3").XY);
}

TEST_F(TextPoints, ExtensionsOfTextAllRead)
{
  for (const char* name :
    { "points.csv", "points.txt", "points.xyz", "points.tsv", "points.pts", "POINTS.CSV" })
  {
    EXPECT_EQ((Values{ 1, 2 }), readPoints(this->Folder.file(name, "1 2\n")).XY) << name;
  }
}

TEST_F(TextPoints, BlankCoordinatesAreNotFinite)
{
  const Values xy = this->read("x,y\n1,2\n3,\n,4\n").XY;
  ASSERT_EQ(6U, xy.size());
  EXPECT_EQ(3, xy[2]);
  EXPECT_TRUE(std::isnan(xy[3]));
  EXPECT_TRUE(std::isnan(xy[4]));
  EXPECT_EQ(4, xy[5]);
}

TEST_F(TextPoints, CompressedFilesAreRead)
{
  for (const char* const program : { "gzip", "xz" })
  {
    const std::string text = this->Folder.file("it's points.csv", "x,y,z\n1,2,3\n4,5,6\n");
    const std::string extension = program == std::string("gzip") ? ".gz" : ".xz";
    const std::string find = std::string("command -v ") + program + " > /dev/null";
    if (std::system(find.c_str()) != 0)
    {
      GTEST_SKIP() << program << " is not installed";
    }
    const std::string command = std::string(program) + " -f \"" + text + "\"";
    ASSERT_EQ(0, std::system(command.c_str())) << command;
    EXPECT_EQ((Values{ 1, 2, 4, 5 }), readPoints(text + extension).XY);
  }
  const std::string bad = this->Folder.file("bad.csv.gz", "x,y\n1,2\n");
  tipp::test::expectIOError(bad, "cannot be decompressed by gzip", [&] { readPoints(bad); });
}

TEST_F(TextPoints, ALineOfCountsIsNoPoint)
{
  EXPECT_EQ((Values{ 1, 2, 3, 4 }), this->read("2 0\n1 2\n\n3 4\n").XY);
  EXPECT_EQ((Values{ 3, 0, 1, 2, 3, 4 }), this->read("3 0\n1 2\n3 4\n").XY);
}

TEST_F(TextPoints, UsualNamesAreFoundInAnyOrderAndCase)
{
  EXPECT_EQ((Values{ 1, 2 }), this->read("id,Y,X\n7,2,1\n").XY);
  EXPECT_EQ((Values{ 1, 2 }), this->read("depth,lat,lon\n7,2,1\n").XY);
  EXPECT_EQ((Values{ 1, 2 }), this->read("line,longitude,latitude\n7,1,2\n").XY);
  EXPECT_EQ((Values{ 1, 2 }), this->read("Northing;Easting\n2;1\n").XY);
}

TEST_F(TextPoints, UnusualNamesAreRefusedUnlessThereAreTwo)
{
  this->expectError("a,b,c\n1,2,3\n", "has the columns a, b, c, and their names do not tell");
  EXPECT_EQ((Values{ 1, 2 }), this->read("a,b\n1,2\n").XY);
}

TEST_F(TextPoints, ColumnsAreChosenByNameOrNumber)
{
  EXPECT_EQ((Values{ 3, 1 }), this->read("a,b,c\n1,2,3\n", { "c", "a" }).XY);
  EXPECT_EQ((Values{ 3, 2 }), this->read("1,2,3\n", { "2", "1" }).XY);
  EXPECT_EQ((Values{ 3, 2 }), this->read("x,y,h\n1,2,3\n", { "h", "" }).XY);
}

TEST_F(TextPoints, MissingColumnIsReportedWithTheNames)
{
  this->expectError("a,b\n1,2\n", "choose from a, b", { "east", "b" });
  this->expectError("1,2\n", "choose from 0 to 1", { "0", "2" });
}

TEST_F(TextPoints, FurtherNumericColumnsBecomeAttributes)
{
  const PointTable points = this->read("x,y,station,q,t\n1,2,North,3,\n4,5,South,NA,6\n");
  ASSERT_EQ(2U, points.Columns.size());
  EXPECT_EQ("q", points.Columns[0].Name);
  EXPECT_EQ(3, points.Columns[0].Values[0]);
  EXPECT_TRUE(std::isnan(points.Columns[0].Values[1]));
  EXPECT_EQ("t", points.Columns[1].Name);
  EXPECT_TRUE(std::isnan(points.Columns[1].Values[0]));
  EXPECT_EQ(6, points.Columns[1].Values[1]);
}

TEST_F(TextPoints, UnnamedThirdColumnIsZ)
{
  const PointTable points = this->read("1 2 3 4\n5 6 7 8\n");
  ASSERT_EQ(2U, points.Columns.size());
  EXPECT_EQ("z", points.Columns[0].Name);
  EXPECT_EQ((Values{ 3, 7 }), points.Columns[0].Values);
  EXPECT_EQ("column3", points.Columns[1].Name);
}

TEST_F(TextPoints, QuotedFieldsMayHoldTheDelimiter)
{
  const PointTable points =
    this->read("\"x\",\"name, or so\",\"y\"\n\"1\",\"a, b\",2\n3,\"c\",4\n");
  EXPECT_EQ((Values{ 1, 2, 3, 4 }), points.XY);
  EXPECT_TRUE(points.Columns.empty());
}

TEST_F(TextPoints, FirstLineMayHoldTheCount)
{
  EXPECT_EQ((Values{ 1, 2, 3, 4 }), this->read("2\n1 2 9 \n3 4 9 \n").XY);
}

TEST_F(TextPoints, CountThatDoesNotMatchIsReported)
{
  this->expectError("3\n1 2\n3 4\n", "announces 3 points in its first line and holds 2");
  this->expectError("-1\n1 2\n", "announces -1 points");
  this->expectError("4000000000000000000\n1 2\n", "announces 4000000000000000000 points");
}

TEST_F(TextPoints, TitleCommentsEmptyLinesAndWindowsLineEndsAreNoPoints)
{
  EXPECT_EQ((Values{ 1, 2, 3, 4 }), this->read("A survey\r\n1 2\r\n\r\n3 4\r\n").XY);
  EXPECT_EQ((Values{ 1, 2 }), this->read("# x y\n1 2\n# end\n\n").XY);
  EXPECT_EQ((Values{ 1, 2 }), this->read("\xef\xbb\xbfx,y\n1,2").XY);
}

TEST_F(TextPoints, NumbersOutOfRangeGiveTheNearestDouble)
{
  const PointTable points = this->read("1e-400,1e400\n+1,-1e-300\n");
  EXPECT_EQ(0, points.XY[0]);
  EXPECT_EQ(std::numeric_limits<double>::infinity(), points.XY[1]);
  EXPECT_EQ(1, points.XY[2]);
  EXPECT_EQ(-1e-300, points.XY[3]);
}

TEST_F(TextPoints, NaNIsRead)
{
  EXPECT_TRUE(std::isnan(this->read("1,2\nnan,3\n").XY[2]));
}

TEST_F(TextPoints, IntegersThatADoubleCannotHoldAreReportedWithTheirLine)
{
  const Values exact{ 9007199254740994.0, -9007199254740992.0, 1e22, 18446744073709551616.0 };
  EXPECT_EQ(exact,
    this->read(
          "9007199254740994,-9007199254740992\n+10000000000000000000000,18446744073709551616\n")
      .XY);
  EXPECT_EQ(12345678901234567.25, this->read("12345678901234567.25,1\n2,3\n").XY[0]);
  this->expectError(
    "1,2\n9007199254740993,4\n", "line 2: '9007199254740993' is an integer beyond 2^53");
  this->expectError("1,-0018446744073709551615\n", "subtract an offset from the column");
}

TEST_F(TextPoints, GarbageInACoordinateIsReportedWithItsLine)
{
  this->expectError("x,y\n1,2\n3,four\n", "line 3: 'four' is not a number");
  this->expectError("1;2\n1.000,5;2,5\n", "line 2: '1.000,5' is not a number");
}

TEST_F(TextPoints, LineWithAnotherNumberOfColumnsIsReported)
{
  this->expectError("1,2,3\n4,5\n", "line 2: has 2 columns where the first point has 3");
  this->expectError("1 2\n4 5 6\n", "line 2: has 3 columns where the first point has 2");
}

TEST_F(TextPoints, FilesWithoutPointsAreReported)
{
  for (const char* content : { "", "\n\n", "# nothing\n", "x,y\n", "0\n" })
  {
    this->expectError(content, "holds no points");
  }
}

TEST_F(TextPoints, OnlyTheRequestedColumnsAreRead)
{
  tipp::PointOptions options;
  options.Columns = { "depth", "missing" };
  const PointTable points = this->read("x,y,speed,depth\n1,2,3,4\n", options);
  EXPECT_EQ(std::vector<std::string>{ "depth" }, points.names());
  EXPECT_EQ(Values{ 4 }, points.Columns[0].Values);
}

TEST_F(TextPoints, SingleColumnIsReported)
{
  this->expectError("one\n1\n2\n", "single column");
}

TEST_F(TextPoints, BinaryFileIsReported)
{
  this->expectError(std::string("ab\0cd", 5), "is not a text file");
}

TEST_F(TextPoints, NetcdfWithTheNameOfATextIsReported)
{
  this->expectError(std::string("CDF\1\0\0", 6), "is not text but NetCDF; give it the extension");
  this->expectError("\x89HDF\r\n\x1a\n", "is not text but HDF5");
}

TEST_F(TextPoints, ColumnMayBeCalledAsNetcdfBegins)
{
  EXPECT_EQ(std::vector<std::string>{ "CDF" }, this->read("CDF,x,y\n1,2,3\n").names());
}

TEST_F(TextPoints, CompressedTextWithoutItsExtensionIsReported)
{
  this->expectError("\x1f\x8b\x08 and more", "gzip -dc FILE");
  this->expectError("\xfd"
                    "7zXZ and more",
    "xz -dc FILE");
  this->expectError("\x28\xb5\x2f\xfd and more", "zstd -dc FILE");
}

TEST_F(TextPoints, UnknownExtensionIsReported)
{
  const std::string path = this->Folder.file("points.dat", "1 2\n");
  tipp::test::expectIOError(path, "no extension", [&]() { readPoints(path); });
}
