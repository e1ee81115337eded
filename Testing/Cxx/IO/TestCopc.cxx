// SPDX-License-Identifier: BSD-3-Clause
#include "Las/CopcHierarchy.h"

#include "Arrays/Random.h"
#include "CopcText.h"
#include "ExpectIOError.h"
#include "Files/InputFile.h"
#include "Files/RawValues.h"
#include "Las/LazFile.h"
#include "Points/ReadPoints.h"
#include "RegionTesting.h"
#include "SharedData.h"
#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

class Copc : public testing::Test
{
protected:
  /// Adds distinct random points, more of them in a corner.
  static CopcText randomCopc(int points, unsigned seed = 1)
  {
    CopcText copc;
    Random random(seed);
    for (int i = 0; i < points; ++i)
    {
      const double side = (i % 3 == 0 ? 0.1 : 1) * CopcText::Side;
      const auto next = [&] { return std::int32_t(side * random.uniform()) / 1024 * 1024; };
      const std::int32_t x = next() + i; // so that no two are equal
      copc.add(x % CopcText::Side, next(), next() / 64, i % 5);
    }
    return copc;
  }

  std::string write(const std::string& text) const { return this->Folder.file("a.copc.laz", text); }

  TemporaryFolder Folder;
};

/// Returns all nodes, by brute force: their points lie in their boxes, and all points are in one.
std::vector<CopcNode> checkedNodes(const std::string& path)
{
  const LasHeader header = readLasHeader(path);
  const CopcInfo info = readCopcInfo(path, header);
  const LazFile laz(path, header);
  const InputFile file(path);
  LazReader reader(laz, laz::All);
  std::vector<CopcNode> nodes = findCopcNodes(path, header, laz.chunks(), {});
  std::int64_t points = 0;
  std::vector<bool> isSeen(laz.chunks().size(), false);
  for (const CopcNode& node : nodes)
  {
    EXPECT_FALSE(isSeen.at(node.Chunk));
    isSeen[node.Chunk] = true;
    EXPECT_EQ(laz.chunks()[node.Chunk].Points, node.Points);
    std::string records(std::size_t(node.Points) * header.RecordLength, '\0');
    reader.begin(file, node.Chunk);
    reader.read(std::size_t(node.Points), records.data());
    const Box3 box = node.bounds(info);
    for (std::size_t at = 0; at < records.size(); at += header.RecordLength)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const double value =
          valueAt<std::int32_t>(&records[at + 4 * axis]) * header.Scale[axis] + header.Offset[axis];
        EXPECT_GE(value, box.Min[axis] - header.Scale[axis]);
        EXPECT_LE(value, box.Max[axis] + header.Scale[axis]);
      }
    }
    points += std::int64_t(node.Points);
  }
  EXPECT_EQ(header.Points, points);
  return nodes;
}

TEST_F(Copc, NodesHaveThePointsInTheirBoxes)
{
  const auto nodes = checkedNodes(this->write(randomCopc(600).text()));
  EXPECT_EQ(600U, nodes.size());
}

TEST_F(Copc, NodesOfRealFilesHaveThePointsInTheirBoxes)
{
  TIPP_REQUIRE_DATA(folder, "laz")
  EXPECT_EQ(65U, checkedNodes(folder + "/simple.copc.laz").size());
  EXPECT_EQ(65U, checkedNodes(folder + "/simple_with_page.copc.laz").size());
  EXPECT_FALSE(checkedNodes(folder + "/lone-star.copc.laz").empty());
}

TEST_F(Copc, RegionEqualsFilteringAllPoints)
{
  expectFiltered(this->write(randomCopc(600).text()));
}

TEST_F(Copc, RegionsOfRealFilesEqualFilteringAllPoints)
{
  TIPP_REQUIRE_DATA(folder, "laz")
  expectFiltered(folder + "/simple.copc.laz");
  expectFiltered(folder + "/simple_with_page.copc.laz");
  expectFiltered(folder + "/lone-star.copc.laz", 5);
}

