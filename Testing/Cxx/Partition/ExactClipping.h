// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippExactClipping_h
#define tippExactClipping_h

#include "Predicates/Geometry.h"

#include <array>
#include <vector>

namespace oracle
{

/// Whether a closed cell and a closed box share a point, by clipping polygons in rational
/// arithmetic. The tested code uses separating axes. In the plane, all z are 0.
bool triangleMeetsBox(const std::array<tipp::Point3, 3>& corners, const tipp::Box3& box);
bool tetrahedronMeetsBox(const std::array<tipp::Point3, 4>& corners, const tipp::Box3& box);

/// The sign of the determinant of b - a, c - a, d - a.
int orientation3(const std::array<tipp::Point3, 4>& corners);

} // namespace oracle

#endif
