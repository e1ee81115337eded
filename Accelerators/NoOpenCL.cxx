// SPDX-License-Identifier: BSD-3-Clause
// Replaces ComputeDevice.cxx and all code that runs on a device in a build without OpenCL.
#include "OpenCL/Devices.h"
#include "Partition/ClassifyCells.h"
#include "Resample/Resample.h"

namespace tipp
{

const std::vector<DeviceDescription>& listDevices()
{
  static const std::vector<DeviceDescription> none;
  return none;
}

std::string noDeviceAdvice()
{
  return "TIPP was built without OpenCL: use OpenMP, or build it with -DTIPP_USE_OPENCL=ON.";
}

std::optional<Membership> classifyOnDevice(
  const CellShape&, const BoxTiling&, const ClassifyOptions& options)
{
  chooseDevice(options.Device, listDevices()); // throws if a device was chosen
  return std::nullopt;
}

std::unique_ptr<DeviceResampler> DeviceResampler::open(
  const SimplexMesh&, const ResampleOptions& options)
{
  chooseDevice(options.Device, listDevices());
  return nullptr;
}

} // namespace tipp
