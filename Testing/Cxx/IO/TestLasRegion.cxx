// SPDX-License-Identifier: BSD-3-Clause
// Points within a region, of LAS and other files, with and without a LASindex.
#include "Las/LasIndex.h"

#include "Arrays/Random.h"
#include "ExpectIOError.h"
#include "Las/LazFile.h"
#include "LasText.h"
#include "LazText.h"
#include "MessageCounter.h"
#include "Points/ReadPoints.h"
#include "RegionTesting.h"
#include "SharedData.h"
#include "TemporaryFolder.h"
#include "vtkTIPPPointReader.h"

#include "vtkNew.h"
#include "vtkPolyData.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

constexpr std::int64_t many = 50000; // several blocks of records

/// Makes a LASindex of points: a quadtree of a few levels, and for each cell its ranges of points.
std::string indexOf(const std::vector<double>& xy, std::uint32_t levels = 3)
{
  std::array<float, 2> low = { float(xy[0]), float(xy[1]) };
  std::array<float, 2> high = low;
  for (std::size_t i = 0; i < xy.size(); ++i)
  {
    low[i % 2] = std::min(low[i % 2], float(xy[i]));
    high[i % 2] = std::max(high[i % 2], float(xy[i]) + 1);
  }
  low[0] += 5; // some points are outside of the root
  std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> cells(
    std::size_t(1) << (2 * levels));
  for (std::size_t i = 0; i < xy.size() / 2; ++i)
  {
    std::size_t cell = 0;
    std::array<float, 2> a = low;
    std::array<float, 2> b = high;
    for (std::uint32_t level = 0; level < levels; ++level)
    {
      cell *= 4;
      for (std::size_t axis = 0; axis < 2; ++axis)
      {
        const float middle = (a[axis] + b[axis]) / 2;
        const bool isLower = xy[2 * i + axis] < double(middle);
        (isLower ? b : a)[axis] = middle;
        cell += isLower ? 0 : axis + 1;
      }
    }
    auto& ranges = cells[cell];
    if (ranges.empty() || ranges.back().second + 1 != i)
    {
      ranges.emplace_back(std::uint32_t(i), std::uint32_t(i));
    }
    ranges.back().second = std::uint32_t(i);
  }
  std::string text;
  const auto put = [&text](auto value)
  { text.append(reinterpret_cast<const char*>(&value), sizeof value); };
  text += "LASX";
  put(std::uint32_t(0));
  text += "LASS";
  put(std::uint32_t(0));
  text += "LASQ";
  put(std::uint32_t(0));
  put(levels);
  put(std::uint32_t(0));
  put(std::uint32_t(0));
  put(low[0]);
  put(high[0]);
  put(low[1]);
  put(high[1]);
  text += "LASV";
  put(std::uint32_t(0));
  put(std::uint32_t(cells.size()));
  const std::uint32_t first =
    ((std::uint32_t(1) << (2 * levels)) - 1) / 3; // cell of the last level
  for (std::uint32_t cell = 0; cell < cells.size(); ++cell)
  {
    put(first + cell);
    put(std::uint32_t(cells[cell].size()));
    put(std::uint32_t(1));
    for (const auto& [begin, end] : cells[cell])
    {
      put(begin);
      put(end);
    }
  }
  return text;
}

class LasRegion : public testing::Test
{
protected:
  /// Makes a file of points along a curve, with its bounds in the header.
  static LasText curve(std::int64_t points, int format = 1)
  {
    LasText las(format < 6 ? 2 : 4, format);
    Random random(5);
    for (std::int64_t i = 0; i < points; ++i)
    {
      las.add(int(i), int(20000 * random.uniform()), int(i % 100), 1 + int(i % 7 == 0));
    }
    putBounds(las, { { 0, 100 }, { 0.01 * double(points), 300 } });
    return las;
  }

  static void putBounds(LasText& las, const Box2& box)
  {
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      las.header(179 + 16 * axis, box.Max[axis]);
      las.header(187 + 16 * axis, box.Min[axis]);
    }
  }

  /// Reads a part of a curve.
  static PointTable readPart(const std::string& path)
  {
    PointOptions options;
    options.Region = Box2{ { 100, 0 }, { 110, 1000 } };
    return readPoints(path, options);
  }

  TemporaryFolder Folder;
};

