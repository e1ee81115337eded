// SPDX-License-Identifier: BSD-3-Clause
#include "ExpectIOError.h"
#include "Files/RawValues.h"
#include "Las/LasHeader.h"
#include "Las/LasWriter.h"
#include "Las/WriteLas.h"
#include "LasRecords.h"
#include "LasText.h"
#include "LazText.h"
#include "SharedData.h"
#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <random>

namespace
{

using namespace tipp;
using namespace tipp::test;

using Values = std::vector<double>;

class LasWriting : public testing::Test
{
protected:
  std::string path(const std::string& name) const { return this->Folder.path(name); }

  /// Copies all points of files to "out.laz" or another file.
  LasReport copy(const std::vector<std::string>& inputs, const std::string& output = "out.laz",
    const std::vector<double>& scale = {}) const
  {
    PointOptions reading;
    reading.Las = keepAll();
    return copyToLas(inputs, reading, this->path(output), { "TIPP test", scale, 2 });
  }

  LasReport write(PointTable table, const std::string& output = "out.las") const
  {
    return writeLas(*streamTable(std::move(table)), this->path(output), { "TIPP test" });
  }

  LasHeader header(const std::string& name) const { return readLasHeader(this->path(name)); }

  /// Writes records with bytes of many values, and returns them.
  std::string writeRecords(const std::string& name, int format, std::size_t extraBytes,
    std::size_t count, int threads = 2) const
  {
    LasLayout layout;
    layout.Format = format;
    layout.ExtraBytes = extraBytes;
    LasWriter writer(this->path(name), layout, threads);
    const std::size_t length = writer.recordLength();
    std::string records(count * length, '\0');
    std::mt19937 random(8);
    for (std::size_t i = 0; i < records.size(); ++i)
    {
      const bool isSame = i >= length && random() % 4 != 0;
      records[i] = isSame ? records[i - length] : char(random() % 7);
    }
    for (std::size_t done = 0; done < count;)
    {
      std::uint8_t* to = nullptr;
      const std::size_t some = writer.makeRoom(std::min<std::size_t>(count - done, 30001), to);
      std::memcpy(to, &records[done * length], some * length);
      writer.add(some);
      done += some;
    }
    writer.close();
    return records;
  }

