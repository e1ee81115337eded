// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSpill_h
#define tippSpill_h

#include "Files/OutputFile.h"
#include "Partitioned/Checksum.h"
#include "Partitioning/Ranks.h"
#include "vtkTIPPIOModule.h"

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
class VTKTIPPIO_EXPORT Spill
{
public:
  /// `keys`: the number of keys. Makes the rank's file, "PATH.RANK"; throws IOError.
  Spill(const std::string& path, const Ranks& ranks, std::size_t keys, std::size_t rowBytes);

  /// One that another process has written: save() told it all after exchange(), on one rank.
  /// Throws IOError.
  Spill(const std::string& path, std::size_t keys, std::size_t rowBytes,
    const std::vector<char>& saved);
  std::vector<char> save() const;

  std::size_t rowBytes() const { return this->RowBytes; }
  std::uint64_t bytes() const { return this->Written; }

  /// Adds a chunk: key of each of `count` items, or -1 to leave it out; fill(item, to) writes the
  /// item's row. Both are called by several threads. Throws IOError.
  template <typename Key, typename Fill>
  void add(std::size_t count, int threads, const Key& keyOf, const Fill& fill);

  /// From now on checksums of rows are taken, key by key, and kept with what save() tells: to be
  /// verified where rows are read. Before all chunks; on one rank.
  void protect();

  /// After all chunks: has every rank know all rows. A call of all ranks. Throws IOError on all.
  void exchange(const Ranks& ranks);

  std::int64_t rows(std::size_t key) const { return this->Rows[key]; }
  /// Gives the key's rows, a block of at most `most` at a time, in order. Throws IOError, after the
  /// last block also where they are not those that were added.
  void read(std::size_t key, std::size_t most,
    const std::function<void(const char* rows, std::size_t count)>& take) const;
  std::vector<char> readAll(std::size_t key) const;
  /// All of the key's rows; there must be room for them.
  void readAll(std::size_t key, void* to) const;

private:
  struct Extent
  {
    std::uint64_t Offset;
    std::uint32_t Rows;
    std::uint32_t Key; ///< then, by key: the file
  };

  void write(const std::vector<char>& rows, const std::vector<std::int64_t>& starts, int threads);
  void sortExtents(const std::vector<std::string>& all);
  void addToChecksums(
    const std::vector<char>& rows, const std::vector<std::int64_t>& starts, int threads);
  static std::string fileOf(const std::string& path, int rank);

  std::string Path;
  std::size_t Keys;
  std::size_t RowBytes;
  std::optional<OutputFile> Out; ///< until exchange()
  std::uint64_t Written = 0;
  std::vector<char> Buffer; ///< a chunk's rows; kept from one chunk to the next
  std::vector<std::unique_ptr<Checksum>>
    Sums;                               ///< of each key, after protect() and until exchange()
  std::vector<std::uint64_t> Checksums; ///< then; none: rows are not protected
  std::vector<Extent> Mine;
  std::vector<Extent> Sorted;
  std::vector<std::size_t> Starts; ///< of each key's in Sorted
  std::vector<std::int64_t> Rows;
};

template <typename Key, typename Fill>
void Spill::add(std::size_t count, int threads, const Key& keyOf, const Fill& fill)
{
  // A counting sort: each thread counts, then places, one stretch of the items.
  const std::size_t stretches = std::size_t(threads);
  std::vector<std::vector<std::int64_t>> places(
    stretches, std::vector<std::int64_t>(this->Keys, 0));
  const auto stretchOf = [&](std::size_t i) { return count * i / stretches; };
#pragma omp parallel for num_threads(threads) schedule(static, 1)
  for (std::size_t s = 0; s < stretches; ++s)
  {
    std::vector<std::int64_t>& mine = places[s];
    for (std::size_t i = stretchOf(s); i < stretchOf(s + 1); ++i)
    {
      const std::int64_t key = keyOf(i);
      if (key >= 0)
      {
        ++mine[std::size_t(key)];
      }
    }
  }
  std::vector<std::int64_t> starts{ 0 };
  std::int64_t total = 0;
  for (std::size_t key = 0; key < this->Keys; ++key)
  {
    for (std::vector<std::int64_t>& mine : places)
    {
      const std::int64_t here = mine[key];
      mine[key] = total;
      total += here;
    }
    starts.push_back(total);
  }
  std::vector<char>& rows = this->Buffer;
  rows.resize(std::size_t(total) * this->RowBytes);
#pragma omp parallel for num_threads(threads) schedule(static, 1)
  for (std::size_t s = 0; s < stretches; ++s)
  {
    std::vector<std::int64_t>& mine = places[s];
    for (std::size_t i = stretchOf(s); i < stretchOf(s + 1); ++i)
    {
      const std::int64_t key = keyOf(i);
      if (key >= 0)
      {
        fill(i, rows.data() + std::size_t(mine[std::size_t(key)]++) * this->RowBytes);
      }
    }
  }
  this->write(rows, starts, threads);
}

} // namespace tipp

#endif
