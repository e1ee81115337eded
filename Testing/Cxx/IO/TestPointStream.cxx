// SPDX-License-Identifier: BSD-3-Clause
// Text files as streams: openPointStream() makes TextFilePoints for them.
#include "Points/ReadPoints.h"

#include "ExpectIOError.h"
#include "TemporaryFolder.h"

#include <cmath>
#include <sstream>

namespace
{

using namespace tipp;
using namespace tipp::test;

/// All points of the stream, read in blocks of at most `most` points.
PointTable collect(PointStream& stream, std::size_t most)
{
  PointTable table;
  for (const std::string& name : stream.columns())
  {
    table.Columns.push_back({ name, {} });
  }
  forEachBlock(stream, most,
    [&](PointBlock& block)
    {
      EXPECT_EQ(std::int64_t(table.size()), block.First);
      EXPECT_GE(most, block.size());
      ASSERT_EQ(table.Columns.size(), block.Columns.size());
      table.XY.insert(table.XY.end(), block.XY.begin(), block.XY.end());
      for (std::size_t i = 0; i < block.Columns.size(); ++i)
      {
        std::vector<double>& values = table.Columns[i].Values;
        values.insert(values.end(), block.Columns[i].begin(), block.Columns[i].end());
      }
    });
  return table;
}

/// The table as text, in which NaN is equal to NaN.
std::string textOf(const PointTable& table)
{
  std::ostringstream text;
  text.precision(17);
  for (const double value : table.XY)
  {
    text << value << ' ';
  }
  for (const PointTable::Column& column : table.Columns)
  {
    text << '\n' << column.Name << ':';
    for (const double value : column.Values)
    {
      text << ' ' << value;
    }
  }
  return text.str();
}

const char* const survey = "station,y,depth,x,name,note,t\n"
                           "7,1,NA,2,north,1,\n"
                           "# a comment\n"
                           "8,3,-5.5,4,south,2,\r\n"
                           "\n"
                           "9,nan,6,1e300,west,three,\n"
                           "9,5,,6,,4,";

TEST(PointStream, TextInBlocksEqualsTheWholeText)
{
  const TemporaryFolder folder;
  for (const char* text :
    { survey, "1 2\n", "3\n1;2;3\n4;5;6\n7;8;9\n", "A title\n1 2 3 x\n5 6 7 8\n" })
  {
    const std::string path = folder.file("points.csv", text);
    const std::string expected = textOf(readPoints(path));
    const auto stream = openPointStream({ path });
    for (const std::size_t most : { 1, 2, 3, 4, 1000 })
    {
      EXPECT_EQ(expected, textOf(collect(*stream, most))) << most;
    }
  }
}

TEST(PointStream, ColumnsOfTextAreChosenByName)
{
  const TemporaryFolder folder;
  const PointOptions options{ "station", "t" };
  const std::string path = folder.file("points.xyz", "t h station\n1 2 3\n4 5 6\n");
  EXPECT_EQ(
    textOf(readPoints(path, options)), textOf(collect(*openPointStream({ path }, options), 1)));
}

TEST(PointStream, FilesOfTextFollowEachOther)
{
  const TemporaryFolder folder;
  const auto stream =
    openPointStream({ folder.file("a.csv", "1,2,3\n4,5,6\n"), folder.file("b.txt", "7 8 9\n") });
  EXPECT_EQ("1 2 4 5 7 8 \nz: 3 6 9", textOf(collect(*stream, 2)));
}

TEST(PointStream, AnErrorAtTheEndOfTextIsReportedAtOnce)
{
  const TemporaryFolder folder;
  std::string text = "x,y\n";
  for (int i = 0; i < 300000; ++i)
  {
    text += "1,2\n";
  }
  const std::string path = folder.file("points.csv", text + "3,four\n");
  expectIOError(path, "line 300002: 'four' is not a number", [&] { openPointStream({ path }); });
  const std::string counted = folder.file("counted.xyz", "4\n1 2\n3 4\n");
  expectIOError(counted, "announces 4 points", [&] { openPointStream({ counted }); });
}

TEST(PointStream, AChangeOfTheFileIsNoticed)
{
  const TemporaryFolder folder;
  const std::string path = folder.file("points.csv", "1,2,3\n4,5,6\n");
  const auto stream = openPointStream({ path });
  folder.file("points.csv", "1,2,3\n4,5,six\n");
  PointBlock block;
  expectIOError(path, "changed meanwhile", [&] { stream->next(block, 10); });
  folder.file("points.csv", "1,2\n4,5\n");
  expectIOError(path, "changed", [&] { stream->rewind(); });
}

} // namespace