  TemporaryFolder Folder;
};

const Values& readValues(const PointTable& table, const std::string& name)
{
  for (const PointTable::Column& column : table.Columns)
  {
    if (column.Name == name)
    {
      return column.Values;
    }
  }
  throw std::runtime_error("no column " + name);
}

TEST_F(LasWriting, RecordsComeBackAtTheBordersOfChunks)
{
  for (const std::size_t count : { 0, 1, 2, 49999, 50000, 50001, 100001 })
  {
    for (const char* const name : { "a.las", "a.laz" })
    {
      const std::string records = this->writeRecords(name, 7, 3, count);
      EXPECT_TRUE(recordsOf(this->path(name)) == records) << name << ' ' << count;
      EXPECT_EQ(
        readPoints(this->path(name)).LeftOut + std::int64_t(readPoints(this->path(name)).size()),
        std::int64_t(count));
    }
  }
}

TEST_F(LasWriting, RecordsOfEachFormatComeBack)
{
  for (int format = 6; format <= 8; ++format)
  {
    for (const std::size_t extraBytes : { 0, 1, 9 })
    {
      const std::string records = this->writeRecords("a.laz", format, extraBytes, 3000);
      EXPECT_TRUE(recordsOf(this->path("a.laz")) == records) << format << ' ' << extraBytes;
    }
  }
}

TEST_F(LasWriting, BytesDoNotDependOnThreads)
{
  this->writeRecords("one.laz", 8, 2, 210000, 1);
  const std::string one = contentOf(this->path("one.laz"));
  for (const int threads : { 2, 3, 7 })
  {
    this->writeRecords("more.laz", 8, 2, 210000, threads);
    EXPECT_TRUE(contentOf(this->path("more.laz")) == one) << threads;
  }
}

/// Of long records, one thread compresses one chunk after the other.
TEST_F(LasWriting, BytesOfLongRecordsDoNotDependOnThreads)
{
  const auto contentWith = [this](int threads)
  {
    LasLayout layout;
    layout.ExtraBytes = 1100;
    LasWriter writer(this->path("a.laz"), layout, threads);
    for (std::size_t i = 0; i < LazFormat::UsualChunkPoints + 1; ++i)
    {
      std::uint8_t* record = nullptr;
      EXPECT_EQ(writer.makeRoom(1, record), 1U);
      std::memset(record, 0, writer.recordLength());
      setValue(record, std::int32_t(i));
      setValue(record + 1000, std::uint8_t(i % 5));
      writer.add(1);
    }
    writer.close();
    return contentOf(this->path("a.laz"));
  };
  EXPECT_TRUE(contentWith(1) == contentWith(3));
}

TEST_F(LasWriting, HeaderHasBoxAndCounts)
{
  LasText las(4, 6);
  las.add(100, -200, 300, 2, 0, 1, 2);
  las.add(150, -250, 310, 2, 0, 2, 2);
  las.add(120, -210, 290, 2, 0, 15, 15);
  const LasReport report = this->copy({ this->Folder.file("a.las", las.text()) });
  EXPECT_EQ(report.Points, 3);
  const std::string text = contentOf(this->path("out.laz"));
  const auto number = [&](std::size_t at) { return valueAt<double>(&text[at]); };
  EXPECT_EQ(number(179), 1.5);
  EXPECT_EQ(number(187), 1);
  EXPECT_EQ(number(195), -200 * 0.01 + 100);
  EXPECT_EQ(number(203), -250 * 0.01 + 100);
  EXPECT_EQ(number(211), 310 * 0.01 + 200);
  EXPECT_EQ(number(219), 290 * 0.01 + 200);
  const auto count = [&](std::size_t at) { return valueAt<std::uint64_t>(&text[at]); };
  EXPECT_EQ(count(247), 3U);
  EXPECT_EQ(count(255), 1U);
  EXPECT_EQ(count(263), 1U);
  EXPECT_EQ(count(255 + 14 * 8), 1U);
  EXPECT_EQ(text.substr(58, 9), "TIPP test");
  EXPECT_EQ(valueAt<std::uint16_t>(&text[6]) & 16, 16); // the system is WKT
}

/// Records of formats 6 to 8 stay to the bit, in both kinds of files.
TEST_F(LasWriting, ExtendedRecordsStayAsTheyAre)
{
  for (const LazInput& input : lazInputs)
  {
    if (input.Format < 6 || input.Format > 8)
    {
      continue;
    }
    const std::string source = this->Folder.file("a.laz", filesOf(input).Compressed);
    for (const char* const output : { "out.las", "out.laz" })
    {
      const LasReport report = this->copy({ source }, output);
      EXPECT_EQ(report.Format, input.Format);
      EXPECT_TRUE(report.Warnings.empty());
      EXPECT_TRUE(recordsOf(this->path(output)) == recordsOf(source)) << input.Format;
    }
  }
}

TEST_F(LasWriting, OldRecordsBecomeExtended)
{
  for (int format = 0; format <= 5; ++format)
  {
    LasText las(3, format);
    las.add(1, 2, 3, 2, 5, 3, 4); // flags synthetic and withheld
    las.add(4, 5, 6, 12, 2, 1, 1);
    std::string text = las.text();
    const std::size_t first = text.size() - 2 * las.length();
    text[first + 14] = char(text[first + 14] | 0xC0); // direction and edge
    text[first + 16] = char(-7);                      // scan angle
    text[first + 17] = 'u';
    putAt(text, first + 18, std::uint16_t(777));
    const LasReport report = this->copy({ this->Folder.file("a.las", text) });
    const bool hasColour = format == 2 || format == 3 || format == 5;
    EXPECT_EQ(report.Format, hasColour ? 7 : 6);
    const std::string records = recordsOf(this->path("out.laz"));
    const std::size_t length = (hasColour ? 36U : 30U) + 3;
    ASSERT_EQ(records.size(), 2 * length);
    EXPECT_EQ(records.substr(0, 14), text.substr(first, 14));
    EXPECT_EQ(std::uint8_t(records[14]), 3 + 16 * 4);
    EXPECT_EQ(std::uint8_t(records[15]), 0xC5);
    EXPECT_EQ(records[16], 2);
    EXPECT_EQ(records[17], 'u');
    EXPECT_EQ(valueAt<std::int16_t>(&records[18]), -1167); // 7 / 0.006, rounded
    EXPECT_EQ(valueAt<std::uint16_t>(&records[20]), 777);
    EXPECT_EQ(valueAt<double>(&records[22]), format == 0 || format == 2 ? 0 : 1.5);
    EXPECT_EQ(hasColour ? valueAt<std::uint16_t>(&records[32]) : 1001, 1001);
    EXPECT_EQ(records.substr(length - 3, 3), text.substr(first + las.length() - 3, 3));
    EXPECT_EQ(std::uint8_t(records[length + 15]), 2 + 8); // key point and overlap
    EXPECT_EQ(records[length + 16], 1);
    EXPECT_NE(report.Warnings.back().find("rounded to 0.006 degrees"), std::string::npos);
    EXPECT_EQ(report.Warnings.size(), format >= 4 ? 2U : 1U); // wave packets
  }
}

TEST_F(LasWriting, RealFilesKeepTheirPoints)
{
  TIPP_REQUIRE_DATA(folder, "laz")
  PointOptions options;
  options.Las = keepAll();
  for (const auto& entry : std::filesystem::directory_iterator(folder))
  {
    const std::string path = entry.path().string();
    const LasHeader from = readLasHeader(path);
    if (from.Points == 0)
    {
      continue;
    }
    SCOPED_TRACE(path);
    this->copy({ path });
    const PointTable expected = readPoints(path, options);
    const PointTable points = readPoints(this->path("out.laz"), options);
    EXPECT_TRUE(points.XY == expected.XY);
    for (const PointTable::Column& column : expected.Columns)
    {
      if (column.Name != "classification" || from.isExtended())
      {
        EXPECT_TRUE(readValues(points, column.Name) == column.Values) << column.Name;
      }
    }
    const LasHeader to = this->header("out.laz");
    EXPECT_EQ(to.Scale, from.Scale);
    EXPECT_EQ(to.Offset, from.Offset);
    EXPECT_EQ(to.Encoding & 1, from.Encoding & 1);
    EXPECT_TRUE(areSameCrs(understandCrs(to.Crs).Text, understandCrs(from.Crs).Text));
    if (from.isExtended() && !from.hasWaves())
    {
      EXPECT_TRUE(recordsOf(this->path("out.laz")) == recordsOf(path));
    }
    for (std::size_t i = 0; i < to.Extras.size(); ++i)
    {
      EXPECT_EQ(to.Extras[i].key(), from.Extras[i].key());
    }
    EXPECT_EQ(to.Extras.size(), from.Extras.size());
  }
}

/// A description of extra bytes: their type and name.
std::string descriptorOf(int type, const std::string& name)
{
  std::string descriptor(LasExtra::DescriptorSize, '\0');
  descriptor[2] = char(type);
  descriptor.replace(4, name.size(), name);
  return descriptor;
}

/// A file of a point with three extra bytes, "eee", of which descriptions tell.
LasText withExtras(const std::string& descriptors)
{
  LasText las(4, 6);
  std::string record(54, '\0');
  record.replace(2, 9, "LASF_Spec");
  record[18] = 4;
  putAt(record, 20, std::uint16_t(descriptors.size()));
  las.addBytes(record + descriptors);
  las.header(100, std::uint32_t(1));
  las.add(1, 2, 3, 2);
  return las;
}

TEST_F(LasWriting, ExtraBytesThatAllFilesHaveStay)
{
  const std::string a = this->Folder.file(
    "a.las", withExtras(descriptorOf(1, "amplitude") + descriptorOf(3, "width")).text());
  const std::string b = this->Folder.file(
    "b.las", withExtras(descriptorOf(3, "width") + descriptorOf(1, "quality")).text());
  EXPECT_TRUE(this->copy({ a, a }).Warnings.empty());
  ASSERT_EQ(this->header("out.laz").Extras.size(), 2U);
  EXPECT_EQ(this->header("out.laz").Extras[0].name(), "amplitude");
  const LasReport report = this->copy({ a, b });
  ASSERT_EQ(this->header("out.laz").Extras.size(), 1U);
  EXPECT_EQ(this->header("out.laz").Extras[0].name(), "width");
  const std::string records = recordsOf(this->path("out.laz"));
  EXPECT_EQ(records.substr(30, 2), contentOf(a).substr(contentOf(a).size() - 2));
  EXPECT_EQ(records.substr(62, 2), contentOf(b).substr(contentOf(b).size() - 3, 2));
  ASSERT_EQ(report.Warnings.size(), 2U);
  EXPECT_NE(report.Warnings[0].find("'amplitude'"), std::string::npos);
  EXPECT_NE(report.Warnings[1].find("'quality'"), std::string::npos);
}

/// Bytes of a file are data: whatever they are, points are copied, or one sentence tells why not.
TEST_F(LasWriting, SurvivesMutants)
{
  constexpr int mutants = 300;
  std::vector<std::string> inputs = { withExtras(descriptorOf(9, "width")).text() };
  for (const LazInput& input : lazInputs)
  {
    inputs.push_back(filesOf(input).Plain);
    inputs.push_back(filesOf(input).Compressed);
  }
  std::mt19937 random(12);
  int copied = 0;
  for (int i = 0; i < mutants; ++i)
  {
    std::string mutant = inputs[random() % inputs.size()];
    for (unsigned changes = random() % 4 + 1; changes > 0; --changes)
    {
      const std::size_t end =
        random() % 4 == 0 ? mutant.size() : std::min<std::size_t>(700, mutant.size());
      mutant[random() % end] = char(random());
    }
    PointOptions reading;
    reading.Las = keepAll();
    reading.Las.KeepTruncated = i % 2 == 0;
    const std::string path = this->Folder.file(i % 3 == 0 ? "a.las" : "a.laz", mutant);
    try
    {
      copyToLas({ path, path }, reading, this->path("out.laz"), { "" });
      ++copied;
    }
    catch (const IOError& error)
    {
      EXPECT_EQ(std::string::npos, std::string(error.what()).find('\n'));
    }
  }
  EXPECT_GT(copied, mutants / 20);
}

TEST_F(LasWriting, FilesOfDifferentFormatsAreJoined)
{
  LasText plain(4, 6);
  plain.add(1, 1, 1, 2);
  LasText coloured(4, 8);
  coloured.add(2, 2, 2, 2);
  const LasReport report = this->copy(
    { this->Folder.file("a.las", plain.text()), this->Folder.file("b.las", coloured.text()) });
  EXPECT_EQ(report.Format, 8);
  const PointTable points = readPoints(this->path("out.laz"));
  EXPECT_EQ(readValues(points, "red"), (Values{ 0, 1000 }));
  EXPECT_EQ(readValues(points, "nir"), (Values{ 0, 1003 }));
}

TEST_F(LasWriting, FinestScaleOfFilesIsTaken)
{
  LasText coarse(4, 6);
  coarse.add(1, 1, 1, 2);
  LasText fine(4, 6);
  fine.header(131, 0.001);
  fine.header(155, 0.0005);
  fine.add(1234, 1, 1, 2);
  const std::string a = this->Folder.file("a.las", coarse.text());
  const LasReport report = this->copy({ a, this->Folder.file("b.las", fine.text()) });
  EXPECT_EQ(report.Transform.Scale[0], 0.001);
  EXPECT_EQ(report.Transform.Scale[1], 0.01);
  const PointTable points = readPoints(this->path("out.laz"));
  EXPECT_NEAR(points.XY[0], 0.01, 1e-12);
  EXPECT_NEAR(points.XY[2], 1.2345, 0.0005 + 1e-12);
  ASSERT_EQ(report.Warnings.size(), 1U);
  EXPECT_NE(report.Warnings[0].find("0.001, 0.01 and 0.01"), std::string::npos);
}

TEST_F(LasWriting, OffsetsThatDifferByWholeStepsLoseNothing)
{
  LasText moved(4, 6);
  moved.header(155, 1e9); // too far for 32 bits
  moved.add(7, 1, 1, 2);
  LasText near(4, 6);
  near.header(155, 1e9 - 1000);
  near.add(7, 1, 1, 2);
  const LasReport report = this->copy(
    { this->Folder.file("a.las", near.text()), this->Folder.file("b.las", moved.text()) });
  EXPECT_TRUE(report.Warnings.empty());
  EXPECT_EQ(readPoints(this->path("out.laz")).XY[2], 7 * 0.01 + 1e9);
}

TEST_F(LasWriting, RangeTooWideForTheScaleNamesAnother)
{
  LasText far(4, 6);
  far.header(155, 1e9);
  far.add(7, 1, 1, 2);
  LasText near(4, 6);
  near.add(7, 1, 1, 2);
  const std::string a = this->Folder.file("a.las", near.text());
  const std::string b = this->Folder.file("b.las", far.text());
  expectIOError(this->path("out.laz"), "--scale 1.", [&] { this->copy({ a, b }); });
  EXPECT_EQ(this->Folder.fileCount(), 2U);
  EXPECT_EQ(this->copy({ a, b }, "out.laz", { 1 }).Transform.Scale[0], 1);
}

TEST_F(LasWriting, CoordinatesAreMultiplesOfAGivenScale)
{
  LasText las(4, 6);
  las.header(155, 0.123);
  las.add(0, 0, 0, 2);
  las.add(6100, 1234, 77, 2);
  const std::string moved = this->Folder.file("a.las", las.text());
  // The offset 0 is too far for 32 bits.
  const std::string far = this->Folder.file("b.csv", "x,y\n1000000,1000001\n1000002,1000007\n");
  const auto expectMultiples = [this](const std::string& path, double scale)
  {
    const LasReport report = this->copy({ path }, "out.las", { scale });
    EXPECT_EQ(report.Transform.Scale[0], scale);
    for (const double coordinate : readPoints(this->path("out.las")).XY)
    {
      EXPECT_NEAR(coordinate / scale, std::nearbyint(coordinate / scale), 1e-5) << scale;
    }
    return report.Transform.Offset;
  };
  EXPECT_EQ(expectMultiples(moved, 1), (std::array<double, 3>{ 0, 100, 200 }));
  expectMultiples(moved, 0.3);
  expectMultiples(moved, 1000);
  expectMultiples(far, 3e-4);
}

TEST_F(LasWriting, DecimalsOfCoordinatesGiveTheScale)
{
  const auto scaleOf = [this](const Values& x)
  {
    PointTable table;
    for (const double value : x)
    {
      table.XY.insert(table.XY.end(), { value, 4 });
    }
    const LasReport report = this->write(table);
    const PointTable points = readPoints(this->path("out.las"));
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      EXPECT_NEAR(points.XY[2 * i], x[i], report.Transform.Scale[0] / 2 + 1e-9);
    }
    return std::make_pair(report.Transform.Scale[0], report.Warnings.size());
  };
  EXPECT_EQ(scaleOf({ 1, 2, 3 }), std::make_pair(1.0, std::size_t(0)));
  EXPECT_EQ(scaleOf({ 500000.125, 500001.5 }), std::make_pair(0.001, std::size_t(0)));
  EXPECT_EQ(scaleOf({ 5400000.12, 5400100.1 }), std::make_pair(0.01, std::size_t(0)));
  EXPECT_EQ(scaleOf({ -179.1234567, 179.5 }), std::make_pair(1e-7, std::size_t(0)));
  EXPECT_EQ(scaleOf({ 1.0 / 3, 2.0 / 3 }), std::make_pair(1e-10, std::size_t(1)));
  EXPECT_EQ(scaleOf({ 0, 2e9 }), std::make_pair(1.0, std::size_t(0)));
  // Nobody wants whole units to be rounded, as an outlier would make it.
  EXPECT_THROW(scaleOf({ 0, 1e12 }), IOError);
}

