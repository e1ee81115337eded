// SPDX-License-Identifier: BSD-3-Clause
#include "Kernel/InsertionOrder.h"

#include "Kernel/Lanes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace tipp
{
namespace
{

constexpr unsigned IndexBits = InsertionOrder::IndexBits;
constexpr unsigned Levels = 16;
constexpr unsigned KeyBits = 2 * Levels;
constexpr unsigned RoundBits = 4;
constexpr std::size_t PointsInBlock = 256;
static_assert(RoundBits + KeyBits + IndexBits == 64, "an entry is one word");

/// The number of rounds before the last, chosen so that the first holds a few dozen points.
unsigned earlierRounds(std::size_t count)
{
  unsigned rounds = 0;
  for (std::size_t size = count; size > 256 && rounds + 1 < (1U << RoundBits); size /= 8)
  {
    ++rounds;
  }
  return rounds;
}

/// Murmur3's finaliser.
inline std::uint32_t mix(std::uint32_t z)
{
  z = (z ^ z >> 16) * 0x85ebca6bU;
  z = (z ^ z >> 13) * 0xc2b2ae35U;
  return z ^ z >> 16;
}

inline std::uint32_t quantise(double distance, double scale)
{
  constexpr double last = (1U << Levels) - 1;
  const double cell = distance * scale;
  // NaN (the extent is zero or exceeds the range of doubles) gives cell 0: slower, but correct.
  const double atLeast = cell > 0 ? cell : 0;
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(atLeast < last ? atLeast : last));
}

/// Computes the entries of a block in several loops, each of which compilers vectorise.
inline void fillBlock(const Point2* points, std::size_t first, std::size_t count, Pair low,
  double scale, unsigned lastRound, std::uint64_t* entries)
{
  std::uint32_t x[PointsInBlock];
  std::uint32_t y[PointsInBlock];
  std::uint32_t round[PointsInBlock];
  for (std::size_t i = 0; i < count; ++i)
  {
    x[i] = quantise(points[first + i].x - low[0], scale);
    y[i] = quantise(points[first + i].y - low[1], scale);
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    x[i] = hilbertKey(x[i], y[i]);
    y[i] = mix(static_cast<std::uint32_t>(first + i));
    round[i] = lastRound;
  }
  for (unsigned earlier = 1; earlier <= lastRound; ++earlier)
  {
    const std::uint32_t mask = (1U << (3 * earlier)) - 1;
    for (std::size_t i = 0; i < count; ++i)
    {
      round[i] -= (y[i] & mask) == 0 ? 1 : 0;
    }
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::uint64_t roundAndKey = std::uint64_t(round[i]) << KeyBits | x[i];
    entries[first + i] = roundAndKey << IndexBits | (first + i);
  }
}

inline void fillEntries(const Point2* points, std::size_t count, std::uint64_t* entries)
{
  const Extent extent = extentOf(points, count);
  const Pair sides = extent.High - extent.Low;
  const double scale = (1U << Levels) / std::max(sides[0], sides[1]);
  const unsigned lastRound = earlierRounds(count);
  for (std::size_t first = 0; first < count; first += PointsInBlock)
  {
    fillBlock(
      points, first, std::min(PointsInBlock, count - first), extent.Low, scale, lastRound, entries);
  }
}

/// Entries of consecutive points with the same round and key.
struct Run
{
  std::size_t Begin;
  std::size_t End;
};

/// Runs of at most this many points are not worth sorting: a walk among them is short.
constexpr std::size_t ShortRun = 16;

/// Adds the runs of more than ShortRun entries in `within` that are equal above bit `lowest`.
void addRuns(
  const Uninitialised<std::uint64_t>& entries, Run within, unsigned lowest, std::vector<Run>& runs)
{
  const std::size_t count = within.End - within.Begin;
  std::size_t begin = 0;
  for (std::size_t i = 1; i <= count; ++i)
  {
    if (i == count || (entries[i] ^ entries[begin]) >> lowest != 0)
    {
      if (i - begin > ShortRun)
      {
        runs.push_back({ within.Begin + begin, within.Begin + i });
      }
      begin = i;
    }
  }
}

/// Computes each point's key in the points' own bounding box, with its index in the low bits.
/// Returns false if that distinguishes no points: all coincide, or the box is too large or too
/// small for doubles.
bool fillKeys(const std::vector<Point2>& points, Uninitialised<std::uint64_t>& keys)
{
  const Extent extent = extentOf(points.data(), points.size());
  const Pair sides = extent.High - extent.Low;
  const double scale = (1U << Levels) / std::max(sides[0], sides[1]);
  if (!std::isnormal(scale))
  {
    return false;
  }
  keys.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const std::uint64_t key = hilbertKey(
      quantise(points[i].x - extent.Low[0], scale), quantise(points[i].y - extent.Low[1], scale));
    keys[i] = key << IndexBits | i;
  }
  return true;
}

} // namespace

