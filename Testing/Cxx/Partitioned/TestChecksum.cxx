// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/Checksum.h"

// The library's own code for any processor: this file is not compiled for AVX2.
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <gtest/gtest.h>

#include <vector>

namespace
{

std::vector<unsigned char> someBytes(std::size_t count)
{
  std::vector<unsigned char> bytes(count);
  std::uint32_t state = 1;
  for (unsigned char& byte : bytes)
  {
    state = state * 1664525 + 1013904223;
    byte = static_cast<unsigned char>(state >> 24);
  }
  return bytes;
}

const std::vector<std::size_t> sizes = { 0, 1, 3, 8, 9, 16, 17, 128, 129, 240, 241, 1023, 1024,
  1025, 4096, 65537, 1000003 };

} // namespace

TEST(Checksum, IsTheLibrarysOnEveryProcessor)
{
  for (const std::size_t size : sizes)
  {
    const std::vector<unsigned char> bytes = someBytes(size);
    EXPECT_EQ(tipp::checksumOf(bytes.data(), size), XXH3_64bits(bytes.data(), size)) << size;
  }
}

TEST(Checksum, OfPartsIsThatOfTheWhole)
{
  tipp::Checksum checksum;
  for (const std::size_t size : sizes)
  {
    const std::vector<unsigned char> bytes = someBytes(size);
    checksum.add(bytes.data(), size / 3);
    checksum.add(bytes.data() + size / 3, size - size / 3);
    EXPECT_EQ(checksum.finish(), XXH3_64bits(bytes.data(), size)) << size;
  }
}