TEST_F(LasWriting, ColumnsBecomeFieldsIfTheyFit)
{
  PointTable table;
  table.XY = { 0, 0, 1, 1 };
  table.Columns = { { "z", { 5, 6 } }, { "intensity", { 0, 65535 } },
    { "classification", { 2, 2.5 } }, { "red", { 1, 2 } }, { "green", { 3, 4 } },
    { "blue", { 5, 6 } }, { "velocity", { -0.1, std::nan("") } } };
  const LasReport report = this->write(table);
  EXPECT_EQ(report.Format, 7);
  const PointTable points = readPoints(this->path("out.las"));
  EXPECT_EQ(readValues(points, "z"), (Values{ 5, 6 }));
  EXPECT_EQ(readValues(points, "intensity"), (Values{ 0, 65535 }));
  EXPECT_EQ(readValues(points, "classification"), (Values{ 0, 0 }));
  EXPECT_EQ(readValues(points, "green"), (Values{ 3, 4 }));
  const LasHeader header = this->header("out.las");
  ASSERT_EQ(header.Extras.size(), 2U);
  // Programs would take an extra attribute of this name for the field.
  EXPECT_EQ(header.Extras[0].name(), "classification_column");
  EXPECT_EQ(header.Extras[1].name(), "velocity");
  ASSERT_FALSE(report.Warnings.empty());
  EXPECT_NE(report.Warnings[0].find("column classification does not fit"), std::string::npos);
  const std::string records = recordsOf(this->path("out.las"));
  EXPECT_EQ(valueAt<double>(&records[36 + 16 + 36]), 2.5);
  EXPECT_EQ(valueAt<double>(&records[36 + 8]), -0.1);
  EXPECT_TRUE(std::isnan(valueAt<double>(&records[52 + 36 + 8])));
}

