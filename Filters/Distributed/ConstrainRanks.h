// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstrainRanks_h
#define tippConstrainRanks_h

#include "Constraints/ConstraintSegments.h"
#include "Distributed/DistributedTriangulation.h"
#include "Ranks/Communicator.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Turns all ranks' triangulation into the constrained Delaunay triangulation with these segments,
/// the same on all ranks, and cuts it to polygons and boundary. Each rank inserts the segments that
/// are complete in its own triangles, and the first rank the others. Collective; call it within
/// Communicator::together(). `threads`: of each rank.
VTKTIPPFILTERS_EXPORT void constrainRanks(Communicator& ranks, const ConstraintSegments& segments,
  int threads, DistributedTriangulation& mine);

/// Segments, and the cells of sources that they are parts of.
struct NamedSegments
{
  const ConstraintSegments& Segments;
  const std::vector<std::int64_t>& Order; ///< by segment: its index in the given order
  const std::vector<std::int64_t>& Cells; ///< cell of the source, by index in the given order
};

/// A rank's share of the edges of all ranks' triangles that lie on constraints.
struct ConstraintLines
{
  std::vector<std::array<std::int64_t, 2>> Ends; ///< local indices, in the constraint's direction
  std::vector<std::int64_t> Cells;
  std::int64_t First = 0; ///< number of lines on lower ranks
};

/// Finds the edges of triangles that lie on constraints. Each edge is on one rank that has a
/// triangle beside it, preferably the one on the left of the constraint; an edge of several
/// constraints is listed once for each. Edges are in the given order of the segments. Collective.
VTKTIPPFILTERS_EXPORT ConstraintLines findConstraintLines(
  Communicator& ranks, const NamedSegments& segments, const DistributedTriangulation& mine);

} // namespace tipp

#endif
