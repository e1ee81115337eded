// SPDX-License-Identifier: BSD-3-Clause
#include "Kernel3D/InsertionOrder3.h"

#include <algorithm>
#include <array>

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

struct Curve3
{
  using Point = Point3;
  static constexpr unsigned Levels = tipp::Levels;

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
