// SPDX-License-Identifier: BSD-3-Clause
#include "Kernel/InsertionOrder.h"

#include <algorithm>
#include <array>

namespace tipp
{
namespace
{

constexpr unsigned LevelsPerStep = 4;
constexpr unsigned Steps = 4;
constexpr unsigned Levels = LevelsPerStep * Steps;
constexpr unsigned KeyBits = 2 * Levels;
constexpr unsigned RoundBits = 4;
constexpr unsigned IndexBits = 28;
static_assert(RoundBits + KeyBits + IndexBits == 64, "an entry is one word");

/// Four levels of the Hilbert curve at once: (state, four bits of x, four bits of y) to eight bits
/// of key and the next state. A state says whether x and y are exchanged and complemented; the
/// two commute, so that it is two independent bits.
struct HilbertTable
{
  std::array<std::uint16_t, 4 * 256> Entries{};

  constexpr HilbertTable()
  {
    for (unsigned start = 0; start < 4; ++start)
    {
      for (unsigned cell = 0; cell < 256; ++cell)
      {
        unsigned swapped = start & 1;
        unsigned flipped = start >> 1;
        unsigned key = 0;
        for (unsigned level = LevelsPerStep; level-- > 0;)
        {
          const unsigned x = ((cell >> (4 + level)) & 1) ^ flipped;
          const unsigned y = ((cell >> level) & 1) ^ flipped;
          const unsigned u = swapped ? y : x;
          const unsigned v = swapped ? x : y;
          key = (key << 2) | ((3 * u) ^ v);
          if (v == 0)
          {
            flipped ^= u;
            swapped ^= 1;
          }
        }
        this->Entries[start * 256 + cell] =
          static_cast<std::uint16_t>(key | ((flipped << 1 | swapped) << 8));
      }
    }
  }
};

constexpr HilbertTable Hilbert;

std::uint64_t hilbertKey(std::uint32_t x, std::uint32_t y)
{
  std::uint64_t key = 0;
  unsigned state = 0;
  for (unsigned step = Steps; step-- > 0;)
  {
    const unsigned shift = LevelsPerStep * step;
    const unsigned cell = ((x >> shift) & 15) << 4 | ((y >> shift) & 15);
    const unsigned entry = Hilbert.Entries[state * 256 + cell];
    key = key << 8 | (entry & 255);
    state = entry >> 8;
  }
  return key;
}

/// Rounds before the last: so many that the first holds a few dozen points.
unsigned earlierRounds(std::size_t count)
{
  unsigned rounds = 0;
  for (std::size_t size = count; size > 256 && rounds + 1 < (1U << RoundBits); size /= 8)
  {
    ++rounds;
  }
  return rounds;
}

std::uint64_t mix(std::uint64_t z)
{
  z = (z + 0x9e3779b97f4a7c15U) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 29)) * 0x94d049bb133111ebU;
  return z ^ (z >> 32);
}

std::uint32_t quantise(double distance, double scale)
{
  constexpr double cells = 1U << Levels;
  const double cell = distance * scale;
  // NaN (an extent of zero, or beyond the range of doubles) goes to cell 0: slower, never wrong.
  return cell > 0 ? static_cast<std::uint32_t>(std::min(cell, cells - 1)) : 0;
}

} // namespace

void InsertionOrder::computeKeys(const Point2* points, std::size_t count)
{
  Point2 low = points[0];
  Point2 high = points[0];
  for (std::size_t i = 1; i < count; ++i)
  {
    low.x = std::min(low.x, points[i].x);
    low.y = std::min(low.y, points[i].y);
    high.x = std::max(high.x, points[i].x);
    high.y = std::max(high.y, points[i].y);
  }
  const double scale = (1U << Levels) / std::max(high.x - low.x, high.y - low.y);
  const unsigned lastRound = earlierRounds(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::uint32_t x = quantise(points[i].x - low.x, scale);
    const std::uint32_t y = quantise(points[i].y - low.y, scale);
    const unsigned earlier = static_cast<unsigned>(__builtin_ctzll(mix(i) | (1ULL << 63))) / 3;
    const std::uint64_t round = lastRound - std::min(earlier, lastRound);
    this->Entries[i] = (round << KeyBits | hilbertKey(x, y)) << IndexBits | i;
  }
}

template <unsigned passes>
void InsertionOrder::sortByKey()
{
  constexpr unsigned digitBits = (KeyBits + RoundBits) / passes;
  constexpr unsigned digits = 1U << digitBits;
  static_assert(passes * digitBits == KeyBits + RoundBits, "the passes cover the key");

  std::array<std::array<std::uint32_t, digits>, passes> starts{};
  for (const std::uint64_t entry : this->Entries)
  {
    for (unsigned pass = 0; pass < passes; ++pass)
    {
      ++starts[pass][(entry >> (IndexBits + pass * digitBits)) & (digits - 1)];
    }
  }
  for (unsigned pass = 0; pass < passes; ++pass)
  {
    std::uint32_t sum = 0;
    for (std::uint32_t& start : starts[pass])
    {
      const std::uint32_t size = start;
      start = sum;
      sum += size;
    }
    for (const std::uint64_t entry : this->Entries)
    {
      this->Scratch[starts[pass][(entry >> (IndexBits + pass * digitBits)) & (digits - 1)]++] =
        entry;
    }
    this->Entries.swap(this->Scratch);
  }
}

const std::vector<std::uint32_t>& InsertionOrder::compute(const Point2* points, std::size_t count)
{
  this->Entries.resize(count);
  this->Scratch.resize(count);
  this->Order.resize(count);
  if (count > 0)
  {
    this->computeKeys(points, count);
    // Large digits need fewer passes, but their counters would cost more than a few points.
    constexpr std::size_t many = 8192;
    count < many ? this->sortByKey<4>() : this->sortByKey<3>();
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    this->Order[i] = static_cast<std::uint32_t>(this->Entries[i] & ((1U << IndexBits) - 1));
  }
  return this->Order;
}

void InsertionOrder::releaseIfLarge()
{
  constexpr std::size_t large = std::size_t(1) << 18;
  if (this->Order.capacity() > large)
  {
    std::vector<std::uint64_t>().swap(this->Entries);
    std::vector<std::uint64_t>().swap(this->Scratch);
    std::vector<std::uint32_t>().swap(this->Order);
  }
}

} // namespace tipp
