// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippStreamSampler_h
#define tippStreamSampler_h

#include "Arrays/Random.h"
#include "Predicates/Geometry.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace tipp
{

/// A point of a sample.
template <typename Point>
struct SampledPointOf
{
  std::int64_t Id; ///< index in the stream
  Point Position;
};

/// Picks one point from each range of ids, at random but always the same. Ranges double in length
/// until their number is at most twice `atLeast`. (Picks at equal distances could hit one column of
/// a lattice given row by row.) If the number of all points is known, the picks from a part of the
/// stream are those that the whole stream gives there.
template <typename Point>
class StreamSampler
{
public:
  /// `atLeast`: the smallest size of the sample if the stream has that many points. `points`: the
  /// number of points in the whole stream, or -1.
  StreamSampler(std::size_t atLeast, std::int64_t points)
    : Most(2 * std::int64_t(std::max<std::size_t>(atLeast, 1)))
    , IsKnown(points >= 0)
  {
    while (this->IsKnown && this->pick(this->Most - 1, this->Doublings) < points)
    {
      ++this->Doublings;
    }
  }

  /// Adds the next points of the stream; the first of them has the id `first`. `points` has size()
  /// and operator[].
  template <typename View>
  void add(std::int64_t first, const View& points)
  {
    const std::int64_t end = first + std::int64_t(points.size());
    this->Range = std::max(this->Range, first >> this->Doublings);
    for (std::int64_t id = this->next(); id < end; id = this->next())
    {
      ++this->Range;
      if (id < first)
      {
        continue; // the pick belongs to an earlier part
      }
      this->Picks.push_back({ id, points[std::size_t(id - first)] });
      if (!this->IsKnown && this->Range == this->Most)
      {
        this->halve();
      }
    }
  }

  /// Returns the picks that are finite, and leaves none.
  std::vector<SampledPointOf<Point>> take()
  {
    this->Picks.erase(std::remove_if(this->Picks.begin(), this->Picks.end(),
                        [](const SampledPointOf<Point>& p) { return !isFinite(p.Position); }),
      this->Picks.end());
    return std::move(this->Picks);
  }

private:
  std::int64_t next() const { return this->pick(this->Range, this->Doublings); }

  /// Which one of two neighbouring ranges keeps its pick when ranges double.
  static std::int64_t chosenOf(std::int64_t pair) { return 2 * pair + (mixBits(pair) & 1); }

  /// Returns the id picked for a range after this many doublings. For the first half of the ranges,
  /// it was picked when they were shorter.
  std::int64_t pick(std::int64_t range, int doublings) const
  {
    while (doublings > 0 && range < this->Most / 2)
    {
      range = chosenOf(range);
      --doublings;
    }
    const std::int64_t length = std::int64_t(1) << doublings;
    return range * length +
      std::int64_t(mixBits(std::uint64_t(range * 64 + doublings)) % std::uint64_t(length));
  }

  /// Doubles the length of ranges.
  void halve()
  {
    const std::int64_t half = this->Most / 2;
    for (std::int64_t i = 0; i < half; ++i)
    {
      this->Picks[std::size_t(i)] = this->Picks[std::size_t(chosenOf(i))];
    }
    this->Picks.resize(std::size_t(half));
    this->Range = half;
    ++this->Doublings;
  }

  const std::int64_t Most;
  const bool IsKnown;
  std::vector<SampledPointOf<Point>> Picks;
  std::int64_t Range = 0; ///< the next range to pick from
  int Doublings = 0;
};

} // namespace tipp

#endif
