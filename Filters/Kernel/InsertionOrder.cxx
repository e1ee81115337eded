// SPDX-License-Identifier: BSD-3-Clause
#include "Kernel/InsertionOrder.h"

#include "Kernel/Lanes.h"

#include <algorithm>
#include <utility>
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

/// Computes the entries of a block in several loops, each of which compilers vectorise.
inline void fillBlock(const Point2* points, std::size_t first, std::size_t count, Pair low,
  double scale, unsigned lastRound, std::uint64_t* entries)
{
  std::uint32_t x[PointsInBlock];
  std::uint32_t y[PointsInBlock];
  std::uint32_t round[PointsInBlock];
  for (std::size_t i = 0; i < count; ++i)
  {
    x[i] = gridCell<Levels>(points[first + i].x - low[0], scale);
    y[i] = gridCell<Levels>(points[first + i].y - low[1], scale);
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    x[i] = hilbertKey(x[i], y[i]);
    y[i] = roundBits(static_cast<std::uint32_t>(first + i));
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
  const unsigned lastRound = earlierRounds(count, 256, (1U << RoundBits) - 1);
  for (std::size_t first = 0; first < count; first += PointsInBlock)
  {
    fillBlock(
      points, first, std::min(PointsInBlock, count - first), extent.Low, scale, lastRound, entries);
  }
}

struct Curve2
{
  using Point = Point2;
  static constexpr unsigned Levels = tipp::Levels;

  static Point2 lower(Point2 a, Point2 b) { return { std::min(a.x, b.x), std::min(a.y, b.y) }; }
  static Point2 upper(Point2 a, Point2 b) { return { std::max(a.x, b.x), std::max(a.y, b.y) }; }
  static double longestSide(Point2 sides) { return std::max(sides.x, sides.y); }
  static std::uint32_t key(Point2 p, double scale)
  {
    return hilbertKey(gridCell<Levels>(p.x, scale), gridCell<Levels>(p.y, scale));
  }
};

} // namespace

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
  count < many ? this->sortByDigits<2, 11, 64 - 2 * 11>({ 0, count })
               : this->sortByDigits<2, 12, 64 - 2 * 12>({ 0, count });
  if (this->hasManyTies(count < many ? 64 - 2 * 11 : 64 - 2 * 12))
  {
    this->sortByDigits<3, 12, IndexBits>({ 0, count });
    if (this->hasManyTies(IndexBits))
    {
      std::vector<Run> runs;
      this->addRuns({ 0, count }, runs);
      this->sortRuns<Curve2>(points, std::move(runs));
    }
  }
}

void InsertionOrder::releaseIfLarge()
{
  constexpr std::size_t large = std::size_t(1) << 18;
  if (this->Entries.capacity() > large)
  {
    this->release();
  }
}

} // namespace tipp
