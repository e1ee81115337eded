// SPDX-License-Identifier: BSD-3-Clause
#include "Kernel/InsertionOrder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

namespace
{

using tipp::hilbertKey;

constexpr std::uint32_t Side = 1U << 16;

// The cells of the square at the curve's start, sorted by their keys. `side` is a power of two.
std::vector<std::pair<int, int>> cellsByKey(std::uint32_t side)
{
  std::vector<std::pair<int, int>> cells(std::size_t(side) * side, { -1, -1 });
  for (std::uint32_t x = 0; x < side; ++x)
  {
    for (std::uint32_t y = 0; y < side; ++y)
    {
      cells.at(hilbertKey(x, y)) = { int(x), int(y) };
    }
  }
  return cells;
}

TEST(HilbertKeys, AreUniqueForEachCellOfASquare)
{
  for (const auto& cell : cellsByKey(256))
  {
    EXPECT_LE(0, cell.first);
  }
}

TEST(HilbertKeys, SuccessiveKeysAreOfAdjacentCells)
{
  const std::vector<std::pair<int, int>> cells = cellsByKey(256);
  for (std::size_t i = 1; i < cells.size(); ++i)
  {
    ASSERT_EQ(1,
      std::abs(cells[i].first - cells[i - 1].first) +
        std::abs(cells[i].second - cells[i - 1].second));
  }
}

TEST(HilbertKeys, OfASquareOfCellsAreARange)
{
  for (std::uint32_t x = 0; x < Side; x += 4096)
  {
    for (std::uint32_t y = 0; y < Side; y += 4096)
    {
      const std::uint32_t quarter = hilbertKey(x, y) >> 24;
      ASSERT_EQ(quarter, hilbertKey(x + 4095, y) >> 24);
      ASSERT_EQ(quarter, hilbertKey(x, y + 4095) >> 24);
      ASSERT_EQ(quarter, hilbertKey(x + 1234, y + 3021) >> 24);
    }
  }
}

TEST(HilbertKeys, BeginAndEndOnOneSide)
{
  EXPECT_EQ(0U, hilbertKey(0, 0));
  EXPECT_EQ(0xffffffffU, hilbertKey(Side - 1, 0));
}

} // namespace
