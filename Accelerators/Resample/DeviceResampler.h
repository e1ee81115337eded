// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDeviceResampler_h
#define tippDeviceResampler_h

#include "Resample/DirectSampling.h"
#include "Resample/Resample.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

/// The steps of resampling one mesh on an OpenCL device. All throw AcceleratorError.
class DeviceResampler
{
public:
  /// Opens the device that the options choose; null if OpenMP is to be used.
  static std::unique_ptr<DeviceResampler> open(
    const SimplexMesh& mesh, const ResampleOptions& options);

  virtual ~DeviceResampler() = default;

  virtual std::string name() const = 0;
  /// Total time of all transfers to and from the device.
  virtual double transferSeconds() const = 0;

  ///@{
  /// See ResampleOnDevice.h.
  virtual bool canSample(const std::vector<Attribute>& attributes) const = 0;
  virtual SampledCells sample(const Lattice& lattice, const std::vector<Attribute>& attributes,
    unsigned char* valid, const Report& report) = 0;
  ///@}

  ///@{
  /// See ResampleOnDevice.h.
  virtual Claims claim(const Lattice& lattice, const Report& report) = 0;
  virtual bool interpolate(const SampleWindow& window, const std::int32_t* claims,
    const std::vector<Attribute>& attributes, bool keeps, const Report& report) = 0;
  ///@}
};

} // namespace tipp

#endif
