// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippResample_h
#define tippResample_h

#include "OpenCL/Devices.h"
#include "Resample/Interpolate.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

/// Options of resample().
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
  /// Mask, one byte per sample: 1 if a cell claims it, else 0. With Keys the caller must clear it
  /// first.
  unsigned char* Valid = nullptr;
  const std::int64_t* Parents = nullptr; ///< see InterpolationOptions
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
  /// sampleDirectly() on the device; the statistics count only the cells that threads do.
  virtual DirectResult sample(const Lattice& lattice, const std::vector<Attribute>& attributes,
    const InterpolationOptions& options) = 0;
  /// claimSamples() on the device, likewise. The claims are the same.
  virtual Claims claim(const Lattice& lattice, const Report& report) = 0;
};

} // namespace tipp

#endif
