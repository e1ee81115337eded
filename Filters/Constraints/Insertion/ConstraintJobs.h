// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstraintJobs_h
#define tippConstraintJobs_h

#include "Constraints/ConstraintEdges.h"
#include "Constraints/Insertion/CrossedTriangles.h"
#include "Triangulation/PointsView.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Segments that are split at the vertices on them.
struct SplitSegments
{
  std::vector<IdSegment> Parts;
  std::vector<std::int64_t> Starts; ///< first part of each segment; empty if all have one part

  ///@{
  /// The first part of a segment, and one past the last.
  const IdSegment* begin(std::size_t segment) const
  {
    return this->Parts.data() +
      (this->Starts.empty() ? std::int64_t(segment) : this->Starts[segment]);
  }
  const IdSegment* end(std::size_t segment) const { return this->begin(segment + 1); }
  ///@}
};

/// `touches` must be sorted by segment. The segments are moved into the result.
VTKTIPPFILTERS_EXPORT SplitSegments splitSegments(PointsView points,
  std::vector<IdSegment>& segments, const std::vector<CrossedTriangles::Touch>& touches);

/// The job of each triangle in `crossed`. Segments that cross a common triangle belong to the same
/// job, with all triangles that they cross. Jobs are numbered by their first triangle.
VTKTIPPFILTERS_EXPORT std::vector<std::int64_t> jobsOfTriangles(const CrossedTriangles& crossed);

/// Retriangulates all jobs, which are independent of each other. A job's new triangles replace its
/// old ones in `triangles`, in order, so the result does not depend on the number of threads.
/// `known` are constraints that may already be edges between triangles of a job. Throws
/// CrossingFound.
template <typename Id>
void retriangulateJobs(PointsView points, Id* triangles, const CrossedTriangles& crossed,
  const SplitSegments& split, const ConstraintEdges& known, int threads);

} // namespace tipp

#endif