TEST_F(LasRegion, EqualsFilteringAllPoints)
{
  expectFiltered(this->Folder.file("a.las", curve(many).text()), 8);
  for (const LazInput& input : lazInputs)
  {
    PointOptions options;
    options.Las.KeepWithheld = options.Las.KeepSynthetic = options.Las.KeepOverlap = true;
    const LasAndLaz files = filesOf(input);
    expectFiltered(this->Folder.file("b.las", files.Plain), 10, options);
    expectFiltered(this->Folder.file("b.laz", files.Compressed), 10, options);
  }
}

TEST_F(LasRegion, OfOtherFormatsEqualsFilteringAllPoints)
{
  std::string csv = "x,y,z\n";
  Random random(2);
  for (int i = 0; i < 500; ++i)
  {
    csv += std::to_string(random.uniform()) + "," + std::to_string(random.uniform()) + ",1\n";
  }
  expectFiltered(this->Folder.file("a.csv", csv));
  const PointTable table = readPoints(this->Folder.path("a.csv"));
  std::string npy = "\x93NUMPY\x01";
  std::string dictionary = "{'descr': '<f8', 'fortran_order': False, 'shape': (500, 2), }";
  dictionary.resize(117, ' ');
  npy += std::string("\0\x76\0", 3) + dictionary + "\n";
  npy.append(reinterpret_cast<const char*>(table.XY.data()), sizeof(double) * table.XY.size());
  expectFiltered(this->Folder.file("a.npy", npy));
}

TEST_F(LasRegion, PointsThatClassesLeaveOutAreCountedInTheRegionAlone)
{
  const std::string path = this->Folder.file("a.las", curve(2000).text());
  PointOptions options;
  options.Las.Classes = { 1 };
  options.Region = Box2{ { 0, 0 }, { 6.995, 1000 } }; // points 0 to 699
  const PointTable points = readPoints(path, options);
  EXPECT_EQ(600U, points.size());
  EXPECT_EQ(100, points.LeftOut);
  EXPECT_EQ(100, readPointsShare({ path }, options, 1, 2).LeftOut);
}

TEST_F(LasRegion, AppliesToWrappedLongitudes)
{
  LasText las(2, 1);
  las.add(-17500, 0, 0, 2);
  las.add(17500, 0, 0, 2);
  putBounds(las, { { -175, 100 }, { 175, 100 } });
  PointOptions options;
  options.Wrap = 360;
  options.Region = Box2{ { 180, 0 }, { 190, 200 } };
  EXPECT_EQ((std::vector<double>{ 185, 100 }),
    readPoints(this->Folder.file("a.las", las.text()), options).XY);
}

TEST_F(LasRegion, FilesWhoseBoundsMissItAreNotRead)
{
  LasText far = curve(1000);
  putBounds(far, { { 500, 0 }, { 600, 300 } });
  const std::string near = this->Folder.file("near.las", curve(20000).text());
  PointOptions options;
  options.Region = Box2{ { 100, 0 }, { 110, 1000 } };
  const PointTable points = readPoints({ this->Folder.file("far.las", far.text()), near }, options);
  EXPECT_EQ(2, points.Figures.Files);
  EXPECT_EQ(1, points.Figures.SkippedFiles);
  EXPECT_EQ(1000, points.Figures.SkippedPoints);
  expectSameTable(readPart(near), points);
}

TEST_F(LasRegion, BoundsThatCannotBeRightAreNotUsed)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Box2& wrong :
    { Box2{ { 0, 0 }, { 0, 0 } }, Box2{ { nan, nan }, { nan, nan } }, Box2{ { 0, 0 }, { nan, 1 } },
      Box2{ { 600, 300 }, { 500, 0 } }, Box2{ { -HUGE_VAL, 0 }, { -HUGE_VAL, 0 } } })
  {
    LasText las = curve(20000);
    putBounds(las, wrong);
    const PointTable points = readPart(this->Folder.file("a.las", las.text()));
    EXPECT_EQ(1001U, points.size());
    EXPECT_EQ(0, points.Figures.SkippedFiles);
  }
}

TEST_F(LasRegion, IndexChoosesTheRecordsToRead)
{
  const std::string path = this->Folder.file("a.las", curve(many).text());
  const PointTable all = readPoints(path);
  const PointTable expected = readPart(path);
  EXPECT_EQ(0, expected.Figures.SkippedPoints);
  this->Folder.file("a.lax", indexOf(all.XY));
  const PointTable points = readPart(path);
  expectSameTable(expected, points);
  EXPECT_GT(points.Figures.SkippedPoints, many / 2);
  EXPECT_TRUE(points.Reports.empty());
  expectFiltered(path, 12);
  // Coarser cells, and the name in capitals.
  this->Folder.file("B.LAS", curve(many).text());
  this->Folder.file("B.LAX", indexOf(all.XY, 1));
  expectFiltered(this->Folder.path("B.LAS"), 6);
}

