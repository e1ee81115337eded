// SPDX-License-Identifier: BSD-3-Clause
#include "Check/PixelSizes.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <utility>

namespace tipp
{
namespace check
{
namespace
{

/// Replaces each of `count` numbers, which are `step` apart, by the largest of those at most
/// `reach` indices away. NaN is smaller than any number.
void takeLargest(double* numbers, std::size_t count, std::size_t step, std::size_t reach)
{
  std::deque<std::pair<std::size_t, double>> falling; // the candidates, the largest first
  std::size_t next = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    for (; next < count && next <= i + reach; ++next)
    {
      const double number = numbers[next * step];
      while (!falling.empty() && !(falling.back().second > number) && !std::isnan(number))
      {
        falling.pop_back();
      }
      if (!std::isnan(number))
      {
        falling.emplace_back(next, number);
      }
    }
    while (!falling.empty() && falling.front().first + reach < i)
    {
      falling.pop_front();
    }
    numbers[i * step] =
      falling.empty() ? std::numeric_limits<double>::quiet_NaN() : falling.front().second;
  }
}

/// Returns the index of the pixel at a coordinate, or of the nearest one.
std::size_t pixelAt(double coordinate, double first, double pixel, std::size_t count)
{
  // With this order of arguments NaN becomes 0.
  const double index = std::max(0.0, std::floor((coordinate - first) / pixel + 0.5));
  return index < double(count) ? std::size_t(index) : count - 1;
}

std::size_t pixelsIn(double reach, double pixel, std::size_t count)
{
  const double pixels = std::ceil(reach / pixel) + 1;
  return pixels < double(count) ? std::size_t(pixels) : count;
}

} // namespace

PixelSizes::PixelSizes(
  std::vector<double> sizes, std::size_t columns, Position first, Position pixel)
  : Sizes(std::move(sizes))
  , Columns(columns)
  , First(first)
  , Pixel(pixel)
{
}

double PixelSizes::smallest() const
{
  double smallest = std::numeric_limits<double>::infinity();
  for (const double size : this->Sizes)
  {
    smallest = size < smallest ? size : smallest; // NaN is not
  }
  return smallest;
}

void PixelSizes::spread(Position reach)
{
  const std::size_t rows = this->Sizes.size() / this->Columns;
  const std::size_t across = pixelsIn(reach.x, this->Pixel.x, this->Columns);
  const std::size_t up = pixelsIn(reach.y, this->Pixel.y, rows);
  for (std::size_t row = 0; row < rows; ++row)
  {
    takeLargest(this->Sizes.data() + row * this->Columns, this->Columns, 1, across);
  }
  for (std::size_t column = 0; column < this->Columns; ++column)
  {
    takeLargest(this->Sizes.data() + column, rows, this->Columns, up);
  }
}

double PixelSizes::at(Position p) const
{
  const std::size_t rows = this->Sizes.size() / this->Columns;
  const std::size_t column = pixelAt(p.x, this->First.x, this->Pixel.x, this->Columns);
  const std::size_t row = pixelAt(p.y, this->First.y, this->Pixel.y, rows);
  const double size = this->Sizes[row * this->Columns + column];
  return std::isnan(size) ? std::numeric_limits<double>::infinity() : size;
}

} // namespace check
} // namespace tipp