TEST_F(Copc, OnlyNodesThatMeetTheRegionAreRead)
{
  const std::string path = this->write(randomCopc(600).text());
  const LasHeader header = readLasHeader(path);
  const CopcInfo info = readCopcInfo(path, header);
  PointOptions options;
  options.Region = Box2{ { 2000, 2100 }, { 3000, 4100 } };
  std::int64_t met = 0;
  for (const CopcNode& node : checkedNodes(path))
  {
    met += projected<2>(node.bounds(info)).meets(*options.Region) ? 1 : 0;
  }
  const ReadFigures figures = readPoints(path, options).Figures;
  EXPECT_EQ(600 - met, figures.SkippedChunks);
  EXPECT_EQ(600 - met, figures.SkippedPoints);
  EXPECT_LT(met, 200);
  EXPECT_EQ(600, figures.Points);
}

TEST_F(Copc, SpacingChoosesTheCoarsestLevelsThatAreFineEnough)
{
  const std::string path = this->write(randomCopc(600).text());
  const CopcInfo info = readCopcInfo(path, readLasHeader(path));
  const std::vector<CopcNode> nodes = checkedNodes(path);
  PointOptions options;
  for (int level = 0; level < 4; ++level)
  {
    const auto expected = std::count_if(
      nodes.begin(), nodes.end(), [&](const CopcNode& node) { return node.Level <= level; });
    options.Spacing = std::ldexp(info.Spacing, -level);
    EXPECT_EQ(std::size_t(expected), readPoints(path, options).size()) << level;
    options.Spacing *= 1.9;
    EXPECT_EQ(std::size_t(expected), readPoints(path, options).size()) << level;
  }
  options.Spacing = 1e-30;
  EXPECT_EQ(600U, readPoints(path, options).size());
}

TEST_F(Copc, SpacingNeedsLevels)
{
  PointOptions options;
  options.Spacing = 1;
  LasText las(2, 0);
  las.add(1, 2, 3, 2);
  for (const std::string& path :
    { this->Folder.file("a.las", las.text()), this->Folder.file("a.csv", "1,2,3\n") })
  {
    expectIOError(path, "is no COPC file", [&] { readPoints(path, options); });
  }
}

/// A file with damage in the hierarchy, and what the error says.
struct Damage
{
  std::string Words;
  std::string Text;
};

std::vector<Damage> damagesOf(CopcText copc)
{
  const std::string whole = copc.text();
  const std::size_t root = copc.PageOffsets[CopcText::Key{}];
  const std::size_t pages =
    root + copc.PageBytes[CopcText::Key{}] - CopcText::EntryBytes; // a page's entry
  const auto second = root + CopcText::EntryBytes;
  std::vector<Damage> damages;
  const auto damage = [&](const std::string& words, std::size_t at, auto value)
  {
    damages.push_back({ words, whole });
    putAt(damages.back().Text, at, value);
  };
  damage("bytes", CopcText::RootOffset, std::uint64_t(whole.size() - 8));
  damage("bytes", CopcText::RootOffset, ~std::uint64_t(0) - 64);
  damage("bytes", CopcText::RootBytes, std::uint64_t(0));
  damage("bytes", CopcText::RootBytes, std::uint64_t(33));
  damage("bytes", CopcText::RootBytes, ~std::uint64_t(31));
  damage("usable", CopcText::Info + 24, std::nan(""));
  damage("usable", CopcText::Info + 32, 0.0);
  damage("usable", CopcText::Info, HUGE_VAL);
  damage("more than once", pages + 16, std::uint64_t(root));     // a circle
  damage("bytes", pages + 16, std::uint64_t(whole.size() + 32)); // beyond the file
  damage("bytes", pages + 24, std::int32_t(-32));
  damage("no part of it", second, std::int32_t(31)); // levels and positions
  damage("no part of it", second, std::int32_t(-1));
  damage("no part of it", second + 4, std::int32_t(2));
  damage("no part of it", second + 8, std::int32_t(-5));
  damage("no such chunk", second + 16, std::uint64_t(5));
  damage("no such chunk", second + 24, std::int32_t(79));
  damage("no such chunk", second + 28, std::int32_t(2));
  damage("no such chunk", second + 28, std::int32_t(-2));
  damage("in no node", second + 28, std::int32_t(0));
  damage("same points", second + 16, valueAt<std::uint64_t>(&whole[root + 16]));
  // A page that has itself.
  const std::size_t page = copc.PageOffsets.rbegin()->second;
  damages.push_back({ "more than once", whole });
  damages.back().Text.replace(page, CopcText::EntryBytes,
    CopcText::entry(copc.PageOffsets.rbegin()->first, page, CopcText::EntryBytes, -1));
  return damages;
}

