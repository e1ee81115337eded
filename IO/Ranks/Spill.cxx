// SPDX-License-Identifier: BSD-3-Clause
#include "Ranks/Spill.h"

#include "Files/IOError.h"

#include <array>
#include <cstring>
#include <utility>

namespace tipp
{

namespace
{

/// Combines the checksums of a key's rows in several files.
std::uint64_t combined(std::uint64_t sum, std::uint64_t next)
{
  const std::array<std::uint64_t, 2> both{ sum, next };
  return checksumOf(both.data(), sizeof(both));
}

constexpr std::size_t rowBufferBytes = std::size_t(1) << 20;

void appendBytes(const void* row, std::size_t bytes, std::vector<char>& buffer)
{
  const char* const begin = static_cast<const char*>(row);
  buffer.insert(buffer.end(), begin, begin + bytes);
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
  , Content{ std::vector<std::int64_t>(keys, 0), {}, { SpilledRows::File() } }
{
}

Spill::Spill(const std::string& path, std::size_t keys, std::size_t rowBytes, SpilledRows content)
  : Path(path)
  , Keys(keys)
  , RowBytes(rowBytes)
  , Content(std::move(content))
{
  this->requireKeys(this->Content);
  for (std::size_t file = 0; file < this->Content.Files.size(); ++file)
  {
    if (InputFile(fileOf(path, file)).size() < this->Content.Files[file].Bytes)
    {
      throw IOError(fileOf(path, file), "is shorter than it was; start again.");
    }
  }
}

Spill::Spill(const std::string& path, std::size_t keys, std::size_t rowBytes,
  const std::vector<SpilledRows>& ranks)
  : Path(path)
  , Keys(keys)
  , RowBytes(rowBytes)
{
  this->join(ranks);
}

void Spill::requireKeys(const SpilledRows& content) const
{
  const std::size_t checksums = content.Checksums.size();
  if (content.Counts.size() != this->Keys || (checksums != 0 && checksums != this->Keys) ||
    content.Files.empty())
  {
    throw IOError(this->Path, "has rows of other pieces; start again.");
  }
}

std::uint64_t Spill::bytes() const
{
  std::uint64_t bytes = 0;
  for (const SpilledRows::File& file : this->Content.Files)
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
    this->Content.Counts[key] += starts[key + 1] - starts[key];
  }
  SpilledRows::File& file = this->Content.Files.front();
  const std::vector<char>& chunk = this->Buffer;
  std::memcpy(this->Buffer.data(), starts.data(), this->listBytes());
  const std::size_t parts = chunk.size() < (std::size_t(1) << 20) ? 1 : std::size_t(threads);
  parallelFor(std::int64_t(parts), threads,
    [&](std::int64_t part)
    {
      const std::size_t from = chunk.size() * std::size_t(part) / parts;
      const std::size_t to = chunk.size() * (std::size_t(part) + 1) / parts;
      this->Out->write(file.Bytes + from, chunk.data() + from, to - from);
    });
  file.Chunks.push_back(file.Bytes);
  file.Bytes += chunk.size();
}

SpilledRows Spill::close()
{
  std::vector<char>().swap(this->Buffer);
  this->Out->close(); // otherwise other machines might not see all rows
  this->Out.reset();
  for (const std::unique_ptr<Checksum>& sum : this->Sums)
  {
    this->Content.Checksums.push_back(sum->finish());
  }
  std::vector<std::unique_ptr<Checksum>>().swap(this->Sums);
  return std::exchange(this->Content, {});
}

void Spill::join(const std::vector<SpilledRows>& ranks)
{
  this->Content = { std::vector<std::int64_t>(this->Keys, 0), {}, {} };
  for (const SpilledRows& rank : ranks)
  {
    this->requireKeys(rank);
    this->Content.Checksums.resize(rank.Checksums.size(), 0);
    for (std::size_t key = 0; key < this->Keys; ++key)
    {
      this->Content.Counts[key] += rank.Counts[key];
      if (!rank.Checksums.empty())
      {
        std::uint64_t& sum = this->Content.Checksums[key];
        sum = combined(sum, rank.Checksums[key]);
      }
    }
    this->Content.Files.push_back(rank.Files.front());
  }
}

void Spill::exchange(Communicator& ranks)
{
  SpilledRows mine;
  ranks.attempt([&] { mine = this->close(); });
  const std::vector<SpilledRows> all = ranks.allGather(mine);
  ranks.attempt([&] { this->join(all); });
}

void Spill::finish()
{
  this->join({ this->close() });
}

void Spill::readRows(std::size_t key, const std::function<Room(std::size_t)>& roomFor) const
{
  std::uint64_t sum = 0;
  auto left = std::uint64_t(this->rows(key));
  Checksum checksum;
  for (std::size_t f = 0; f < this->Content.Files.size(); ++f)
  {
    const InputFile file(fileOf(this->Path, f));
    for (const std::uint64_t chunk : this->Content.Files[f].Chunks)
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
        if (!this->Content.Checksums.empty())
        {
          checksum.add(room.At, bytes);
        }
        ends[0] += std::uint32_t(room.Rows);
      }
    }
    sum = combined(sum, checksum.finish());
  }
  if (left > 0 || (!this->Content.Checksums.empty() && sum != this->Content.Checksums[key]))
  {
    refuse(fileOf(this->Path, 0));
  }
}

