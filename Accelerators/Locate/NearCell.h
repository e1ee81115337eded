// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNearCell_h
#define tippNearCell_h

#include "Predicates/Points.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <cstdint>
#include <limits>

namespace tipp
{

/// A triangle in the plane, or a tetrahedron, and its distance from a point outside of it.
struct VTKTIPPACCELERATORS_EXPORT NearCell
{
  std::int64_t Id = -1; ///< global; -1: none yet
  int Dimension = 2;
  Point3 Corners[4] = {}; ///< triangles use three, with z = 0
  Point3 At = {};         ///< the nearest location of the cell, rounded
  /// Bounds of the distance; the upper one is infinite if it is not known.
  double Low = 0;
  double High = std::numeric_limits<double>::infinity();

  /// Sets At and the bounds for a point outside of the cell.
  void measure(const Point3& from);
  /// Whether this cell is nearer to `from` than another, or as near with the lower id. Both must
  /// have been measured from that point. Decided exactly.
  bool isBetterThan(const NearCell& other, const Point3& from) const;
  /// Returns the distance from `from`. The distance and At become accurate to a few roundings.
  double distance(const Point3& from);
};

} // namespace tipp

#endif
