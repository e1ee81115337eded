// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSpill_h
#define tippSpill_h

#include "Files/OutputFile.h"
#include "Partitioned/Checksum.h"
#include "Partitioning/Ranks.h"
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

/// Rows of equal size on their way from chunks of a mesh to the pieces: a distribution sort by a
/// key through a file of each rank. Within a key the rows stay in the order of their chunks, and of
/// ranks.
///
/// A chunk's rows stand in the file by key, behind the list of where each key's begin. So memory
/// has a number for each key and one for each chunk, but none for each pair of them.
class VTKTIPPIO_EXPORT Spill
{
public:
  /// `keys`: the number of keys. Makes the rank's file, "PATH.RANK"; throws IOError.
  Spill(const std::string& path, int rank, std::size_t keys, std::size_t rowBytes);

  /// One that other processes have written: save() told it all after exchange(). Throws
  /// IOError.
  Spill(const std::string& path, std::size_t keys, std::size_t rowBytes,
    const std::vector<std::uint64_t>& saved);
  std::vector<std::uint64_t> save() const;

  /// One that others have written: what close() told on each, in the order of the ranks.
  Spill(const std::string& path, std::size_t keys, std::size_t rowBytes,
    const std::vector<std::vector<std::uint64_t>>& ranks);

  std::size_t rowBytes() const { return this->RowBytes; }
  /// In this rank's file; after exchange() in all ranks'.
  std::uint64_t bytes() const;

  /// Adds a chunk: key of each of `count` items, or -1 to leave it out; fill(item, to) writes the
  /// item's row. Both are called by several threads. Throws IOError.
  template <typename Key, typename Fill>
  void add(std::size_t count, int threads, const Key& keyOf, const Fill& fill);

  /// From now on checksums of rows are taken, key by key, and kept with what save() tells: to be
  /// verified where rows are read. Before all chunks; on all ranks.
  void protect();

  /// After all chunks: has every rank know all rows. A call of all ranks. Throws IOError on all.
  void exchange(const Ranks& ranks);
  /// The same where the caller carries what it tells, to make one of what all ranks have written.
  std::vector<std::uint64_t> close();

  std::int64_t rows(std::size_t key) const { return this->Rows[key]; }
  /// Gives the key's rows, a block of at most `most` at a time, in order. Throws IOError, after the
  /// last block also where they are not those that were added.
  void read(std::size_t key, std::size_t most,
    const std::function<void(const char* rows, std::size_t count)>& take) const;
  std::vector<char> readAll(std::size_t key) const;
  /// All of the key's rows; there must be room for them.
  void readAll(std::size_t key, void* to) const;

private:
  /// What a rank has written.
  struct File
  {
    std::uint64_t Bytes = 0;
    std::vector<std::uint64_t> Chunks; ///< where each begins
  };
  struct Room
  {
    char* At;
    std::size_t Rows;
  };

  void join(const std::vector<std::vector<std::uint64_t>>& ranks);
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
  File Mine;                                   ///< then, too
  std::vector<std::int64_t> Rows;              ///< of each key; of this rank until join()
  std::vector<char> Buffer;                    ///< a chunk; kept from one chunk to the next
  std::vector<std::unique_ptr<Checksum>> Sums; ///< of each key, after protect() and until close()
  std::vector<std::uint64_t> Checksums;        ///< from exchange() on; none: rows are not protected
  std::vector<File> Files;                     ///< from exchange() on
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
  // A counting sort: each thread counts, then places, one stretch of the items.
  const std::size_t stretches = std::size_t(threads);
  std::vector<std::vector<std::uint32_t>> places(
    stretches, std::vector<std::uint32_t>(this->Keys, 0));
  const auto stretchOf = [&](std::size_t i) { return first + count * i / stretches; };
#pragma omp parallel for num_threads(threads) schedule(static, 1)
  for (std::size_t s = 0; s < stretches; ++s)
  {
    std::vector<std::uint32_t>& mine = places[s];
    for (std::size_t i = stretchOf(s); i < stretchOf(s + 1); ++i)
    {
      const std::int64_t key = keyOf(i);
      if (key >= 0)
      {
        ++mine[std::size_t(key)];
      }
    }
  }
  std::vector<std::uint32_t> starts{ 0 };
  starts.reserve(this->Keys + 1);
  std::uint32_t total = 0;
  for (std::size_t key = 0; key < this->Keys; ++key)
  {
    for (std::vector<std::uint32_t>& mine : places)
    {
      const std::uint32_t here = mine[key];
      mine[key] = total;
      total += here;
    }
    starts.push_back(total);
  }
  this->Buffer.resize(this->listBytes() + std::size_t(total) * this->RowBytes);
  char* const rows = this->Buffer.data() + this->listBytes();
#pragma omp parallel for num_threads(threads) schedule(static, 1)
  for (std::size_t s = 0; s < stretches; ++s)
  {
    std::vector<std::uint32_t>& mine = places[s];
    for (std::size_t i = stretchOf(s); i < stretchOf(s + 1); ++i)
    {
      const std::int64_t key = keyOf(i);
      if (key >= 0)
      {
        fill(i, rows + std::size_t(mine[std::size_t(key)]++) * this->RowBytes);
      }
    }
  }
  this->write(starts, threads);
}

} // namespace tipp

#endif
