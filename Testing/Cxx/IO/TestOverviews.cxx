// SPDX-License-Identifier: BSD-3-Clause
#include "Raster/Overviews.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace
{

using namespace tipp;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// A pixel of the raster, by column and row from the north-west.
using PixelAt = std::function<double(std::int64_t column, std::int64_t row)>;

/// The overviews of a raster.
class Made
{
public:
  Made(std::int64_t columns, std::int64_t rows, OverviewRule rule, const PixelAt& pixelAt)
  {
    RasterGrid grid;
    grid.Columns = columns;
    grid.Rows = rows;
    this->Sizes = overviewSizes(grid);
    OverviewTiles tiles;
    tiles.Read = [&](std::int64_t tile)
    {
      const RasterWindow window = tileOf(grid, tile);
      TilePixels pixels(std::size_t(RasterTileSize * RasterTileSize), none);
      for (std::int64_t row = 0; row < window.Rows; ++row)
      {
        for (std::int64_t column = 0; column < window.Columns; ++column)
        {
          pixels[std::size_t(row * RasterTileSize + column)] =
            pixelAt(window.Column + column, rows - window.Row - window.Rows + row);
        }
      }
      return pixels;
    };
    tiles.Write = [&](std::size_t level, std::int64_t tile, const TilePixels& pixels)
    { EXPECT_TRUE(this->Tiles.emplace(std::make_pair(level, tile), pixels).second); };
    makeOverviews(this->Sizes, rule, tiles);
  }

  double at(std::size_t level, std::int64_t column, std::int64_t row) const
  {
    const std::int64_t tile =
      row / RasterTileSize * tilesAlong(this->Sizes[level].Columns) + column / RasterTileSize;
    return this->Tiles.at({ level,
      tile })[std::size_t(row % RasterTileSize * RasterTileSize + column % RasterTileSize)];
  }

  std::vector<OverviewSize> Sizes;

private:
  std::map<std::pair<std::size_t, std::int64_t>, TilePixels> Tiles;
};

TEST(Overviews, HalveTheRasterUntilATileHoldsIt)
{
  const Made made(2100, 700, OverviewRule::Mean, [](std::int64_t, std::int64_t) { return 1; });
  ASSERT_EQ(4U, made.Sizes.size());
  EXPECT_EQ(1050, made.Sizes[1].Columns);
  EXPECT_EQ(350, made.Sizes[1].Rows);
  EXPECT_EQ(263, made.Sizes[3].Columns);
  EXPECT_EQ(88, made.Sizes[3].Rows);
  for (std::size_t level = 1; level < 4; ++level)
  {
    EXPECT_EQ(1, made.at(level, made.Sizes[level].Columns - 1, made.Sizes[level].Rows - 1));
  }
}

TEST(Overviews, HaveTheMeanOfPixelsWithAValue)
{
  const PixelAt pixelAt = [](std::int64_t column, std::int64_t row)
  { return (column + row) % 5 == 0 || column > 900 ? none : double(column * 7 % 100 + row % 13); };
  const Made made(1200, 600, OverviewRule::Mean, pixelAt);
  ASSERT_EQ(3U, made.Sizes.size());
  for (std::int64_t row = 0; row < 150; ++row)
  {
    for (std::int64_t column = 0; column < 300; ++column)
    {
      double sum = 0;
      int count = 0;
      for (std::int64_t i = 0; i < 16; ++i)
      {
        const double pixel = pixelAt(4 * column + i % 4, 4 * row + i / 4);
        sum += std::isnan(pixel) ? 0 : pixel;
        count += std::isnan(pixel) ? 0 : 1;
      }
      ASSERT_EQ(count == 0, std::isnan(made.at(2, column, row)));
      if (count > 0)
      {
        ASSERT_DOUBLE_EQ(sum / count, made.at(2, column, row));
      }
    }
  }
}

TEST(Overviews, OfMasksHaveValuesOfTheMask)
{
  const Made made(1200, 600, OverviewRule::Nearest,
    [](std::int64_t column, std::int64_t row) { return double((column / 3 + row / 3) % 2); });
  for (std::int64_t i = 0; i < 300 * 150; ++i)
  {
    const double value = made.at(2, i % 300, i / 300);
    ASSERT_EQ((i % 300 * 4 / 3 + i / 300 * 4 / 3) % 2, value);
  }
}

TEST(Overviews, OfDirectionsHaveMeanDirections)
{
  const Made made(1024, 600, OverviewRule::Direction,
    [](std::int64_t column, std::int64_t row)
    {
      const double around = column % 2 == 0 ? 350 : 20; // mean 5
      return column < 512 ? around : row % 2 == 0 ? 90.0 : 270.0;
    });
  EXPECT_NEAR(5, made.at(1, 0, 0), 1e-9);
  EXPECT_NEAR(5, made.at(1, 255, 299), 1e-9);
  EXPECT_TRUE(std::isnan(made.at(1, 256, 0))); // opposite directions have no mean
}

} // namespace