TEST_F(LasWriting, ColumnsThatEqualTheHeightsStay)
{
  PointTable table;
  table.XY = { 0, 0, 1, 1 };
  table.Columns = { { "elevation", { 5, 5 } }, { "z", { 5, 5 } }, { "intensity", { 5, 5 } },
    { "quality", { 5, 5 } } };
  this->write(table);
  const PointTable points = readPoints(this->path("out.las"));
  EXPECT_EQ(readValues(points, "z"), (Values{ 5, 5 }));
  EXPECT_EQ(readValues(points, "intensity"), (Values{ 5, 5 }));
  const LasHeader header = this->header("out.las");
  ASSERT_EQ(header.Extras.size(), 2U);
  EXPECT_EQ(header.Extras[0].name(), "elevation");
  EXPECT_EQ(header.Extras[1].name(), "quality");
  const std::string records = recordsOf(this->path("out.las"));
  EXPECT_EQ(valueAt<double>(&records[30]), 5);
  EXPECT_EQ(valueAt<double>(&records[38]), 5);
}

/// LasFields has names of its own, which mean nothing in other files.
TEST_F(LasWriting, ColumnsNamedAsStoredBitsBecomeExtraBytes)
{
  const std::string path =
    this->Folder.file("a.csv", "x,y,z,las:flags,las:returns\n1,2,3,4,33\n4,5,6,4,7\n");
  PointOptions reading;
  reading.NoData = 7;
  copyToLas({ path }, reading, this->path("out.las"), { "" });
  EXPECT_EQ(readPoints(this->path("out.las")).size(), 2U); // none is withheld
  const LasHeader header = this->header("out.las");
  ASSERT_EQ(header.Extras.size(), 2U);
  EXPECT_EQ(header.Extras[0].name(), "las:flags");
  EXPECT_EQ(header.Extras[1].name(), "las:returns");
  const std::string records = recordsOf(this->path("out.las"));
  EXPECT_EQ(records[14], 0x11);
  EXPECT_EQ(records[15], 0);
  EXPECT_EQ(valueAt<double>(&records[30]), 4);
  EXPECT_EQ(valueAt<double>(&records[38]), 33);
  EXPECT_TRUE(std::isnan(valueAt<double>(&records[46 + 38])));
}