TEST_F(Copc, DamagedHierarchiesAreNamed)
{
  for (const Damage& damage : damagesOf(randomCopc(400)))
  {
    SCOPED_TRACE(damage.Words);
    const std::string path = this->write(damage.Text);
    PointOptions options;
    options.Region = Box2{ { -1e6, -1e6 }, { 1e6, 1e6 } };
    expectIOError(path, damage.Words, [&] { readPoints(path, options); });
    expectIOError(path, "damaged COPC hierarchy", [&] { readPoints(path, options); });
    expectIOError(path, "convert it to .las", [&] { readPoints(path, options); });
    EXPECT_EQ(400U, readPoints(path).size()); // without the hierarchy
  }
}

TEST_F(Copc, OnlyPagesThatAreNeededAreRead)
{
  CopcText copc = randomCopc(600);
  std::string text = copc.text();
  const auto& [key, offset] = *copc.PageOffsets.rbegin(); // of the largest x
  text.replace(offset, 32, 32, '\xAA');
  const std::string path = this->write(text);
  const CopcInfo info = readCopcInfo(path, readLasHeader(path));
  const CopcNode cube{ key[0], { key[1], key[2], key[3] }, 0, 0 };
  const Box3 box = cube.bounds(info);
  PointOptions options;
  options.Region = Box2{ { 0, 0 }, { box.Min.x - 1, 1e6 } };
  EXPECT_NO_THROW(readPoints(path, options));
  options.Region->Max.x = box.Min.x + 1;
  expectIOError(path, "no part of it", [&] { readPoints(path, options); });
}

/// No mutant of the hierarchy is read outside of the file, or gives points outside of the region.
TEST_F(Copc, MutantsGiveAnErrorOrPointsOfTheRegion)
{
  CopcText copc = randomCopc(200);
  const std::string whole = copc.text();
  PointOptions options;
  options.Region = Box2{ { 1000, 1000 }, { 6000, 6000 } };
  const std::size_t expected = readPoints(this->write(whole), options).size();
  const std::size_t pages = copc.PageOffsets.rbegin()->second;
  Random random(3);
  int refused = 0;
  for (int i = 0; i < 400; ++i)
  {
    std::string text = whole;
    for (int changes = 1 + i % 3; changes > 0; --changes)
    {
      const bool isInfo = random.uniform() < 0.1;
      const std::size_t begin = isInfo ? CopcText::Info : pages;
      const std::size_t size = isInfo ? 160 : whole.size() - pages;
      text[begin + std::size_t(random.uniform() * double(size))] = char(256 * random.uniform());
    }
    const std::string path = this->write(text);
    try
    {
      const PointTable points = readPoints(path, options);
      EXPECT_LE(points.size(), expected);
      for (std::size_t p = 0; p < points.size(); ++p)
      {
        EXPECT_TRUE(options.Region->contains(Point2{ points.XY[2 * p], points.XY[2 * p + 1] }));
      }
    }
    catch (const IOError& error)
    {
      ++refused;
      EXPECT_EQ(0U, std::string(error.what()).find(path)) << error.what();
    }
  }
  EXPECT_GT(refused, 100);
}

} // namespace
