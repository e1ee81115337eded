// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/Spill.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <cstring>
#include <optional>

namespace tipp
{

std::string Spill::fileOf(const std::string& path, int rank)
{
  return path + "." + std::to_string(rank);
}

Spill::Spill(const std::string& path, const Ranks& ranks, std::size_t keys, std::size_t rowBytes)
  : Path(path)
  , Keys(keys)
  , RowBytes(rowBytes)
  , Out(std::in_place, fileOf(path, ranks.rank()))
{
}

Spill::Spill(
  const std::string& path, std::size_t keys, std::size_t rowBytes, const std::vector<char>& saved)
  : Path(path)
  , Keys(keys)
  , RowBytes(rowBytes)
{
  const std::size_t sums = keys * sizeof(std::uint64_t);
  if (saved.size() < sums || (saved.size() - sums) % sizeof(Extent) != 0)
  {
    throw IOError(path, "has checksums of other pieces; start again.");
  }
  this->Checksums.resize(keys);
  std::memcpy(this->Checksums.data(), saved.data(), sums);
  for (std::size_t at = sums; at < saved.size(); at += sizeof(Extent))
  {
    Extent extent;
    std::memcpy(&extent, saved.data() + at, sizeof(Extent));
    this->Written = std::max(this->Written, extent.Offset + std::uint64_t(extent.Rows) * rowBytes);
    if (extent.Key >= keys)
    {
      throw IOError(path, "has rows of a piece that there is not; start again.");
    }
  }
  if (InputFile(fileOf(path, 0)).size() < this->Written)
  {
    throw IOError(fileOf(path, 0), "is shorter than it was; start again.");
  }
  this->sortExtents({ std::string(saved.data() + sums, saved.size() - sums) });
}

std::vector<char> Spill::save() const
{
  std::vector<Extent> extents = this->Sorted;
  for (std::size_t key = 0; key < this->Keys; ++key)
  {
    for (std::size_t i = this->Starts[key]; i < this->Starts[key + 1]; ++i)
    {
      extents[i].Key = std::uint32_t(key);
    }
  }
  const auto append = [](const auto& values, std::vector<char>& to)
  {
    const char* const begin = reinterpret_cast<const char*>(values.data());
    to.insert(to.end(), begin, begin + values.size() * sizeof(values[0]));
  };
  std::vector<char> saved;
  append(this->Checksums, saved);
  append(extents, saved);
  return saved;
}

void Spill::protect()
{
  this->Checksums.resize(this->Keys);
  for (std::size_t key = 0; key < this->Keys; ++key)
  {
    this->Sums.push_back(std::make_unique<Checksum>());
  }
}

void Spill::addToChecksums(
  const std::vector<char>& rows, const std::vector<std::int64_t>& starts, int threads)
{
  parallelFor(std::int64_t(this->Sums.size()), threads,
    [&](std::int64_t key)
    {
      const auto from = std::size_t(starts[std::size_t(key)]) * this->RowBytes;
      const auto to = std::size_t(starts[std::size_t(key) + 1]) * this->RowBytes;
      this->Sums[std::size_t(key)]->add(rows.data() + from, to - from);
    });
}

void Spill::write(
  const std::vector<char>& rows, const std::vector<std::int64_t>& starts, int threads)
{
  for (std::size_t key = 0; key < this->Keys; ++key)
  {
    // Longer runs than a field holds become several.
    constexpr std::int64_t most = std::int64_t(1) << 31;
    for (std::int64_t row = starts[key]; row < starts[key + 1]; row += most)
    {
      this->Mine.push_back({ this->Written + std::uint64_t(row) * this->RowBytes,
        std::uint32_t(std::min(most, starts[key + 1] - row)), std::uint32_t(key) });
    }
  }
  this->addToChecksums(rows, starts, threads);
  const std::size_t parts = rows.size() < (std::size_t(1) << 20) ? 1 : std::size_t(threads);
  parallelFor(std::int64_t(parts), threads,
    [&](std::int64_t part)
    {
      const std::size_t from = rows.size() * std::size_t(part) / parts;
      const std::size_t to = rows.size() * (std::size_t(part) + 1) / parts;
      this->Out->write(this->Written + from, rows.data() + from, to - from);
    });
  this->Written += rows.size();
}

void Spill::exchange(const Ranks& ranks)
{
  const std::string mine(
    reinterpret_cast<const char*>(this->Mine.data()), this->Mine.size() * sizeof(Extent));
  std::vector<Extent>().swap(this->Mine);
  std::vector<char>().swap(this->Buffer);
  for (std::size_t key = 0; key < this->Sums.size(); ++key)
  {
    this->Checksums[key] = this->Sums[key]->finish();
  }
  this->Sums.clear();
  ranks.attempt([this] { this->Out->close(); }); // or other machines might not see all rows
  this->Out.reset();
  const std::vector<std::string> all = ranks.gather(mine);
  ranks.attempt([&] { this->sortExtents(all); });
}

void Spill::sortExtents(const std::vector<std::string>& all)
{
  this->Rows.assign(this->Keys, 0);
  this->Starts.assign(this->Keys + 1, 0);
  const auto eachExtent = [&](const auto& take)
  {
    for (std::size_t rank = 0; rank < all.size(); ++rank)
    {
      for (std::size_t at = 0; at < all[rank].size(); at += sizeof(Extent))
      {
        Extent extent;
        std::memcpy(&extent, all[rank].data() + at, sizeof(Extent));
        take(extent, std::uint32_t(rank));
      }
    }
  };
  eachExtent(
    [&](const Extent& extent, std::uint32_t)
    {
      this->Rows[extent.Key] += extent.Rows;
      ++this->Starts[extent.Key + 1];
    });
  for (std::size_t key = 0; key < this->Keys; ++key)
  {
    this->Starts[key + 1] += this->Starts[key];
  }
  this->Sorted.resize(this->Starts.back());
  std::vector<std::size_t> places(this->Starts.begin(), this->Starts.end() - 1);
  eachExtent(
    [&](const Extent& extent, std::uint32_t rank) {
      this->Sorted[places[extent.Key]++] = { extent.Offset, extent.Rows, rank };
    });
}

void Spill::read(std::size_t key, std::size_t most,
  const std::function<void(const char*, std::size_t)>& take) const
{
  std::vector<char> block;
  std::size_t held = 0;
  const std::size_t room = std::min(most, std::size_t(this->Rows[key]));
  block.resize(room * this->RowBytes);
  // A key's extents are in the order of the ranks: one file is open at a time.
  std::optional<InputFile> file;
  std::uint32_t opened = 0;
  Checksum checksum;
  const auto give = [&]
  {
    if (!this->Checksums.empty())
    {
      checksum.add(block.data(), held * this->RowBytes);
    }
    take(block.data(), held);
    held = 0;
  };
  for (std::size_t i = this->Starts[key]; i < this->Starts[key + 1]; ++i)
  {
    Extent extent = this->Sorted[i];
    if (!file || opened != extent.Key)
    {
      opened = extent.Key;
      file.emplace(fileOf(this->Path, int(opened)));
    }
    while (extent.Rows > 0)
    {
      const std::size_t rows = std::min<std::size_t>(extent.Rows, room - held);
      file->read(extent.Offset, block.data() + held * this->RowBytes, rows * this->RowBytes);
      held += rows;
      extent.Rows -= std::uint32_t(rows);
      extent.Offset += rows * this->RowBytes;
      if (held == room)
      {
        give();
      }
    }
  }
  if (held > 0)
  {
    give();
  }
  if (!this->Checksums.empty() && checksum.finish() != this->Checksums[key])
  {
    throw IOError(fileOf(this->Path, 0),
      "is damaged: it does not hold what was written to it; remove its folder and start again.");
  }
}

void Spill::readAll(std::size_t key, void* to) const
{
  char* at = static_cast<char*>(to);
  this->read(key, std::size_t(1) << 16,
    [&](const char* block, std::size_t count)
    {
      std::memcpy(at, block, count * this->RowBytes);
      at += count * this->RowBytes;
    });
}

std::vector<char> Spill::readAll(std::size_t key) const
{
  std::vector<char> rows(std::size_t(this->Rows[key]) * this->RowBytes);
  this->readAll(key, rows.data());
  return rows;
}

} // namespace tipp
