// SPDX-License-Identifier: BSD-3-Clause
#include "Raster/RasterFile.h"

#include "ExpectIOError.h"
#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

class GeoTiff : public testing::Test
{
protected:
  GeoTiff()
  {
    this->Description.Grid = { 0, 0, { 1, 1 }, 300, 20, std::nullopt };
    this->Description.Bands = { "elevation" };
    this->Description.Compression = "none";
  }

  /// The value of a pixel is its column plus a thousandth of its row, counted from the south.
  static std::vector<double> valuesOf(const RasterWindow& window)
  {
    std::vector<double> values;
    for (std::int64_t i = 0; i < window.Columns * window.Rows; ++i)
    {
      values.push_back(double(window.Column + i % window.Columns) +
        double(window.Row + i / window.Columns) / 1000);
    }
    return values;
  }

  std::string write(bool isEncodedBefore = false) const
  {
    const std::string path = this->Folder.path("a.tif");
    const auto writer = createRaster(path, this->Description, PendingFile(path).before());
    for (std::int64_t tile = tileCount(this->Description.Grid) - 1; tile >= 0; --tile)
    {
      const RasterWindow window = tileOf(this->Description.Grid, tile);
      const std::vector<double> values = valuesOf(window);
      isEncodedBefore
        ? writer->writeEncoded(tile, encodeTile(this->Description, window, { values.data() }))
        : writer->write(window, { values.data() });
    }
    writer->close();
    std::ifstream file(path, std::ios::binary);
    return { std::istreambuf_iterator<char>(file), {} };
  }

  template <typename T>
  static T at(const std::string& bytes, std::uint64_t offset)
  {
    T value;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
  }

  /// The first value of a BigTIFF's field with this tag.
  static std::uint64_t fieldOf(const std::string& bytes, std::uint16_t tag)
  {
    const auto directory = at<std::uint64_t>(bytes, 8);
    const auto count = at<std::uint64_t>(bytes, directory);
    for (std::uint64_t entry = directory + 8; entry < directory + 8 + 20 * count; entry += 20)
    {
      if (at<std::uint16_t>(bytes, entry) == tag)
      {
        const auto type = at<std::uint16_t>(bytes, entry + 2);
        const bool isLong = type == 16;
        const std::uint64_t size = at<std::uint64_t>(bytes, entry + 4) * (isLong ? 8 : 4);
        const std::uint64_t where = size > 8 ? at<std::uint64_t>(bytes, entry + 12) : entry + 12;
        return isLong ? at<std::uint64_t>(bytes, where) : at<std::uint32_t>(bytes, where);
      }
    }
    return 0;
  }

  RasterDescription Description;
  TemporaryFolder Folder;
};

TEST_F(GeoTiff, IsABigTiffIfLargerThanAClassicTiffMayBe)
{
  const std::string classic = this->write();
  EXPECT_EQ(42, at<std::uint16_t>(classic, 2));
  this->Description.ClassicBytes = 1000;
  const std::string big = this->write();
  ASSERT_EQ(43, at<std::uint16_t>(big, 2));
  EXPECT_EQ(8, at<std::uint16_t>(big, 4));
  EXPECT_EQ(300U, fieldOf(big, 256) & 0xffffffffU);
  const std::uint64_t tile = fieldOf(big, 324);
  // The north-western pixel, and the pixel to the east of it.
  EXPECT_EQ(0.019F, at<float>(big, tile));
  EXPECT_EQ(1.019F, at<float>(big, tile + 4));
  EXPECT_EQ(classic.substr(16, 2 * 4 * 256 * 256), big.substr(16, 2 * 4 * 256 * 256));
}

TEST_F(GeoTiff, RefusesValuesThatAreTooLargeFor32Bits)
{
  const std::string path = this->Folder.path("a.tif");
  const RasterWindow window = tileOf(this->Description.Grid, 0);
  std::vector<double> values = valuesOf(window);
  values[5] = 1e300;
  const auto encode = [&] { encodeTile(this->Description, window, { values.data() }); };
  expectIOError("The value 1", "e+300 of the band 'elevation'", encode);
  this->Description.Double = true;
  EXPECT_NO_THROW(encodeTile(this->Description, window, { values.data() }));
}

TEST_F(GeoTiff, TilesMayBeEncodedInAdvance)
{
  for (const char* const compression : { "none", "deflate" })
  {
    this->Description.Compression = compression;
    EXPECT_EQ(this->write(), this->write(true)) << compression;
  }
}

} // namespace
