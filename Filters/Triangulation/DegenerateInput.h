// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDegenerateInput_h
#define tippDegenerateInput_h

#include "Triangulation/PointsView.h"
#include "Triangulation/Triangulate.h"

#include <vector>

namespace tipp
{

/// True if the finite points lie on one line, or there are fewer than three. Looks at no more
/// points than it needs.
bool areCollinear(PointsView points);

/// The duplicates of finite points, by sorting: for input that is not triangulated.
std::vector<Duplicate> sortOutDuplicates(PointsView points);

} // namespace tipp

#endif
