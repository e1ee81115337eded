// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSpill_h
#define tippSpill_h

#include "Files/Checksum.h"
#include "Files/InputFile.h"
#include "Files/OutputFile.h"
#include "Files/TemporaryPaths.h"
#include "Parallel/CountingSort.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Poll.h"
#include "Ranks/Communicator.h"
#include "vtkTIPPIOModule.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// The layout of the files of a Spill.
struct SpilledRows
{
  /// A rank's file.
  struct File
  {
    std::uint64_t Bytes = 0;
    std::vector<std::uint64_t> Chunks; ///< offset of each chunk
  };

  std::vector<std::int64_t> Counts;     ///< rows per key
  std::vector<std::uint64_t> Checksums; ///< per key; empty: not protected
  std::vector<File> Files;              ///< one file per rank
};

template <typename Archive>
void serialize(Archive& archive, SpilledRows::File& file)
{
  archive(file.Bytes, file.Chunks);
}

template <typename Archive>
void serialize(Archive& archive, SpilledRows& rows)
{
  archive(rows.Counts, rows.Checksums, rows.Files);
}

/// A distribution sort on disk: rows of equal size from chunks of a mesh are sorted by a key, the
/// piece, through a file of each rank. Rows of a key stay in the order of the chunks, and of the
/// ranks.
///
/// The file holds a chunk's rows sorted by key, preceded by a list of each key's first row. So
/// memory holds a number per key and one per chunk, but none per pair of them.
class VTKTIPPIO_EXPORT Spill
{
public:
  /// `keys` is the number of keys. Creates the rank's file, "PATH.RANK"; throws IOError.
  Spill(const std::string& path, int rank, std::size_t keys, std::size_t rowBytes);

  /// Opens a spill that other processes have written, from what content() returned after
  /// exchange(). Throws IOError.
  Spill(const std::string& path, std::size_t keys, std::size_t rowBytes, SpilledRows content);

  /// Opens a spill that other ranks have written, from what close() returned on each, in the order
  /// of the ranks. Throws IOError.
  Spill(const std::string& path, std::size_t keys, std::size_t rowBytes,
    const std::vector<SpilledRows>& ranks);

  std::size_t rowBytes() const { return this->RowBytes; }
  /// The size of the files in content(), in bytes.
  std::uint64_t bytes() const;

  /// Adds a chunk of `count` items: key(item) returns an item's key, or -1 to skip it; fill(item,
  /// to) writes its row. Both are called by several threads. Throws IOError.
  template <typename Key, typename Fill>
  void add(std::size_t count, int threads, const Key& keyOf, const Fill& fill);

  /// Enables checksums of the rows per key, which reading verifies. Call it before adding chunks,
  /// on all ranks.
  void protect();

  /// Call after all chunks: makes all ranks' rows known to every rank. Collective. Throws IOError
  /// on all.
  void exchange(Communicator& ranks);
  /// Like exchange(), for a single rank; no communication.
  void finish();
  /// Ends writing; returns what the constructor for several ranks' rows needs from this rank. No
  /// communication.
  SpilledRows close();

  /// The layout of this rank's file, or after exchange() of all ranks' files.
  const SpilledRows& content() const { return this->Content; }
  std::int64_t rows(std::size_t key) const { return this->Content.Counts[key]; }
  /// Passes the key's rows in order, in blocks of at most `most` rows. Throws IOError; if the
  /// checksum does not match, after the last block.
  void read(std::size_t key, std::size_t most,
    const std::function<void(const char* rows, std::size_t count)>& take) const;
  std::vector<char> readAll(std::size_t key) const;
  /// Reads all of the key's rows; `to` must have room for them.
  void readAll(std::size_t key, void* to) const;

private:
  struct Room
  {
    char* At;
    std::size_t Rows;
  };

  void join(const std::vector<SpilledRows>& ranks);
  void requireKeys(const SpilledRows& content) const;
  template <typename Key, typename Fill>
  void addChunk(
    std::size_t first, std::size_t count, int threads, const Key& keyOf, const Fill& fill);
  std::size_t listBytes() const { return (this->Keys + 1) * sizeof(std::uint32_t); }
  void write(const std::vector<std::uint32_t>& starts, int threads);
  void addToChecksums(const std::vector<std::uint32_t>& starts, int threads);
  void readRows(std::size_t key, const std::function<Room(std::size_t rows)>& roomFor) const;
  static std::string fileOf(const std::string& path, std::size_t rank);
  [[noreturn]] static void refuse(const std::string& file);

  std::string Path;
  std::size_t Keys;
  std::size_t RowBytes;
  std::optional<OutputFile> Out;               ///< until close()
  SpilledRows Content;                         ///< this rank's until join()
  std::vector<char> Buffer;                    ///< a chunk's; reused
  std::vector<std::unique_ptr<Checksum>> Sums; ///< per key, after protect() and until close()
};

