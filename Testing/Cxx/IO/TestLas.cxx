// SPDX-License-Identifier: BSD-3-Clause
#include "ExpectIOError.h"
#include "Files/InputFile.h"
#include "Files/RawValues.h"
#include "Las/LasHeader.h"
#include "Las/LazFile.h"
#include "LasRecords.h"
#include "LasText.h"
#include "LazText.h"
#include "Points/ReadPoints.h"
#include "SharedData.h"
#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <tuple>

namespace
{

using namespace tipp;
using namespace tipp::test;

using Values = std::vector<double>;

const PointTable::Column* columnOf(const PointTable& table, const std::string& name)
{
  for (const PointTable::Column& column : table.Columns)
  {
    if (column.Name == name)
    {
      return &column;
    }
  }
  return nullptr;
}

class Las : public testing::Test
{
protected:
  PointTable read(LasText& las, const LasSelection& selection = {}) const
  {
    PointOptions options;
    options.Las = selection;
    return readPoints(this->Folder.file("a.las", las.text()), options);
  }

  void expectRefusal(LasText& las, const std::string& words) const
  {
    const std::string path = this->Folder.file("bad.las", las.text());
    expectIOError(path, words, [&] { readPoints(path); });
  }

  /// Points of classes 1, 2 and 12, and a point with each flag.
  static LasText classes(int minor, int format)
  {
    LasText las(minor, format);
    las.add(1, 0, 10, 1);
    las.add(2, 0, 20, 2);
    las.add(3, 0, 30, 12);
    las.add(4, 0, 40, 2, 1); // flag 'synthetic'
    las.add(5, 0, 50, 2, 4); // flag 'withheld'
    if (las.isExtended())
    {
      las.add(6, 0, 60, 2, 8);
    }
    return las;
  }

  static Values xs(const PointTable& table)
  {
    Values xs;
    for (std::size_t i = 0; i < table.size(); ++i)
    {
      xs.push_back(std::round(100 * table.XY[2 * i]));
    }
    return xs;
  }

