// SPDX-License-Identifier: BSD-3-Clause
#include "Raster/Overviews.h"

#include "Predicates/Angles.h"

#include <cmath>
#include <cstddef>
#include <limits>

namespace tipp
{
namespace
{

constexpr auto side = std::size_t(RasterTileSize);
constexpr double noValue = std::numeric_limits<double>::quiet_NaN();

/// Sums over the raster's pixels that stand behind each pixel of a tile of an overview.
struct TileSums
{
  explicit TileSums(OverviewRule rule)
    : X(side * side)
    , Y(rule == OverviewRule::Direction ? side * side : 0)
    , Count(side * side)
  {
  }

  std::vector<double> X;     ///< the values, or the cosines of directions
  std::vector<double> Y;     ///< the sines of directions
  std::vector<double> Count; ///< of the pixels with a value
};

TileSums sumsOf(const TilePixels& pixels, OverviewRule rule)
{
  TileSums sums(rule);
  for (std::size_t i = 0; i < pixels.size(); ++i)
  {
    if (std::isnan(pixels[i]))
    {
      continue;
    }
    const bool isDirection = rule == OverviewRule::Direction;
    sums.X[i] = isDirection ? cosineOfDegrees(pixels[i]) : pixels[i];
    if (isDirection)
    {
      sums.Y[i] = sineOfDegrees(pixels[i]);
    }
    sums.Count[i] = 1;
  }
  return sums;
}

/// Adds a tile of the level below to the quarter of a tile in which it lies.
void addQuarter(
  TileSums& sums, const TileSums& below, std::size_t right, std::size_t down, OverviewRule rule)
{
  for (std::size_t row = 0; row < side; ++row)
  {
    for (std::size_t column = 0; column < side; ++column)
    {
      const bool isFirst = row % 2 == 0 && column % 2 == 0;
      if (rule == OverviewRule::Nearest && !isFirst)
      {
        continue; // the north-western pixel of four
      }
      const std::size_t from = row * side + column;
      const std::size_t to = (down * side + row) / 2 * side + (right * side + column) / 2;
      sums.X[to] += below.X[from];
      if (!sums.Y.empty())
      {
        sums.Y[to] += below.Y[from];
      }
      sums.Count[to] += below.Count[from];
    }
  }
}

double valueOf(const TileSums& sums, std::size_t i)
{
  // Directions that cancel each other, up to rounding, have no mean.
  constexpr double least = 1e-9;
  const double count = sums.Count[i];
  if (count == 0)
  {
    return noValue;
  }
  if (sums.Y.empty())
  {
    return sums.X[i] / count;
  }
  if (std::sqrt(sums.X[i] * sums.X[i] + sums.Y[i] * sums.Y[i]) < least * count)
  {
    return noValue;
  }
  const double angle = degreesOf(sums.X[i], sums.Y[i]);
  const double turned = angle < 0 ? angle + 360 : angle;
  return turned < 360 ? turned : 0;
}

class OverviewMaker
{
public:
  OverviewMaker(
    const std::vector<OverviewSize>& sizes, OverviewRule rule, const OverviewTiles& tiles)
    : Sizes(sizes)
    , Rule(rule)
    , Tiles(tiles)
  {
  }

  /// Makes a tile of a level, and before it those of the lower levels that it covers.
  TileSums make(std::size_t level, std::int64_t column, std::int64_t row) const
  {
    const std::int64_t tile = row * tilesAlong(this->Sizes[level].Columns) + column;
    if (level == 0)
    {
      return sumsOf(this->Tiles.Read(tile), this->Rule);
    }
    TileSums sums(this->Rule);
    const OverviewSize& below = this->Sizes[level - 1];
    for (const std::int64_t down : { 0, 1 })
    {
      for (const std::int64_t right : { 0, 1 })
      {
        if (2 * column + right < tilesAlong(below.Columns) &&
          2 * row + down < tilesAlong(below.Rows))
        {
          addQuarter(sums, this->make(level - 1, 2 * column + right, 2 * row + down),
            std::size_t(right), std::size_t(down), this->Rule);
        }
      }
    }
    TilePixels pixels(side * side);
    for (std::size_t i = 0; i < pixels.size(); ++i)
    {
      pixels[i] = valueOf(sums, i);
    }
    this->Tiles.Write(level, tile, pixels);
    return sums;
  }

private:
  const std::vector<OverviewSize>& Sizes;
  const OverviewRule Rule;
  const OverviewTiles& Tiles;
};

} // namespace

std::vector<OverviewSize> overviewSizes(const RasterGrid& grid)
{
  constexpr std::int64_t largest = 512;
  std::vector<OverviewSize> sizes = { { grid.Columns, grid.Rows } };
  while (sizes.back().Columns > largest || sizes.back().Rows > largest)
  {
    sizes.push_back({ (sizes.back().Columns + 1) / 2, (sizes.back().Rows + 1) / 2 });
  }
  return sizes;
}

void makeOverviews(
  const std::vector<OverviewSize>& sizes, OverviewRule rule, const OverviewTiles& tiles)
{
  if (sizes.size() < 2)
  {
    return;
  }
  const OverviewMaker maker(sizes, rule, tiles);
  const std::size_t top = sizes.size() - 1;
  for (std::int64_t row = 0; row < tilesAlong(sizes[top].Rows); ++row)
  {
    for (std::int64_t column = 0; column < tilesAlong(sizes[top].Columns); ++column)
    {
      maker.make(top, column, row);
    }
  }
}

} // namespace tipp
