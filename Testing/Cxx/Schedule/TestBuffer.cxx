// SPDX-License-Identifier: BSD-3-Clause
#include "Arrays/Buffer.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <numeric>
#include <utility>

namespace
{

using namespace tipp;

/// Less than a page, and many pages.
constexpr std::size_t Sizes[] = { 1, 1000, 3000000 };

Buffer<int> counting(std::size_t size)
{
  Buffer<int> buffer(size);
  std::iota(buffer.begin(), buffer.end(), 0);
  return buffer;
}

TEST(Buffer, HoldsWhatIsWritten)
{
  for (const std::size_t size : Sizes)
  {
    const Buffer<int> buffer = counting(size);
    ASSERT_EQ(size, buffer.size());
    EXPECT_EQ(int(size) - 1, buffer[size - 1]);
    EXPECT_EQ(std::ptrdiff_t(size), buffer.end() - buffer.begin());
  }
}

TEST(Buffer, WithoutElementsIsEmpty)
{
  EXPECT_TRUE(Buffer<int>().empty());
  EXPECT_TRUE(Buffer<int>(0).empty());
  EXPECT_EQ(nullptr, Buffer<int>(0).data());
}

TEST(Buffer, TruncatingKeepsTheFirstElements)
{
  Buffer<int> buffer = counting(100);
  buffer.truncate(7);
  EXPECT_EQ(7U, buffer.size());
  EXPECT_EQ(6, *(buffer.end() - 1));
}

TEST(Buffer, ReleasedMemoryIsFreedWithFree)
{
  for (const std::size_t size : Sizes)
  {
    Buffer<int> buffer = counting(size);
    int* const memory = buffer.release();
    EXPECT_TRUE(buffer.empty());
    EXPECT_EQ(nullptr, buffer.data());
    EXPECT_EQ(int(size) - 1, memory[size - 1]);
    std::free(memory);
  }
}

TEST(Buffer, MovingTransfersTheMemory)
{
  Buffer<int> buffer = counting(100);
  const int* const memory = buffer.data();
  const Buffer<int> other = std::move(buffer);
  EXPECT_EQ(memory, other.data());
  EXPECT_EQ(100U, other.size());
}

TEST(Buffer, AMovedFromBufferIsEmpty)
{
  Buffer<int> buffer = counting(100);
  const Buffer<int> other = std::move(buffer);
  EXPECT_EQ(nullptr, buffer.data());
  EXPECT_TRUE(buffer.empty());
}

/// Computed modulo 2^64, the larger count of bytes would be a small number.
TEST(Buffer, MoreThanCanBeAddressedThrows)
{
  constexpr std::size_t most = std::numeric_limits<std::size_t>::max();
  EXPECT_THROW(Buffer<char>(most / 2 + 1), std::bad_alloc);
  EXPECT_THROW(Buffer<double>(most / sizeof(double) + 2), std::bad_alloc);
}

} // namespace
