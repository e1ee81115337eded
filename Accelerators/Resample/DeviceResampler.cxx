// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/DeviceResampler.h"

#include "Resample/MeshOnDevice.h"
#include "Resample/ResampleOnDevice.h"
#include "Resample/SampleOnDevice.h"

namespace tipp
{
namespace
{

class OpenCLResampler : public DeviceResampler
{
public:
  OpenCLResampler(ComputeDevice& device, const SimplexMesh& mesh, const ResampleOptions& options)
    : Device(device)
    , Pieces(device, mesh, options.Threads, options.DeviceMemory)
  {
  }

  std::string name() const override { return this->Device.description().Name; }
  double transferSeconds() const override { return this->Device.transferSeconds(); }

  bool canSample(const std::vector<Attribute>& attributes) const override
  {
    return canSampleOnDevice(attributes);
  }
  SampledCells sample(const Lattice& lattice, const std::vector<Attribute>& attributes,
    unsigned char* valid, const Report& report) override
  {
    return sampleOnDevice(this->Pieces, lattice, attributes, valid, report);
  }
  Claims claim(const Lattice& lattice, const Report& report) override
  {
    return claimOnDevice(this->Pieces, lattice, report);
  }
  bool interpolate(const SampleWindow& window, const std::int32_t* claims,
    const std::vector<Attribute>& attributes, bool keeps, const Report& report) override
  {
    return interpolateOnDevice(this->Pieces, window, claims, attributes, keeps, report);
  }

private:
  ComputeDevice& Device;
  MeshPieces Pieces;
};

} // namespace

std::unique_ptr<DeviceResampler> DeviceResampler::open(
  const SimplexMesh& mesh, const ResampleOptions& options)
{
  ComputeDevice* const device = ComputeDevice::open(options.Device);
  return device ? std::make_unique<OpenCLResampler>(*device, mesh, options) : nullptr;
}

} // namespace tipp
