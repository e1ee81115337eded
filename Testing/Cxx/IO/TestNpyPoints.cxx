// SPDX-License-Identifier: BSD-3-Clause
#include "ExpectIOError.h"
#include "Npy/NpyFile.h"
#include "NpyText.h"
#include "Points/ReadPoints.h"
#include "TemporaryFolder.h"

#include <cmath>
#include <limits>

namespace
{

using tipp::readPoints;
using tipp::test::bytesOf;
using tipp::test::npyBytes;
using tipp::test::npyHeader;

class NpyPoints : public testing::Test
{
protected:
  std::string file(const std::string& header, const std::string& data) const
  {
    return this->Folder.file("points.npy", npyBytes(header, data));
  }

  // Expects that reading the file fails with a message that contains `words`.
  void expectError(const std::string& path, const std::string& words) const
  {
    tipp::test::expectIOError(path, words, [&]() { readPoints(path); });
  }

  const tipp::test::TemporaryFolder Folder;
  const std::string TwoPoints = bytesOf<double>({ 1, 2, 3, 4 });
};

} // namespace

TEST_F(NpyPoints, PointsAreReadAsWrittenBitForBit)
{
  const std::vector<double> xy{ 0.1, -1e300, std::numeric_limits<double>::denorm_min(), -0.0,
    std::numeric_limits<double>::infinity(), 1 / 3.0 };
  const std::string path = this->Folder.path("points.npy");
  tipp::writePoints(path, xy);
  EXPECT_EQ(xy, readPoints(path).XY);
}

TEST_F(NpyPoints, DataOfWrittenFilesStartAtAMultipleOf64)
{
  const std::string path = this->Folder.path("points.npy");
  tipp::writePoints(path, { 1, 2 });
  EXPECT_EQ(0U, (tipp::test::contentOf(path).size() - 16) % 64);
}

TEST_F(NpyPoints, AFileMayHaveNoPoints)
{
  const std::string path = this->Folder.path("points.npy");
  tipp::writePoints(path, {});
  EXPECT_EQ(0U, readPoints(path).size());
}

TEST_F(NpyPoints, ThirdColumnIsZ)
{
  const tipp::PointTable points =
    tipp::readPoints(this->file(npyHeader("<f8", "(2, 3)"), bytesOf<double>({ 1, 2, 3, 4, 5, 6 })));
  EXPECT_EQ((std::vector<double>{ 1, 2, 4, 5 }), points.XY);
  ASSERT_EQ(1U, points.Columns.size());
  EXPECT_EQ("z", points.Columns[0].Name);
  EXPECT_EQ((std::vector<double>{ 3, 6 }), points.Columns[0].Values);
}

TEST_F(NpyPoints, Float32IsWidened)
{
  const tipp::PointTable points =
    tipp::readPoints(this->file(npyHeader("<f4", "(2, 2)"), bytesOf<float>({ 0.1F, 2, 3, 4 })));
  EXPECT_EQ((std::vector<double>{ double(0.1F), 2, 3, 4 }), points.XY);
}

TEST_F(NpyPoints, ALongFileIsReadInChunks)
{
  std::vector<float> values;
  for (int i = 0; i < 300000; ++i)
  {
    values.push_back(float(i));
  }
  const tipp::PointTable points =
    tipp::readPoints(this->file(npyHeader("<f4", "(100000, 3)"), bytesOf(values)));
  for (std::size_t i = 0; i < 100000; ++i)
  {
    ASSERT_EQ(double(3 * i), points.XY[2 * i]);
    ASSERT_EQ(double(3 * i + 1), points.XY[2 * i + 1]);
    ASSERT_EQ(double(3 * i + 2), points.Columns[0].Values[i]);
  }
}

TEST_F(NpyPoints, ColumnsCanBeChosen)
{
  const std::string path = this->file(npyHeader("<f8", "(1, 3)"), bytesOf<double>({ 1, 2, 3 }));
  const tipp::PointTable points = readPoints(path, { "z", "0" });
  EXPECT_EQ((std::vector<double>{ 3, 1 }), points.XY);
  EXPECT_EQ("y", points.Columns.at(0).Name);
}

TEST_F(NpyPoints, OnlyTheRequestedColumnsAreRead)
{
  tipp::PointOptions options;
  options.Columns.emplace();
  const std::string path = this->file(npyHeader("<f8", "(1, 3)"), bytesOf<double>({ 1, 2, 3 }));
  EXPECT_TRUE(readPoints(path, options).Columns.empty());
}

TEST_F(NpyPoints, TwoColumnsCanBeSwapped)
{
  const std::string path = this->file(npyHeader("<f8", "(2, 2)"), this->TwoPoints);
  EXPECT_EQ((std::vector<double>{ 2, 1, 4, 3 }), readPoints(path, { "1", "0" }).XY);
}

TEST_F(NpyPoints, HeaderOfVersion2IsRead)
{
  const std::string header = npyHeader("<f8", "(2, 2)") + "\n";
  const std::string start =
    std::string("\x93NUMPY\x02") + '\0' + char(header.size()) + std::string(3, '\0');
  const std::string path = this->Folder.file("points.npy", start + header + this->TwoPoints);
  EXPECT_EQ((std::vector<double>{ 1, 2, 3, 4 }), readPoints(path).XY);
}

