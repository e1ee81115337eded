// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippKeepInside_h
#define tippKeepInside_h

#include "Constraints/ConstraintEdges.h"
#include "Triangulation/PointsView.h"
#include "Triangulation/Triangulation.h"
#include "vtkTIPPFiltersModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Rules for which triangles of a constrained triangulation are kept. All edges are edges of
/// constraints.
struct Cuts
{
  /// Edges of closed polygons. A triangle is inside if the winding number of the polygons around it
  /// is positive. If there is no such triangle, all polygons are holes: then a triangle is inside
  /// unless its winding number is negative.
  std::vector<IdSegment> Polygons;
  /// Edges of closed lines. A triangle is inside if a path to it from outside crosses them an odd
  /// number of times.
  std::vector<IdSegment> Boundary;
  /// Points in holes. A hole consists of all triangles that can be reached from its point without
  /// crossing a constraint. If the point is on a constraint, these are the triangles on both sides.
  std::vector<Point2> Holes;
};

/// Removes the triangles that are not inside polygons and boundary, and those in holes. `edges` are
/// the segments of all constraints. Returns how many triangles are left out because clockwise
/// polygons alone surround them, though others are inside: one part of a polygon that crosses
/// itself, or of a hole that lies outside. Throws std::invalid_argument if the point of a hole is
/// in no triangle.
VTKTIPPFILTERS_EXPORT std::int64_t keepInside(PointsView points, Triangulation& triangulation,
  const std::vector<IdSegment>& edges, const Cuts& cuts);

using PositionPair = std::array<Point2, 2>;

/// The edges around Cuts::Holes, for a triangulation with these corners of its convex hull and
/// these segments as constraints, none of which cross. A triangle is removed if an odd number of
/// these edges is above it. All edges are on segments or on the hull. Throws like keepInside().
VTKTIPPFILTERS_EXPORT std::vector<PositionPair> edgesAroundHoles(const std::vector<Point2>& hull,
  const std::vector<PositionPair>& segments, const std::vector<Point2>& seeds, int threads);

/// The convex hull of points that are added one by one. Only a few of the points are kept.
class VTKTIPPFILTERS_EXPORT HullOfPoints
{
public:
  /// Adds a point. Points that are not finite are ignored.
  void add(Point2 p);
  /// The corners of the hull, counter-clockwise.
  std::vector<Point2> corners();

private:
  bool isInside(Point2 p) const;
  void reduce();

  std::vector<Point2> Points; ///< the hull of these is the hull of all points
  std::vector<Point2> Inner;  ///< some corners, counter-clockwise; unused if fewer than 3
  std::size_t Most = std::size_t(1) << 16; ///< size of Points at which reduce() is called
};

} // namespace tipp

#endif
