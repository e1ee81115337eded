// SPDX-License-Identifier: BSD-3-Clause
// Which pixels of a raster have values, compared with rational arithmetic of the decimal numbers
// that a user writes.
#include "Dem/MakeDem.h"

#include "Arrays/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

namespace
{

using namespace tipp;

/// Whole numbers of half pixels from the origin.
struct Node
{
  std::int64_t X;
  std::int64_t Y;
};

/// A resolution as a user writes it, and as a whole number of units of 10^-Places.
struct Resolution
{
  std::int64_t Units;
  int Places;
};

const std::vector<Resolution> resolutions = { { 1, 1 }, { 5, 2 }, { 1, 2 }, { 3, 1 }, { 7, 1 },
  { 333333, 6 }, { 25, 2 }, { 30, 0 }, { 1, 3 }, { 2, 1 } };

/// The double that is read from the text of halves / 2 * resolution.
double numberAt(const Resolution& resolution, std::int64_t halves)
{
  const std::string text =
    std::to_string(halves * resolution.Units * 5) + "e-" + std::to_string(resolution.Places + 1);
  return std::strtod(text.c_str(), nullptr);
}

/// A multiple of the pixel near a large coordinate, in half pixels.
std::int64_t offsetNear(double coordinate, const Resolution& resolution)
{
  return 2 * std::int64_t(coordinate / numberAt(resolution, 2));
}

struct Raster
{
  RasterGrid Grid;
  std::vector<double> Values;
};

/// Makes a raster of points with heights, in memory, or within a limit in bytes.
Raster rasterOf(
  std::vector<double> xy, std::vector<double> heights, double resolution, std::uint64_t memory = 0)
{
  PointTable table;
  table.XY = std::move(xy);
  table.Columns.push_back({ "z", std::move(heights) });
  DemRequest request;
  request.Raster.Resolution = resolution;
  request.Threads = 2;
  TerrainSettings settings;
  BandValues samples;
  makeDem(streamTable(std::move(table), {}), request, memory, {}, settings, samples);
  return { settings.Grid, samples.front() };
}

Raster rasterOf(
  const std::vector<Node>& nodes, const Resolution& resolution, std::uint64_t memory = 0)
{
  std::vector<double> xy;
  std::vector<double> heights;
  for (const Node& node : nodes)
  {
    xy.push_back(numberAt(resolution, node.X));
    xy.push_back(numberAt(resolution, node.Y));
    heights.push_back(double(node.X % 16 + node.Y % 16));
  }
  return rasterOf(xy, heights, numberAt(resolution, 2), memory);
}

/// Twice the area of a triangle.
std::int64_t areaOf(Node a, Node b, Node c)
{
  return (b.X - a.X) * (c.Y - a.Y) - (b.Y - a.Y) * (c.X - a.X);
}

/// Checks the size of a raster of a convex polygon, and which pixels have values. The corners are
/// counter-clockwise.
void expectExact(const std::vector<Node>& polygon, const Raster& raster)
{
  const auto [left, right] =
    std::minmax_element(polygon.begin(), polygon.end(), [](Node a, Node b) { return a.X < b.X; });
  const auto [bottom, top] =
    std::minmax_element(polygon.begin(), polygon.end(), [](Node a, Node b) { return a.Y < b.Y; });
  const auto floored = [](std::int64_t halves) { return halves >> 1; };
  const auto ceiled = [](std::int64_t halves) { return (halves + 1) >> 1; };
  const std::int64_t west = floored(left->X);
  const std::int64_t south = floored(bottom->Y);
  ASSERT_EQ(std::max<std::int64_t>(1, ceiled(right->X) - west), raster.Grid.Columns);
  ASSERT_EQ(std::max<std::int64_t>(1, ceiled(top->Y) - south), raster.Grid.Rows);
  for (std::int64_t row = 0; row < raster.Grid.Rows; ++row)
  {
    for (std::int64_t column = 0; column < raster.Grid.Columns; ++column)
    {
      const Node centre{ 2 * (west + column) + 1, 2 * (south + row) + 1 };
      bool isInside = true;
      for (std::size_t i = 0; i < polygon.size(); ++i)
      {
        isInside = isInside && areaOf(polygon[i], polygon[(i + 1) % polygon.size()], centre) >= 0;
      }
      ASSERT_EQ(
        isInside, !std::isnan(raster.Values[std::size_t(row * raster.Grid.Columns + column)]))
        << "column " << column << ", row " << row;
    }
  }
}

class DemBorder : public testing::Test
{
protected:
  std::int64_t upTo(std::int64_t most)
  {
    return std::int64_t(this->Source.uniform() * double(most + 1));
  }
  /// One of the resolutions.
  Resolution resolution() { return resolutions[std::size_t(this->upTo(9))]; }
  /// A multiple of the pixel, in half pixels: near 0 or as in projected coordinates.
  std::int64_t offset(const Resolution& resolution)
  {
    const std::array<double, 5> near = { 0, -3.4, 5e5, 5e6, -123456.7 };
    return offsetNear(near[std::size_t(this->upTo(4))], resolution);
  }

