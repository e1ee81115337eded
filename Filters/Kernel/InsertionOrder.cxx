// SPDX-License-Identifier: BSD-3-Clause
#include "Kernel/InsertionOrder.h"

#include <algorithm>
#include <array>
#include <utility>

namespace tipp
{
namespace
{

constexpr unsigned IndexBits = CurveOrder::IndexBits;
constexpr unsigned Levels2 = 16; ///< of the curve in the plane
constexpr unsigned Levels3 = 12; ///< of the curve in space
constexpr unsigned KeyBits = 2 * Levels2;
constexpr unsigned RoundBits = 4;
constexpr std::size_t PointsInBlock = 256;
static_assert(RoundBits + KeyBits + IndexBits == 64, "an entry is one word");
static_assert(3 * Levels3 + IndexBits == 64, "an entry is one word");

/// @name Biased randomised insertion rounds (Amenta, Choi, Rote 2003)
/// One point in eight goes to a round before the last, one in eight of these to a round before the
/// last but one, and so on.
///@{
/// The number of rounds before the last: as many as are needed for the first round to have at most
/// about `few` points, but no more than `most`.
inline unsigned earlierRounds(std::size_t count, std::size_t few, unsigned most)
{
  unsigned rounds = 0;
  for (std::size_t size = count; size > few && rounds < most; size /= 8)
  {
    ++rounds;
  }
  return rounds;
}

/// Random bits of a point, computed from its index (Murmur3's finaliser). For every three trailing
/// zeros the point is one round earlier.
inline std::uint32_t roundBits(std::uint32_t index)
{
  index = (index ^ index >> 16) * 0x85ebca6bU;
  index = (index ^ index >> 13) * 0xc2b2ae35U;
  return index ^ index >> 16;
}
///@}

/// The cell, below 2^Levels, at a distance from the lower border; `scale` is in cells per length.
template <unsigned Levels>
inline std::uint32_t gridCell(double distance, double scale)
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
    x[i] = gridCell<Levels2>(points[first + i].x - low[0], scale);
    y[i] = gridCell<Levels2>(points[first + i].y - low[1], scale);
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
  const Pair low = pairAt(&extent.Bounds.Min.x);
  const Pair sides = pairAt(&extent.Bounds.Max.x) - low;
  const double scale = (1U << Levels2) / std::max(sides[0], sides[1]);
  const unsigned lastRound = earlierRounds(count, 256, (1U << RoundBits) - 1);
  for (std::size_t first = 0; first < count; first += PointsInBlock)
  {
    fillBlock(
      points, first, std::min(PointsInBlock, count - first), low, scale, lastRound, entries);
  }
}

struct Curve2
{
  using Point = Point2;
  static constexpr unsigned Levels = Levels2;

  static Point2 lower(Point2 a, Point2 b) { return { std::min(a.x, b.x), std::min(a.y, b.y) }; }
  static Point2 upper(Point2 a, Point2 b) { return { std::max(a.x, b.x), std::max(a.y, b.y) }; }
  static double longestSide(Point2 sides) { return std::max(sides.x, sides.y); }
  static std::uint32_t key(Point2 p, double scale)
  {
    return hilbertKey(gridCell<Levels>(p.x, scale), gridCell<Levels>(p.y, scale));
  }
};

constexpr unsigned rotated(unsigned bits, unsigned by)
{
  return (bits << by | bits >> (3 - by)) & 7;
}

constexpr unsigned gray(unsigned n)
{
  return n ^ n >> 1;
}

/// The Hilbert curve in three dimensions as an automaton of 24 states (Hamilton 2006). A state is
/// the corner where the curve enters a cube, and the axis from there to the corner where it leaves.
struct HilbertTable
{
  struct Step
  {
    std::uint8_t Digit;
    std::uint8_t Next;
  };
  std::array<std::array<Step, 8>, 24> Steps = {};

