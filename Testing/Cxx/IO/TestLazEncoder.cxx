// SPDX-License-Identifier: BSD-3-Clause
#include "Files/RawValues.h"
#include "Laz/LazChunk.h"
#include "Laz/LazEncoder.h"
#include "LazText.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace
{

using namespace tipp;
using namespace tipp::test;

using Bytes = std::vector<std::uint8_t>;

Bytes encode(const LazFormat& format, const Bytes& records)
{
  Bytes bytes;
  LazChunkEncoder(format).encode(records.size() / format.RecordLength, records.data(), bytes);
  return bytes;
}

/// Decodes a chunk, and expects that it ends where the bytes end.
Bytes decode(const LazFormat& format, const Bytes& bytes, std::size_t count)
{
  Bytes records(count * format.RecordLength);
  LazChunk chunk(format);
  chunk.begin(bytes.data(), bytes.size());
  chunk.read(count, records.data());
  EXPECT_EQ(chunk.position(), bytes.size());
  return records;
}

void expectRoundTrip(const LazFormat& format, const Bytes& records)
{
  const Bytes bytes = encode(format, records);
  EXPECT_TRUE(decode(format, bytes, records.size() / format.RecordLength) == records);
}

Bytes randomBytes(std::mt19937& random, std::size_t count)
{
  Bytes bytes(count);
  std::generate(bytes.begin(), bytes.end(), [&random] { return std::uint8_t(random()); });
  return bytes;
}

/// Records that are mostly like the one before: each byte changes with a probability of its own.
Bytes similarRecords(std::mt19937& random, const LazFormat& format, std::size_t count)
{
  Bytes records = randomBytes(random, format.RecordLength);
  std::vector<unsigned> stays(format.RecordLength);
  std::generate(stays.begin(), stays.end(), [&random] { return random() % 4 * 80; });
  for (std::size_t i = 1; i < count; ++i)
  {
    for (std::size_t k = 0; k < format.RecordLength; ++k)
    {
      const std::uint8_t last = records[(i - 1) * format.RecordLength + k];
      const bool isSame = random() % 256 < stays[k];
      records.push_back(isSame ? last : std::uint8_t(last + random() % 5 - 2));
    }
  }
  return records;
}

/// The chunks and the table are those that lazrs made of the same points.
TEST(LazEncoder, MakesTheBytesOfAnotherEncoder)
{
  for (const LazInput& input : lazInputs)
  {
    if (input.Format < 6 || input.Format > 8)
    {
      continue;
    }
    constexpr std::size_t extraBytes = 2;
    constexpr std::size_t chunkPoints = 16;
    const LazFormat format = LazFormat::layered(input.Format, extraBytes);
    const std::string expected = textOfDigits(input.Data);
    Bytes bytes(8);
    std::vector<std::uint32_t> sizes;
    LazChunkEncoder encoder(format);
    for (std::size_t first = 0; first < lazInputPoints; first += chunkPoints)
    {
      const std::size_t count = std::min(chunkPoints, lazInputPoints - first);
      Bytes records;
      for (std::size_t i = first; i < first + count; ++i)
      {
        const Bytes record = recordOf(input.Format, i);
        records.insert(records.end(), record.begin(), record.end());
      }
      const std::size_t before = bytes.size();
      encoder.encode(count, records.data(), bytes);
      sizes.push_back(std::uint32_t(bytes.size() - before));
    }
    setValue(bytes.data(), std::uint64_t(bytes.size()));
    const Bytes table = writeLazChunkTable(sizes);
    bytes.insert(bytes.end(), table.begin(), table.end());
    EXPECT_EQ(std::string(bytes.begin(), bytes.end()), expected.substr(0, bytes.size()))
      << input.Format;
    EXPECT_LE(expected.size() - bytes.size(), 4U); // lazrs adds zeros
  }
}

TEST(LazEncoder, FormatIsReadBackFromItsRecord)
{
  for (int pointFormat = 6; pointFormat <= 8; ++pointFormat)
  {
    const LazFormat format = LazFormat::layered(pointFormat, 5);
    const Bytes content = format.record();
    const LazFormat again(content.data(), content.size());
    EXPECT_EQ(again.RecordLength, format.RecordLength);
    EXPECT_EQ(again.ChunkPoints, LazFormat::UsualChunkPoints);
    EXPECT_EQ(again.Items.size(), format.Items.size());
    EXPECT_EQ(again.record(), content);
  }
}

TEST(LazEncoder, ArbitraryPointsComeBack)
{
  std::mt19937 random(3);
  for (int round = 0; round < 200; ++round)
  {
    const LazFormat format = LazFormat::layered(6 + int(random() % 3), random() % 12);
    const std::size_t count = random() % 300 + 1;
    const bool isRandom = round % 4 == 0;
    expectRoundTrip(format,
      isRandom ? randomBytes(random, count * format.RecordLength)
               : similarRecords(random, format, count));
  }
}

TEST(LazEncoder, EqualPointsTakeFewBytes)
{
  const LazFormat format = LazFormat::layered(8, 3);
  const Bytes first = recordOf(8, 5);
  Bytes records;
  for (int i = 0; i < 10000; ++i)
  {
    records.insert(records.end(), first.begin(), first.end());
    records.push_back(7);
  }
  expectRoundTrip(format, records);
  EXPECT_LT(encode(format, records).size(), 500U);
}

TEST(LazEncoder, IsTheSameWhenUsedAgain)
{
  std::mt19937 random(4);
  const LazFormat format = LazFormat::layered(8, 3);
  LazChunkEncoder encoder(format);
  for (int round = 0; round < 5; ++round)
  {
    const Bytes records = similarRecords(random, format, 500);
    Bytes bytes;
    encoder.encode(500, records.data(), bytes);
    EXPECT_EQ(encode(format, records), bytes);
  }
}

TEST(LazEncoder, CoordinatesOfAnySizeComeBack)
{
  const LazFormat format = LazFormat::layered(6, 0);
  std::mt19937 random(5);
  constexpr std::int32_t low = std::numeric_limits<std::int32_t>::min();
  constexpr std::int32_t high = std::numeric_limits<std::int32_t>::max();
  constexpr std::array<std::int32_t, 7> corners = { low, high, 0, -1, 1, high - 1, low + 1 };
  Bytes records(2000 * format.RecordLength);
  for (std::size_t i = 0; i < 2000; ++i)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const std::int32_t some = std::int32_t(random()) >> (random() % 32);
      setValue(&records[i * format.RecordLength + 4 * axis],
        random() % 2 == 0 ? corners[random() % corners.size()] : some);
    }
  }
  expectRoundTrip(format, records);
}

