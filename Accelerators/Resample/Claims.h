// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippClaims_h
#define tippClaims_h

#include "Predicates/Geometry.h"
#include "Resample/CellKey.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace tipp
{

/// A sample that lies on the border of cells without being inside any, with the key of the cell
/// that claims it.
struct BorderSample
{
  std::int64_t Sample; ///< index of the sample
  CellKey Key;
};

/// A sample outside of all triangles, but within Lattice::Slack of one, which claims it.
struct NearSample
{
  std::int64_t Sample; ///< index of the sample
  std::int32_t Cell;   ///< index of the triangle
  CellKey Key;         ///< of the triangle, with the rank nearOnly
  double Distance;     ///< from the triangle's nearest edge
  Point2 Ends[2];      ///< of this edge
  std::int64_t Ids[2]; ///< the indices of its ends
  double Weight;       ///< of its second end at the point that is nearest to the sample
};

/// A sample on the mesh's border that its cell does not contain after the move by (e, e^2, e^3).
struct BorderClaim
{
  std::int64_t Sample; ///< index of the sample
  std::int32_t Cell;   ///< index of the cell
};

/// A sample on the border of a cell that does not claim it.
struct Touch
{
  std::int64_t Sample; ///< index of the sample
  std::int32_t Cell;   ///< index of the cell

  bool operator<(const Touch& other) const
  {
    return this->Sample != other.Sample ? this->Sample < other.Sample : this->Cell < other.Cell;
  }
};

/// Statistics of the cells that the CPU's threads have visited; if an OpenCL device claims samples,
/// these are only the cells that it leaves undecided.
struct ClaimStatistics
{
  std::int64_t VisitedCells = 0;      ///< cells whose boxes contain samples
  std::int64_t Tests = 0;             ///< samples in these boxes
  std::int64_t ExactTests = 0;        ///< exact predicate evaluations
  std::int64_t OverlappingClaims = 0; ///< samples that a cell lost to an overlapping one
};

/// The cell that claims each sample of a lattice.
struct Claims
{
  /// cell index per sample, the first axis fastest; -1: none
  std::unique_ptr<std::int32_t[]> Cells;
  std::vector<BorderClaim> Border; ///< sorted by sample; with the samples of Near
  std::vector<NearSample> Near;    ///< sorted by sample
  ClaimStatistics Statistics;
  bool Aborted = false; ///< whether the report stopped the work; the claims are incomplete
};

/// What a device has done of the work of claimSamples() or sampleDirectly().
struct SampledCells
{
  /// Number of samples that cells claim, without those of open cells. A sample counts for each of
  /// the cells that claim it.
  std::int64_t Claimed = 0;
  std::vector<std::int32_t> Open; ///< cells that are not processed, or only in part
  bool Aborted = false;
};

} // namespace tipp

#endif