  Random Source{ 7 };
};

TEST_F(DemBorder, RectanglesOfGridPointsHaveAllPixels)
{
  for (int i = 0; i < 300; ++i)
  {
    const Resolution resolution = this->resolution();
    const std::int64_t x = this->offset(resolution) + this->upTo(40);
    const std::int64_t y = this->offset(resolution) + this->upTo(40);
    const std::int64_t right = x + 1 + this->upTo(40);
    const std::int64_t top = y + 1 + this->upTo(40);
    const std::vector<Node> corners = { { x, y }, { right, y }, { right, top }, { x, top } };
    SCOPED_TRACE(testing::Message() << i << ": " << resolution.Units << "e-" << resolution.Places
                                    << ", " << x << ", " << y << ", " << right << ", " << top);
    expectExact(corners, rasterOf(corners, resolution));
  }
}

TEST_F(DemBorder, CentresOnSlantedEdgesHaveValues)
{
  for (int i = 0; i < 500; ++i)
  {
    const Resolution resolution = this->resolution();
    const std::int64_t x = this->offset(resolution);
    const std::int64_t y = this->offset(resolution);
    // Most corners are centres, so that edges pass through others.
    const auto corner = [&]() -> Node {
      return { x + 2 * this->upTo(20) + 1, y + 2 * this->upTo(20) + 1 };
    };
    std::vector<Node> triangle = { corner(), corner(), corner() };
    const std::int64_t area = areaOf(triangle[0], triangle[1], triangle[2]);
    if (area == 0)
    {
      continue;
    }
    if (area < 0)
    {
      std::swap(triangle[0], triangle[1]);
    }
    SCOPED_TRACE(testing::Message() << i << ": " << resolution.Units << "e-" << resolution.Places);
    expectExact(triangle, rasterOf(triangle, resolution));
  }
}

TEST_F(DemBorder, IsTheSameOutOfCore)
{
  constexpr std::uint64_t memory = 1 << 20;
  for (int i = 0; i < 10; ++i)
  {
    const Resolution resolution = this->resolution();
    const std::int64_t x = this->offset(resolution);
    const std::int64_t y = this->offset(resolution);
    std::vector<Node> triangle = { { x + 1, y + 1 }, { x + 2801, y + 1 + 2 * this->upTo(300) },
      { x + 1 + 2 * this->upTo(300), y + 1901 } };
    std::vector<Node> nodes = triangle;
    while (nodes.size() < 20000)
    {
      const Node node{ x + this->upTo(2800), y + this->upTo(1900) };
      const bool isInside = areaOf(triangle[0], triangle[1], node) > 0 &&
        areaOf(triangle[1], triangle[2], node) > 0 && areaOf(triangle[2], triangle[0], node) > 0;
      if (isInside)
      {
        nodes.push_back(node);
      }
    }
    const Raster expected = rasterOf(nodes, resolution);
    const Raster raster = rasterOf(nodes, resolution, memory);
    expectExact(triangle, raster);
    ASSERT_EQ(expected.Values.size(), raster.Values.size());
    for (std::size_t j = 0; j < expected.Values.size(); ++j)
    {
      ASSERT_TRUE(std::isnan(expected.Values[j]) ? std::isnan(raster.Values[j])
                                                 : expected.Values[j] == raster.Values[j]);
    }
  }
}

/// The centres of a raster's pixels, computed from the corner and the pixel size in floating point,
/// as users do.
std::vector<double> centresOf(const RasterGrid& grid)
{
  std::vector<double> xy;
  for (std::int64_t row = 0; row < grid.Rows; ++row)
  {
    for (std::int64_t column = 0; column < grid.Columns; ++column)
    {
      xy.push_back(grid.West + (double(column) + 0.5) * grid.Pixel[0]);
      xy.push_back(grid.north() - (double(grid.Rows - 1 - row) + 0.5) * grid.Pixel[1]);
    }
  }
  return xy;
}

TEST_F(DemBorder, RastersOfTheirOwnCentresAreTheSame)
{
  std::vector<Resolution> all = resolutions;
  all.push_back({ 3333333333333333, 16 });
  for (const Resolution& resolution : all)
  {
    for (const double offset : { 0.0, -1.7, 5e5, 5e6 })
    {
      const std::int64_t x = offsetNear(offset, resolution) / 2;
      const std::int64_t y = offsetNear(2 * offset, resolution) / 2;
      const double size = std::strtod(
        (std::to_string(resolution.Units) + "e-" + std::to_string(resolution.Places)).c_str(),
        nullptr);
      RasterGrid grid;
      grid.West = gridPosition(0, size, 2 * x);
      grid.South = gridPosition(0, size, 2 * y);
      grid.Pixel = { size, size };
      grid.Columns = 37;
      grid.Rows = 23;
      std::vector<double> heights;
      for (int i = 0; i < 37 * 23; ++i)
      {
        heights.push_back(i % 11);
      }
      const Raster raster = rasterOf(centresOf(grid), heights, size);
      SCOPED_TRACE(testing::Message() << size << " at " << offset);
      EXPECT_EQ(grid.West, raster.Grid.West);
      EXPECT_EQ(grid.South, raster.Grid.South);
      ASSERT_EQ(grid.Columns, raster.Grid.Columns);
      ASSERT_EQ(grid.Rows, raster.Grid.Rows);
      for (std::size_t i = 0; i < heights.size(); ++i)
      {
        // The centres are rounded, so the heights are those next to them.
        ASSERT_NEAR(heights[i], raster.Values[i], 1e-3) << i;
      }
    }
  }
}

TEST_F(DemBorder, ValuesNearTheBorderAreThoseOnIt)
{
  // A triangle a few units in the last place high at the southern border.
  const double y = 0.05;
  const double above = std::nextafter(std::nextafter(y, 1), 1);
  const Raster raster =
    rasterOf({ 0.05, above, 0.55, y, 1.05, above, 0.05, 1.05, 1.05, 1.05 }, { 0, 8, 4, 0, 0 }, 0.1);
  ASSERT_EQ(11, raster.Grid.Columns);
  for (std::size_t i = 0; i < 11; ++i)
  {
    EXPECT_LE(0, raster.Values[i]) << i;
    EXPECT_GE(8, raster.Values[i]) << i;
  }
}

} // namespace
