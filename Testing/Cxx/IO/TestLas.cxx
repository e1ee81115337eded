// SPDX-License-Identifier: BSD-3-Clause
#include "ExpectIOError.h"
#include "Las/LasHeader.h"
#include "LasText.h"
#include "Points/ReadPoints.h"
#include "SharedData.h"
#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#ifdef TIPP_HAVE_LASZIP
#include <laszip/laszip_api.h>
#endif

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

#ifdef TIPP_HAVE_LASZIP
/// Compresses a .las file to a .laz file with LASzip.
void compress(const std::string& from, const std::string& to)
{
  laszip_POINTER reader = nullptr;
  laszip_POINTER writer = nullptr;
  laszip_BOOL isCompressed = 1;
  laszip_header* header = nullptr;
  laszip_point* point = nullptr;
  ASSERT_EQ(0, laszip_create(&reader) + laszip_create(&writer));
  ASSERT_EQ(0, laszip_open_reader(reader, from.c_str(), &isCompressed));
  ASSERT_EQ(0, laszip_get_header_pointer(reader, &header));
  ASSERT_EQ(0, laszip_get_point_pointer(reader, &point));
  ASSERT_EQ(0, laszip_set_header(writer, header));
  ASSERT_EQ(0, laszip_open_writer(writer, to.c_str(), 1));
  const bool wide = header->point_data_format >= 6;
  const auto count = wide ? std::int64_t(header->extended_number_of_point_records)
                          : std::int64_t(header->number_of_point_records);
  for (std::int64_t i = 0; i < count; ++i)
  {
    ASSERT_EQ(0, laszip_read_point(reader));
    ASSERT_EQ(0, laszip_set_point(writer, point));
    ASSERT_EQ(0, laszip_write_point(writer));
  }
  ASSERT_EQ(0, laszip_close_writer(writer) + laszip_close_reader(reader));
  laszip_destroy(writer);
  laszip_destroy(reader);
}

void expectSame(const PointTable& expected, const PointTable& points)
{
  EXPECT_EQ(expected.XY, points.XY);
  ASSERT_EQ(expected.Columns.size(), points.Columns.size());
  for (std::size_t i = 0; i < points.Columns.size(); ++i)
  {
    EXPECT_EQ(expected.Columns[i].Name, points.Columns[i].Name);
    EXPECT_EQ(expected.Columns[i].Values, points.Columns[i].Values) << points.Columns[i].Name;
  }
}

TEST_F(Las, CompressedFilesHaveTheSamePoints)
{
  for (const int format : { 0, 1, 2, 3, 6, 7, 8 })
  {
    LasText las(format < 6 ? 2 : 4, format);
    for (int i = 0; i < 1000; ++i)
    {
      las.add(7 * i, 3 * i % 101, -i, i % 12, i % 50 == 0 ? 4 : 0, 1 + i % 2, 2);
    }
    const std::string plain = this->Folder.file("a.las", las.text());
    const std::string compressed = this->Folder.path("a.laz");
    compress(plain, compressed);
    PointOptions options;
    expectSame(readPoints(plain), readPoints(compressed));
    options.Las.Classes = { 2, 9 };
    expectSame(readPoints(plain, options), readPoints(compressed, options));
    expectSame(
      readPointsShare({ plain }, options, 1, 3), readPointsShare({ compressed }, options, 1, 3));
  }
}

TEST_F(Las, DamagedCompressedFilesAreRefused)
{
  LasText las(2, 1);
  for (int i = 0; i < 1000; ++i)
  {
    las.add(7919 * i % 1000003, 104729 * i % 999983, -i, 2);
  }
  const std::string path = this->Folder.path("a.laz");
  compress(this->Folder.file("a.las", las.text()), path);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  expectIOError(path, "cannot be decompressed", [&] { readPoints(path); });
}
#else
TEST_F(Las, CompressedFilesNameTheMissingLibrary)
{
  LasText las(2, 1);
  las.header(104, std::uint8_t(128 + 1));
  const std::string path = this->Folder.file("a.laz", las.text());
  expectIOError(path, "'pdal translate a.laz a.las'", [&] { readPoints(path); });
}
#endif

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
