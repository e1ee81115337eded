// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCurveOrder_h
#define tippCurveOrder_h

#include "Arrays/Buffer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace tipp
{

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

/// An order of points along a space-filling curve: 64-bit entries, each with a key in the high bits
/// and the point's index in the low ones.
class CurveOrder
{
public:
  static constexpr unsigned IndexBits = 28;

  std::size_t size() const { return this->Entries.size(); }

  /// The input index of the k-th point to insert.
  std::uint32_t operator[](std::size_t k) const
  {
    return static_cast<std::uint32_t>(this->Entries[k] & IndexMask);
  }

  /// Reserves memory for `points` points.
  void reserve(std::size_t points)
  {
    this->Entries.reserve(points);
    this->Scratch.reserve(points);
  }

  std::size_t bytes() const
  {
    return (this->Entries.capacity() + this->Scratch.capacity()) * sizeof(std::uint64_t);
  }

  /// Frees the memory and the order.
  void release()
  {
    Uninitialised<std::uint64_t>().swap(this->Entries);
    Uninitialised<std::uint64_t>().swap(this->Scratch);
  }

protected:
  static constexpr std::uint64_t IndexMask = (std::uint64_t(1) << IndexBits) - 1;

  /// A range of entries.
  struct Run
  {
    std::size_t Begin;
    std::size_t End;
  };

  /// Radix sort of a range by `passes` digits from bit `lowest` up, least significant digit first.
  template <unsigned passes, unsigned digitBits, unsigned lowest>
  void sortByDigits(Run range)
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
  void addRuns(Run within, std::vector<Run>& runs) const
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
  void sortRuns(const typename Curve::Point* points, std::vector<Run> runs)
  {
    constexpr std::size_t few = 4096;
    Uninitialised<typename Curve::Point> local;
    while (!runs.empty())
    {
      const Run run = runs.back();
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
      run.End - run.Begin < few
        ? std::sort(&this->Entries[run.Begin], this->Entries.data() + run.End)
        : this->sortByDigits<3, 12, IndexBits>(run);
      this->addRuns(run, runs);
    }
  }

  Uninitialised<std::uint64_t> Entries;
  Uninitialised<std::uint64_t> Scratch;
};

} // namespace tipp

#endif
