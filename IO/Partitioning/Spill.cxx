// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/Spill.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Parallel/ParallelFor.h"

#include <array>
#include <cstring>
#include <optional>

namespace tipp
{
namespace
{

using Words = std::vector<std::uint64_t>;

/// Reads numbers from a list, which may end early.
class WordReader
{
public:
  WordReader(const std::string& path, const Words& words)
    : Path(path)
    , Left(words)
  {
  }

  Words take(std::uint64_t count)
  {
    if (count > this->Left.size() - this->At)
    {
      throw IOError(this->Path, "has rows of other pieces; start again.");
    }
    const auto begin = this->Left.begin() + std::ptrdiff_t(this->At);
    this->At += std::size_t(count);
    return { begin, begin + std::ptrdiff_t(count) };
  }
  std::uint64_t take() { return this->take(1)[0]; }

private:
  const std::string& Path;
  const Words& Left;
  std::size_t At = 0;
};

void append(Words& words, const Words& more)
{
  words.insert(words.end(), more.begin(), more.end());
}

/// Combines the checksums of a key's rows in several files.
std::uint64_t combined(std::uint64_t sum, std::uint64_t next)
{
  const std::array<std::uint64_t, 2> both{ sum, next };
  return checksumOf(both.data(), sizeof(both));
}

} // namespace

std::string Spill::fileOf(const std::string& path, std::size_t rank)
{
  return path + "." + std::to_string(rank);
}

void Spill::refuse(const std::string& file)
{
  throw IOError(file,
    "is damaged: it does not hold what was written to it; remove its folder and start again.");
}

Spill::Spill(const std::string& path, int rank, std::size_t keys, std::size_t rowBytes)
  : Path(path)
  , Keys(keys)
  , RowBytes(rowBytes)
  , Out(std::in_place, fileOf(path, std::size_t(rank)))
  , Rows(keys, 0)
{
}

Spill::Spill(const std::string& path, std::size_t keys, std::size_t rowBytes, const Words& saved)
  : Path(path)
  , Keys(keys)
  , RowBytes(rowBytes)
{
  WordReader words(this->Path, saved);
  for (const std::uint64_t rows : words.take(keys))
  {
    this->Rows.push_back(std::int64_t(rows));
  }
  this->Checksums = words.take(words.take());
  const std::uint64_t files = words.take();
  for (std::uint64_t file = 0; file < files; ++file)
  {
    this->Files.emplace_back();
    this->Files.back().Bytes = words.take();
    this->Files.back().Chunks = words.take(words.take());
    if (InputFile(fileOf(path, file)).size() < this->Files.back().Bytes)
    {
      throw IOError(fileOf(path, file), "is shorter than it was; start again.");
    }
  }
}

Spill::Spill(
  const std::string& path, std::size_t keys, std::size_t rowBytes, const std::vector<Words>& ranks)
  : Path(path)
  , Keys(keys)
  , RowBytes(rowBytes)
{
  this->join(ranks);
}

Words Spill::save() const
{
  Words words(this->Rows.begin(), this->Rows.end());
  words.push_back(this->Checksums.size());
  append(words, this->Checksums);
  words.push_back(this->Files.size());
  for (const File& file : this->Files)
  {
    words.push_back(file.Bytes);
    words.push_back(file.Chunks.size());
    append(words, file.Chunks);
  }
  return words;
}

std::uint64_t Spill::bytes() const
{
  std::uint64_t bytes = this->Mine.Bytes;
  for (const File& file : this->Files)
  {
    bytes += file.Bytes;
  }
  return bytes;
}

void Spill::protect()
{
  for (std::size_t key = 0; key < this->Keys; ++key)
  {
    this->Sums.push_back(std::make_unique<Checksum>());
  }
}

void Spill::addToChecksums(const std::vector<std::uint32_t>& starts, int threads)
{
  const char* const rows = this->Buffer.data() + this->listBytes();
  parallelFor(std::int64_t(this->Sums.size()), threads,
    [&](std::int64_t key)
    {
      const auto from = std::size_t(starts[std::size_t(key)]) * this->RowBytes;
      const auto to = std::size_t(starts[std::size_t(key) + 1]) * this->RowBytes;
      this->Sums[std::size_t(key)]->add(rows + from, to - from);
    });
}

void Spill::write(const std::vector<std::uint32_t>& starts, int threads)
{
  if (starts.back() == 0)
  {
    return;
  }
  this->addToChecksums(starts, threads);
  for (std::size_t key = 0; key < this->Keys; ++key)
  {
    this->Rows[key] += starts[key + 1] - starts[key];
  }
  const std::vector<char>& chunk = this->Buffer;
  std::memcpy(this->Buffer.data(), starts.data(), this->listBytes());
  const std::size_t parts = chunk.size() < (std::size_t(1) << 20) ? 1 : std::size_t(threads);
  parallelFor(std::int64_t(parts), threads,
    [&](std::int64_t part)
    {
      const std::size_t from = chunk.size() * std::size_t(part) / parts;
      const std::size_t to = chunk.size() * (std::size_t(part) + 1) / parts;
      this->Out->write(this->Mine.Bytes + from, chunk.data() + from, to - from);
    });
  this->Mine.Chunks.push_back(this->Mine.Bytes);
  this->Mine.Bytes += chunk.size();
}

Words Spill::close()
{
  std::vector<char>().swap(this->Buffer);
  this->Out->close(); // else other machines might not see all rows
  this->Out.reset();
  Words words(this->Rows.begin(), this->Rows.end());
  words.push_back(this->Sums.size());
  for (const std::unique_ptr<Checksum>& sum : this->Sums)
  {
    words.push_back(sum->finish());
  }
  std::vector<std::unique_ptr<Checksum>>().swap(this->Sums);
  words.push_back(this->Mine.Bytes);
  append(words, this->Mine.Chunks);
  this->Mine = File();
  return words;
}

void Spill::join(const std::vector<Words>& ranks)
{
  this->Rows.assign(this->Keys, 0);
  for (const Words& rank : ranks)
  {
    WordReader words(this->Path, rank);
    const Words rows = words.take(this->Keys);
    for (std::size_t key = 0; key < this->Keys; ++key)
    {
      this->Rows[key] += std::int64_t(rows[key]);
    }
    const Words sums = words.take(words.take());
    this->Checksums.resize(sums.size(), 0);
    for (std::size_t key = 0; key < sums.size(); ++key)
    {
      this->Checksums[key] = combined(this->Checksums[key], sums[key]);
    }
    this->Files.emplace_back();
    this->Files.back().Bytes = words.take();
    this->Files.back().Chunks = words.take(rank.size() - this->Keys - sums.size() - 2);
  }
}

void Spill::exchange(Communicator& ranks)
{
  Words mine;
  ranks.attempt([&] { mine = this->close(); });
  const std::vector<Words> words = ranks.allGather(mine);
  ranks.attempt([&] { this->join(words); });
}

void Spill::readRows(std::size_t key, const std::function<Room(std::size_t)>& roomFor) const
{
  std::uint64_t sum = 0;
  auto left = std::uint64_t(this->Rows[key]);
  Checksum checksum;
  for (std::size_t f = 0; f < this->Files.size(); ++f)
  {
    const InputFile file(fileOf(this->Path, f));
    for (const std::uint64_t chunk : this->Files[f].Chunks)
    {
      std::array<std::uint32_t, 2> ends{};
      file.read(chunk + key * sizeof(ends[0]), ends.data(), sizeof(ends));
      if (ends[1] < ends[0] || ends[1] - ends[0] > left)
      {
        refuse(file.path());
      }
      left -= ends[1] - ends[0];
      while (ends[0] < ends[1])
      {
        const Room room = roomFor(ends[1] - ends[0]);
        const std::size_t bytes = room.Rows * this->RowBytes;
        file.read(
          chunk + this->listBytes() + std::uint64_t(ends[0]) * this->RowBytes, room.At, bytes);
        if (!this->Checksums.empty())
        {
          checksum.add(room.At, bytes);
        }
        ends[0] += std::uint32_t(room.Rows);
      }
    }
    sum = combined(sum, checksum.finish());
  }
  if (left > 0 || (!this->Checksums.empty() && sum != this->Checksums[key]))
  {
    refuse(fileOf(this->Path, 0));
  }
}

void Spill::read(std::size_t key, std::size_t most,
  const std::function<void(const char*, std::size_t)>& take) const
{
  const std::size_t room = std::min(most, std::size_t(this->Rows[key]));
  std::vector<char> block(room * this->RowBytes);
  std::size_t held = 0;
  const auto give = [&]
  {
    if (held > 0)
    {
      take(block.data(), held);
      held = 0;
    }
  };
  this->readRows(key,
    [&](std::size_t rows)
    {
      if (held == room)
      {
        give();
      }
      const Room here{ block.data() + held * this->RowBytes, std::min(rows, room - held) };
      held += here.Rows;
      return here;
    });
  give();
}

void Spill::readAll(std::size_t key, void* to) const
{
  char* at = static_cast<char*>(to);
  this->readRows(key,
    [&](std::size_t rows)
    {
      const Room here{ at, rows };
      at += rows * this->RowBytes;
      return here;
    });
}

std::vector<char> Spill::readAll(std::size_t key) const
{
  std::vector<char> rows(std::size_t(this->Rows[key]) * this->RowBytes);
  this->readAll(key, rows.data());
  return rows;
}

} // namespace tipp
