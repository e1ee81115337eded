// SPDX-License-Identifier: BSD-3-Clause
#include "ExpectIOError.h"
#include "Las/LasHeader.h"
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

namespace
{

using namespace tipp;
using namespace tipp::test;

using Values = std::vector<double>;

/// Makes a LAS file in memory, by the specification.
class LasText
{
public:
  LasText(int minor, int format)
    : Format(format)
    , Header(minor >= 4 ? 375
          : minor == 3  ? 235
                        : 227)
  {
    std::memcpy(this->Header.data(), "LASF", 4);
    this->header(24, std::uint8_t(1));
    this->header(25, std::uint8_t(minor));
    this->header(94, std::uint16_t(this->Header.size()));
    this->header(96, std::uint32_t(this->Header.size()));
    this->header(104, std::uint8_t(format));
    this->header(105, std::uint16_t(this->length()));
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      this->header(131 + 8 * axis, 0.01);
      this->header(155 + 8 * axis, 100.0 * double(axis));
    }
  }

  template <typename T>
  void header(std::size_t at, T value)
  {
    std::memcpy(this->Header.data() + at, &value, sizeof(T));
  }

  std::size_t length() const
  {
    constexpr std::size_t lengths[] = { 20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67 };
    return lengths[this->Format] + 3; // each format has three extra bytes
  }
  bool isExtended() const { return this->Format >= 6; }

  void add(int x, int y, int z, int number, int flags = 0, int returnNumber = 1, int returns = 1)
  {
    std::vector<char> record(this->length(), 'e');
    const auto put = [&](std::size_t at, auto value)
    { std::memcpy(record.data() + at, &value, sizeof(value)); };
    put(0, std::int32_t(x));
    put(4, std::int32_t(y));
    put(8, std::int32_t(z));
    put(12, std::uint16_t(70));
    const bool wide = this->isExtended();
    put(14, std::uint8_t(returnNumber | (returns << (wide ? 4 : 3))));
    put(15, std::uint8_t(wide ? flags : number | (flags << 5)));
    wide ? put(16, std::uint8_t(number)) : void();
    const std::size_t basics = wide ? 22 : 20;
    const bool timed = this->Format == 1 || this->Format >= 3;
    timed ? put(basics, 1.5) : void();
    const std::size_t colour = basics + (timed ? 8 : 0);
    for (std::size_t i = 0; i < 4 && colour + 2 * i + 2 <= record.size(); ++i)
    {
      put(colour + 2 * i, std::uint16_t(1000 + i));
    }
    this->Records.append(record.data(), record.size());
    ++this->Count;
  }

  std::string text()
  {
    this->header(107, std::uint32_t(this->isExtended() ? 0 : this->Count));
    if (this->Header.size() == 375)
    {
      this->header(247, std::uint64_t(this->Count));
    }
    return std::string(this->Header.data(), this->Header.size()) + this->Between + this->Records;
  }

  /// Adds a variable length record before the points.
  void addRecord(int id, const std::string& content)
  {
    std::string record(54, '\0');
    record.replace(2, 15, "LASF_Projection");
    record[18] = char(id & 255);
    record[19] = char(id >> 8);
    record[20] = char(content.size() & 255);
    record[21] = char(content.size() >> 8);
    this->addBytes(record + content);
    this->header(100, ++this->RecordCount);
  }

  /// Adds bytes before the points.
  void addBytes(const std::string& bytes)
  {
    this->Between += bytes;
    this->header(96, std::uint32_t(this->Header.size() + this->Between.size()));
  }

private:
  int Format;
  std::vector<char> Header;
  std::string Between;
  std::string Records;
  std::uint32_t RecordCount = 0;
  std::size_t Count = 0;
};

/// A GeoTIFF key directory with these keys and values.
std::string keysOf(const std::vector<std::pair<int, int>>& keys)
{
  std::vector<std::uint16_t> numbers = { 1, 1, 0, std::uint16_t(keys.size()) };
  for (const auto& [key, value] : keys)
  {
    numbers.insert(numbers.end(), { std::uint16_t(key), 0, 1, std::uint16_t(value) });
  }
  return { reinterpret_cast<const char*>(numbers.data()), 2 * numbers.size() };
}

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
    las.isExtended() ? las.add(6, 0, 60, 2, 8) : void();
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
  for (int minor = 0; minor <= 4; ++minor)
  {
    for (int format = 0; format <= (minor == 4 ? 10 : minor == 3 ? 5 : 3); ++format)
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

TEST_F(Las, ReferenceSystemIsRead)
{
  LasText keys(2, 0);
  keys.addRecord(34735, keysOf({ { 1024, 1 }, { 3072, 26910 }, { 4096, 5703 } }));
  EXPECT_EQ("EPSG:26910+5703", readLasHeader(this->Folder.file("k.las", keys.text())).Crs);
  LasText own(2, 0);
  own.addRecord(34735, keysOf({ { 3072, 32767 }, { 2048, 4269 } }));
  const LasHeader unknown = readLasHeader(this->Folder.file("o.las", own.text()));
  EXPECT_EQ("", unknown.Crs);
  EXPECT_TRUE(unknown.HasUnknownCrs);
  LasText wkt(4, 6);
  wkt.addRecord(2112, std::string("LOCAL_CS[\"here\"]") + '\0');
  EXPECT_EQ("LOCAL_CS[\"here\"]", readLasHeader(this->Folder.file("w.las", wkt.text())).Crs);
  EXPECT_EQ("", readLasHeader(this->Folder.file("n.las", LasText(1, 1).text())).Crs);
}

TEST_F(Las, FilesOfDifferentReferenceSystemsAreNotMixed)
{
  LasText one(2, 0);
  one.addRecord(34735, keysOf({ { 3072, 26910 } }));
  LasText two(2, 0);
  two.addRecord(34735, keysOf({ { 3072, 26911 } }));
  const std::string path = this->Folder.file("two.las", two.text());
  const std::vector<std::string> paths = { this->Folder.file("one.las", one.text()), path };
  expectIOError(path, "another coordinate reference system", [&] { openPointStream(paths); });
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
  bad = damaged(24, std::uint8_t(2));
  this->expectRefusal(bad, "version 2.2");
  bad = damaged(94, std::uint16_t(20));
  this->expectRefusal(bad, "header of 20 bytes");
  bad = damaged(96, std::uint32_t(4000000000U));
  this->expectRefusal(bad, "no room");
  bad = damaged(104, std::uint8_t(11));
  this->expectRefusal(bad, "format 11");
  bad = damaged(105, std::uint16_t(20));
  this->expectRefusal(bad, "20 bytes for a point");
  bad = damaged(131, 0.0);
  this->expectRefusal(bad, "scale or offset of x");
  bad = damaged(163, std::numeric_limits<double>::infinity());
  this->expectRefusal(bad, "scale or offset of y");
  LasText empty(2, 1);
  const std::string path = this->Folder.file("cut.las", classes(2, 1).text().substr(0, 300));
  expectIOError(path, "announces 5 points and has room for 2", [&] { readPoints(path); });
  EXPECT_EQ(0U, this->read(empty).size());
}

TEST_F(Las, DamagedRecordsOfTheReferenceSystemAreIgnored)
{
  LasText las(2, 0);
  las.addRecord(34735, "x");
  las.addRecord(2112, "");
  las.header(100, std::uint32_t(4000000000U));
  EXPECT_EQ("", readLasHeader(this->Folder.file("a.las", las.text())).Crs);
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
  expectIOError(path, "install liblaszip-dev", [&] { readPoints(path); });
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
