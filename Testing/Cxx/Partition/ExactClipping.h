// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippExactClipping_h
#define tippExactClipping_h

#include "Predicates/Points.h"

#include <array>
#include <vector>

namespace oracle
{

/// Whether closed cell and closed box share a point, by clipping polygons in rationals: the oracle
/// of the separating axes. In the plane the box spans z = 0 and the corners lie there.
bool triangleMeetsBox(const std::array<tipp::Point3, 3>& corners, const tipp::Box3& box);
bool tetrahedronMeetsBox(const std::array<tipp::Point3, 4>& corners, const tipp::Box3& box);

/// Sign of the determinant of b - a, c - a, d - a.
int orientation3(const std::array<tipp::Point3, 4>& corners);

} // namespace oracle

#endif
