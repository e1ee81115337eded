// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCutPolygon_h
#define tippCutPolygon_h

#include "Predicates/Geometry.h"
#include "vtkTIPPIOModule.h"

#include <array>
#include <cstddef>
#include <vector>

namespace tipp
{

/// The most corners of a polygon that cutPolygon() cuts; its time grows with their third power.
constexpr std::size_t mostCorners = 256;

/// A triangle of a polygon's corners, as indices of them.
using CornerTriangle = std::array<std::size_t, 3>;

/// Cuts a simple polygon along diagonals into counter-clockwise triangles of positive area. It may
/// be concave, turn either way, and have corners on straight edges. The triangles depend on the
/// coordinates alone, not on the corner with which the polygon begins or on its direction: the
/// shortest diagonal that cuts off an ear is next, and of equal ones that of the lexicographically
/// lowest ear. Returns false if the polygon crosses or touches itself or has no area, or if it has
/// more than mostCorners corners; all decisions are exact.
VTKTIPPIO_EXPORT bool cutPolygon(
  const std::vector<Point2>& corners, std::vector<CornerTriangle>& triangles);

} // namespace tipp

#endif
