// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/PieceEnds.h"

#include "Parallel/ParallelFor.h"
#include "Parallel/RadixSort.h"

#include <algorithm>
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
  this->Entries.reserve(2 * pieces.size());
  PointId last = -1;
  const auto append = [&](PointId id, std::int64_t entry)
  {
    if (id != last)
    {
      this->Words[std::size_t(id) / 64].Bits |= std::uint64_t(1) << (std::size_t(id) % 64);
      this->Starts.push_back(std::int64_t(this->Entries.size()));
      last = id;
    }
    this->Entries.push_back(entry);
  };
  const auto idOf = [&](std::size_t entry)
  { return entry % 2 == 0 ? pieces[entry / 2].A : pieces[entry / 2].B; };
  if (points <= UINT32_MAX && 2 * pieces.size() <= UINT32_MAX)
  {
    std::vector<std::uint64_t> words(2 * pieces.size());
    constexpr std::int64_t chunk = 16384;
    forChunks(std::int64_t(words.size()), chunk, threads, {},
      [&](std::int64_t begin, std::int64_t end, int)
      {
        for (auto entry = std::size_t(begin); entry < std::size_t(end); ++entry)
        {
          words[entry] = std::uint64_t(idOf(entry)) << 32 | entry;
        }
      });
    sortByUpperHalf(words, threads);
    for (const std::uint64_t word : words)
    {
      append(PointId(word >> 32), std::int64_t(word & UINT32_MAX));
    }
  }
  else
  {
    std::vector<std::pair<PointId, std::int64_t>> words;
    for (std::size_t entry = 0; entry < 2 * pieces.size(); ++entry)
    {
      words.emplace_back(idOf(entry), std::int64_t(entry));
    }
    std::sort(words.begin(), words.end());
    for (const auto& [id, entry] : words)
    {
      append(id, entry);
    }
  }
  this->Starts.push_back(std::int64_t(this->Entries.size()));
  std::uint64_t ends = 0;
  for (std::size_t w = 0; w < this->Words.size(); ++w)
  {
    Word& word = this->Words[w];
    this->Marks[w % MarkWords] |= word.Bits;
    word.Before = ends;
    ends += bitsIn(word.Bits);
  }
}

std::size_t PieceEnds::rank(PointId id) const
{
  const std::uint64_t below = (std::uint64_t(1) << (std::size_t(id) % 64)) - 1;
  const Word& word = this->Words[std::size_t(id) / 64];
  return std::size_t(word.Before) + bitsIn(word.Bits & below);
}

} // namespace tipp
