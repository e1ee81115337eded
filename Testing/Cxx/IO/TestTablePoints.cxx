// SPDX-License-Identifier: BSD-3-Clause
#include "Points/ReadPoints.h"

#include <gtest/gtest.h>

using namespace tipp;

namespace
{

PointTable tableOf(std::size_t points)
{
  PointTable table;
  table.Columns = { { "z", {} }, { "intensity", {} } };
  for (std::size_t i = 0; i < points; ++i)
  {
    table.XY.insert(table.XY.end(), { double(i), double(i % 7) });
    table.Columns[0].Values.push_back(100 + double(i));
    table.Columns[1].Values.push_back(-double(i));
  }
  return table;
}

/// All points of the stream, read in blocks of `most` points. Checks that the numbers of points
/// continue from block to block.
PointTable readAll(PointStream& stream, std::size_t most, std::int64_t first)
{
  PointTable read;
  read.Columns.resize(stream.columns().size());
  for (PointBlock block; stream.next(block, most);)
  {
    EXPECT_EQ(first + std::int64_t(read.size()), block.First);
    EXPECT_GE(most, block.XY.size() / 2);
    read.XY.insert(read.XY.end(), block.XY.begin(), block.XY.end());
    for (std::size_t i = 0; i < block.Columns.size(); ++i)
    {
      std::vector<double>& to = read.Columns[i].Values;
      to.insert(to.end(), block.Columns[i].begin(), block.Columns[i].end());
    }
  }
  return read;
}

void expectRange(
  const PointTable& read, const PointTable& whole, std::size_t begin, std::size_t end)
{
  ASSERT_EQ(end - begin, read.size());
  for (std::size_t i = begin; i < end; ++i)
  {
    EXPECT_EQ(whole.XY[2 * i], read.XY[2 * (i - begin)]);
    EXPECT_EQ(whole.XY[2 * i + 1], read.XY[2 * (i - begin) + 1]);
    EXPECT_EQ(whole.Columns[0].Values[i], read.Columns[0].Values[i - begin]);
    EXPECT_EQ(whole.Columns[1].Values[i], read.Columns[1].Values[i - begin]);
  }
}

} // namespace

TEST(TablePoints, AreReadInBlocksAndAgainAfterRewind)
{
  const PointTable table = tableOf(100);
  const auto stream = streamTable(table);
  EXPECT_EQ((std::vector<std::string>{ "z", "intensity" }), stream->columns());
  for (const std::size_t most : { 1, 33, 100, 1000 })
  {
    stream->rewind();
    expectRange(readAll(*stream, most, 0), table, 0, 100);
  }
}

TEST(TablePoints, ARangeKeepsThePointsNumbers)
{
  const PointTable table = tableOf(100);
  const auto stream = streamTable(table);
  stream->limitTo(20, 61);
  stream->rewind();
  expectRange(readAll(*stream, 7, 20), table, 20, 61);
  stream->limitTo(90, 1000);
  stream->rewind();
  expectRange(readAll(*stream, 7, 90), table, 90, 100);
}

TEST(TablePoints, NoneAreAnEmptyStream)
{
  const auto stream = streamTable({});
  PointBlock block;
  EXPECT_FALSE(stream->next(block, 10));
  EXPECT_EQ(0, stream->most());
}

/// The x of the points that are left.
std::vector<double> thinned(std::vector<double> xy, double side, Thinning::Rule rule)
{
  PointTable table;
  table.Columns.push_back({ "z", std::vector<double>(xy.size() / 2, 1) });
  table.XY = std::move(xy);
  Thinning thinning;
  thinning.Cell = side;
  thinning.Keep = rule;
  const PointTable left = readAllPoints(*streamTable(std::move(table), thinning));
  std::vector<double> xs;
  for (std::size_t i = 0; i < left.size(); ++i)
  {
    xs.push_back(left.XY[2 * i]);
  }
  return xs;
}

TEST(TablePoints, OfTheNearestPointsThinningKeepsTheFirst)
{
  // All are 0.02 from the centre of a square of side 0.1.
  EXPECT_EQ(std::vector<double>{ 0.33 },
    thinned({ 0.33, 0.05, 0.37, 0.05, 0.35, 0.03, 0.35, 0.07 }, 0.1, Thinning::Rule::Nearest));
  EXPECT_EQ(
    std::vector<double>{ 0.37 }, thinned({ 0.37, 0.05, 0.33, 0.05 }, 0.1, Thinning::Rule::Nearest));
  EXPECT_EQ(std::vector<double>{ 500000.37 },
    thinned({ 500000.37, 0.05, 500000.33, 0.05 }, 0.1, Thinning::Rule::Nearest));
}

TEST(TablePoints, ThinningDecidesBordersWithTheWrittenNumbers)
{
  // 0.3 / 0.1 is less than 3, and 0.30000000000000004 is 3 * 0.1.
  EXPECT_EQ((std::vector<double>{ 0.29, 0.3 }),
    thinned({ 0.29, 0, 0.3, 0, 0.35, 0 }, 0.1, Thinning::Rule::Lowest));
  EXPECT_EQ((std::vector<double>{ 0.29, 0.30000000000000004 }),
    thinned({ 0.29, 0, 0.30000000000000004, 0, 0.35, 0 }, 0.1, Thinning::Rule::Lowest));
  EXPECT_EQ((std::vector<double>{ -0.31, -0.3 }),
    thinned({ -0.31, 0, -0.3, 0, -0.25, 0 }, 0.1, Thinning::Rule::Lowest));
}

TEST(TablePoints, ThinningKeepsOneInEachSquare)
{
  Thinning thinning;
  thinning.Cell = 10;
  thinning.Keep = Thinning::Rule::Highest;
  const auto stream = streamTable(tableOf(100), thinning);
  EXPECT_EQ(10U, readAll(*stream, 100, 0).size());
}
