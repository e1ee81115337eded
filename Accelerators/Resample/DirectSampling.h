// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDirectSampling_h
#define tippDirectSampling_h

#include "Resample/BorderSample.h"
#include "Resample/Interpolate.h"

#include <vector>

namespace tipp
{

struct DirectResult
{
  ClaimStatistics Statistics;
  double FinishSeconds = 0; ///< for null values and the mesh's border, after the walk
  bool Overlapping = false; ///< cells claim the same samples: the result is undefined
  bool Aborted = false;
};

/// Does the work of claimSamples() and interpolate() in one walk, which reads each cell once.
/// Correct for cells that do not overlap; otherwise it sets Overlapping. All samples are filled;
/// `options.Valid` must not be null.
VTKTIPPACCELERATORS_EXPORT DirectResult sampleDirectly(const SimplexMesh& mesh,
  const Lattice& lattice, const std::vector<Attribute>& attributes,
  const InterpolationOptions& options);

/// The same of a part of a mesh. `border` gets the samples on the part's border, which other parts
/// may contain.
VTKTIPPACCELERATORS_EXPORT DirectResult samplePartDirectly(const SimplexMesh& mesh,
  const Lattice& lattice, const std::vector<Attribute>& attributes,
  const InterpolationOptions& options, std::vector<BorderSample>& border);

/// The part of that work that a device has done.
struct SampledCells
{
  std::int64_t Claimed = 0; ///< number of samples that cells claim, without those of open cells
  std::vector<std::int32_t> Open; ///< cells that are not processed, or only in part
  bool Aborted = false;
};

/// Completes the work of a device; all attributes must be point arrays.
DirectResult finishDirectly(const SimplexMesh& mesh, const Lattice& lattice,
  const std::vector<Attribute>& attributes, const InterpolationOptions& options,
  const SampledCells& sampled);

/// Marks all samples as not valid.
void clearMask(std::int64_t samples, int threads, unsigned char* valid);

} // namespace tipp

#endif