  TemporaryFolder Folder;
};

TEST_F(Las, EveryVersionAndFormatIsRead)
{
  for (int minor = 0; minor <= 5; ++minor)
  {
    for (int format = minor == 5 ? 6 : 0; format <= (minor >= 4      ? 10
                                                        : minor == 3 ? 5
                                                                     : 3);
         ++format)
    {
      LasText las(minor, format);
      las.add(123, -456, 789, 2);
      las.add(std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::min(), 0,
        6, 0, 1, 2);
      const PointTable points = this->read(las);
      const Values xy = { 123 * 0.01 + 0.0, -456 * 0.01 + 100, 2147483647 * 0.01 + 0.0,
        -2147483648.0 * 0.01 + 100 };
      EXPECT_EQ(xy, points.XY) << minor << " " << format;
      EXPECT_EQ((Values{ 789 * 0.01 + 200, 200 }), columnOf(points, "z")->Values);
      EXPECT_EQ((Values{ 2, 6 }), columnOf(points, "classification")->Values);
      EXPECT_EQ((Values{ 70, 70 }), columnOf(points, "intensity")->Values);
      const bool timed = format == 1 || format >= 3;
      ASSERT_EQ(timed, columnOf(points, "gps_time") != nullptr) << format;
      EXPECT_TRUE(!timed || columnOf(points, "gps_time")->Values[0] == 1.5);
      const bool coloured =
        format == 2 || format == 3 || format == 5 || format == 7 || format == 8 || format == 10;
      ASSERT_EQ(coloured, columnOf(points, "blue") != nullptr) << format;
      EXPECT_TRUE(!coloured || columnOf(points, "blue")->Values[1] == 1002) << format;
      ASSERT_EQ(format == 8 || format == 10, columnOf(points, "nir") != nullptr) << format;
    }
  }
}

/// Version 1.0 has a signature of two bytes before the points, and before each record.
TEST_F(Las, PointsFollowTheSignatureOfTheFirstVersion)
{
  LasText las(0, 1);
  las.addBytes("\xdd\xcc");
  las.add(100, 200, 300, 2);
  const PointTable points = this->read(las);
  EXPECT_EQ((Values{ 1, 102 }), points.XY);
  EXPECT_EQ((Values{ 203 }), columnOf(points, "z")->Values);
}

TEST_F(Las, FlagsAreObeyedUnlessTheyAreKept)
{
  LasText old = classes(2, 1);
  EXPECT_EQ((Values{ 1, 2 }), xs(this->read(old)));
  EXPECT_EQ(3, this->read(old).LeftOut);
  LasText recent = classes(4, 6);
  EXPECT_EQ((Values{ 1, 2, 3 }), xs(this->read(recent)));
  LasSelection all;
  all.KeepWithheld = all.KeepSynthetic = all.KeepOverlap = true;
  EXPECT_EQ((Values{ 1, 2, 3, 4, 5 }), xs(this->read(old, all)));
  EXPECT_EQ((Values{ 1, 2, 3, 4, 5, 6 }), xs(this->read(recent, all)));
  EXPECT_EQ(0, this->read(recent, all).LeftOut);
}

TEST_F(Las, ClassesAndReturnsAreSelected)
{
  LasText las = classes(2, 3);
  las.add(7, 0, 0, 9, 0, 1, 2);
  las.add(8, 0, 0, 9, 0, 2, 2);
  LasSelection selection;
  selection.Classes = { 2, 9 };
  EXPECT_EQ((Values{ 2, 7, 8 }), xs(this->read(las, selection)));
  selection.Kind = LasSelection::Returns::First;
  EXPECT_EQ((Values{ 2, 7 }), xs(this->read(las, selection)));
  selection.Kind = LasSelection::Returns::Last;
  EXPECT_EQ((Values{ 2, 8 }), xs(this->read(las, selection)));
  selection.Classes = { 12 };
  EXPECT_EQ((Values{ 3 }), xs(this->read(las, selection)));
}

TEST_F(Las, SeveralFilesAreOneStream)
{
  LasText las(4, 7);
  constexpr int count = 40000;
  for (int i = 0; i < count; ++i)
  {
    las.add(i, 2 * i, 3 * i, i % 3);
  }
  const std::vector<std::string> paths = { this->Folder.file("a.las", las.text()),
    this->Folder.file("b.las", las.text()) };
  PointOptions options;
  options.Las.Classes = { 0, 2 };
  options.Columns = { "z", "red" };
  const PointTable whole = readPoints(paths, options);
  ASSERT_EQ(2U, whole.Columns.size());
  std::size_t at = 0;
  for (int part = 0; part < 5; ++part)
  {
    const PointTable share = readPointsShare(paths, options, part, 5);
    ASSERT_LE(2 * at + share.XY.size(), whole.XY.size());
    EXPECT_TRUE(
      std::equal(share.XY.begin(), share.XY.end(), whole.XY.begin() + std::ptrdiff_t(2 * at)));
    at += share.size();
  }
  EXPECT_EQ(whole.size(), at);
  EXPECT_EQ(2 * count - 2 * 13333, int(at));
}

TEST_F(Las, DamagedHeadersAreRefused)
{
  const auto damaged = [](std::size_t at, auto value)
  {
    LasText las(2, 1);
    las.add(1, 2, 3, 2);
    las.header(at, value);
    return las;
  };
  LasText bad = damaged(0, std::uint32_t(7));
  this->expectRefusal(bad, "is not a LAS file");
  bad = damaged(94, std::uint16_t(20));
  this->expectRefusal(bad, "header of 20 bytes");
  bad = damaged(96, std::uint32_t(4000000000U));
  this->expectRefusal(bad, "no room");
  bad = damaged(105, std::uint16_t(20));
  this->expectRefusal(bad, "20 bytes for a point");
  bad = damaged(131, 0.0);
  this->expectRefusal(bad, "scale or offset of x");
  bad = damaged(163, std::numeric_limits<double>::infinity());
  this->expectRefusal(bad, "scale or offset of y");
  LasText empty(2, 1);
  EXPECT_EQ(0U, this->read(empty).size());
}

TEST_F(Las, UnknownVersionsAndFormatsAreNotCalledDamaged)
{
  for (const auto& [at, value, words] : { std::make_tuple(24, 2, "version 2.2, which is not known"),
         std::make_tuple(25, 6, "version 1.6, which is not known"),
         std::make_tuple(104, 11, "points of format 11, which is not known") })
  {
    LasText las(2, 1);
    las.add(1, 2, 3, 2);
    las.header(std::size_t(at), std::uint8_t(value));
    const std::string path = this->Folder.file("new.las", las.text());
    try
    {
      readPoints(path);
      ADD_FAILURE() << words;
    }
    catch (const IOError& error)
    {
      const std::string text = error.what();
      EXPECT_NE(std::string::npos, text.find(words)) << text;
      EXPECT_EQ(std::string::npos, text.find("copy it again")) << text;
    }
  }
}

TEST_F(Las, FileThatEndsEarlyIsReadOnRequest)
{
  const std::string path = this->Folder.file("cut.las", classes(2, 1).text().substr(0, 300));
  expectIOError(path, "announces 5 points and ends after 2", [&] { readPoints(path); });
  expectIOError(path, "--keep truncated", [&] { readPoints(path); });
  PointOptions options;
  options.Las.keep("truncated");
  const PointTable points = readPoints(path, options);
  EXPECT_EQ((Values{ 1, 2 }), xs(points));
  ASSERT_EQ(1U, points.Reports.size());
  EXPECT_NE(std::string::npos,
    points.Reports[0].Warnings.at(0).find("announces 5 points and ends after 2"));
}

TEST_F(Las, OlderCountHoldsWhereTheLongOneIsZero)
{
  LasText las(4, 1);
  las.add(1, 0, 10, 2);
  las.add(2, 0, 10, 2);
  las.text();
  std::string text = las.text();
  text.replace(247, 8, 8, '\0');
  EXPECT_EQ((Values{ 1, 2 }), xs(readPoints(this->Folder.file("a.las", text))));
}

TEST_F(Las, PointsBeyondTheCountAreReportedAndReadOnRequest)
{
  LasText las(2, 1);
  las.add(1, 0, 10, 2);
  las.add(2, 0, 20, 2);
  las.add(3, 0, 30, 2);
  std::string text = las.text();
  text[107] = 2;
  const std::string path = this->Folder.file("a.las", text);
  const PointTable some = readPoints(path);
  EXPECT_EQ((Values{ 1, 2 }), xs(some));
  ASSERT_EQ(1U, some.Reports.size());
  EXPECT_NE(std::string::npos,
    some.Reports[0].Warnings.at(0).find("announces 2 points and has room for 3"));
  PointOptions options;
  options.Las.keep("uncounted");
  EXPECT_EQ((Values{ 1, 2, 3 }), xs(readPoints(path, options)));
}

/// Waveforms (version 1.3) and extended records (1.4) follow the points.
TEST_F(Las, DataBehindThePointsIsNotTakenForPoints)
{
  for (const int minor : { 3, 4 })
  {
    LasText las(minor, 1);
    las.add(1, 0, 10, 2);
    const std::size_t end = las.text().size();
    las.header(minor == 3 ? 227 : 235, std::uint64_t(end));
    const std::string path = this->Folder.file("a.las", las.text() + std::string(500, 'w'));
    EXPECT_TRUE(readPoints(path).Reports.empty()) << minor;
  }
}

TEST_F(Las, DamagedRecordsOfTheReferenceSystemAreIgnored)
{
  LasText las(2, 0);
  las.addRecord(34735, "x");
  las.addRecord(2112, "");
  las.header(100, std::uint32_t(4000000000U));
  EXPECT_EQ("", readPoints(this->Folder.file("a.las", las.text())).Crs);
}

void expectSame(const PointTable& expected, const PointTable& points)
{
  EXPECT_EQ(expected.XY, points.XY);
  EXPECT_EQ(expected.LeftOut, points.LeftOut);
  ASSERT_EQ(expected.Columns.size(), points.Columns.size());
  for (std::size_t i = 0; i < points.Columns.size(); ++i)
  {
    EXPECT_EQ(expected.Columns[i].Name, points.Columns[i].Name);
    const Values& values = expected.Columns[i].Values;
    // Bytes, since times of made-up points may not be numbers.
    ASSERT_EQ(values.size(), points.Columns[i].Values.size());
    EXPECT_TRUE(values.empty() ||
      std::memcmp(values.data(), points.Columns[i].Values.data(), values.size() * sizeof(double)) ==
        0)
      << points.Columns[i].Name;
  }
}

/// Reads all points or some, with several threads, and a share that begins and ends within a file.
void expectSamePoints(const std::string& plain, const std::string& compressed,
  const std::vector<int>& threads = { 1, 2, 5 })
{
  std::vector<PointOptions> cases(5);
  cases[0].Las = keepAll();
  cases[2].Las = keepAll();
  cases[2].Columns = { "z" };
  cases[3].Las.Classes = { 2, 3, 5, 7, 200 };
  cases[3].Columns = { "classification" };
  cases[4].Las.Kind = LasSelection::Returns::Last;
  cases[4].Las.KeepTruncated = true;
  for (PointOptions& options : cases)
  {
    for (const int count : threads)
    {
      options.Threads = count;
      expectSame(readPoints(plain, options), readPoints(compressed, options));
      expectSame(readPointsShare({ plain, plain }, options, 1, 3),
        readPointsShare({ compressed, compressed }, options, 1, 3));
    }
  }
}

TEST_F(Las, CompressedFilesHaveTheSamePoints)
{
  for (const LazInput& input : lazInputs)
  {
    SCOPED_TRACE(input.Format);
    const LasAndLaz files = filesOf(input);
    expectSamePoints(
      this->Folder.file("a.las", files.Plain), this->Folder.file("a.laz", files.Compressed));
  }
}

/// Decodes a LAZ file to the LAS file of the same points.
std::string decompressed(const std::string& path)
{
  const LasHeader header = readLasHeader(path);
  const InputFile file(path);
  std::string text(std::size_t(header.PointOffset), '\0');
  file.read(0, text.data(), text.size());
  text[104] = char(text[104] & 63);
  if (header.Minor >= 3)
  {
    putAt(text, 227, std::uint64_t(0));
  }
  if (header.Minor >= 4)
  {
    putAt(text, 235, std::uint64_t(0));
  }
  return text + recordsOf(path);
}

TEST_F(Las, RealCompressedFilesHaveTheSamePoints)
{
  TIPP_REQUIRE_DATA(folder, "laz")
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
  {
    if (entry.path().extension() == ".laz")
    {
      SCOPED_TRACE(entry.path());
      expectSamePoints(this->Folder.file("a.las", decompressed(entry.path().string())),
        entry.path().string(), { 2 });
      ++files;
    }
  }
  EXPECT_EQ(13, files);
  expectSamePoints(folder + "/1_4_w_evlr.las", folder + "/1_4_w_evlr.laz");
}

/// Reads a pass of a stream.
PointTable passOf(PointStream& stream)
{
  PointTable table;
  for (const std::string& name : stream.columns())
  {
    table.Columns.push_back({ name, {} });
  }
  forEachBlock(stream, 7, [&](PointBlock& block) { append(block, table); });
  return table;
}

TEST_F(Las, PassesWithoutColumnsHaveTheSamePlacesAndFiniteValues)
{
  for (const LazInput& input : lazInputs)
  {
    SCOPED_TRACE(input.Format);
    PointOptions options;
    options.Las = keepAll();
    const auto stream =
      openPointStream({ this->Folder.file("a.laz", filesOf(input).Compressed) }, options);
    const PointTable all = passOf(*stream);
    ASSERT_GT(all.size(), 0U);
    stream->needColumns(false);
    const PointTable places = passOf(*stream);
    EXPECT_EQ(all.XY, places.XY);
    for (std::size_t c = 0; c < all.Columns.size(); ++c)
    {
      for (std::size_t i = 0; i < all.size(); ++i)
      {
        EXPECT_TRUE(std::isfinite(places.Columns[c].Values.at(i)) ||
          !std::isfinite(all.Columns[c].Values[i]));
      }
    }
    stream->needColumns(true);
    expectSame(all, passOf(*stream));
  }
}

TEST_F(Las, ValuesThatStandForMissingOnesAreReadInEachPass)
{
  PointOptions options;
  options.Las = keepAll();
  const std::string path = this->Folder.file("a.laz", filesOf(lazInputs[6]).Compressed);
  options.NoData = readPoints(path, options).Columns[0].Values[3];
  const auto stream = openPointStream({ path }, options);
  stream->needColumns(false);
  const PointTable table = passOf(*stream);
  EXPECT_TRUE(std::isnan(table.Columns[0].Values.at(3)));
  EXPECT_FALSE(std::isnan(table.Columns[0].Values.at(4)));
}

TEST_F(Las, ChunksAreFoundWithoutTheirTable)
{
  for (const LazInput& input : lazInputs)
  {
    SCOPED_TRACE(input.Format);
    const LasAndLaz files = filesOf(input);
    PointOptions options;
    options.Las = keepAll();
    const PointTable expected = readPoints(this->Folder.file("a.las", files.Plain), options);
    const auto table = valueAt<std::uint64_t>(&files.Compressed[files.PointOffset]);
    const auto read = [&](const std::string& text)
    {
      const PointTable points = readPoints(this->Folder.file("a.laz", text), options);
      expectSame(expected, points);
      return points;
    };
    EXPECT_TRUE(read(files.Compressed).Reports.empty());
    for (const std::uint64_t wrong :
      { std::uint64_t(0), ~std::uint64_t(0), table + 1000, table - 3, std::uint64_t(1) << 63 })
    {
      std::string text = files.Compressed;
      putAt(text, files.PointOffset, wrong);
      const PointTable points = read(text);
      ASSERT_EQ(1U, points.Reports.size()) << wrong;
      EXPECT_NE(std::string::npos, points.Reports[0].Warnings.at(0).find("chunk table"));
    }
    std::string damaged = files.Compressed;
    putAt(damaged, std::size_t(table) + 8, 0x5A5A5A5A);
    EXPECT_EQ(1U, read(damaged).Reports.size());
    // Written to a stream: the offset is behind the table.
    std::string text = files.Compressed + std::string(8, '\0');
    putAt(text, files.PointOffset, ~std::uint64_t(0));
    putAt(text, text.size() - 8, table);
    EXPECT_TRUE(read(text).Reports.empty());
  }
}

TEST_F(Las, DamagedChunksAreNamed)
{
  for (const LazInput& input : lazInputs)
  {
    SCOPED_TRACE(input.Format);
    const LasAndLaz files = filesOf(input);
    PointOptions options;
    options.Las = keepAll();
    const PointTable all = readPoints(this->Folder.file("a.las", files.Plain), options);
    const std::string whole = this->Folder.file("a.laz", files.Compressed);
    const LazFile laz(whole, readLasHeader(whole));
    ASSERT_EQ(3U, laz.chunks().size());
    const LazChunkPlace& second = laz.chunks()[1];
    const std::string path = this->Folder.file(
      "cut.laz", files.Compressed.substr(0, std::size_t(second.Begin + second.Bytes / 2)));
    expectIOError(path, "chunk 2 of 2", [&] { readPoints(path, options); });
    expectIOError(path, "--keep truncated", [&] { readPoints(path, options); });
    options.Las.KeepTruncated = true;
    const PointTable points = readPoints(path, options);
    EXPECT_EQ(Values(all.XY.begin(), all.XY.begin() + 32), points.XY);
    EXPECT_NE(std::string::npos,
      points.Reports.at(0).Warnings.at(0).find(
        "announces 40 points and can be decompressed up to point 16"));
  }
}

TEST_F(Las, CompressedPointsBeyondTheHeadersNumberGiveAWarning)
{
  for (const LazInput& input : lazInputs)
  {
    SCOPED_TRACE(input.Format);
    const LasAndLaz files = filesOf(input);
    // 40 points, 16 a chunk: further chunks, or further points of the last chunk, which only
    // layered ones tell.
    for (const std::size_t count : { 16, 20, 39 })
    {
      std::string text = files.Compressed;
      putCount(text, input.Format, count);
      PointOptions options;
      options.Las = keepAll();
      const PointTable points = readPoints(this->Folder.file("a.laz", text), options);
      EXPECT_EQ(count, points.size());
      if (count < 32 || input.Format >= 6)
      {
        EXPECT_NE(std::string::npos,
          points.Reports.at(0).Warnings.at(0).find("points and has more, which are not read"));
      }
    }
  }
}

TEST_F(Las, TheFirstOfSeveralDamagedChunksIsNamed)
{
  const LasAndLaz files = filesOf(lazInputs[6]);
  const std::string whole = this->Folder.file("a.laz", files.Compressed);
  const LazFile laz(whole, readLasHeader(whole));
  const LazChunkPlace& first = laz.chunks()[0];
  const LazChunkPlace& second = laz.chunks()[1];
  std::string text = files.Compressed;
  const std::size_t layers = laz.format().RecordLength + 4 + 4 * 11; // behind their sizes
  std::fill(text.begin() + std::ptrdiff_t(first.Begin + layers),
    text.begin() + std::ptrdiff_t(first.Begin + first.Bytes), '\xFF');
  const std::size_t sizes = std::size_t(second.Begin) + laz.format().RecordLength + 4;
  putAt(text, sizes, 0xFFFFFFFFU); // of the second chunk's first layer
  const std::string path = this->Folder.file("damaged.laz", text);
  for (const int threads : { 1, 2, 3 })
  {
    PointOptions options;
    options.Threads = threads;
    options.Las = keepAll();
    expectIOError(path, "chunk 1 of 3",
      [&]
      {
        PointBlock block;
        openPointStream({ path }, options)->next(block, 40);
      });
  }
}

TEST_F(Las, UnknownCompressionIsRefused)
{
  const LasAndLaz files = filesOf(lazInputs[1]);
  const std::size_t content = files.PointOffset - textOfDigits(lazInputs[1].Record).size();
  std::string text = files.Compressed;
  text[content + 34 + 4] = 1; // the version of the first item
  const std::string path = this->Folder.file("a.laz", text);
  expectIOError(path, "LASzip 1", [&] { readPoints(path); });
  text = files.Compressed;
  text[content] = 9;
  this->Folder.file("a.laz", text);
  expectIOError(path, "method 9", [&] { readPoints(path); });
  text = files.Compressed;
  text[content - 54 + 2] = 'x'; // the record is none of the compression
  this->Folder.file("a.laz", text);
  expectIOError(path, "damaged record of its compression", [&] { readPoints(path); });
}

TEST_F(Las, RealFileAgreesWithItsText)
{
  TIPP_REQUIRE_DATA(folder, "lidar")
  LasSelection all;
  all.KeepWithheld = all.KeepSynthetic = all.KeepOverlap = true;
  PointOptions options;
  options.Las = all;
  const PointTable points = readPoints(folder + "/autzen_trim.las", options);
  const PointTable text = readPoints(folder + "/autzen_trim.xyz");
  ASSERT_EQ(110000U, points.size());
  for (std::size_t i = 0; i < text.XY.size(); ++i)
  {
    ASSERT_NEAR(text.XY[i], points.XY[i], 1e-8);
  }
  EXPECT_NEAR(text.Columns[0].Values[109999], columnOf(points, "z")->Values[109999], 1e-8);
}

} // namespace
