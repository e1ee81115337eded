// SPDX-License-Identifier: BSD-3-Clause
#include "Kernel3D/InsertionOrder3.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace tipp
{
namespace
{

constexpr unsigned IndexBits = InsertionOrder3::IndexBits;
constexpr unsigned Levels = 12;
static_assert(3 * Levels + IndexBits == 64, "an entry is one word");

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
    const unsigned before = digit % 2 == 0 ? digit - 1 : digit;
    unsigned direction = 0;
    if (digit != 0)
    {
      // The number of trailing ones.
      for (unsigned bits = before; (bits & 1) != 0; bits >>= 1)
      {
        ++direction;
      }
      direction %= 3;
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
  for (unsigned level = Levels; level-- > 0;)
  {
    const unsigned octant = (x >> level & 1) << 2 | (y >> level & 1) << 1 | (z >> level & 1);
    const HilbertTable::Step step = Hilbert.Steps[state][octant];
    key = key << 3 | step.Digit;
    state = step.Next;
  }
  return key;
}

std::uint32_t quantise(double distance, double scale)
{
  constexpr double last = (1U << Levels) - 1;
  const double cell = distance * scale;
  const double atLeast = cell > 0 ? cell : 0;
  return static_cast<std::uint32_t>(atLeast < last ? atLeast : last);
}

/// Murmur3's finaliser.
std::uint32_t mix(std::uint32_t z)
{
  z = (z ^ z >> 16) * 0x85ebca6bU;
  z = (z ^ z >> 13) * 0xc2b2ae35U;
  return z ^ z >> 16;
}

struct Bounds
{
  Point3 Low;
  Point3 High;

  void include(const Point3& p)
  {
    this->Low = { std::min(this->Low.x, p.x), std::min(this->Low.y, p.y),
      std::min(this->Low.z, p.z) };
    this->High = { std::max(this->High.x, p.x), std::max(this->High.y, p.y),
      std::max(this->High.z, p.z) };
  }

  /// Cells of the finest level per unit of length.
  double scale() const
  {
    const Point3 sides = this->High - this->Low;
    return (1U << Levels) / std::max({ sides.x, sides.y, sides.z });
  }
};

/// Runs of at most this many points are not sorted: a walk among them is short.
constexpr std::size_t ShortRun = 16;

} // namespace

/// Radix sort, least significant digit first. Few entries are sorted by comparison.
void InsertionOrder3::sortByKey(std::size_t begin, std::size_t end)
{
  constexpr std::size_t few = 4096;
  if (end - begin < few)
  {
    std::sort(
      this->Entries.begin() + std::ptrdiff_t(begin), this->Entries.begin() + std::ptrdiff_t(end));
    return;
  }
  constexpr unsigned digitBits = 12;
  constexpr unsigned passes = 3;
  constexpr std::uint64_t mask = (1U << digitBits) - 1;
  std::array<std::array<std::uint32_t, mask + 1>, passes> starts = {};
  for (std::size_t i = begin; i < end; ++i)
  {
    for (unsigned pass = 0; pass < passes; ++pass)
    {
      ++starts[pass][this->Entries[i] >> (IndexBits + pass * digitBits) & mask];
    }
  }
  std::uint64_t* from = &this->Entries[begin];
  std::uint64_t* to = &this->Scratch[begin];
  for (unsigned pass = 0; pass < passes; ++pass)
  {
    std::uint32_t sum = 0;
    for (std::uint32_t& start : starts[pass])
    {
      sum += std::exchange(start, sum);
    }
    for (std::size_t i = 0; i < end - begin; ++i)
    {
      to[starts[pass][from[i] >> (IndexBits + pass * digitBits) & mask]++] = from[i];
    }
    std::swap(from, to);
  }
  std::copy_n(&this->Scratch[begin], end - begin, &this->Entries[begin]);
}

void InsertionOrder3::fillKeys(
  const Point3* points, std::size_t begin, std::size_t end, const Point3& low, double scale)
{
  for (std::size_t i = begin; i < end; ++i)
  {
    const std::uint32_t index = (*this)[i];
    const Point3 p = points[index] - low;
    this->Entries[i] = hilbertKey3(quantise(p.x, scale), quantise(p.y, scale), quantise(p.z, scale))
        << IndexBits |
      index;
  }
}

/// Sorts points along a curve in their bounding box. If more than a few share a cell of the finest
/// level, they are sorted again in their own bounding box, and so on. This is needed because
/// coordinates may differ by hundreds of powers of two.
void InsertionOrder3::sortRound(const Point3* points, std::size_t begin, std::size_t end)
{
  std::vector<std::pair<std::size_t, std::size_t>> runs = { { begin, end } };
  while (!runs.empty())
  {
    const auto [first, last] = runs.back();
    runs.pop_back();
    Bounds bounds{ points[(*this)[first]], points[(*this)[first]] };
    for (std::size_t i = first; i < last; ++i)
    {
      bounds.include(points[(*this)[i]]);
    }
    // If all points coincide, or if the box is too large or too small for doubles, the order does
    // not matter.
    if (!std::isnormal(bounds.scale()))
    {
      continue;
    }
    this->fillKeys(points, first, last, bounds.Low, bounds.scale());
    this->sortByKey(first, last);
    std::size_t start = first;
    for (std::size_t i = first + 1; i <= last; ++i)
    {
      if (i == last || (this->Entries[i] ^ this->Entries[start]) >> IndexBits != 0)
      {
        if (i - start > ShortRun)
        {
          runs.emplace_back(start, i);
        }
        start = i;
      }
    }
  }
}

void InsertionOrder3::compute(const Point3* points, std::size_t count)
{
  this->Entries.resize(count);
  this->Scratch.resize(count);
  constexpr unsigned mostRounds = 10;
  unsigned lastRound = 0;
  for (std::size_t size = count; size > 512 && lastRound + 1 < mostRounds; size /= 8)
  {
    ++lastRound;
  }
  const auto roundOf = [lastRound](std::uint32_t index)
  {
    const auto zeros = static_cast<unsigned>(__builtin_ctz(mix(index) | 1U << 30));
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
      this->sortRound(points, begins[round], begins[round + 1]);
    }
  }
}

void InsertionOrder3::release()
{
  Uninitialised<std::uint64_t>().swap(this->Entries);
  Uninitialised<std::uint64_t>().swap(this->Scratch);
}

} // namespace tipp