  constexpr HilbertTable()
  {
    for (unsigned state = 0; state < 24; ++state)
    {
      for (unsigned octant = 0; octant < 8; ++octant)
      {
        this->Steps[state][octant] = step(state / 3, state % 3, octant);
      }
    }
  }

private:
  static constexpr Step step(unsigned entry, unsigned axis, unsigned octant)
  {
    const unsigned turn = (axis + 1) % 3;
    const unsigned local = rotated(octant ^ entry, (3 - turn) % 3);
    unsigned digit = 0;
    while (gray(digit) != local)
    {
      ++digit;
    }
    const unsigned localEntry = digit == 0 ? 0 : gray((digit - 1) & ~1U);
    // The number of trailing ones of the last odd number up to the digit.
    unsigned direction = 0;
    for (unsigned bits = digit == 0 ? 0 : (digit - 1) | 1; (bits & 1) != 0; bits >>= 1)
    {
      ++direction;
    }
    const unsigned nextEntry = entry ^ rotated(localEntry, turn);
    const unsigned nextAxis = (axis + direction + 1) % 3;
    return { static_cast<std::uint8_t>(digit),
      static_cast<std::uint8_t>(3 * nextEntry + nextAxis) };
  }
};

constexpr HilbertTable Hilbert;

std::uint64_t hilbertKey3(std::uint32_t x, std::uint32_t y, std::uint32_t z)
{
  std::uint64_t key = 0;
  unsigned state = 0;
  for (unsigned level = Levels3; level-- > 0;)
  {
    const unsigned octant = (x >> level & 1) << 2 | (y >> level & 1) << 1 | (z >> level & 1);
    const HilbertTable::Step step = Hilbert.Steps[state][octant];
    key = key << 3 | step.Digit;
    state = step.Next;
  }
  return key;
}

struct Curve3
{
  using Point = Point3;
  static constexpr unsigned Levels = Levels3;

  static Point3 lower(const Point3& a, const Point3& b)
  {
    return { std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z) };
  }
  static Point3 upper(const Point3& a, const Point3& b)
  {
    return { std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z) };
  }
  static double longestSide(const Point3& sides) { return std::max({ sides.x, sides.y, sides.z }); }
  static std::uint64_t key(const Point3& p, double scale)
  {
    return hilbertKey3(
      gridCell<Levels>(p.x, scale), gridCell<Levels>(p.y, scale), gridCell<Levels>(p.z, scale));
  }
};

} // namespace

/// Radix sort of a range by `passes` digits from bit `lowest` up, least significant digit first.
template <unsigned passes, unsigned digitBits, unsigned lowest>
void CurveOrder::sortByDigits(EntryRange range)
{
  constexpr std::uint64_t mask = (1U << digitBits) - 1;
  std::array<std::array<std::uint32_t, mask + 1>, passes> starts = {};
  const std::size_t count = range.End - range.Begin;
  std::uint64_t* from = this->Entries.data() + range.Begin;
  std::uint64_t* to = this->Scratch.data() + range.Begin;
  for (std::size_t i = 0; i < count; ++i)
  {
    for (unsigned pass = 0; pass < passes; ++pass)
    {
      ++starts[pass][from[i] >> (lowest + pass * digitBits) & mask];
    }
  }
  for (unsigned pass = 0; pass < passes; ++pass)
  {
    std::uint32_t sum = 0;
    for (std::uint32_t& start : starts[pass])
    {
      sum += std::exchange(start, sum);
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      to[starts[pass][from[i] >> (lowest + pass * digitBits) & mask]++] = from[i];
    }
    std::swap(from, to);
  }
  if (passes % 2 == 1 && count == this->size())
  {
    this->Entries.swap(this->Scratch);
  }
  else if (passes % 2 == 1)
  {
    std::copy_n(from, count, to);
  }
}