TEST_F(LasWriting, ColumnsOfOneLongNameAreRefused)
{
  const std::string name(32, 'n');
  PointTable table;
  table.XY = { 0, 0 };
  table.Columns = { { name + "a", { 1 } }, { name + "b", { 2 } } };
  expectIOError(this->path("out.las"), "rename one", [&] { this->write(table); });
}

TEST_F(LasWriting, PointsThatAreNotFiniteAreCounted)
{
  PointTable table;
  table.XY = { 0, 0, std::nan(""), 1, 2, 2 };
  table.Columns = { { "z", { 1, 2, std::numeric_limits<double>::infinity() } } };
  const LasReport report = this->write(table);
  EXPECT_EQ(report.Points, 1);
  EXPECT_EQ(report.NotFinite, 2);
  EXPECT_EQ(this->header("out.las").Points, 1);
}

TEST_F(LasWriting, NothingIsWrittenWithoutPoints)
{
  expectIOError(this->path("out.las"), "no points", [&] { this->write({}); });
  EXPECT_EQ(this->Folder.fileCount(), 0U);
}

TEST_F(LasWriting, TimesOfDifferentKindsAreRefused)
{
  LasText week(4, 6);
  week.add(1, 1, 1, 2);
  LasText standard(4, 6);
  standard.header(6, std::uint16_t(1));
  standard.add(1, 1, 1, 2);
  const std::string a = this->Folder.file("a.las", week.text());
  const std::string b = this->Folder.file("b.las", standard.text());
  this->copy({ b });
  EXPECT_EQ(this->header("out.laz").Encoding & 1, 1);
  expectIOError(b, "GPS times of another kind", [&] { this->copy({ a, b }); });
}

