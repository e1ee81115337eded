// SPDX-License-Identifier: BSD-3-Clause
#include "Files/Checksum.h"

// xxHash without vector instructions, inlined into this file.
#define XXH_INLINE_ALL
#define XXH_VECTOR XXH_SCALAR
#include <xxhash.h>

#include <gtest/gtest.h>

#include <algorithm>
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

#if defined(__x86_64__)
namespace
{

/// If the processor has AVX2, Checksum.cxx calls ChecksumAvx2.cxx. Tested for long inputs at any
/// alignment, split anywhere.
class ChecksumAvx2 : public testing::Test
{
protected:
  void SetUp() override
  {
    if (!__builtin_cpu_supports("avx2"))
    {
      GTEST_SKIP() << "this processor has no AVX2";
    }
  }

  const std::vector<unsigned char> Bytes = someBytes(300000);
};

} // namespace

TEST_F(ChecksumAvx2, EqualsTheCommonCodeAtEveryAlignment)
{
  for (std::size_t offset = 0; offset < 64; ++offset)
  {
    for (const std::size_t size : { 241, 1024, 4095, 65536, 262144 + 17 })
    {
      const unsigned char* const data = this->Bytes.data() + offset;
      EXPECT_EQ(XXH3_64bits(data, size), tipp::checksumOf(data, size)) << offset << " " << size;
    }
  }
}

TEST_F(ChecksumAvx2, EqualsTheCommonCodeHoweverTheBytesAreSplit)
{
  const std::uint64_t expected = XXH3_64bits(this->Bytes.data(), this->Bytes.size());
  tipp::Checksum checksum;
  for (const std::size_t step : { 1, 63, 64, 255, 257, 1023, 1025, 4096, 65537, 262144 })
  {
    for (std::size_t at = 0; at < this->Bytes.size(); at += step)
    {
      checksum.add(this->Bytes.data() + at, std::min(step, this->Bytes.size() - at));
    }
    EXPECT_EQ(expected, checksum.finish()) << step;
  }
}
#endif
