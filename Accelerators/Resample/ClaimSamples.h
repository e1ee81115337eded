// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippClaimSamples_h
#define tippClaimSamples_h

#include "Parallel/ParallelFor.h"
#include "Resample/CellKey.h"
#include "Resample/Claims.h"
#include "Resample/Lattice.h"
#include "Resample/SampleWindow.h"
#include "Resample/SimplexMesh.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace tipp
{

/// Returns the cell of lowest CellKey at each sample: the one that contains it after a move by (e,
/// e^2, e^3) for all sufficiently small e, or on the border after the mirrored moves, or as a
/// closed set, or within Lattice::Slack. Exact for finite coordinates; a cell without area or
/// volume or with a coordinate that is not finite claims nothing. Of cells with the same corners
/// the first claims.
///
/// Triangles are sampled in the plane of the two axes `mesh.Axes`; the third one is ignored. The
/// number of cells must be below 2^31. The result does not depend on the number of threads.
VTKTIPPACCELERATORS_EXPORT Claims claimSamples(
  const SimplexMesh& mesh, const Lattice& lattice, int threads, const Report& report = {});

/// Completes the work of a device by processing the open cells. `cells` is as Claims::Cells; it may
/// have some claims of open cells, too.
Claims finishClaims(const SimplexMesh& mesh, const Lattice& lattice, int threads,
  std::unique_ptr<std::int32_t[]> cells, const SampledCells& sampled, const Report& report);

/// Decides which of the touching cells claims each sample; no other cell claims it. Returns the
/// claims by ascending sample.
VTKTIPPACCELERATORS_EXPORT std::vector<BorderClaim> borderClaims(
  const SimplexMesh& mesh, const LatticeAxes& axes, std::vector<Touch> touches, int threads);

/// Sets a sample's key to that of its claim where the claim's key is lower, and removes the other
/// claims. So several parts of a mesh can be merged in any order. `claims` has one
/// entry per sample of the window, and `keys` one per sample of the whole lattice.
VTKTIPPACCELERATORS_EXPORT void mergeClaims(
  const SimplexMesh& mesh, Claims& claims, const SampleWindow& window, int threads, CellKey* keys);

} // namespace tipp

#endif
