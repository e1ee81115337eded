// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippContainment_h
#define tippContainment_h

#include "Predicates/Point2.h"
#include "Predicates/Point3.h"

namespace tipp
{

/// The rank of the move by which a closed cell that contains a sample comes to contain it properly:
/// 0 for (e, e^2, e^3); m for the move mirrored along x if m has bit 0, along y if bit 1, along z
/// if bit 2; `closedOnly` if none does. Of the cells at a sample the one of lowest rank claims it.
constexpr int closedOnly = 8;

/// Exact. The corners are in any order; the triangle has an area and contains the sample.
int moveRank(const Point2 (&corners)[3], Point2 sample);
/// Exact. The corners are in any order; the tetrahedron has a volume and contains the sample.
int moveRank(const Point3 (&corners)[4], Point3 sample);

} // namespace tipp

#endif
