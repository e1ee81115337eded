// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLanes_h
#define tippLanes_h

#include "Predicates/Geometry.h"
#include "Resample/Lattice.h"

#include <cstddef>
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

/// Four doubles in SIMD lanes, and masks of four lanes, each 0 or -1.
using Lanes = double __attribute__((vector_size(32)));
using LaneMask = std::int64_t __attribute__((vector_size(32)));
using LaneInts = std::int32_t __attribute__((vector_size(16)));
using TwoDoubles = double __attribute__((vector_size(16)));
using FourFloats = float __attribute__((vector_size(16)));

constexpr int laneCount = 4;

[[gnu::always_inline]] inline Lanes allLanes(double value)
{
  return Lanes{ value, value, value, value };
}
/// The larger value in each lane; b if one is NaN.
[[gnu::always_inline]] inline Lanes most(Lanes a, Lanes b)
{
  return a > b ? a : b;
}
/// The smaller value in each lane; b if one is NaN.
[[gnu::always_inline]] inline Lanes least(Lanes a, Lanes b)
{
  return a < b ? a : b;
}
[[gnu::always_inline]] inline Lanes absolute(Lanes a)
{
  const LaneMask bits = LaneMask(a) & ~(LaneMask{} + INT64_MIN);
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
[[gnu::always_inline]] inline bool any(LaneMask mask)
{
  return (mask[0] | mask[1] | mask[2] | mask[3]) != 0;
}
/// The lower (0) or upper (1) lanes of a vector, as a vector of another type.
template <typename Half, typename Whole>
[[gnu::always_inline]] inline Half halfOf(const Whole& lanes, int which)
{
  Half half;
  std::memcpy(&half, reinterpret_cast<const Half*>(&lanes) + which, sizeof half);
  return half;
}

/// A bit mask with one bit per lane.
[[gnu::always_inline]] inline unsigned laneBits(LaneMask mask)
{
#ifdef __SSE2__
  return unsigned(__builtin_ia32_movmskpd(halfOf<TwoDoubles>(mask, 0)) |
    __builtin_ia32_movmskpd(halfOf<TwoDoubles>(mask, 1)) << 2);
#else
  return unsigned((mask[0] & 1) | (mask[1] & 2) | (mask[2] & 4) | (mask[3] & 8));
#endif
}

/// LatticeAxis::position(), error() and certain() for four coordinates at a time.
/// Has copies of the constants, which the compiler can keep in registers.
struct AxisLanes : AxisConstants
{
  explicit AxisLanes(const LatticeAxis& axis)
    : AxisConstants(axis)
    , Axis(axis)
  {
  }

  [[gnu::always_inline]] Lanes position(Lanes v) const
  {
    return this->clamp((v - this->Origin) * this->Inverse - this->First + 1);
  }
  [[gnu::always_inline]] Lanes clamp(Lanes position) const
  {
    return least(most(position, allLanes(0.5)), allLanes(this->Limit));
  }
  [[gnu::always_inline]] Lanes error(Lanes low, Lanes high) const
  {
    return most(-low, high) * this->ErrorScale + this->ErrorOffset;
  }
  [[gnu::always_inline]] static LaneMask certain(Lanes position, Lanes wholePart, Lanes error)
  {
    return absolute(position - wholePart - 0.5) < 0.5 - error;
  }
  [[gnu::always_inline]] Lanes coordinates(int first) const
  {
    Lanes lanes;
    std::memcpy(&lanes, this->Axis.data() + first, sizeof lanes);
    return lanes;
  }

  /// The coordinates of samples with these indices.
  [[gnu::always_inline]] Lanes coordinates(Lanes numbers) const
  {
    const LaneInts i = toInts(numbers);
    return Lanes{ this->Axis[i[0]], this->Axis[i[1]], this->Axis[i[2]], this->Axis[i[3]] };
  }

  const LatticeAxis& Axis;
};

/// LatticeAxis::range() of four cells.
struct RangeLanes
{
  RangeLanes() = default;
  [[gnu::always_inline]] RangeLanes(const AxisLanes& axis, Lanes low, Lanes high)
    : Error(axis.error(low, high))
  {
    this->Low = axis.position(low);
    this->High = axis.position(high);
    this->Begin = whole(this->Low);
    this->End = whole(this->High);
    const LaneMask certain = AxisLanes::certain(this->Low, this->Begin, this->Error) &
      AxisLanes::certain(this->High, this->End, this->Error);
    if (any(~certain))
    {
      this->findExactly(axis, low, high, certain);
    }
    this->Empty = this->Begin >= this->End;
  }

  IndexRange range(int lane) const { return { int(this->Begin[lane]), int(this->End[lane]) }; }

  [[gnu::always_inline]] void store(IndexRange (&to)[laneCount]) const
  {
    const LaneInts begins = toInts(this->Begin);
    const LaneInts ends = toInts(this->End);
    for (int lane = 0; lane < laneCount; ++lane)
    {
      to[lane] = { begins[lane], ends[lane] };
    }
  }

  Lanes Low; ///< the position of the lower end, with rounding errors
  Lanes High;
  Lanes Error;
  Lanes Begin;
  Lanes End;
  LaneMask Empty;

private:
  [[gnu::always_inline]] void findExactly(
    const AxisLanes& axis, Lanes low, Lanes high, LaneMask certain)
  {
    for (int lane = 0; lane < laneCount; ++lane)
    {
      if (certain[lane] == 0)
      {
        const IndexRange range = axis.Axis.exactRange(low[lane], high[lane]);
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

/// Eight single-precision numbers in SIMD lanes, and eight masks or integers.
using FloatLanes = float __attribute__((vector_size(32)));
using FloatLaneInts = std::int32_t __attribute__((vector_size(32)));

constexpr int floatLaneCount = 8;

[[gnu::always_inline]] inline FloatLanes allFloats(float value)
{
  return FloatLanes{} + value;
}
/// The larger value in each lane; b if one is NaN.
[[gnu::always_inline]] inline FloatLanes most(FloatLanes a, FloatLanes b)
{
  return a > b ? a : b;
}
/// The smaller value in each lane; b if one is NaN.
[[gnu::always_inline]] inline FloatLanes least(FloatLanes a, FloatLanes b)
{
  return a < b ? a : b;
}
[[gnu::always_inline]] inline FloatLanes absolute(FloatLanes a)
{
  return FloatLanes(FloatLaneInts(a) & ~(FloatLaneInts{} + INT32_MIN));
}
[[gnu::always_inline]] inline FloatLaneInts toInts(FloatLanes a)
{
  return __builtin_convertvector(a, FloatLaneInts);
}
[[gnu::always_inline]] inline FloatLanes toFloats(FloatLaneInts a)
{
  return __builtin_convertvector(a, FloatLanes);
}

/// A bit mask with one bit per lane.
[[gnu::always_inline]] inline unsigned floatLaneBits(FloatLaneInts mask)
{
#ifdef __SSE__
  return unsigned(__builtin_ia32_movmskps(halfOf<FourFloats>(mask, 0)) |
    __builtin_ia32_movmskps(halfOf<FourFloats>(mask, 1)) << 4);
#else
  unsigned bits = 0;
  for (int lane = 0; lane < floatLaneCount; ++lane)
  {
    bits |= unsigned(mask[lane] & 1) << lane;
  }
  return bits;
#endif
}

/// Rounds four numbers to single precision.
[[gnu::always_inline]] inline void storeFloats(Lanes from, float (&to)[laneCount])
{
  const FourFloats floats = __builtin_convertvector(from, FourFloats);
  std::memcpy(to, &floats, sizeof floats);
}

/// The corners of a cell for each lane.
template <typename Point, int Count>
class LaneCorners
{
public:
  /// Reads cells from `first` on.
  template <typename Access>
  [[gnu::always_inline]] LaneCorners(const Access& cells, std::int64_t first)
  {
    for (int lane = 0; lane < laneCount; ++lane)
    {
      cells.corners(first + lane, this->Corners[lane]);
    }
  }

  /// A coordinate of corner i.
  [[gnu::always_inline]] Lanes get(int i, double Point::*axis) const
  {
    return Lanes{ this->Corners[0][i].*axis, this->Corners[1][i].*axis, this->Corners[2][i].*axis,
      this->Corners[3][i].*axis };
  }

private:
  Point Corners[laneCount][Count];
};

/// A point, or a vector, in space for each lane.
struct PointLanes
{
  Lanes x;
  Lanes y;
  Lanes z;
};

[[gnu::always_inline]] inline PointLanes operator-(const PointLanes& a, const PointLanes& b)
{
  return { a.x - b.x, a.y - b.y, a.z - b.z };
}
[[gnu::always_inline]] inline PointLanes leastOf(const PointLanes (&p)[4])
{
  return { least(least(p[0].x, p[1].x), least(p[2].x, p[3].x)),
    least(least(p[0].y, p[1].y), least(p[2].y, p[3].y)),
    least(least(p[0].z, p[1].z), least(p[2].z, p[3].z)) };
}
[[gnu::always_inline]] inline PointLanes mostOf(const PointLanes (&p)[4])
{
  return { most(most(p[0].x, p[1].x), most(p[2].x, p[3].x)),
    most(most(p[0].y, p[1].y), most(p[2].y, p[3].y)),
    most(most(p[0].z, p[1].z), most(p[2].z, p[3].z)) };
}

/// The corners of four cells in the lexicographic order of their coordinates, and by how much the
/// barycentric weights of all but the first rise along each axis.
///
/// Aligned for functions that are compiled for wider instructions than others.
template <typename Access>
struct alignas(32) GroupLanes
{
  static constexpr int D = Access::Dimension;

  /// Takes four cells.
  [[gnu::always_inline]] void set(const Access& access, const std::int32_t* cells)
  {
    for (int corner = 0; corner <= D; ++corner)
    {
      Point<D> p[laneCount];
      for (int lane = 0; lane < laneCount; ++lane)
      {
        const std::int64_t id = access.ids(cells[lane])[corner];
        this->Ids[corner][lane] = id;
        p[lane] = access.coordinates(id);
      }
      for (std::size_t axis = 0; axis < D; ++axis)
      {
        this->Corners[corner][axis] = Lanes{ p[0][axis], p[1][axis], p[2][axis], p[3][axis] };
      }
    }
    this->sort();
    this->findNormals();
  }

  LaneMask Ids[D + 1];
  Lanes Corners[D + 1][D];
  Lanes Normals[D][D]; ///< gradients of the weights of all corners but the first
  LaneMask Thin;       ///< where roundings would show in the Normals

private:
  [[gnu::always_inline]] void sort()
  {
    if constexpr (D == 2)
    {
      this->order(0, 1);
      this->order(1, 2);
      this->order(0, 1);
    }
    else
    {
      this->order(0, 1);
      this->order(2, 3);
      this->order(0, 2);
      this->order(1, 3);
      this->order(1, 2);
    }
  }

  /// Exchanges corners so that i comes before j.
  [[gnu::always_inline]] void order(int i, int j)
  {
    LaneMask swap = {};
    for (int axis = D - 1; axis >= 0; --axis)
    {
      const Lanes a = this->Corners[i][axis];
      const Lanes b = this->Corners[j][axis];
      swap = (b < a) | ((b == a) & swap);
    }
    for (int axis = 0; axis < D; ++axis)
    {
      exchange(swap, this->Corners[i][axis], this->Corners[j][axis]);
    }
    exchange(swap, this->Ids[i], this->Ids[j]);
  }

  template <typename T>
  [[gnu::always_inline]] static void exchange(LaneMask swap, T& a, T& b)
  {
    const T first = a;
    a = swap ? b : a;
    b = swap ? first : b;
  }

  [[gnu::always_inline]] void findNormals()
  {
    Lanes edges[D][D]; // from the first corner to each of the others
    Lanes product = allLanes(1);
    for (int axis = 0; axis < D; ++axis)
    {
      Lanes largest = {};
      for (int i = 0; i < D; ++i)
      {
        edges[i][axis] = this->Corners[i + 1][axis] - this->Corners[0][axis];
        largest = most(absolute(edges[i][axis]), largest);
      }
      product *= largest;
    }
    const Lanes determinant = this->cofactors(edges);
    // Thinner than that, the roundings of the determinants would show in the thirteenth digit.
    this->Thin = ~(absolute(determinant) * 64 > product) | (product < 1e-280);
    const Lanes inverse = 1 / determinant;
    for (int i = 0; i < D; ++i)
    {
      for (int axis = 0; axis < D; ++axis)
      {
        this->Normals[i][axis] *= inverse;
      }
    }
  }

  /// Sets Normals to the columns of the adjugate matrix. Returns the determinant.
  [[gnu::always_inline]] Lanes cofactors(const Lanes (&e)[D][D])
  {
    auto& n = this->Normals;
    if constexpr (D == 2)
    {
      n[0][0] = e[1][1];
      n[0][1] = -e[1][0];
      n[1][0] = -e[0][1];
      n[1][1] = e[0][0];
      return e[0][0] * e[1][1] - e[1][0] * e[0][1];
    }
    else
    {
      for (int i = 0; i < 3; ++i)
      {
        const auto& u = e[(i + 1) % 3];
        const auto& v = e[(i + 2) % 3];
        n[i][0] = u[1] * v[2] - u[2] * v[1];
        n[i][1] = u[2] * v[0] - u[0] * v[2];
        n[i][2] = u[0] * v[1] - u[1] * v[0];
      }
      return n[0][0] * e[0][0] + n[0][1] * e[0][1] + n[0][2] * e[0][2];
    }
  }
};

} // namespace tipp

#endif
