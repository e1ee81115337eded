// SPDX-License-Identifier: BSD-3-Clause
#include "Files/Checksum.h"
#include "Laz/LazChunk.h"
#include "LazInputs.h"
#include "SharedData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <random>
#include <thread>

namespace
{

using namespace tipp;
using namespace tipp::test;

using Bytes = std::vector<std::uint8_t>;

Bytes bytesOf(const std::string& digits)
{
  Bytes bytes;
  for (std::size_t i = 0; i < digits.size(); i += 2)
  {
    bytes.push_back(std::uint8_t(std::stoi(digits.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

template <typename T>
T valueOf(const Bytes& bytes, std::size_t at)
{
  T value{};
  if (at <= bytes.size() && sizeof value <= bytes.size() - at)
  {
    std::memcpy(&value, &bytes[at], sizeof value);
  }
  return value;
}

/// Compressed points: the record of the compression, and a file's bytes.
struct Compressed
{
  Bytes Record;
  Bytes File;
  std::uint64_t Begin = 0; ///< of the offset of the chunk table
  std::uint64_t Points = 0;

  explicit Compressed(const LazInput& input)
    : Record(bytesOf(input.Record))
    , File(bytesOf(input.Data))
    , Points(lazInputPoints)
  {
  }

  /// Of a LAZ file.
  explicit Compressed(const std::string& path)
  {
    std::ifstream stream(path, std::ios::binary);
    this->File.assign(std::istreambuf_iterator<char>(stream), {});
    this->Begin = valueOf<std::uint32_t>(this->File, 96);
    this->Points = valueOf<std::uint32_t>(this->File, 107);
    if (this->Points == 0 && valueOf<std::uint8_t>(this->File, 25) >= 4)
    {
      this->Points = valueOf<std::uint64_t>(this->File, 247);
    }
    std::size_t at = valueOf<std::uint16_t>(this->File, 94);
    while (valueOf<std::uint16_t>(this->File, at + 18) != 22204)
    {
      at += 54U + valueOf<std::uint16_t>(this->File, at + 20);
    }
    const auto content = this->File.begin() + std::ptrdiff_t(at) + 54;
    this->Record.assign(content, content + valueOf<std::uint16_t>(this->File, at + 20));
  }

  LazFormat format() const { return LazFormat(this->Record.data(), this->Record.size()); }

  std::vector<LazChunkPlace> places() const
  {
    const auto table = valueOf<std::uint64_t>(this->File, this->Begin);
    if (this->Points == 0 || table > this->File.size() || table < this->Begin + 8)
    {
      return {};
    }
    return readLazChunkTable(this->format(), this->File.data() + table,
      this->File.size() - std::size_t(table), this->Points, this->Begin + 8, table)
      .Chunks;
  }

  void begin(LazChunk& chunk, const LazChunkPlace& place) const
  {
    chunk.begin(this->File.data() + place.Begin, std::size_t(place.Bytes));
  }

  /// Decodes all points, `most` at a time.
  Bytes decode(unsigned attributes = laz::All, std::uint64_t most = 1000) const
  {
    const LazFormat format = this->format();
    Bytes records(std::size_t(this->Points) * format.RecordLength);
    LazChunk chunk(format, attributes);
    for (const LazChunkPlace& place : this->places())
    {
      this->begin(chunk, place);
      for (std::uint64_t done = 0; done < place.Points;)
      {
        const std::uint64_t count = std::min(most, place.Points - done);
        chunk.read(std::size_t(count),
          records.data() + std::size_t(place.FirstPoint + done) * format.RecordLength);
        done += count;
      }
      EXPECT_EQ(chunk.position(), place.Bytes);
    }
    return records;
  }
};

Bytes recordsOf(int format)
{
  Bytes records;
  for (std::size_t i = 0; i < lazInputPoints; ++i)
  {
    const Bytes record = recordOf(format, i);
    records.insert(records.end(), record.begin(), record.end());
  }
  return records;
}

TEST(Laz, DecodesEachFormat)
{
  for (const LazInput& input : lazInputs)
  {
    const Compressed compressed(input);
    EXPECT_EQ(compressed.decode(), recordsOf(input.Format)) << input.Format;
    EXPECT_EQ(compressed.decode(laz::All, 3), recordsOf(input.Format)) << input.Format;
  }
}

// The checksums of the records that lazrs 0.8.2 and LASzip 3.4 decode.
TEST(Laz, DecodesRealFilesToTheBit)
{
  TIPP_REQUIRE_DATA(folder, "laz");
  // clang-format off
  const std::vector<std::pair<std::string, std::uint64_t>> files = {
  { "1_4_w_evlr.laz", 0x1bcc7c93fe9b18d6 },
  { "append-bug.laz", 0xb794f3816e2bb88d },
  { "autzen_trim.laz", 0x36687ecaa034bb56 },
  { "extra.laz", 0xed489abf5b59d116 },
  { "fullwave.laz", 0x9178359c96dd98b6 },
  { "lone-star.copc.laz", 0x6e4f47a6d2a0f069 },
  { "no-points-1.3.laz", 0x2d06800538d394c2 },
  { "plane.laz", 0xc91fd52842b1b1df },
  { "point-color.laz", 0xc3e5557afe56254b },
  { "point-time-1.4.laz", 0xcda2f2621cd7aa12 },
  { "simple.copc.laz", 0x70e7db383f302008 },
  { "simple.laz", 0xddea711d08c487d5 },
  { "simple_with_page.copc.laz", 0x70e7db383f302008 },
  };
  // clang-format on
  for (const auto& [name, checksum] : files)
  {
    const Bytes records = Compressed(folder + "/" + name).decode();
    EXPECT_EQ(checksumOf(records.data(), records.size()), checksum) << name;
  }
}

TEST(Laz, LeavesAttributesThatAreNotAskedFor)
{
  for (const LazInput& input : lazInputs)
  {
    const Compressed compressed(input);
    if (!compressed.format().IsLayered)
    {
      continue;
    }
    const Bytes all = recordsOf(input.Format);
    const Bytes some = compressed.decode(laz::Z | laz::Class);
    const std::size_t length = compressed.format().RecordLength;
    for (std::size_t i = 0; i < lazInputPoints; ++i)
    {
      const std::uint8_t* const decoded = &some[i * length];
      EXPECT_EQ(std::memcmp(decoded, &all[i * length], 12), 0) << input.Format << ' ' << i;
      EXPECT_EQ(decoded[14], all[i * length + 14]);
      EXPECT_EQ(decoded[16], all[i * length + 16]);
      const std::size_t firstOfChunk = i / 16 * 16;
      EXPECT_EQ(decoded[17], all[firstOfChunk * length + 17]);
      EXPECT_EQ(std::memcmp(decoded + 18, &all[firstOfChunk * length + 18], length - 18), 0);
    }
  }
}

TEST(Laz, TwoChunksTogetherAreTheSame)
{
  for (const LazInput& input : lazInputs)
  {
    const Compressed compressed(input);
    const std::vector<LazChunkPlace> places = compressed.places();
    const LazFormat format = compressed.format();
    Bytes records(32 * format.RecordLength);
    LazChunk first(format);
    LazChunk second(format);
    compressed.begin(first, places[0]);
    compressed.begin(second, places[1]);
    std::uint8_t* const to = records.data();
    std::uint8_t* const secondTo = to + 16 * format.RecordLength;
    first.readWith(second, 5, to, secondTo);
    const std::size_t done = 5 * format.RecordLength;
    first.readWith(second, 11, to + done, secondTo + done);
    Bytes expected = recordsOf(input.Format);
    expected.resize(records.size());
    EXPECT_EQ(records, expected) << input.Format;
  }
}

TEST(Laz, ThreadsDecodeChunksInAnyOrder)
{
  const Compressed compressed(lazInputs[7]);
  const LazFormat format = compressed.format();
  const std::vector<LazChunkPlace> places = compressed.places();
  Bytes records(lazInputPoints * format.RecordLength);
  std::vector<std::thread> threads;
  for (auto place = places.rbegin(); place != places.rend(); ++place)
  {
    threads.emplace_back(
      [&, place]
      {
        LazChunk chunk(format);
        compressed.begin(chunk, *place);
        chunk.read(std::size_t(place->Points),
          records.data() + std::size_t(place->FirstPoint) * format.RecordLength);
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  EXPECT_EQ(records, recordsOf(lazInputs[7].Format));
}

TEST(Laz, ChunksFollowEachOtherWithoutATable)
{
  for (const LazInput& input : lazInputs)
  {
    const Compressed compressed(input);
    const LazFormat format = compressed.format();
    LazChunk chunk(format);
    Bytes records(lazInputPoints * format.RecordLength);
    std::size_t at = 8;
    for (std::size_t first = 0; first < lazInputPoints; first += format.ChunkPoints)
    {
      chunk.begin(&compressed.File[at], compressed.File.size() - at);
      chunk.read(std::min<std::size_t>(format.ChunkPoints, lazInputPoints - first),
        &records[first * format.RecordLength]);
      at += chunk.position();
    }
    EXPECT_EQ(records, recordsOf(input.Format)) << input.Format;
    EXPECT_EQ(at, valueOf<std::uint64_t>(compressed.File, 0)) << input.Format;
  }
}

TEST(Laz, EndsWhereBytesAreMissing)
{
  for (const LazInput& input : lazInputs)
  {
    const Compressed compressed(input);
    const LazFormat format = compressed.format();
    const LazChunkPlace place = compressed.places().front();
    Bytes records(16 * format.RecordLength);
    for (std::size_t size = 0; size + 4 < place.Bytes; ++size)
    {
      // A copy of its own size, past whose end a sanitizer sees every read.
      const Bytes part(compressed.File.begin() + 8, compressed.File.begin() + 8 + long(size));
      LazChunk chunk(format);
      const auto read = [&]
      {
        chunk.begin(part.data(), part.size());
        chunk.read(16, records.data());
      };
      EXPECT_THROW(read(), LazError) << input.Format << ' ' << size;
    }
  }
}

TEST(Laz, RefusesATableWithTooFewPoints)
{
  Compressed compressed(lazInputs.front());
  compressed.Points = 49;
  EXPECT_THROW(compressed.places(), LazError);
}

/// Decodes what a damaged input has, of up to 64 points a chunk.
void decodeMutant(const Compressed& compressed)
{
  try
  {
    const LazFormat format = compressed.format();
    Bytes records(64 * format.RecordLength);
    LazChunk chunk(format);
    if (compressed.File.size() > 8)
    {
      chunk.begin(&compressed.File[8], compressed.File.size() - 8);
      chunk.read(64, records.data());
    }
    LazChunk other(format, laz::Z | laz::Class);
    Bytes otherRecords(records.size());
    for (const LazChunkPlace& place : compressed.places())
    {
      compressed.begin(chunk, place);
      compressed.begin(other, place);
      const auto count = std::min<std::size_t>(64, std::size_t(place.Points));
      chunk.readWith(other, count, records.data(), otherRecords.data());
    }
  }
  catch (const LazError&)
  {
  }
}

TEST(Laz, SurvivesMutants)
{
  constexpr int mutants = 10000;
  const std::vector<Compressed> inputs(lazInputs.begin(), lazInputs.end());
  std::mt19937 random(49);
  for (int i = 0; i < mutants; ++i)
  {
    Compressed mutant = inputs[random() % inputs.size()];
    for (unsigned changes = random() % 4 + 1; changes > 0; --changes)
    {
      Bytes& bytes = random() % 8 == 0 ? mutant.Record : mutant.File;
      bytes[random() % bytes.size()] = std::uint8_t(random());
    }
    if (random() % 8 == 0)
    {
      mutant.File.resize(random() % mutant.File.size());
    }
    decodeMutant(mutant);
  }
}

} // namespace
