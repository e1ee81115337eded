// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMatchPositions_h
#define tippMatchPositions_h

#include "Triangulation/PointsView.h"
#include "Triangulation/Triangulate.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <vector>

namespace tipp
{

/// Other points among those of a triangulation.
struct MatchedPositions
{
  std::vector<PointId> Ids; ///< of each: the first point at its position, or a new one
  std::vector<std::size_t>
    New; ///< those whose positions have no point: their ids follow the points'
};

VTKTIPPFILTERS_EXPORT MatchedPositions matchPositions(PointsView points, PointsView others);

} // namespace tipp

#endif
