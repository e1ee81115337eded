// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstraintPoints_h
#define tippConstraintPoints_h

#include "Arrays/Scalar.h"
#include "Constraints/ResolveCrossings.h"
#include "Triangulation/PointsView.h"
#include "Triangulation/Triangulate.h"
#include "vtkTIPPFiltersModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Points to be looked up by their coordinates.
class PositionIndex
{
public:
  explicit PositionIndex(std::vector<Point2> points);

  /// The first point with these coordinates; -1: none. NaN and infinity are not found.
  std::int64_t find(Point2 position) const;

private:
  static std::uint64_t hashOf(Point2 position);

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

/// Where a point lies on a triangulated surface.
struct SurfacePosition
{
  std::array<PointId, 3> Corners{ -1, -1, -1 }; ///< -1: it lies outside
  std::array<double, 3> Weights{};

  /// The point's value, linear in the triangle; NaN outside.
  double valueOf(const std::vector<double>& values) const;
};

/// Locates the points of `all` after the first surface.size() ones. If several triangles contain a
/// point, the first is chosen.
std::vector<SurfacePosition> locateOnSurface(
  PointsView surface, const Triangulation& triangles, PointsView all, int threads);

} // namespace tipp

#endif
