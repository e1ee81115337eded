// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstraintJobs_h
#define tippConstraintJobs_h

#include "Constraints/ConstraintPieces.h"
#include "Constraints/Insertion/CrossedTriangles.h"
#include "Triangulation/PointsView.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Pieces that are split at the vertices on them.
struct SplitPieces
{
  std::vector<ConstraintPiece> Parts;
  std::vector<std::int64_t> Starts; ///< first part of each piece; empty if all have one part

  ///@{
  /// The first part of a piece, and one past the last.
  const ConstraintPiece* begin(std::size_t piece) const
  {
    return this->Parts.data() + (this->Starts.empty() ? std::int64_t(piece) : this->Starts[piece]);
  }
  const ConstraintPiece* end(std::size_t piece) const { return this->begin(piece + 1); }
  ///@}
};

/// `touches` must be sorted by piece. The pieces are moved into the result.
VTKTIPPFILTERS_EXPORT SplitPieces splitPieces(PointsView points,
  std::vector<ConstraintPiece>& pieces, const std::vector<CrossedTriangles::Touch>& touches);

/// The job of each triangle in `crossed`. Pieces that cross a common triangle belong to the same
/// job, with all triangles that they cross. Jobs are numbered by their first triangle.
VTKTIPPFILTERS_EXPORT std::vector<std::int64_t> jobsOfTriangles(const CrossedTriangles& crossed);

/// Retriangulates all jobs, which are independent of each other. A job's new triangles replace its
/// old ones in `triangles`, in order, so the result does not depend on the number of threads.
/// `known` are constraints that may already be edges between triangles of a job. Throws
/// CrossingFound.
template <typename Id>
void retriangulateJobs(PointsView points, Id* triangles, const CrossedTriangles& crossed,
  const SplitPieces& split, const ConstraintEdges& known, int threads);

} // namespace tipp

#endif