TEST_F(LasWriting, MissingValuesOfFieldsStay)
{
  LasText las(4, 6);
  las.add(1, 1, 1, 2);
  PointOptions reading;
  reading.NoData = 70; // the intensity of LasText
  const std::string path = this->Folder.file("a.las", las.text());
  copyToLas({ path }, reading, this->path("out.laz"), { "" });
  EXPECT_TRUE(recordsOf(this->path("out.laz")) == recordsOf(path));
}

TEST_F(LasWriting, MissingTimesStay)
{
  LasText las(4, 6);
  las.add(1, 1, 1, 2);
  PointOptions reading;
  reading.NoData = 1.5; // the time of LasText
  const std::string path = this->Folder.file("a.las", las.text());
  copyToLas({ path }, reading, this->path("out.laz"), { "" });
  EXPECT_TRUE(recordsOf(this->path("out.laz")) == recordsOf(path));
}

TEST_F(LasWriting, WhatFilesLoseBesideOtherKindsIsNamed)
{
  LasText las(2, 0);
  las.add(1, 1, 1, 2);
  const std::string a = this->Folder.file("a.las", las.text());
  const std::string b = this->Folder.file("b.csv", "x,y,z,intensity,classification\n1,1,1,1,1\n");
  for (const std::vector<std::string>& inputs : { std::vector{ a, b }, std::vector{ b, a, a } })
  {
    const LasReport report = this->copy(inputs);
    EXPECT_EQ(report.Points, std::int64_t(inputs.size()));
    ASSERT_EQ(report.Warnings.size(), 1U);
    const std::string& warning = report.Warnings[0];
    EXPECT_NE(warning.find(a), std::string::npos) << warning;
    EXPECT_NE(warning.find("returns, flags, source ids, user data, scan angles and extra bytes"),
      std::string::npos)
      << warning;
    EXPECT_NE(warning.find("copy the LAS files apart"), std::string::npos) << warning;
  }
  EXPECT_TRUE(this->copy({ b, b }).Warnings.empty());
}