TEST_F(LasRegion, IndexChoosesTheChunksToDecode)
{
  PointOptions options;
  options.Las.KeepWithheld = options.Las.KeepSynthetic = options.Las.KeepOverlap = true;
  std::int64_t skipped = 0;
  for (const LazInput& input : lazInputs)
  {
    const std::string path = this->Folder.file("a.laz", filesOf(input).Compressed);
    this->Folder.file("a.lax", "");
    const PointTable all = readPoints(path, options);
    this->Folder.file("a.lax", indexOf(all.XY, 2));
    expectFiltered(path, 12, options);
    options.Region = Box2::of({ all.XY[0], all.XY[1] });
    skipped += readPoints(path, options).Figures.SkippedChunks;
    options.Region.reset();
  }
  EXPECT_GT(skipped, 0);
}

/// LAStools appends an index as a record after the points, which that of the compression names.
TEST_F(LasRegion, IndexAmongTheRecordsIsUsed)
{
  const PointTable all = readPoints(this->Folder.file("a.las", curve(many).text()));
  const std::string index = indexOf(all.XY);
  std::string header(60, '\0');
  header.replace(2, 8, "LAStools");
  putAt(header, 18, std::uint16_t(30));
  putAt(header, 20, std::uint64_t(index.size()));
  std::string text = curve(many, 6).text();
  putAt(text, 235, std::uint64_t(text.size()));
  putAt(text, 243, std::uint32_t(1));
  const std::string path = this->Folder.file("b.las", text + header + index);
  EXPECT_GT(readPart(path).Figures.SkippedPoints, many / 2);
  expectFiltered(path, 4);

  PointOptions options;
  options.Las.KeepWithheld = options.Las.KeepSynthetic = options.Las.KeepOverlap = true;
  const LasAndLaz files = filesOf(lazInputs[1]);
  const std::string laz = this->Folder.file("c.laz", files.Compressed);
  const std::string small = indexOf(readPoints(laz, options).XY, 2);
  putAt(header, 20, std::uint64_t(small.size()));
  std::string compressed = files.Compressed;
  const std::size_t content = files.PointOffset - textOfDigits(lazInputs[1].Record).size();
  putAt(compressed, content + 16, std::int64_t(1));
  putAt(compressed, content + 24, std::int64_t(compressed.size()));
  this->Folder.file("c.laz", compressed + header + small);
  expectFiltered(laz, 12, options);
  const LasHeader found = readLasHeader(laz);
  EXPECT_EQ(small.size(), found.IndexBytes);
}

TEST_F(LasRegion, DamagedChunksAreNotCountedAsNotNeeded)
{
  const LasAndLaz files = filesOf(lazInputs[1]);
  const std::string path = this->Folder.file("a.laz", files.Compressed);
  const LazChunkPlace last = LazFile(path, readLasHeader(path)).chunks().back();
  this->Folder.file("a.laz", files.Compressed.substr(0, std::size_t(last.Begin) + 30));
  PointOptions options;
  options.Las.KeepTruncated = true;
  options.Region = Box2{ { -HUGE_VAL, -HUGE_VAL }, { HUGE_VAL, HUGE_VAL } };
  const ReadFigures figures = readPoints(path, options).Figures;
  EXPECT_EQ(32, figures.Points);
  EXPECT_EQ(2, figures.Chunks);
  EXPECT_EQ(0, figures.SkippedPoints);
  EXPECT_EQ(0, figures.SkippedChunks);
}