TEST_F(NpyPoints, MissingFileIsReported)
{
  this->expectError(this->Folder.path("absent.npy"), "cannot be opened");
}

TEST_F(NpyPoints, FolderIsNotAFile)
{
  const std::string path = this->Folder.path("folder.npy");
  std::filesystem::create_directory(path);
  this->expectError(path, "is a folder");
}

TEST_F(NpyPoints, TruncatedDataAreReported)
{
  const std::string data = this->TwoPoints.substr(0, 31);
  this->expectError(this->file(npyHeader("<f8", "(2, 2)"), data), "holds 31 bytes of data");
}

TEST_F(NpyPoints, SurplusDataAreReported)
{
  const std::string data = this->TwoPoints + "x";
  this->expectError(this->file(npyHeader("<f8", "(2, 2)"), data), "holds 33 bytes of data");
}

TEST_F(NpyPoints, EveryTruncationOfTheHeaderIsReported)
{
  const std::string whole = npyBytes(npyHeader("<f8", "(2, 2)"), "");
  for (std::size_t size = 0; size < whole.size(); ++size)
  {
    const std::string path = this->Folder.file("points.npy", whole.substr(0, size));
    EXPECT_THROW(readPoints(path), tipp::IOError) << size;
  }
}

TEST_F(NpyPoints, WrongTypesAreReported)
{
  for (const char* descr : { ">f8", "|O", "<c16", "<f16", "" })
  {
    this->expectError(
      this->file(npyHeader(descr, "(2, 2)"), this->TwoPoints), "holds elements of type");
  }
  this->expectError(this->file(npyHeader("<i2", "(2, 2)"), this->TwoPoints.substr(0, 8)),
    "holds elements of type Int16");
}

TEST_F(NpyPoints, MessagesAreOneLineWhateverTheFileHolds)
{
  try
  {
    tipp::readPoints(this->file(npyHeader("<f\n\t\x01", "(2, 2)"), this->TwoPoints));
    FAIL() << "nothing was thrown";
  }
  catch (const tipp::IOError& error)
  {
    EXPECT_EQ(std::string::npos, std::string(error.what()).find_first_of("\n\t\x01"));
  }
}

TEST_F(NpyPoints, IntegersAreNotPoints)
{
  this->expectError(this->file(npyHeader("<i8", "(2, 2)"), this->TwoPoints), "float64");
}

TEST_F(NpyPoints, FortranOrderIsReported)
{
  this->expectError(
    this->file("{'descr': '<f8', 'fortran_order': True, 'shape': (2, 2), }", this->TwoPoints),
    "Fortran order");
}

TEST_F(NpyPoints, WrongShapesAreReported)
{
  this->expectError(this->file(npyHeader("<f8", "(4,)"), this->TwoPoints), "1 dimensions");
  this->expectError(this->file(npyHeader("<f8", "(1, 2, 2)"), this->TwoPoints), "3 dimensions");
  this->expectError(this->file(npyHeader("<f8", "(4, 1)"), this->TwoPoints), "n x 2 or n x 3");
  this->expectError(this->file(npyHeader("<f8", "(1, 4)"), this->TwoPoints), "n x 2 or n x 3");
}

TEST_F(NpyPoints, NegativeCountIsReported)
{
  this->expectError(
    this->file(npyHeader("<f8", "(-2, 2)"), this->TwoPoints), "does not describe a plain array");
}

TEST_F(NpyPoints, HugeCountsAllocateNoMemory)
{
  this->expectError(
    this->file(npyHeader("<f8", "(1000000000000, 2)"), this->TwoPoints), "need 16000000000000");
  this->expectError(this->file(npyHeader("<f8", "(9223372036854775807, 2)"), this->TwoPoints),
    "need more than 2^63");
  this->expectError(this->file(npyHeader("<f8", "(99999999999999999999, 2)"), this->TwoPoints),
    "does not describe a plain array");
}

TEST_F(NpyPoints, HeadersThatAreNoPlainDictionaryAreReported)
{
  for (const char* header : { "", "{", "{}", "[]", "{'descr': '<f8'}",
         "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2), 'more': 1}",
         "{'descr': [('x', '<f8')], 'fortran_order': False, 'shape': (2, 2), }",
         "{'descr': '<f8', 'descr': '<f8', 'shape': (2, 2), }",
         "{'descr': '<f8', 'fortran_order': False, 'shape': (2 2), }",
         "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2), } + 1" })
  {
    this->expectError(this->file(header, this->TwoPoints), "does not describe a plain array");
  }
}

TEST_F(NpyPoints, HeaderLongerThanTheFileIsReported)
{
  const std::string path = this->Folder.file("points.npy",
    std::string("\x93NUMPY\x02") + '\0' + "\xff\xff\xff\x7f" + npyHeader("<f8", "(2, 2)"));
  this->expectError(path, "header of 2147483647 bytes");
}

TEST_F(NpyPoints, SameColumnTwiceIsReported)
{
  const std::string path = this->file(npyHeader("<f8", "(2, 2)"), this->TwoPoints);
  tipp::test::expectIOError(path, "same column", [&]() { readPoints(path, { "x", "0" }); });
}
