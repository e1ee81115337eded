// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippClaims_h
#define tippClaims_h

#include "Parallel/ForChunks.h"
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

/// Of the cells that the threads of this process have visited: where a device claims samples, those
/// that it leaves to them.
struct ClaimStatistics
{
  std::int64_t VisitedCells = 0; ///< whose boxes have samples
  std::int64_t Tests = 0;        ///< samples in the boxes of these
  std::int64_t ExactTests = 0;
  std::int64_t OverlappingClaims = 0; ///< samples that a cell gave up to one that overlaps it
};

/// Which cell answers each sample of a lattice.
struct Claims
{
  std::unique_ptr<std::int32_t[]> Cells; ///< one a sample, the first axis fastest; -1: none
  std::vector<BorderClaim> Border;       ///< by ascending sample
  ClaimStatistics Statistics;
  bool Aborted = false;
};

/// The cell of lowest CellKey at each sample: the one that contains it after a move by (e, e^2,
/// e^3), e being as small as can be, or on the border after the mirrored moves, or as a closed set.
/// Exact for finite coordinates; a cell without area or volume or with a coordinate that is not
/// finite answers nothing. Of cells with the same corners the first answers.
///
/// For triangles the samples are those of the lattice's two `mesh.Axes`; the third is not looked
/// at. There are fewer than 2^31 cells. The result does not depend on the number of threads.
VTKTIPPACCELERATORS_EXPORT Claims claimSamples(
  const SimplexMesh& mesh, const Lattice& lattice, int threads, const Report& report = {});

/// Finishes what a device has begun: `claims` has those of all cells but the `open` ones, which it
/// may have in part; `claimed` is the sum of samples that each of the others claims.
Claims finishClaims(const SimplexMesh& mesh, const Lattice& lattice, int threads,
  std::unique_ptr<std::int32_t[]> claims, std::int64_t claimed,
  const std::vector<std::int32_t>& open, const Report& report);

/// Lowers `keys` to those of the claims, and takes back the claims that are not below what they
/// find: then other parts of a mesh can add their samples to the same arrays, in any order. The
/// claims are of the window's samples, the keys of all.
VTKTIPPACCELERATORS_EXPORT void mergeClaims(
  const SimplexMesh& mesh, Claims& claims, const SampleWindow& window, int threads, CellKey* keys);

} // namespace tipp

#endif
