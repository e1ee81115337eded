// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInterpolate_h
#define tippInterpolate_h

#include "Arrays/Scalar.h"
#include "Parallel/ParallelFor.h"
#include "Resample/Claims.h"
#include "Resample/SimplexMesh.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// An array of a mesh, and the array of samples to compute from it.
struct Attribute
{
  /// Values per point or per cell, Components per tuple; not owned. Null: all samples get
  /// NullValue.
  const void* Values = nullptr;
  void* Samples = nullptr;       ///< Components per sample; not owned
  Scalar Type = Scalar::Float64; ///< type of Values and of Samples
  int Components = 1;            ///< components per tuple
  bool OfCells = false;          ///< whether Values are per cell; otherwise per point
  double NullValue = 0;          ///< value of samples outside of all cells
};

/// Options of interpolate() and sampleDirectly().
struct InterpolationOptions
{
  int Threads = 1; ///< OpenMP threads, at least 1
  /// Whether samples that no cell claims get NullValue; if false, they are left unchanged.
  bool FillUnclaimed = true;
  /// For each simplex the index of its cell in the attributes' arrays; null: its own index.
  const std::int64_t* Parents = nullptr;
  /// Mask, one value per sample: set to 1 if a cell claims it, and with FillUnclaimed to 0
  /// otherwise; may be null.
  unsigned char* Valid = nullptr;
  Report Progress;
};

/// Fills the attributes' samples, and Valid, in a window from its claims; other samples are left
/// unchanged. Floating-point point arrays are interpolated linearly in double precision; integer
/// point arrays are taken from the corner of largest weight; cell arrays from the cell. The weights
/// are evaluated with the corners in lexicographic order of their coordinates, so that a cell gives
/// the same bits however it is stored. Returns false if Progress stopped it.
VTKTIPPACCELERATORS_EXPORT bool interpolate(const SimplexMesh& mesh, const SampleWindow& window,
  const std::int32_t* claims, const std::vector<Attribute>& attributes,
  const InterpolationOptions& options);

/// The result of sampleDirectly().
struct DirectResult
{
  ClaimStatistics Statistics;
  double FinishSeconds = 0; ///< for null values and the mesh's border, after the main pass
  bool Overlapping = false; ///< cells overlap at samples: the sampled values are undefined
  bool Aborted = false;     ///< whether Progress stopped the work
};

/// Does the work of claimSamples() and interpolate() in one pass, which reads each cell once. Works
/// only for cells that do not overlap; otherwise it sets Overlapping. All samples are filled;
/// `options.Valid` must not be null.
VTKTIPPACCELERATORS_EXPORT DirectResult sampleDirectly(const SimplexMesh& mesh,
  const Lattice& lattice, const std::vector<Attribute>& attributes,
  const InterpolationOptions& options);

/// The same for a part of a mesh. `border` gets the samples on the part's border, which other parts
/// may claim.
VTKTIPPACCELERATORS_EXPORT DirectResult samplePartDirectly(const SimplexMesh& mesh,
  const Lattice& lattice, const std::vector<Attribute>& attributes,
  const InterpolationOptions& options, std::vector<BorderSample>& border);

/// Completes the work of a device; all attributes must be point arrays.
DirectResult finishDirectly(const SimplexMesh& mesh, const Lattice& lattice,
  const std::vector<Attribute>& attributes, const InterpolationOptions& options,
  const SampledCells& sampled);

} // namespace tipp

#endif
