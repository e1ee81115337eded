// SPDX-License-Identifier: BSD-3-Clause
// The files of rows by key, which the out-of-core run and the partitioner write.
#include "ExpectIOError.h"
#include "TemporaryFolder.h"

#include "Files/OutputFile.h"
#include "Ranks/Spill.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

constexpr std::size_t keys = 5;
constexpr std::size_t rowBytes = 12;
constexpr std::size_t chunkRows = 100;

using Row = std::array<std::int32_t, 3>;

int keyOf(std::size_t row)
{
  return int(row * row % 7) - 1; // keys 0, 1 and 3; other rows (-1) are not stored
}

/// The rows from `first` on, written by one rank in `chunks` chunks.
class Written
{
public:
  Written(const TemporaryFolder& folder, int rank, std::size_t first, std::size_t chunks)
    : Rows(folder.path("rows"), rank, keys, rowBytes)
  {
    this->Rows.protect();
    for (std::size_t chunk = 0; chunk < chunks; ++chunk, first += chunkRows)
    {
      this->Rows.add(
        chunkRows, 2, [&](std::size_t i) { return keyOf(first + i); },
        [&](std::size_t i, char* to)
        {
          const Row row{ std::int32_t(first + i), 7, -1 };
          std::memcpy(to, row.data(), rowBytes);
        });
    }
  }

  Spill Rows;
};

/// Rows written by a single rank, for reading.
class WrittenAlone : public Written
{
public:
  WrittenAlone(const TemporaryFolder& folder, std::size_t chunks)
    : Written(folder, 0, 0, chunks)
  {
    Communicator alone(nullptr);
    this->Rows.exchange(alone);
  }
};

std::vector<std::int32_t> numbersOf(const Spill& spill, std::size_t key)
{
  const std::vector<char> bytes = spill.readAll(key);
  std::vector<std::int32_t> numbers;
  for (std::size_t at = 0; at < bytes.size(); at += rowBytes)
  {
    Row row{};
    std::memcpy(row.data(), bytes.data() + at, rowBytes);
    numbers.push_back(row[0]);
  }
  return numbers;
}

std::vector<std::int32_t> expectedNumbers(std::size_t key, std::size_t rows)
{
  std::vector<std::int32_t> numbers;
  for (std::size_t row = 0; row < rows; ++row)
  {
    if (keyOf(row) == int(key))
    {
      numbers.push_back(std::int32_t(row));
    }
  }
  return numbers;
}

TEST(Spill, ReadsEachKeysRowsInTheOrderOfTheChunks)
{
  const TemporaryFolder folder;
  const WrittenAlone written(folder, 4);
  for (std::size_t key = 0; key < keys; ++key)
  {
    EXPECT_EQ(expectedNumbers(key, 4 * chunkRows), numbersOf(written.Rows, key));
    EXPECT_EQ(numbersOf(written.Rows, key).size(), std::size_t(written.Rows.rows(key)));
  }
}

TEST(Spill, ReadsRowsInBlocks)
{
  const TemporaryFolder folder;
  const WrittenAlone written(folder, 4);
  std::vector<std::int32_t> numbers;
  written.Rows.read(1, 30,
    [&](const char* rows, std::size_t count)
    {
      EXPECT_LE(count, 30U);
      for (std::size_t i = 0; i < count; ++i)
      {
        numbers.emplace_back();
        std::memcpy(&numbers.back(), rows + i * rowBytes, 4);
      }
    });
  EXPECT_EQ(expectedNumbers(1, 4 * chunkRows), numbers);
}

TEST(Spill, JoinsTheRowsOfRanksInTheirOrder)
{
  const TemporaryFolder folder;
  Written first(folder, 0, 0, 3);
  Written second(folder, 1, 3 * chunkRows, 2);
  const auto ofFirst = first.Rows.close();
  const auto ofSecond = second.Rows.close();
  const Spill joined(folder.path("rows"), keys, rowBytes, { ofFirst, ofSecond });
  const Spill back(folder.path("rows"), keys, rowBytes, joined.content());
  for (std::size_t key = 0; key < keys; ++key)
  {
    EXPECT_EQ(expectedNumbers(key, 5 * chunkRows), numbersOf(joined, key));
    EXPECT_EQ(expectedNumbers(key, 5 * chunkRows), numbersOf(back, key));
  }
}

TEST(Spill, SavedStateDoesNotGrowWithChunksTimesKeys)
{
  const TemporaryFolder folder;
  const std::size_t few = packed(WrittenAlone(folder, 10).Rows.content()).size();
  EXPECT_EQ(
    few + 20 * sizeof(std::uint64_t), packed(WrittenAlone(folder, 30).Rows.content()).size());
}

TEST(Spill, ReportsADamagedList)
{
  const TemporaryFolder folder;
  const WrittenAlone written(folder, 2);
  const std::uint32_t wrong = 77;
  OutputFile::shared(folder.path("rows.0")).write(4, &wrong, 4); // start of key 1
  for (const std::size_t key : { std::size_t(0), std::size_t(1) })
  {
    expectIOError(folder.path("rows.0"), "is damaged", [&] { written.Rows.readAll(key); });
  }
  EXPECT_EQ(expectedNumbers(3, 2 * chunkRows), numbersOf(written.Rows, 3));
}

TEST(Spill, RefusesTheStateOfAnotherSpill)
{
  const TemporaryFolder folder;
  const SpilledRows saved = WrittenAlone(folder, 2).Rows.content();
  const auto expectRefusal = [&](const SpilledRows& rows)
  {
    expectIOError(folder.path("rows"), "other pieces",
      [&] { Spill(folder.path("rows"), keys, rowBytes, rows); });
  };
  SpilledRows fewer = saved;
  fewer.Counts.pop_back();
  expectRefusal(fewer);
  fewer = saved;
  fewer.Checksums.pop_back();
  expectRefusal(fewer);
  fewer = saved;
  fewer.Files.clear();
  expectRefusal(fewer);
}

} // namespace
