// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/PieceEnds.h"

#include "Parallel/ParallelFor.h"
#include "Parallel/RadixSort.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace tipp
{
namespace
{

/// The compiler calls a function if the processor lacks the instruction.
std::size_t bitsIn(std::uint64_t word)
{
  word -= word >> 1 & 0x5555555555555555U;
  word = (word & 0x3333333333333333U) + (word >> 2 & 0x3333333333333333U);
  word = (word + (word >> 4)) & 0x0f0f0f0f0f0f0f0fU;
  return std::size_t(word * 0x0101010101010101U >> 56);
}

} // namespace

PieceEnds::PieceEnds(std::size_t points, const std::vector<ConstraintPiece>& pieces, int threads)
  : Words(points / 64 + 1)
{
  const auto idOf = [&](std::size_t entry)
  { return entry % 2 == 0 ? pieces[entry / 2].A : pieces[entry / 2].B; };
  const std::size_t count = 2 * pieces.size();
  if (points <= UINT32_MAX && count <= UINT32_MAX)
  {
    this->Entries.resize(count);
    constexpr std::int64_t chunk = 16384;
    forChunks(std::int64_t(count), chunk, threads, {},
      [&](std::int64_t begin, std::int64_t end, int)
      {
        for (auto entry = std::size_t(begin); entry < std::size_t(end); ++entry)
        {
          this->Entries[entry] = std::uint64_t(idOf(entry)) << 32 | entry;
        }
      });
    sortByUpperHalf(this->Entries, threads, std::uint32_t(points));
    this->EntryMask = UINT32_MAX;
    this->makeIndex([this](std::size_t i) { return this->Entries[i] >> 32; }, threads);
  }
  else
  {
    std::vector<std::pair<PointId, std::uint64_t>> sorted;
    for (std::size_t entry = 0; entry < count; ++entry)
    {
      sorted.emplace_back(idOf(entry), entry);
    }
    std::sort(sorted.begin(), sorted.end());
    std::transform(sorted.begin(), sorted.end(), std::back_inserter(this->Entries),
      [](const auto& entry) { return entry.second; });
    this->makeIndex([&](std::size_t i) { return std::uint64_t(sorted[i].first); }, threads);
  }
}

/// Makes all but Entries. idOf(i) is the id of entry i, and never decreases.
template <typename IdOf>
void PieceEnds::makeIndex(const IdOf& idOf, int threads)
{
  // Blocks of ids have words and starts of their own.
  constexpr std::size_t blockWords = 4096;
  const std::size_t blocks = (this->Words.size() + blockWords - 1) / blockWords;
  const auto firstEntry = [&](std::size_t block)
  {
    const std::uint64_t id = std::uint64_t(64) * blockWords * block;
    std::size_t low = 0;
    std::size_t high = this->Entries.size();
    while (low < high)
    {
      const std::size_t middle = low + (high - low) / 2;
      idOf(middle) < id ? low = middle + 1 : high = middle;
    }
    return low;
  };
  parallelFor(std::int64_t(blocks), threads,
    [&](std::int64_t block)
    {
      const std::size_t end = firstEntry(std::size_t(block) + 1);
      for (std::size_t i = firstEntry(std::size_t(block)); i < end; ++i)
      {
        this->Words[idOf(i) / 64].Bits |= std::uint64_t(1) << (idOf(i) % 64);
      }
    });
  std::uint64_t ends = 0;
  for (std::size_t w = 0; w < this->Words.size(); ++w)
  {
    Word& word = this->Words[w];
    this->Marks[w % MarkWords] |= word.Bits;
    word.Before = ends;
    ends += bitsIn(word.Bits);
  }
  this->Starts.resize(ends + 1);
  this->Starts.back() = std::int64_t(this->Entries.size());
  parallelFor(std::int64_t(blocks), threads,
    [&](std::int64_t block)
    {
      const std::size_t begin = firstEntry(std::size_t(block));
      const std::size_t end = firstEntry(std::size_t(block) + 1);
      std::int64_t* start =
        this->Starts.data() + this->Words[std::size_t(block) * blockWords].Before;
      std::size_t first = begin; // of the entries with the same id
      for (std::size_t i = begin; i < end; ++i)
      {
        // Without branches, which would often be mispredicted.
        const bool isNew = idOf(i) != idOf(first);
        start += isNew ? 1 : 0;
        first = isNew ? i : first;
        *start = std::int64_t(first);
      }
    });
}

std::size_t PieceEnds::rank(PointId id) const
{
  const std::uint64_t below = (std::uint64_t(1) << (std::size_t(id) % 64)) - 1;
  const Word& word = this->Words[std::size_t(id) / 64];
  return std::size_t(word.Before) + bitsIn(word.Bits & below);
}

} // namespace tipp
