// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippResample_h
#define tippResample_h

#include "OpenCL/Devices.h"
#include "Parallel/ParallelFor.h"
#include "Resample/Attribute.h"
#include "Resample/CellKey.h"
#include "Resample/Claims.h"
#include "Resample/Lattice.h"
#include "Resample/SampleWindow.h"
#include "Resample/SimplexMesh.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

/// Options of resample(). interpolate() and sampleDirectly() ignore Device and DeviceMemory.
struct ResampleOptions
{
  DeviceChoice Device = { tipp::Device::OpenMP, -1, "" };
  std::uint64_t DeviceMemory = 0; ///< limit of OpenCL device memory, in bytes; 0: half of it
  int Threads = 1;                ///< OpenMP threads, at least 1
  /// If the mesh is a part of a larger one: for each sample the key of the cell that claims it so
  /// far (noCellKey: none). Only samples that get a lower key are changed, and the cost depends on
  /// the part's own bounding box. Null: the mesh is complete, and samples that no cell claims get
  /// the attributes' NullValue.
  CellKey* Keys = nullptr;
  /// Mask, one byte per sample: 1 if a cell claims it, else 0. May be null. With Keys the caller
  /// must clear it first.
  unsigned char* Valid = nullptr;
  /// For each simplex the index of its cell in the attributes' arrays; null: its own index.
  const std::int64_t* Parents = nullptr;
  Report Progress;
};

/// The result of resample(): statistics, wall-clock times, and the device that was used.
struct ResampleResult
{
  ClaimStatistics Statistics;
  /// If threads resample a complete mesh, this includes most of the interpolation.
  double ClaimSeconds = 0;
  double InterpolationSeconds = 0;
  double TransferSeconds = 0; ///< to and from an OpenCL device; not included in the others
  /// "OpenMP", or an OpenCL device's name; empty if a part has no samples.
  std::string Device;
  std::string Warning;  ///< why another device than the requested one was used; else empty
  bool Aborted = false; ///< whether Progress stopped the work
};

/// Samples a mesh on a lattice: see claimSamples() and interpolate(). The attributes' sample arrays
/// have the lattice's samples, the first axis fastest; for triangles those of its two `mesh.Axes`.
/// If an OpenCL device is missing or fails, OpenMP does all the work, and Warning gives the reason.
VTKTIPPACCELERATORS_EXPORT ResampleResult resample(const SimplexMesh& mesh, const Lattice& lattice,
  const std::vector<Attribute>& attributes, const ResampleOptions& options);

/// Computes, from a window's claims, the attributes' samples and Valid within the window. Samples
/// outside of it are left unchanged, and with Keys so are those without a claim. Floating-point
/// point arrays are interpolated linearly in double precision; integer point arrays are taken from
/// the corner of largest weight; cell arrays from the cell. The weights are evaluated with the
/// corners in lexicographic order of their coordinates, so that a cell gives the same bits however
/// it is stored. Returns false if Progress stopped it.
VTKTIPPACCELERATORS_EXPORT bool interpolate(const SimplexMesh& mesh, const SampleWindow& window,
  const std::int32_t* claims, const std::vector<Attribute>& attributes,
  const ResampleOptions& options);

/// The result of sampleDirectly().
struct DirectResult
{
  ClaimStatistics Statistics;
  double FinishSeconds = 0; ///< for null values and the mesh's border, after the main pass
  bool Overlapping = false; ///< cells overlap at samples: the sampled values are undefined
  bool Aborted = false;     ///< whether Progress stopped the work
};

/// Does the work of claimSamples() and interpolate() in one pass, which reads each cell once. Works
/// only for cells that do not overlap; otherwise it sets Overlapping. All samples are filled:
/// `options.Keys` is ignored. `options.Valid` must not be null. If the mesh is a part of a larger
/// one, `border` (may be null) gets the samples on the part's border, which other parts may claim.
VTKTIPPACCELERATORS_EXPORT DirectResult sampleDirectly(const SimplexMesh& mesh,
  const Lattice& lattice, const std::vector<Attribute>& attributes, const ResampleOptions& options,
  std::vector<BorderSample>* border = nullptr);

/// Completes the work of a device; all attributes must be point arrays.
DirectResult finishDirectly(const SimplexMesh& mesh, const Lattice& lattice,
  const std::vector<Attribute>& attributes, const ResampleOptions& options,
  const SampledCells& sampled);

/// Resampling of one mesh on an OpenCL device. Threads of this process complete the device's work:
/// they process thin cells and the cells for which rounding could change the result, and decide
/// the samples on cells' borders that no cell claims. All methods throw AcceleratorError.
class DeviceResampler
{
public:
  /// Opens the device that the options choose. Returns null if OpenMP is to be used.
  static std::unique_ptr<DeviceResampler> open(
    const SimplexMesh& mesh, const ResampleOptions& options);

  virtual ~DeviceResampler() = default;

  virtual std::string name() const = 0;
  /// Total time of all transfers to and from the device.
  virtual double transferSeconds() const = 0;

  /// Whether sample() supports all of the arrays: a few floating-point point arrays.
  virtual bool canSample(const std::vector<Attribute>& attributes) const = 0;
  /// Returns what sampleDirectly() returns. The statistics count only the cells that threads
  /// process.
  virtual DirectResult sample(const Lattice& lattice, const std::vector<Attribute>& attributes,
    const ResampleOptions& options) = 0;
  /// Returns the claims that claimSamples() returns. The statistics count only the cells that
  /// threads process.
  virtual Claims claim(const Lattice& lattice, const Report& report) = 0;
};

} // namespace tipp

#endif
