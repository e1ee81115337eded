// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstraintPoints_h
#define tippConstraintPoints_h

#include "Arrays/Scalar.h"
#include "Constraints/ResolveCrossings.h"
#include "Constraints/SegmentTree.h"
#include "Predicates/ExactPredicates.h"
#include "Triangulation/PointsView.h"
#include "Triangulation/Triangulate.h"
#include "vtkTIPPFiltersModule.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace tipp
{

/// Points to be looked up by their coordinates.
class PositionIndex
{
public:
  explicit PositionIndex(std::vector<Point2> points);

  const std::vector<Point2>& points() const { return this->Points; }

  /// Of its coordinates; all digits depend on both.
  static std::uint64_t hashOf(Point2 position)
  {
    // Zeros of both signs are equal.
    const double xy[2] = { position.x + 0.0, position.y + 0.0 };
    std::uint64_t bits[2];
    std::memcpy(bits, xy, sizeof bits);
    std::uint64_t hash = bits[0] * 0x9e3779b97f4a7c15U + bits[1];
    hash ^= hash >> 32;
    hash *= 0xd6e8feb86659fd93U;
    return hash ^ hash >> 32;
  }

  /// The first point with these coordinates; -1: none. NaN and infinity are not found.
  std::int64_t find(Point2 position) const;

  /// Calls found(i, index) for each of `count` positions that is there; it waits less for memory
  /// than find() of each.
  template <typename Found>
  void findAll(const Point2* positions, std::size_t count, const Found& found) const
  {
    constexpr std::size_t group = 32;
    std::array<std::uint64_t, group> hashes;
    for (std::size_t begin = 0; begin < count; begin += group)
    {
      const std::size_t size = std::min(group, count - begin);
      for (std::size_t i = 0; i < size; ++i)
      {
        hashes[i] = hashOf(positions[begin + i]);
        __builtin_prefetch(&this->markOf(hashes[i]));
      }
      for (std::size_t i = 0; i < size; ++i)
      {
        const std::int64_t index =
          this->isMarked(hashes[i]) ? this->lookUp(positions[begin + i], hashes[i]) : -1;
        index >= 0 ? found(begin + i, std::size_t(index)) : void();
      }
    }
  }

private:
  bool isMarked(std::uint64_t hash) const
  {
    return (this->markOf(hash) >> (hash >> 32 & 7) & 1) != 0;
  }
  std::int64_t lookUp(Point2 position, std::uint64_t hash) const;
  const std::uint8_t& markOf(std::uint64_t hash) const
  {
    return this->Marks[hash >> 35 & (this->Marks.size() - 1)];
  }

  static constexpr std::uint32_t Nobody = 0xffffffff;

  std::vector<Point2> Points;
  std::vector<std::uint32_t> Slots; ///< indices, or Nobody; their number is a power of two
  /// Bits by other digits of the hash, four a slot: most points that are not there are told by
  /// them, and caches hold more of them than of the slots.
  std::vector<std::uint8_t> Marks;
};

/// The ids of other points among those of a triangulation.
struct MatchedPositions
{
  std::vector<PointId> Ids;     ///< by other point: the first point at its position, or a new id
  std::vector<std::size_t> New; ///< the other points with new ids, which follow those of the points
};

VTKTIPPFILTERS_EXPORT MatchedPositions matchPositions(PointsView points, PointsView others);

/// Fills the tuples of an array after the first `points` ones: those of the crossings, each linear
/// between the two points that it lies between. Integers are rounded.
void interpolateTuples(const std::vector<CrossingPoint>& crossings, std::size_t points, Scalar type,
  std::size_t components, void* values);

/// A triangle of a surface, with its corners in the order of their coordinates, so that values in
/// it do not depend on how a triangulation orders triangles and corners.
struct SurfaceTriangle
{
  explicit SurfaceTriangle(const std::array<Point2, 3>& corners);

  std::array<Point2, 3> Corners;
  std::array<std::size_t, 3> Order{ 0, 1, 2 }; ///< of each, its index among the given corners

  /// Of two triangles that contain a position the one before answers it.
  bool isBefore(const SurfaceTriangle& other) const;

  /// The value at a position, linear in the triangle. valueOf(i): that of the given corner i.
  template <typename ValueOf>
  double valueAt(Point2 position, const ValueOf& valueOf) const
  {
    const std::array<double, 3> weights = this->weightsAt(position);
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i)
    {
      // A corner without weight may be one without value.
      sum += weights[i] > 0 ? weights[i] * valueOf(this->Order[i]) : 0;
    }
    return sum;
  }

private:
  std::array<double, 3> weightsAt(Point2 position) const;
};

/// Positions whose values on a triangulated surface are wanted.
class VTKTIPPFILTERS_EXPORT SurfacePositions
{
public:
  /// NaN and infinite ones lie in no triangle.
  explicit SurfacePositions(const std::vector<Point2>& positions);

  /// visit(index, position) for those in a counter-clockwise triangle or on its border.
  template <typename Visit>
  void visitInside(const std::array<Point2, 3>& p, const Visit& visit) const
  {
    const Box2 box{ std::min({ p[0].x, p[1].x, p[2].x }), std::min({ p[0].y, p[1].y, p[2].y }),
      std::max({ p[0].x, p[1].x, p[2].x }), std::max({ p[0].y, p[1].y, p[2].y }) };
    this->Tree.visitNear(box,
      [&](const SegmentTree::Item& item)
      {
        if (orientation(p[0], p[1], item.A) >= 0 && orientation(p[1], p[2], item.A) >= 0 &&
          orientation(p[2], p[0], item.A) >= 0)
        {
          visit(std::size_t(item.Id), item.A);
        }
        return true;
      });
  }

  /// Whether one may be in the box.
  bool meets(const Box2& box) const;

private:
  SegmentTree Tree;
};

/// The values at positions on the surface of points, of each column; NaN outside of it.
/// `columns`: of each one the values of the points.
std::vector<std::vector<double>> valuesOnSurface(const std::vector<Point2>& positions,
  PointsView points, const Triangulation& triangles, const std::vector<const double*>& columns,
  int threads);

} // namespace tipp

#endif
