// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstraintChains_h
#define tippConstraintChains_h

#include "Check/DelaunayChecker.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tipp
{

/// The constraints, as chains of edges of a mesh.
struct ConstraintChains
{
  std::vector<FixedEdge> Edges; ///< sorted, without duplicates
  std::int64_t Lost = 0;        ///< number of constraints without a chain
};

/// Finds for each constraint a chain of edges between its two points. Each vertex of the chain must
/// lie within two units in the last place of the constraint's coordinates, tested in exact
/// arithmetic. Constraints whose ends are equal or not finite need no chain. `xy` holds x and y of
/// each point; `triangles` (three each) and `constraints` hold indices of these points. `isCut`:
/// the mesh ends at polygons, so chains may have gaps between vertices of its border.
ConstraintChains findConstraintChains(const std::vector<double>& xy,
  const std::vector<std::int64_t>& triangles,
  const std::vector<std::array<std::int64_t, 2>>& constraints, bool isCut = false);

} // namespace tipp

#endif
