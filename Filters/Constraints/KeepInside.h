// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippKeepInside_h
#define tippKeepInside_h

#include "Constraints/Constraint.h"
#include "Triangulation/PointsView.h"
#include "vtkTIPPFiltersModule.h"

#include <array>
#include <cstddef>
#include <vector>

namespace tipp
{

/// What tells which triangles of a constrained triangulation are kept. Edges are those of
/// constraints.
struct Cuts
{
  /// Edges of closed polygons. Inside is what they go round counter-clockwise more often than
  /// clockwise. Where that is nothing, all polygons are holes: then all is inside but what they go
  /// round clockwise.
  std::vector<ConstraintPiece> Polygons;
  /// Edges of closed lines. Inside is what an odd number of them goes round.
  std::vector<ConstraintPiece> Boundary;
  /// Points in holes. A hole is what can be reached from its point without crossing a constraint;
  /// from a point on a constraint: what can be reached from both sides.
  std::vector<Point2> Holes;
};

/// Removes the triangles that are not inside of polygons and boundary, or are in a hole. `edges`:
/// all constraints. Throws std::invalid_argument for a hole whose point is in no triangle.
VTKTIPPFILTERS_EXPORT void keepInside(PointsView points, Triangulation& triangulation,
  const std::vector<ConstraintPiece>& edges, const Cuts& cuts);

using PositionPair = std::array<Point2, 2>;

/// The edges around Cuts::Holes of any points with these corners of the convex hull and these
/// segments as constraints, none of which crosses another: an odd number of them is above each
/// removed triangle. They lie on segments and on the hull. Throws as keepInside().
VTKTIPPFILTERS_EXPORT std::vector<PositionPair> edgesAroundHoles(const std::vector<Point2>& hull,
  const std::vector<PositionPair>& segments, const std::vector<Point2>& seeds, int threads);

/// The convex hull of points that are added one by one; keeps few of them.
class VTKTIPPFILTERS_EXPORT HullOfPoints
{
public:
  /// Points that are NaN or infinite are left out.
  void add(Point2 p);
  /// The corners, counter-clockwise.
  std::vector<Point2> corners();

private:
  bool isInside(Point2 p) const;
  void reduce();

  std::vector<Point2> Points; ///< of which the hull is that of all
  std::vector<Point2> Inner;  ///< some corners, counter-clockwise; less than three: none
  std::size_t Most = std::size_t(1) << 16; ///< Points before they are reduced
};

} // namespace tipp

#endif
