// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDeviceList_h
#define tippDeviceList_h

#include "OpenCL/DeviceChoice.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

enum class DeviceType
{
  Cpu,
  Gpu,
  Other
};

/// The properties of an OpenCL device that matter to users.
struct DeviceDescription
{
  int Index = 0;        ///< index in listDevices()
  std::string Name;     ///< as reported by its driver, trimmed
  std::string Platform; ///< the driver's name
  DeviceType Type = DeviceType::Other;
  std::uint64_t Memory = 0;        ///< total memory in bytes
  std::uint64_t LargestBuffer = 0; ///< maximum size of a buffer in bytes
  bool Double = false;             ///< whether it supports double precision
};

/// The OpenCL devices of this machine, by platform, in the drivers' order. Empty if no driver is
/// installed. They are enumerated once per process.
VTKTIPPACCELERATORS_EXPORT const std::vector<DeviceDescription>& listDevices();

/// A sentence for users of a machine without OpenCL devices: what is missing and what to do.
VTKTIPPACCELERATORS_EXPORT std::string noDeviceAdvice();

/// The chosen device among `devices`; nullopt if OpenMP is to be used. Throws AcceleratorError,
/// which lists the available devices, if the chosen device is missing or has no double precision.
/// Auto never throws.
VTKTIPPACCELERATORS_EXPORT std::optional<DeviceDescription> chooseDevice(
  const DeviceChoice& choice, const std::vector<DeviceDescription>& devices);

/// The choices that these devices offer, in the syntax of parseDeviceChoice(): "auto", "openmp" and
/// for each device with double precision "opencl:NAME", or "opencl:INDEX" if its name selects
/// another device.
VTKTIPPACCELERATORS_EXPORT std::vector<std::string> deviceChoices(
  const std::vector<DeviceDescription>& devices);

} // namespace tipp

#endif
