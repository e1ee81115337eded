// SPDX-License-Identifier: BSD-3-Clause
#include "Raster/RasterFile.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace
{

using namespace tipp;

RasterGrid gridFor(double resolution, const std::array<double, 4>& bounds, bool aligned = true)
{
  RasterRequest request;
  request.Resolution = resolution;
  request.Aligned = aligned;
  return makeRasterGrid(request, boxOfVtkBounds<2>(bounds.data()));
}

TEST(RasterGrid, CoversTheBoundsWithBordersAtMultiples)
{
  const RasterGrid grid = gridFor(10, { -3, 27, 11, 40 });
  EXPECT_EQ(-10, grid.West);
  EXPECT_EQ(10, grid.South);
  EXPECT_EQ(4, grid.Columns);
  EXPECT_EQ(3, grid.Rows);
  EXPECT_EQ(40, grid.north());
}

TEST(RasterGrid, RoundingAddsNoPixel)
{
  const RasterGrid grid = gridFor(0.1, { 0.3, 0.7, 0, 0.1 });
  EXPECT_EQ(4, grid.Columns);
  EXPECT_EQ(1, grid.Rows);
}

TEST(RasterGrid, HasTheBordersThatTheWrittenNumbersHave)
{
  EXPECT_EQ(13, gridFor(0.1, { 0, 1.3, 0, 0.7 }).Columns);
  EXPECT_EQ(7, gridFor(0.1, { 0, 1.3, 0, 0.7 }).Rows);
  for (const double resolution : { 0.1, 0.05, 0.01, 0.3, 0.7, 0.333333 })
  {
    for (const std::int64_t first : { 0, -17, 1000003, 50000001 })
    {
      for (int count = 1; count < 100; ++count)
      {
        const double low = gridPosition(0, resolution, 2 * first);
        const double high = gridPosition(0, resolution, 2 * (first + count));
        for (const bool isAligned : { true, false })
        {
          const RasterGrid grid = gridFor(resolution, { low, high, low, high }, isAligned);
          ASSERT_EQ(low, grid.West);
          ASSERT_EQ(count, grid.Columns) << resolution << " " << first;
          ASSERT_EQ(count, grid.Rows);
          ASSERT_EQ(high, grid.north());
        }
      }
    }
  }
}

TEST(RasterGrid, BoundsWithinRoundingOfABorderAreOnIt)
{
  const RasterGrid grid = gridFor(0.1, { 0.29999999999999993, 0.70000000000000007, 0, 1 });
  EXPECT_EQ(0.3, grid.West);
  EXPECT_EQ(4, grid.Columns);
  EXPECT_EQ(5, gridFor(0.1, { 0.3, 0.7000000001, 0, 1 }).Columns);
}

TEST(RasterGrid, RefusesPixelsSmallerThanRounding)
{
  EXPECT_THROW(gridFor(1e-9, { 5e6, 5e6 + 1e-8, 0, 1 }), std::runtime_error);
}

TEST(RasterGrid, StartsAtTheBoundsOnRequest)
{
  const RasterGrid grid = gridFor(10, { -3, 27, 11, 40 }, false);
  EXPECT_EQ(-3, grid.West);
  EXPECT_EQ(11, grid.South);
  EXPECT_EQ(3, grid.Columns);
  EXPECT_EQ(3, grid.Rows);
}

TEST(RasterGrid, OfASinglePointIsAPixel)
{
  const RasterGrid grid = gridFor(2, { 4, 4, 6, 6 });
  EXPECT_EQ(1, grid.Columns);
  EXPECT_EQ(1, grid.Rows);
}

TEST(RasterGrid, RefusesInvalidBoundsAndTooManyPixels)
{
  EXPECT_THROW(gridFor(1, { 1, 0, 0, 1 }), std::runtime_error);
  EXPECT_THROW(gridFor(1e-9, { 0, 10, 0, 1 }), std::runtime_error);
}

TEST(RasterTiles, FollowEachOtherFromTheNorthWest)
{
  RasterGrid grid;
  grid.Columns = 300;
  grid.Rows = 500;
  ASSERT_EQ(4, tileCount(grid));
  std::vector<RasterWindow> tiles;
  for (std::int64_t number = 0; number < 4; ++number)
  {
    tiles.push_back(tileOf(grid, number));
    EXPECT_EQ(number, tileNumber(grid, tiles.back()));
  }
  EXPECT_EQ(244, tiles[0].Row);
  EXPECT_EQ(256, tiles[0].Columns);
  EXPECT_EQ(256, tiles[1].Column);
  EXPECT_EQ(44, tiles[1].Columns);
  EXPECT_EQ(0, tiles[3].Row);
  EXPECT_EQ(244, tiles[3].Rows);
}

} // namespace
