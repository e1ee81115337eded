// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointsView_h
#define tippPointsView_h

#include "Predicates/Geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
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

/// A view of points in memory: x and y are the first two of every `stride` scalars (floats or
/// doubles), multiplied by a factor. It does not own the memory.
class PointsView
{
public:
  PointsView() = default;
  PointsView(const double* scalars, std::size_t count, std::size_t stride)
    : Doubles(scalars)
    , Count(count)
    , Stride(stride)
  {
  }
  PointsView(const float* scalars, std::size_t count, std::size_t stride)
    : Floats(scalars)
    , Count(count)
    , Stride(stride)
  {
  }
  explicit PointsView(const std::vector<Point2>& points)
    : PointsView(reinterpret_cast<const double*>(points.data()), points.size(), 2)
  {
  }

  std::size_t size() const { return this->Count; }
  double factor() const { return this->Factor; }

  Point2 operator[](std::size_t i) const
  {
    const std::size_t at = i * this->Stride;
    return this->Doubles
      ? Point2{ this->Doubles[at] * this->Factor, this->Doubles[at + 1] * this->Factor }
      : Point2{ this->Floats[at] * this->Factor, this->Floats[at + 1] * this->Factor };
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
  const Point2* contiguous() const
  {
    static_assert(sizeof(Point2) == 2 * sizeof(double), "a point is its coordinates");
    return this->Stride == 2 && this->Factor == 1 ? reinterpret_cast<const Point2*>(this->Doubles)
                                                  : nullptr;
  }

  /// The same points times a factor; exact if it is a power of two and nothing underflows or
  /// overflows.
  PointsView scaled(double factor) const
  {
    PointsView view = *this;
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
    std::array<Point2, 256> room;
    for (std::size_t first = begin; first < end; first += room.size())
    {
      const std::size_t count = std::min(room.size(), end - first);
      const Point2* block = this->contiguous() ? this->contiguous() + first : room.data();
      if (!this->contiguous())
      {
        this->forEach(
          first, first + count, [&room, first](std::size_t i, Point2 p) { room[i - first] = p; });
      }
      visit(first, block, count);
    }
  }

private:
  template <typename Coordinate, typename Visit>
  void scan(const Coordinate* coordinates, std::size_t begin, std::size_t end, Visit& visit) const
  {
    const std::size_t stride = this->Stride;
    const double factor = this->Factor;
    for (std::size_t i = begin; i < end; ++i)
    {
      visit(i, Point2{ coordinates[i * stride] * factor, coordinates[i * stride + 1] * factor });
    }
  }

  const double* Doubles = nullptr;
  const float* Floats = nullptr;
  std::size_t Count = 0;
  std::size_t Stride = 2;
  double Factor = 1;
};

/// The result of one pass over the points.
struct PointSurvey
{
  Box2 Bounds = Box2::empty();        ///< bounds of the finite points
  std::vector<std::int64_t> Rejected; ///< ids of points that are not finite; ascending
};

/// Returns the bounds of the finite points, and the indices of the others.
PointSurvey surveyPoints(PointsView points, int threads);

/// Returns about `count` finite points, evenly spaced in the input's order.
std::vector<Point2> samplePoints(PointsView points, std::size_t count);

/// Returns a power of two that scales coordinates whose largest magnitude is `largest` to about 1;
/// 1 if `largest` is 0 or between 2^-`moderate` and 2^`moderate`.
double moderateFactor(double largest, int moderate);
/// Returns whether multiplying this coordinate by the factor, a power of two, is exact.
inline bool isExactTimes(double x, double factor)
{
  return !std::isfinite(x) || x * factor / factor == x;
}

/// Scales very small or very large coordinates, whose products would underflow or overflow, by a
/// power of two that brings them near 1. This is exact, and the floating-point filters work again.
/// Returns the points unchanged if scaling would lose digits (a wide range of magnitudes) or is not
/// needed.
PointsView withModerateMagnitude(PointsView points, const Box2& bounds);

/// Tests whether points, added one at a time, are collinear.
class CollinearityTest
{
public:
  /// Adds a point. Returns false once three finite points added are not collinear.
  bool add(Point2 p);

  /// Returns up to two distinct points of the line; they stand for all points if all are collinear.
  std::vector<Point2> line() const { return { this->Line, this->Line + this->Found }; }

private:
  bool Holds = true;
  std::size_t Found = 0; ///< distinct points, at most two
  Point2 Line[2]{};
};

/// Whether the finite points are collinear or fewer than three. Stops at the first point off the
/// line.
bool areCollinear(PointsView points);

/// Returns the duplicates among the finite points, found by sorting, for input without triangles.
/// Ids are point indices.
std::vector<Duplicate> sortOutDuplicates(PointsView points);

} // namespace tipp

#endif
