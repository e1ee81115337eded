// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstraintJobs_h
#define tippConstraintJobs_h

#include "Constraints/Constraint.h"
#include "Constraints/CrossedTriangles.h"
#include "Triangulation/PointsView.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// The pieces' parts between the vertices that lie on them.
struct SplitPieces
{
  std::vector<ConstraintPiece> Parts;
  std::vector<std::int64_t> Starts; ///< of each piece's parts, and the end; empty: one each
};

/// Touches: sorted by piece. Pieces are moved into the result.
VTKTIPPFILTERS_EXPORT SplitPieces splitPieces(PointsView points,
  std::vector<ConstraintPiece>& pieces, const std::vector<CrossedTriangles::Touch>& touches);

/// For each triangle of `crossed` its job: pieces that cross the same triangle form one job with
/// the triangles that they cross. Jobs are numbered by their first piece, of `pieces`.
VTKTIPPFILTERS_EXPORT std::vector<std::int64_t> jobsOfTriangles(
  const CrossedTriangles& crossed, std::size_t pieces);

/// Retriangulates all jobs, which do not depend on each other. The new triangles of a job take the
/// positions of the old ones in `triangles`, both in their order, so that the result is the same
/// for any number of threads. `known` are constraints that may be edges between a job's triangles.
/// Throws CrossingFound.
template <typename Id>
void retriangulateJobs(PointsView points, Id* triangles, const CrossedTriangles& crossed,
  std::size_t pieces, const SplitPieces& split, const ConstraintEdges& known, int threads);

} // namespace tipp

#endif