/// Points of several channels, whose return numbers change in all ways.
TEST(LazEncoder, ReturnsOfScannerChannelsComeBack)
{
  const LazFormat format = LazFormat::layered(7, 1);
  std::mt19937 random(6);
  Bytes records = similarRecords(random, format, 5000);
  for (std::size_t i = 0; i < 5000; ++i)
  {
    std::uint8_t* const record = &records[i * format.RecordLength];
    record[14] = std::uint8_t(i % 256 + (i / 256 % 2) * (random() % 16));
    record[15] = std::uint8_t((record[15] & 0xCFU) | (random() % 4 << 4));
    setValue(record + 22, double(i / 3));
  }
  expectRoundTrip(format, records);
}

Bytes recordsOfTimes(const std::function<std::uint64_t(std::size_t)>& time, std::size_t count)
{
  const LazFormat format = LazFormat::layered(6, 0);
  Bytes records(count * format.RecordLength);
  for (std::size_t i = 0; i < count; ++i)
  {
    setValue(&records[i * format.RecordLength + 22], time(i));
  }
  return records;
}

TEST(LazEncoder, TimesOfAllKindsComeBack)
{
  const LazFormat format = LazFormat::layered(6, 0);
  std::mt19937_64 random(7);
  const auto bitsOf = [](double value) { return valueAt<std::uint64_t>(&value); };
  const std::uint64_t start = bitsOf(4e5);
  std::uint64_t last = start;
  const auto expectTimes = [&](const auto& time)
  {
    last = start;
    expectRoundTrip(format, recordsOfTimes(time, 3000));
  };
  // A constant pulse rate, with the end of a week, and repeated times.
  expectTimes(
    [&](std::size_t i) { return bitsOf(std::fmod(604799.9 + double(i / 3) * 1e-4, 604800)); });
  // Multiples of a step, up to those that begin a new one.
  expectTimes([&](std::size_t) { return last += (random() % 1400 - 700) * 1000; });
  // Steps of any number of bits.
  expectTimes([&](std::size_t) { return last += random() >> (random() % 64); });
  // More interleaved sequences than there are models.
  expectTimes([&](std::size_t i) { return start + (std::uint64_t(i % 5) << 45) + i * 977; });
  expectTimes([&](std::size_t) { return random(); });
}

} // namespace
