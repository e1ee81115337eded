// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippKeptClaims_h
#define tippKeptClaims_h

#include "Parallel/ParallelFor.h"
#include "Resample/Claims.h"
#include "Resample/Lattice.h"
#include "Resample/SimplexMesh.h"

#include <cstdint>
#include <optional>

namespace tipp
{

/// The claims of a mesh's cells, kept while mesh and lattice stay the same, as they do from one
/// time step to the next.
class KeptClaims
{
public:
  /// Returns what claimSamples() does, and calls it only if the mesh, in its content, or the
  /// lattice differs from that of the last call. Null if `progress` stopped it.
  const Claims* of(
    const SimplexMesh& mesh, const Lattice& lattice, int threads, const Report& progress);

private:
  std::optional<std::uint64_t> Key; ///< a checksum of mesh and lattice
  Claims Kept;
};

} // namespace tipp

#endif