void Spill::read(std::size_t key, std::size_t most,
  const std::function<void(const char*, std::size_t)>& take) const
{
  const std::size_t room = std::min(most, std::size_t(this->rows(key)));
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
  std::vector<char> rows(std::size_t(this->rows(key)) * this->RowBytes);
  this->readAll(key, rows.data());
  return rows;
}

RowFile::RowFile(const std::string& path, std::size_t rowBytes)
  : File(path)
  , RowBytes(rowBytes)
  , Out(std::make_unique<OutputFile>(path))
{
}

void RowFile::append(const void* row)
{
  appendBytes(row, this->RowBytes, this->Buffer);
  ++this->Count;
  if (this->Buffer.size() >= rowBufferBytes)
  {
    this->flush();
  }
}

void RowFile::flush()
{
  const std::uint64_t end = std::uint64_t(this->Count) * this->RowBytes;
  this->Out->write(end - this->Buffer.size(), this->Buffer.data(), this->Buffer.size());
  this->Buffer.clear();
}

void RowFile::finish()
{
  this->flush();
  std::vector<char>().swap(this->Buffer);
  this->Out->close();
  this->Out.reset();
  this->In = std::make_unique<InputFile>(this->File.path());
}

void RowFile::read(std::int64_t first, std::size_t count, void* to) const
{
  this->In->read(std::uint64_t(first) * this->RowBytes, to, count * this->RowBytes);
}

KeyedRows::KeyedRows(const std::string& path, std::size_t keys, std::size_t rowBytes)
  : File(path + ".0") // the name that Spill gives it
  , Rows(path, 0, keys, rowBytes)
{
}

void KeyedRows::add(std::size_t key, const void* row)
{
  this->BufferedKeys.push_back(std::uint32_t(key));
  appendBytes(row, this->Rows.rowBytes(), this->Buffer);
  if (this->Buffer.size() >= rowBufferBytes)
  {
    this->flush();
  }
}

void KeyedRows::flush()
{
  this->Rows.add(
    this->BufferedKeys.size(), 1, [this](std::size_t i) { return this->BufferedKeys[i]; },
    [this, bytes = this->Rows.rowBytes()](std::size_t i, char* to)
    { std::memcpy(to, this->Buffer.data() + i * bytes, bytes); });
  this->BufferedKeys.clear();
  this->Buffer.clear();
}

void KeyedRows::finish()
{
  this->flush();
  std::vector<char>().swap(this->Buffer);
  std::vector<std::uint32_t>().swap(this->BufferedKeys);
  this->Rows.finish();
}

} // namespace tipp
