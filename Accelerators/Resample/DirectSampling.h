// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDirectSampling_h
#define tippDirectSampling_h

#include "Resample/Interpolate.h"

#include <vector>

namespace tipp
{

struct DirectResult
{
  ClaimStatistics Statistics;
  double FinishSeconds = 0; ///< for null values and the mesh's border, after the walk
  bool Overlapping = false; ///< cells claim the same samples: nothing is decided
  bool Aborted = false;
};

/// What claimSamples() and interpolate() do, in one walk over the cells, which are read once. Right
/// for cells that do not overlap; for others it tells. All samples are filled; `options.Valid` is
/// not null.
VTKTIPPACCELERATORS_EXPORT DirectResult sampleDirectly(const SimplexMesh& mesh,
  const Lattice& lattice, const std::vector<Attribute>& attributes,
  const InterpolationOptions& options);

/// What a device has done of that.
struct SampledCells
{
  std::int64_t Claimed = 0;       ///< the sum of samples that the cells claim but for the open ones
  std::vector<std::int32_t> Open; ///< cells that are not done, or in part
  bool Aborted = false;
};

/// Finishes what a device has begun, with arrays of points alone.
DirectResult finishDirectly(const SimplexMesh& mesh, const Lattice& lattice,
  const std::vector<Attribute>& attributes, const InterpolationOptions& options,
  const SampledCells& sampled);

/// No sample is valid.
void clearMask(std::int64_t samples, int threads, unsigned char* valid);

} // namespace tipp

#endif