InsertionOrder::InsertionOrder(Instructions instructions)
  : Allowed(instructions)
{
}

/// Radix sort by the bits of the entries from `lowest` up, least significant digit first.
template <unsigned passes>
void InsertionOrder::sortByDigits(unsigned lowest, unsigned digitBits)
{
  constexpr std::size_t most = 1U << 12;
  const std::uint64_t mask = (1U << digitBits) - 1;
  std::array<std::array<std::uint32_t, most>, passes> starts;
  for (auto& pass : starts)
  {
    std::fill_n(pass.begin(), mask + 1, 0U);
  }
  for (const std::uint64_t entry : this->Entries)
  {
    for (unsigned pass = 0; pass < passes; ++pass)
    {
      ++starts[pass][(entry >> (lowest + pass * digitBits)) & mask];
    }
  }
  for (unsigned pass = 0; pass < passes; ++pass)
  {
    std::uint32_t sum = 0;
    for (std::size_t digit = 0; digit <= mask; ++digit)
    {
      const std::uint32_t size = starts[pass][digit];
      starts[pass][digit] = sum;
      sum += size;
    }
    for (const std::uint64_t entry : this->Entries)
    {
      this->Scratch[starts[pass][(entry >> (lowest + pass * digitBits)) & mask]++] = entry;
    }
    this->Entries.swap(this->Scratch);
  }
}

/// Whether more than a few neighbours in the order differ only below bit `lowest`. Samples every
/// fourth.
bool InsertionOrder::hasManyTies(unsigned lowest) const
{
  constexpr std::size_t step = 4;
  std::size_t ties = 0;
  for (std::size_t i = 1; i < this->Entries.size(); i += step)
  {
    ties += (this->Entries[i] ^ this->Entries[i - 1]) >> lowest == 0 ? 1 : 0;
  }
  return 16 * step * ties > this->Entries.size();
}

void InsertionOrder::compute(const Point2* points, std::size_t count)
{
  this->Entries.resize(count);
  this->Scratch.resize(count);
  if (count == 0)
  {
    return;
  }
  runWith(this->Allowed, [&] { fillEntries(points, count, this->Entries.data()); });
  // Two passes distinguish evenly spread points; clusters need the finer levels as well. Histograms
  // of large digits would cost more than they save for a few points.
  constexpr std::size_t many = 16384;
  const unsigned digitBits = count < many ? 11 : 12;
  const unsigned lowest = 64 - 2 * digitBits;
  this->sortByDigits<2>(lowest, digitBits);
  if (this->hasManyTies(lowest))
  {
    this->sortByDigits<3>(IndexBits, (RoundBits + KeyBits) / 3);
    if (this->hasManyTies(IndexBits))
    {
      this->refineTies(points);
    }
  }
}

/// Sorts points of one round that share a cell of the finest level along a curve in their own
/// bounding box, and repeats this until few share a cell: coordinates may differ by hundreds of
/// powers of two.
void InsertionOrder::refineTies(const Point2* points)
{
  std::vector<Run> runs;
  addRuns(this->Entries, { 0, this->Entries.size() }, IndexBits, runs);
  Uninitialised<std::uint64_t> keys;
  std::vector<Point2> local;
  while (!runs.empty())
  {
    const Run run = runs.back();
    runs.pop_back();
    local.clear();
    for (std::size_t i = run.Begin; i < run.End; ++i)
    {
      local.push_back(points[(*this)[i]]);
    }
    if (!fillKeys(local, keys))
    {
      continue;
    }
    std::sort(keys.begin(), keys.end());
    for (std::size_t i = 0; i < local.size(); ++i)
    {
      this->Scratch[run.Begin + i] = this->Entries[run.Begin + (keys[i] & IndexMask)];
    }
    std::copy_n(&this->Scratch[run.Begin], local.size(), &this->Entries[run.Begin]);
    addRuns(keys, { run.Begin, run.End }, IndexBits, runs);
  }
}

void InsertionOrder::releaseIfLarge()
{
  constexpr std::size_t large = std::size_t(1) << 18;
  if (this->Entries.capacity() > large)
  {
    Uninitialised<std::uint64_t>().swap(this->Entries);
    Uninitialised<std::uint64_t>().swap(this->Scratch);
  }
}

} // namespace tipp