TEST_F(LasWriting, KeysOfTheReferenceSystemBecomeWkt)
{
  LasText las(2, 1);
  las.addRecord(34735, keysOf({ { 1024, 1 }, { 3072, 25832 } }));
  las.add(1, 1, 1, 2);
  const std::string path = this->Folder.file("a.las", las.text());
  const LasReport report = this->copy({ path });
  const LasHeader header = this->header("out.laz");
  const bool isWkt = report.Warnings.size() == 1; // that of the scan angles
  EXPECT_EQ(header.Crs.Text.empty(), !isWkt);
  EXPECT_EQ(header.Crs.Keys.empty(), isWkt);
  EXPECT_EQ((header.Encoding & 16) != 0, isWkt);
  EXPECT_EQ(understandCrs(header.Crs).Text, "EPSG:25832");
}

TEST_F(LasWriting, KeysThatAreNotUnderstoodAreCopied)
{
  LasText las(2, 1);
  const std::string keys = keysOf({ { 1024, 1 }, { 3072, 61234 } });
  las.addRecord(34735, keys);
  las.add(1, 1, 1, 2);
  const LasReport report = this->copy({ this->Folder.file("a.las", las.text()) });
  EXPECT_EQ(this->header("out.laz").Crs.Keys, keys);
  EXPECT_EQ(this->header("out.laz").Encoding & 16, 0);
  EXPECT_NE(report.Warnings.front().find("keys of GeoTIFF"), std::string::npos);
}

TEST_F(LasWriting, WktIsCopiedAsItIs)
{
  LasText las(4, 6);
  const std::string wkt = "PROJCS[\"of a user\",strange]";
  las.addRecord(2112, wkt + '\0');
  las.add(1, 1, 1, 2);
  this->copy({ this->Folder.file("a.las", las.text()) });
  EXPECT_EQ(this->header("out.laz").Crs.Text, wkt);
}

} // namespace
