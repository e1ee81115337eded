// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLanes_h
#define tippLanes_h

#include "Resample/LatticeAxis.h"

#include <cstdint>
#include <cstring>

// Functions of lanes are always inlined, so their calling convention does not matter.
#pragma GCC diagnostic ignored "-Wpsabi"
#ifndef __clang__
// GCC 12 reports arrays of lanes as uninitialised even if they are not.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

namespace tipp
{

/// Four numbers in SIMD lanes, and four masks: 0 or -1.
using Lanes = double __attribute__((vector_size(32)));
using LaneTruths = std::int64_t __attribute__((vector_size(32)));
using LaneInts = std::int32_t __attribute__((vector_size(16)));

constexpr int laneCount = 4;

/// Whether functions for AVX2 may be called.
inline bool hasAvx2()
{
#ifdef __x86_64__
  return __builtin_cpu_supports("avx2") != 0;
#else
  return false;
#endif
}

[[gnu::always_inline]] inline Lanes allLanes(double value)
{
  return Lanes{ value, value, value, value };
}
/// The larger; b if one is NaN.
[[gnu::always_inline]] inline Lanes most(Lanes a, Lanes b)
{
  return a > b ? a : b;
}
/// The smaller; b if one is NaN.
[[gnu::always_inline]] inline Lanes least(Lanes a, Lanes b)
{
  return a < b ? a : b;
}
[[gnu::always_inline]] inline Lanes absolute(Lanes a)
{
  const LaneTruths bits = LaneTruths(a) & ~(LaneTruths{} + INT64_MIN);
  return Lanes(bits);
}
[[gnu::always_inline]] inline LaneInts toInts(Lanes a)
{
  return __builtin_convertvector(a, LaneInts);
}
[[gnu::always_inline]] inline Lanes whole(Lanes a)
{
  return __builtin_convertvector(toInts(a), Lanes);
}
[[gnu::always_inline]] inline bool any(LaneTruths truths)
{
  return (truths[0] | truths[1] | truths[2] | truths[3]) != 0;
}
[[gnu::always_inline]] inline Lanes loadLanes(const double* from)
{
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}

/// A bit for each lane.
[[gnu::always_inline]] inline unsigned laneBits(LaneTruths truths)
{
#ifdef __SSE2__
  using Half = double __attribute__((vector_size(16)));
  Half halves[2];
  std::memcpy(halves, &truths, sizeof truths);
  return unsigned(__builtin_ia32_movmskpd(halves[0]) | __builtin_ia32_movmskpd(halves[1]) << 2);
#else
  return unsigned((truths[0] & 1) | (truths[1] & 2) | (truths[2] & 4) | (truths[3] & 8));
#endif
}

/// LatticeAxis::place(), error() and certain() for four coordinates at a time.
class AxisLanes
{
public:
  explicit AxisLanes(const LatticeAxis& axis)
    : Axis(axis)
    , Min(axis.origin())
    , Inverse(axis.inverse())
    , Delta(axis.delta())
    , First(axis.firstIndex())
    , Limit(axis.limit())
    , ErrorScale(axis.errorScale())
    , ErrorOffset(axis.errorOffset())
  {
  }

  [[gnu::always_inline]] Lanes place(Lanes v) const
  {
    return this->clamp((v - this->Min) * this->Inverse - this->First + 1);
  }
  [[gnu::always_inline]] Lanes clamp(Lanes place) const
  {
    return least(most(place, allLanes(0.5)), allLanes(this->Limit));
  }
  [[gnu::always_inline]] Lanes error(Lanes low, Lanes high) const
  {
    return most(-low, high) * this->ErrorScale + this->ErrorOffset;
  }
  [[gnu::always_inline]] static LaneTruths certain(Lanes place, Lanes wholePart, Lanes error)
  {
    return absolute(place - wholePart - 0.5) < 0.5 - error;
  }
  [[gnu::always_inline]] Lanes coordinates(int first) const
  {
    return loadLanes(this->Axis.data() + first);
  }

  /// The coordinates of samples with these indices, as coordinate() returns them.
  [[gnu::always_inline]] Lanes coordinates(Lanes numbers) const
  {
    return this->Min + (numbers + this->First) * this->Delta;
  }

  double coordinate(int i) const { return this->Axis[i]; }
  double origin() const { return this->Min; }
  double inverse() const { return this->Inverse; }
  double firstIndex() const { return this->First; }
  double delta() const { return this->Delta; }
  IndexRange exactRange(double low, double high) const { return this->Axis.exactRange(low, high); }

private:
  const LatticeAxis& Axis;
  double Min;
  double Inverse;
  double Delta;
  double First;
  double Limit;
  double ErrorScale;
  double ErrorOffset;
};

/// LatticeAxis::range() of four cells.
struct RangeLanes
{
  [[gnu::always_inline]] RangeLanes(const AxisLanes& axis, Lanes low, Lanes high)
    : Error(axis.error(low, high))
  {
    const Lanes begin = axis.place(low);
    const Lanes end = axis.place(high);
    this->Begin = whole(begin);
    this->End = whole(end);
    const LaneTruths certain = AxisLanes::certain(begin, this->Begin, this->Error) &
      AxisLanes::certain(end, this->End, this->Error);
    any(~certain) ? this->findExactly(axis, low, high, certain) : void();
    this->Empty = this->Begin >= this->End;
  }

  IndexRange range(int lane) const { return { int(this->Begin[lane]), int(this->End[lane]) }; }

  Lanes Error;
  Lanes Begin;
  Lanes End;
  LaneTruths Empty;

private:
  [[gnu::always_inline]] void findExactly(
    const AxisLanes& axis, Lanes low, Lanes high, LaneTruths certain)
  {
    for (int lane = 0; lane < laneCount; ++lane)
    {
      if (certain[lane] == 0)
      {
        const IndexRange range = axis.exactRange(low[lane], high[lane]);
        this->Begin[lane] = range.Begin;
        this->End[lane] = range.End;
      }
    }
  }
};

/// The samples claimed in several rows of one cell, or in one row of each of several cells.
template <int N>
struct RowSpans
{
  template <typename Ints>
  [[gnu::always_inline]] void set(Ints begin, Ints size, Ints row, Ints layer)
  {
    std::memcpy(this->Begin, &begin, sizeof begin);
    std::memcpy(this->Size, &size, sizeof size);
    std::memcpy(this->Row, &row, sizeof row);
    std::memcpy(this->Layer, &layer, sizeof layer);
  }

  unsigned Open;     ///< a bit for each row that has samples
  unsigned Doubtful; ///< a bit for each row that needs exact tests; the others are decided
  std::int32_t Begin[N];
  std::int32_t Size[N];
  std::int32_t Row[N];
  std::int32_t Layer[N];
};

/// The mask of the first `count` lanes.
[[gnu::always_inline]] inline LaneTruths firstLanes(int count)
{
  return LaneTruths{ 0, 1, 2, 3 } < count;
}

} // namespace tipp

#endif
