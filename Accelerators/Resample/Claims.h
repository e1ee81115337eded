// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippClaims_h
#define tippClaims_h

#include "Parallel/ParallelFor.h"
#include "Resample/CellKey.h"
#include "Resample/Lattice.h"
#include "Resample/SampleWindow.h"
#include "Resample/SimplexMesh.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace tipp
{

/// A sample on the mesh's border that its cell does not contain after the move by (e, e^2, e^3).
struct BorderClaim
{
  std::int64_t Sample;
  std::int32_t Cell;
};

/// Statistics of the cells that threads of this process have visited: if a device claims samples,
/// only of the cells that it leaves undecided.
struct ClaimStatistics
{
  std::int64_t VisitedCells = 0; ///< cells whose boxes contain samples
  std::int64_t Tests = 0;        ///< samples in these boxes
  std::int64_t ExactTests = 0;
  std::int64_t OverlappingClaims = 0; ///< samples that a cell lost to an overlapping one
};

/// The cell that claims each sample of a lattice.
struct Claims
{
  /// cell index per sample, the first axis fastest; -1: none
  std::unique_ptr<std::int32_t[]> Cells;
  std::vector<BorderClaim> Border; ///< by ascending sample
  ClaimStatistics Statistics;
  bool Aborted = false;
};

/// Returns the cell of lowest CellKey at each sample: the one that contains it after a move by (e,
/// e^2, e^3) for all sufficiently small e, or on the border after the mirrored moves, or as a
/// closed set. Exact for finite coordinates; a cell without area or volume or with a coordinate
/// that is not finite claims nothing. Of cells with the same corners the first claims.
///
/// Triangles are sampled in the plane of the two axes `mesh.Axes`; the third one is ignored. The
/// number of cells must be below 2^31. The result does not depend on the number of threads.
VTKTIPPACCELERATORS_EXPORT Claims claimSamples(
  const SimplexMesh& mesh, const Lattice& lattice, int threads, const Report& report = {});

/// Completes the work of a device: `claims` has the claims of all cells but the `open` ones, which
/// may be there in part; `claimed` is the sum of the samples that each of the other cells claims.
Claims finishClaims(const SimplexMesh& mesh, const Lattice& lattice, int threads,
  std::unique_ptr<std::int32_t[]> claims, std::int64_t claimed,
  const std::vector<std::int32_t>& open, const Report& report);

/// Sets each sample's key to the lower of its own and the claim's, and removes claims that are not
/// lower. Several
/// parts of a mesh can add their samples to the same arrays, in any order. The claims are of the
/// window's samples, the keys of all.
VTKTIPPACCELERATORS_EXPORT void mergeClaims(
  const SimplexMesh& mesh, Claims& claims, const SampleWindow& window, int threads, CellKey* keys);

} // namespace tipp

#endif
