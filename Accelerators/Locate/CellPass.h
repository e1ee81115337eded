// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellPass_h
#define tippCellPass_h

#include "Locate/CellLocator.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <cstdint>

namespace tipp
{

/// Finds what locatePoints() does in one pass over the cells, each of which looks for its points in
/// a grid. It needs no locator, and is the fastest way where the points are about as many as the
/// cells. False if that is not so for these cells and points, as many thin cells, points on many
/// edges, or cells that overlap: then `take` has got some points only, and not always their last
/// location. Takes about 30 bytes a point. Exact; at most 2^31 - 1 points.
VTKTIPPACCELERATORS_EXPORT bool locateInOnePass(const SimplexMesh& mesh,
  const std::int64_t* cellIds, const AskedPoints& points, int threads, const TakeLocations& take);

} // namespace tipp

#endif
