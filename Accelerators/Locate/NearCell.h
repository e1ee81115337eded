// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNearCell_h
#define tippNearCell_h

#include "Predicates/Points.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <cstdint>
#include <limits>

namespace tipp
{

/// A triangle in the plane or a tetrahedron, and how far it is from a point outside of it.
struct VTKTIPPACCELERATORS_EXPORT NearCell
{
  std::int64_t Id = -1; ///< global; -1: none yet
  int Dimension = 2;
  Point3 Corners[4] = {}; ///< of a triangle three, with z = 0
  Point3 At = {};         ///< about the nearest location of the cell
  /// Bounds of the distance; the upper one is infinite if it is not known.
  double Low = 0;
  double High = std::numeric_limits<double>::infinity();

  /// Sets At and the bounds for a point outside of the cell.
  void measure(const Point3& from);
  /// Whether this cell is nearer than another to the point of their measures, or as near with the
  /// lower id. Decided exactly.
  bool isBetterThan(const NearCell& other, const Point3& from) const;
  /// The distance; makes it and At accurate to a few roundings.
  double distance(const Point3& from);
};

} // namespace tipp

#endif