TEST_F(LasRegion, IndexOfAnotherFileIsReportedAndNotUsed)
{
  const std::string path = this->Folder.file("a.las", curve(many).text());
  const PointTable expected = readPart(path);
  const std::vector<double> xy = readPoints(path).XY;
  const std::string index = indexOf(xy);
  const std::size_t cells = 4 + 4 + 8 + 8 + 28; // 'LASV'
  std::vector<std::pair<std::string, std::string>> wrong = {
    { "lacks points", indexOf({ xy.begin(), xy.end() - 200 }) },
    { "is no LASindex", "LASY" + index.substr(4) }, { "ends too early", "" },
    { "ends too early", index.substr(0, index.size() - 3) },
    { "ends too early", index.substr(0, 40) }
  };
  std::vector<double> more = xy;
  more.insert(more.end(), xy.begin(), xy.begin() + 200);
  wrong.emplace_back("of " + std::to_string(many), indexOf(more));
  const auto damage = [&](const std::string& words, std::size_t at, auto value)
  {
    wrong.emplace_back(words, index);
    putAt(wrong.back().second, at, value);
  };
  damage("has a quadtree", 24, std::uint32_t(40)); // levels
  damage("has a quadtree", 36, std::numeric_limits<float>::quiet_NaN());
  damage("its quadtree has not", cells + 12, std::uint32_t(85)); // a cell
  damage("ends too early", cells + 8, ~std::uint32_t(0));        // number of cells
  damage("ends too early", cells + 16, ~std::uint32_t(0));       // ranges
  for (const auto& [words, text] : wrong)
  {
    SCOPED_TRACE(words);
    this->Folder.file("a.lax", text);
    const PointTable points = readPart(path);
    expectSameTable(expected, points);
    ASSERT_EQ(1U, points.Reports.size());
    const std::string& warning = points.Reports[0].Warnings.at(0);
    EXPECT_NE(std::string::npos, warning.find(words)) << warning;
    EXPECT_NE(std::string::npos, warning.find("is not used")) << warning;
  }
}

TEST_F(LasRegion, IndexOlderThanItsFileIsReportedAndNotUsed)
{
  const std::string path = this->Folder.file("a.las", curve(many).text());
  const PointTable expected = readPart(path);
  const std::string index = this->Folder.file("a.lax", indexOf(readPoints(path).XY));
  const auto changed = std::filesystem::last_write_time(path);
  std::filesystem::last_write_time(index, changed - std::chrono::seconds(1));
  const PointTable points = readPart(path);
  expectSameTable(expected, points);
  EXPECT_EQ(0, points.Figures.SkippedPoints);
  ASSERT_EQ(1U, points.Reports.size());
  const std::string& warning = points.Reports[0].Warnings.at(0);
  EXPECT_NE(std::string::npos,
    warning.find(
      "the index " + index + " is older than the file and is not used; make it again or remove it"))
    << warning;
  std::filesystem::last_write_time(index, changed);
  EXPECT_GT(readPart(path).Figures.SkippedPoints, many / 2);
}

TEST_F(LasRegion, MutantsOfAnIndexGivePointsOfTheRegion)
{
  const std::string path = this->Folder.file("a.las", curve(many).text());
  const std::string index = indexOf(readPoints(path).XY, 1);
  const std::size_t expected = readPart(path).size();
  Random random(11);
  for (int i = 0; i < 60; ++i)
  {
    std::string text = index;
    for (int changes = 1 + i % 4; changes > 0; --changes)
    {
      const double most = i % 2 == 0 ? 100 : double(text.size());
      text[std::size_t(random.uniform() * most)] = char(256 * random.uniform());
    }
    this->Folder.file("a.lax", text);
    EXPECT_LE(readPart(path).size(), expected);
  }
}

TEST_F(LasRegion, TheReaderOfVtkReadsItsBounds)
{
  const std::string path = this->Folder.file("a.las", curve(20000).text());
  vtkNew<vtkTIPPPointReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  EXPECT_EQ(20000, reader->GetOutput()->GetNumberOfPoints());
  reader->SetBounds(100, 110, 0, 1000);
  reader->Update();
  EXPECT_EQ(vtkIdType(readPart(path).size()), reader->GetOutput()->GetNumberOfPoints());
  vtkNew<MessageCounter> errors;
  reader->AddObserver(vtkCommand::ErrorEvent, errors);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::array<double, 4>& wrong :
    { std::array<double, 4>{ 100, 110, 1000, 0 }, { nan, 110, 0, 1 }, { 100, 110, 0, nan } })
  {
    errors->Text.clear();
    reader->SetBounds(wrong[0], wrong[1], wrong[2], wrong[3]);
    reader->Update();
    EXPECT_NE(std::string::npos, errors->Text.find("Bounds are no range")) << errors->Text;
  }
}

TEST_F(LasRegion, UncountedPointsMayLieOutsideOfTheHeadersBounds)
{
  LasText las(2, 1);
  las.add(100, 100, 0, 2);
  las.add(90000, 90000, 0, 2);                // at 900, 1000
  putBounds(las, { { 1, 101 }, { 1, 101 } }); // of the first point
  std::string text = las.text();
  putAt(text, 107, std::uint32_t(1));
  const std::string path = this->Folder.file("a.las", text);
  PointOptions options;
  options.Las.KeepUncounted = true;
  options.Region = Box2{ { 800, 900 }, { 1000, 1100 } };
  EXPECT_EQ(1U, readPoints(path, options).size());
}

} // namespace
