// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointsView_h
#define tippPointsView_h

#include "Predicates/Geometry.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace tipp
{

struct Duplicate;

/// The range [begin, end) of n items that is share `part` of `parts` equal shares.
inline std::pair<std::size_t, std::size_t> evenShare(std::size_t n, int part, int parts)
{
  return { n * std::size_t(part) / std::size_t(parts),
    n * std::size_t(part + 1) / std::size_t(parts) };
}

/// A view of points in memory: the coordinates are the first D of every `stride` scalars (floats or
/// doubles), multiplied by a factor. It does not own the memory.
template <int D>
class PointsViewOf
{
public:
  PointsViewOf() = default;
  PointsViewOf(const double* scalars, std::size_t count, std::size_t stride)
    : Doubles(scalars)
    , Count(count)
    , Stride(stride)
  {
  }
  PointsViewOf(const float* scalars, std::size_t count, std::size_t stride)
    : Floats(scalars)
    , Count(count)
    , Stride(stride)
  {
  }
  PointsViewOf(const Point<D>* points, std::size_t count)
    : PointsViewOf(reinterpret_cast<const double*>(points), count, D)
  {
  }
  explicit PointsViewOf(const std::vector<Point<D>>& points)
    : PointsViewOf(points.data(), points.size())
  {
  }

  std::size_t size() const { return this->Count; }
  double factor() const { return this->Factor; }

  Point<D> operator[](std::size_t i) const
  {
    const std::size_t at = i * this->Stride;
    return this->Doubles ? pointAt(this->Doubles + at, this->Factor)
                         : pointAt(this->Floats + at, this->Factor);
  }

  /// Starts to load point i into the cache. Does nothing if there is no such point. Inlined,
  /// because GCC leaves out calls of functions that only prefetch.
  [[gnu::always_inline]] void prefetch(std::size_t i) const
  {
    if (i < this->Count)
    {
      const std::size_t at = i * this->Stride;
      this->Doubles ? __builtin_prefetch(this->Doubles + at)
                    : __builtin_prefetch(this->Floats + at);
    }
  }

  /// The points as an array if they are contiguous doubles and the factor is 1, else nullptr.
  const Point<D>* contiguous() const
  {
    return this->Stride == D && this->Factor == 1 ? reinterpret_cast<const Point<D>*>(this->Doubles)
                                                  : nullptr;
  }

  /// The same points times a factor; exact if it is a power of two and nothing underflows or
  /// overflows.
  PointsViewOf scaled(double factor) const
  {
    PointsViewOf view = *this;
    view.Factor *= factor;
    return view;
  }

  /// Calls visit(index, point) for begin <= index < end, in order.
  template <typename Visit>
  void forEach(std::size_t begin, std::size_t end, Visit&& visit) const
  {
    if (this->Doubles)
    {
      this->scan(this->Doubles, begin, end, visit);
    }
    else
    {
      this->scan(this->Floats, begin, end, visit);
    }
  }

  /// Calls visit(index of the first point, points, count) for contiguous blocks of points, in
  /// order.
  template <typename Visit>
  void forBlocks(std::size_t begin, std::size_t end, const Visit& visit) const
  {
    std::array<Point<D>, 256> room;
    for (std::size_t first = begin; first < end; first += room.size())
    {
      const std::size_t count = std::min(room.size(), end - first);
      const Point<D>* block = this->contiguous() ? this->contiguous() + first : room.data();
      if (!this->contiguous())
      {
        this->forEach(first, first + count,
          [&room, first](std::size_t i, const Point<D>& p) { room[i - first] = p; });
      }
      visit(first, block, count);
    }
  }

private:
  template <typename Coordinate>
  static Point<D> pointAt(const Coordinate* at, double factor)
  {
    if constexpr (D == 2)
    {
      return { at[0] * factor, at[1] * factor };
    }
    else
    {
      return { at[0] * factor, at[1] * factor, at[2] * factor };
    }
  }

  template <typename Coordinate, typename Visit>
  void scan(const Coordinate* coordinates, std::size_t begin, std::size_t end, Visit& visit) const
  {
    const std::size_t stride = this->Stride;
    const double factor = this->Factor;
    for (std::size_t i = begin; i < end; ++i)
    {
      visit(i, pointAt(coordinates + i * stride, factor));
    }
  }

  const double* Doubles = nullptr;
  const float* Floats = nullptr;
  std::size_t Count = 0;
  std::size_t Stride = D;
  double Factor = 1;
};

using PointsView = PointsViewOf<2>;
using PointsView3 = PointsViewOf<3>;

/// The result of one pass over the points.
template <int D>
struct PointSurveyOf
{
  Box<D> Bounds = Box<D>::empty();    ///< bounds of the finite points
  std::vector<std::int64_t> Rejected; ///< ids of points that are not finite; ascending
};

/// Returns the bounds of the finite points, and the indices of the others.
template <int D>
PointSurveyOf<D> surveyPoints(const PointsViewOf<D>& points, int threads);

/// Returns the finite ones among the points at about (i + 1/2) * `step`, in the input's order.
template <int D>
std::vector<Point<D>> sampleEvery(const PointsViewOf<D>& points, double step);

/// Returns about `count` finite points, evenly spaced in the input's order.
template <int D>
std::vector<Point<D>> samplePoints(const PointsViewOf<D>& points, std::size_t count)
{
  return sampleEvery(points, std::max(1.0, double(points.size()) / double(count)));
}

/// Scales very small or very large coordinates, whose products would underflow or overflow, by a
/// power of two that brings them near 1. This is exact, and the floating-point filters work again.
/// Returns the points unchanged if scaling would lose digits (a wide range of magnitudes) or is not
/// needed.
template <int D>
PointsViewOf<D> withModerateMagnitude(const PointsViewOf<D>& points, const Box<D>& bounds);

/// Finds the dimension of the points that are added, one at a time: -1 without points, 0 if all
/// have the same coordinates, 1 if they are collinear, and so on, up to D.
template <int D>
class DimensionTest
{
public:
  /// Adds a point, which is ignored if it is not finite.
  void add(const Point<D>& p);

  int dimension() const { return int(this->Simplex.size()) - 1; }
  /// Returns whether more points cannot change the dimension.
  bool isFull() const { return this->Simplex.size() > D; }

  /// Returns points of which none lies in the flat (line or plane) through the others. They stand
  /// for all points unless the dimension is D.
  const std::vector<Point<D>>& simplex() const { return this->Simplex; }

private:
  std::vector<Point<D>> Simplex;
};

/// Whether the finite points are collinear or fewer than three. Stops at the first point off the
/// line.
bool areCollinear(const PointsView& points);

/// Returns the duplicates among the finite points, found by sorting, for input without triangles.
/// Ids are point indices.
std::vector<Duplicate> sortOutDuplicates(const PointsView& points);

} // namespace tipp

#endif