/// Adds the runs of equal keys in `within` that have more than a few points. Shorter runs are not
/// worth sorting: a walk among their points is short.
void CurveOrder::addRuns(EntryRange within, std::vector<EntryRange>& runs) const
{
  constexpr std::size_t few = 16;
  std::size_t begin = within.Begin;
  for (std::size_t i = begin + 1; i <= within.End; ++i)
  {
    if (i == within.End || (this->Entries[i] ^ this->Entries[begin]) >> IndexBits != 0)
    {
      if (i - begin > few)
      {
        runs.push_back({ begin, i });
      }
      begin = i;
    }
  }
}

/// Sorts the points of each run along a curve in the run's bounding box. Points that share a cell
/// of the finest level, if more than a few, are sorted again in their own bounding box, and so
/// on: coordinates may differ by hundreds of powers of two. The points of a run must be in the
/// order of their indices.
template <typename Curve>
void CurveOrder::sortRuns(const typename Curve::Point* points, std::vector<EntryRange> runs)
{
  constexpr std::size_t few = 4096;
  Uninitialised<typename Curve::Point> local;
  while (!runs.empty())
  {
    const EntryRange run = runs.back();
    runs.pop_back();
    // A copy of the points, so that compilers vectorise the computation of keys.
    local.resize(run.End - run.Begin);
    for (std::size_t i = 0; i < local.size(); ++i)
    {
      local[i] = points[(*this)[run.Begin + i]];
    }
    auto low = local.front();
    auto high = low;
    for (const auto& p : local)
    {
      low = Curve::lower(low, p);
      high = Curve::upper(high, p);
    }
    const double scale = (1U << Curve::Levels) / Curve::longestSide(high - low);
    // If all points coincide, or if the box is too large or too small for doubles, the order does
    // not matter.
    if (!std::isnormal(scale))
    {
      continue;
    }
    std::uint64_t* const entries = &this->Entries[run.Begin];
    for (std::size_t i = 0; i < local.size(); ++i)
    {
      entries[i] =
        std::uint64_t(Curve::key(local[i] - low, scale)) << IndexBits | (entries[i] & IndexMask);
    }
    run.End - run.Begin < few ? std::sort(&this->Entries[run.Begin], this->Entries.data() + run.End)
                              : this->sortByDigits<3, 12, IndexBits>(run);
    this->addRuns(run, runs);
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
  count < many ? this->sortByDigits<2, 11, 64 - 2 * 11>({ 0, count })
               : this->sortByDigits<2, 12, 64 - 2 * 12>({ 0, count });
  if (this->hasManyTies(count < many ? 64 - 2 * 11 : 64 - 2 * 12))
  {
    this->sortByDigits<3, 12, IndexBits>({ 0, count });
    if (this->hasManyTies(IndexBits))
    {
      std::vector<EntryRange> runs;
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

void InsertionOrder3::compute(const Point3* points, std::size_t count)
{
  this->Entries.resize(count);
  this->Scratch.resize(count);
  constexpr unsigned mostRounds = 10;
  const unsigned lastRound = earlierRounds(count, 512, mostRounds - 1);
  const auto roundOf = [lastRound](std::uint32_t index)
  {
    const auto zeros = static_cast<unsigned>(__builtin_ctz(roundBits(index) | 1U << 30));
    return lastRound - std::min(lastRound, zeros / 3);
  };
  std::array<std::size_t, mostRounds + 1> begins = {};
  for (std::size_t i = 0; i < count; ++i)
  {
    ++begins[roundOf(static_cast<std::uint32_t>(i)) + 1];
  }
  for (unsigned round = 0; round < mostRounds; ++round)
  {
    begins[round + 1] += begins[round];
  }
  this->RoundEnds.assign(begins.begin() + 1, begins.begin() + lastRound + 2);
  std::array<std::size_t, mostRounds + 1> next = begins;
  for (std::size_t i = 0; i < count; ++i)
  {
    this->Entries[next[roundOf(static_cast<std::uint32_t>(i))]++] = i;
  }
  for (unsigned round = 0; round <= lastRound; ++round)
  {
    if (begins[round] < begins[round + 1])
    {
      this->sortRuns<Curve3>(points, { { begins[round], begins[round + 1] } });
    }
  }
}

} // namespace tipp
