// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstraintLines_h
#define tippConstraintLines_h

#include "Constraints/ConstraintSegments.h"
#include "Distributed/DistributedTriangulation.h"
#include "Ranks/Communicator.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Segments, and the cells of sources that they are parts of.
struct NamedSegments
{
  const ConstraintSegments& Segments;
  const std::vector<std::int64_t>& Order; ///< of each segment: its index as given
  const std::vector<std::int64_t>& Cells; ///< by that index
};

/// A rank's share of the edges of all ranks' triangles that lie on constraints.
struct ConstraintLines
{
  std::vector<std::array<std::int64_t, 2>> Ends; ///< local indices, in the constraint's direction
  std::vector<std::int64_t> Cells;
  std::int64_t First = 0; ///< the number of those on lower ranks
};

/// Each edge is on one rank that has a triangle of it, on the left of the constraint if there is
/// one; an edge of several constraints is listed once for each. In the order of the segments as
/// given. Collective.
VTKTIPPFILTERS_EXPORT ConstraintLines findConstraintLines(
  Communicator& ranks, const NamedSegments& segments, const DistributedTriangulation& mine);

} // namespace tipp

#endif
