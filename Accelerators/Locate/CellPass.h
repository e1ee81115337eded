// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellPass_h
#define tippCellPass_h

#include "Locate/CellLocator.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <cstdint>

namespace tipp
{

/// Does the same as locatePoints() in one pass over the cells, each of which looks up its points in
/// a grid. It needs no locator and is the fastest way if there are about as many points as cells.
/// Returns false if the pass is too slow for this input, for example because of many thin cells or
/// many points on edges, or if cells overlap; `take` may then have received only some points, and
/// wrong locations. Takes about 30 bytes per point. Exact; at most 2^31 - 1 points.
VTKTIPPACCELERATORS_EXPORT bool locateInOnePass(const SimplexMesh& mesh,
  const std::int64_t* cellIds, const AskedPoints& points, int threads, const TakeLocations& take);

} // namespace tipp

#endif
