// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstraintChecker_h
#define tippConstraintChecker_h

#include "Check/DelaunayChecker.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Constraints as chains of edges of a mesh.
struct ConstraintChains
{
  std::vector<FixedEdge> Edges; ///< sorted, each once
  std::int64_t Lost = 0;        ///< constraints without a chain
};

/// Finds for each constraint a way along edges from its first point to its second that bends by no
/// more than rounding: each vertex on it lies, by exact arithmetic, within two units in the last
/// place of the constraint's coordinates. Ends at one position, and such as are not finite, need
/// none.
ConstraintChains findConstraintChains(const std::vector<double>& xy,
  const std::vector<std::int64_t>& triangles,
  const std::vector<std::array<std::int64_t, 2>>& constraints);

} // namespace tipp

#endif