template <typename Key, typename Fill>
void Spill::add(std::size_t count, int threads, const Key& keyOf, const Fill& fill)
{
  constexpr std::size_t most = std::size_t(1) << 31; // the list has 32-bit numbers
  for (std::size_t first = 0; first < count; first += most)
  {
    this->addChunk(first, std::min(most, count - first), threads, keyOf, fill);
  }
}

template <typename Key, typename Fill>
void Spill::addChunk(
  std::size_t first, std::size_t count, int threads, const Key& keyOf, const Fill& fill)
{
  // A counting sort: each thread counts and then copies one range of the items.
  const std::size_t ranges = std::size_t(threads);
  std::vector<std::vector<std::uint32_t>> positions(
    ranges, std::vector<std::uint32_t>(this->Keys, 0));
  const auto beginOf = [&](std::size_t i) { return first + count * i / ranges; };
  // Calls take(item, position) for each item that has a key; `position` is the key's in the range.
  const auto forEachItem = [&](const auto& take)
  {
    parallelFor(std::int64_t(ranges), threads,
      [&](std::int64_t range)
      {
        const auto s = std::size_t(range);
        std::vector<std::uint32_t>& mine = positions[s];
        for (std::size_t i = beginOf(s); i < beginOf(s + 1); ++i)
        {
          const std::int64_t key = keyOf(i);
          if (key >= 0)
          {
            take(i, mine[std::size_t(key)]);
          }
        }
      });
  };
  forEachItem([](std::size_t, std::uint32_t& position) { ++position; });
  const std::vector<std::uint32_t> starts = countsToIndices(this->Keys, positions);
  this->Buffer.resize(this->listBytes() + std::size_t(starts.back()) * this->RowBytes);
  char* const rows = this->Buffer.data() + this->listBytes();
  forEachItem([&](std::size_t i, std::uint32_t& position)
    { fill(i, rows + std::size_t(position++) * this->RowBytes); });
  this->write(starts, threads);
}

/// Rows of equal size in a temporary file: first they are appended, then read. The file is removed
/// with the object.
class VTKTIPPIO_EXPORT RowFile
{
public:
  /// Creates the file. Throws IOError, as all methods do.
  RowFile(const std::string& path, std::size_t rowBytes);

  void append(const void* row);
  /// Call it once, after the last row.
  void finish();

  std::int64_t count() const { return this->Count; }
  /// Reads `count` rows from number `first` on.
  void read(std::int64_t first, std::size_t count, void* to) const;

  /// Calls visit(number, row) for all rows in their order, and polls.
  template <typename Row, typename Visit>
  void forEach(const Visit& visit) const
  {
    constexpr std::int64_t most = 4096;
    std::vector<Row> rows(std::size_t(std::min(most, this->Count)));
    for (std::int64_t first = 0; first < this->Count; first += most)
    {
      const std::int64_t end = std::min(this->Count, first + most);
      this->read(first, std::size_t(end - first), rows.data());
      for (std::int64_t i = first; i < end; ++i)
      {
        visit(i, rows[std::size_t(i - first)]);
      }
      poll();
    }
  }

private:
  void flush();

  const TemporaryFile File;
  const std::size_t RowBytes;
  std::unique_ptr<OutputFile> Out; ///< until finish()
  std::unique_ptr<InputFile> In;   ///< after it
  std::vector<char> Buffer;
  std::int64_t Count = 0;
};

/// Rows of equal size with a key each, in a temporary file: first they are added, then read by key,
/// in the order in which they were added. The file is removed with the object.
class VTKTIPPIO_EXPORT KeyedRows
{
public:
  /// Creates the file. Throws IOError, as all methods do.
  KeyedRows(const std::string& path, std::size_t keys, std::size_t rowBytes);

  void add(std::size_t key, const void* row);
  /// Call it once, after the last row.
  void finish();

  std::size_t keys() const { return this->Rows.content().Counts.size(); }
  std::int64_t count(std::size_t key) const { return this->Rows.rows(key); }

  /// Calls visit(row) with the bytes of each of the key's rows, and polls.
  template <typename Visit>
  void forEach(std::size_t key, const Visit& visit) const
  {
    constexpr std::size_t most = 4096;
    this->Rows.read(key, most,
      [&](const char* rows, std::size_t count)
      {
        for (std::size_t i = 0; i < count; ++i)
        {
          visit(rows + i * this->Rows.rowBytes());
        }
        poll();
      });
  }

  /// All rows of a key.
  template <typename Row>
  std::vector<Row> readAll(std::size_t key) const
  {
    std::vector<Row> rows(std::size_t(this->count(key)));
    this->Rows.readAll(key, rows.data());
    return rows;
  }

private:
  void flush();

  const TemporaryFile File;
  Spill Rows;
  std::vector<std::uint32_t> BufferedKeys;
  std::vector<char> Buffer;
};

} // namespace tipp

#endif
