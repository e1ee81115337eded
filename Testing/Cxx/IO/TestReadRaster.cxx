// SPDX-License-Identifier: BSD-3-Clause
#include "Crs/TiffDirectory.h"
#include "Raster/ReadRaster.h"

#include "ExpectIOError.h"
#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

/// Makes a TIFF file of fields.
class TiffText
{
public:
  explicit TiffText(bool isBigEndian = false, bool isBig = false)
    : IsBigEndian(isBigEndian)
    , IsBig(isBig)
  {
  }

  /// `type` and `size` as in TIFF: 3 and 2, or 12 and 8.
  template <typename Value>
  TiffText& add(std::uint16_t tag, std::uint16_t type, const std::vector<Value>& values)
  {
    std::string bytes;
    for (const Value value : values)
    {
      bytes += this->number(value);
    }
    this->Fields.push_back({ tag, type, values.size(), bytes });
    return *this;
  }

  std::string text() const
  {
    const std::size_t word = this->IsBig ? 8 : 4;
    std::string head =
      (this->IsBigEndian ? "MM" : "II") + this->number(std::uint16_t(this->IsBig ? 43 : 42));
    head += this->IsBig ? this->number(std::uint16_t(8)) + this->number(std::uint16_t(0)) : "";
    const std::size_t directory = head.size() + word;
    head += this->word(directory);
    head += this->IsBig ? this->number(std::uint64_t(this->Fields.size()))
                        : this->number(std::uint16_t(this->Fields.size()));
    const std::size_t end = head.size() + this->Fields.size() * (4 + 2 * word) + word;
    std::string values;
    for (const Field& field : this->Fields)
    {
      head += this->number(field.Tag) + this->number(field.Type) + this->word(field.Count);
      const bool isInside = field.Bytes.size() <= word;
      head += isInside ? field.Bytes + std::string(word - field.Bytes.size(), '\0')
                       : this->word(end + values.size());
      values += isInside ? "" : field.Bytes;
    }
    return head + this->word(0) + values;
  }

private:
  struct Field
  {
    std::uint16_t Tag;
    std::uint16_t Type;
    std::size_t Count;
    std::string Bytes;
  };

  template <typename Value>
  std::string number(Value value) const
  {
    std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
    if (this->IsBigEndian)
    {
      std::reverse(bytes.begin(), bytes.end());
    }
    return bytes;
  }

  std::string word(std::uint64_t value) const
  {
    return this->IsBig ? this->number(value) : this->number(std::uint32_t(value));
  }

  bool IsBigEndian;
  bool IsBig;
  std::vector<Field> Fields;
};

using Shorts = std::vector<std::uint16_t>;
using Doubles = std::vector<double>;

TiffText sized(TiffText text = TiffText())
{
  return text.add(256, 3, Shorts{ 40 }).add(257, 3, Shorts{ 30 });
}

class ReadRaster : public testing::Test
{
protected:
  std::string file(const TiffText& text) const { return this->Folder.file("a.tif", text.text()); }
  TemporaryFolder Folder;
};

TEST_F(ReadRaster, ScaleAndTiePointAreReadInEveryLayout)
{
  for (const bool isBigEndian : { false, true })
  {
    for (const bool isBig : { false, true })
    {
      const auto info = readGeoTiffInfo(
        this->file(sized(TiffText(isBigEndian, isBig))
                     .add(33550, 12, Doubles{ 0.5, 2, 0 })
                     .add(33922, 12, Doubles{ 2, 3, 0, 101, 206, 0 })
                     .add(34735, 3, Shorts{ 1, 1, 0, 2, 1024, 0, 1, 1, 3072, 0, 1, 25832 })));
      ASSERT_TRUE(info);
      EXPECT_EQ(40, info->Grid.Columns);
      EXPECT_EQ(30, info->Grid.Rows);
      EXPECT_EQ(100, info->Grid.West);
      EXPECT_EQ(212, info->Grid.north());
      EXPECT_EQ(152, info->Grid.South);
      EXPECT_EQ("EPSG:25832", info->Crs.Text);
    }
  }
}

TEST_F(ReadRaster, MatrixAndCentresAreRead)
{
  const auto info = readGeoTiffInfo(
    this->file(sized()
                 .add(34264, 12, Doubles{ 2, 0, 0, 11, 0, -4, 0, 98, 0, 0, 0, 0, 0, 0, 0, 1 })
                 .add(34735, 3, Shorts{ 1, 1, 0, 1, 1025, 0, 1, 2 })));
  ASSERT_TRUE(info);
  EXPECT_EQ(10, info->Grid.West);
  EXPECT_EQ(100, info->Grid.north());
  EXPECT_EQ(4, info->Grid.Pixel[1]);
}

TEST_F(ReadRaster, FileWithoutAPlaceHasNoGrid)
{
  EXPECT_FALSE(readGeoTiffInfo(this->file(sized())));
}

TEST_F(ReadRaster, RotatedRasterIsRefused)
{
  const std::string path = this->file(
    sized().add(34264, 12, Doubles{ 2, 1, 0, 11, 1, -4, 0, 98, 0, 0, 0, 0, 0, 0, 0, 1 }));
  expectIOError(path, "from north to south", [&] { readGeoTiffInfo(path); });
}

TEST_F(ReadRaster, EveryCutFileIsRefused)
{
  const std::string whole = sized()
                              .add(33550, 12, Doubles{ 0.5, 2, 0 })
                              .add(33922, 12, Doubles{ 2, 3, 0, 101, 206, 0 })
                              .text();
  ASSERT_TRUE(readGeoTiffInfo(this->Folder.file("a.tif", whole)));
  for (std::size_t size = 0; size < whole.size(); ++size)
  {
    const std::string path = this->Folder.file("b.tif", whole.substr(0, size));
    expectIOError(path, "copy or write it again", [&] { readGeoTiffInfo(path); });
  }
}

TEST_F(ReadRaster, CountsAndOffsetsAreNotTrusted)
{
  const std::string whole = sized().add(33550, 12, Doubles{ 0.5, 2, 0 }).text();
  for (std::size_t at = 4; at < whole.size(); ++at)
  {
    std::string damaged = whole;
    damaged[at] = '\xff';
    const std::string path = this->Folder.file("b.tif", damaged);
    try
    {
      readGeoTiffInfo(path);
    }
    catch (const IOError& error)
    {
      EXPECT_NE(std::string::npos, std::string(error.what()).find(path));
    }
  }
}

} // namespace
