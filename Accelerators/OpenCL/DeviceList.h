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

/// What a user needs to know of an OpenCL device to choose it.
struct DeviceDescription
{
  int Index = 0;        ///< its place in listDevices()
  std::string Name;     ///< as its driver gives it, without outer spaces
  std::string Platform; ///< the driver's name
  DeviceType Type = DeviceType::Other;
  std::uint64_t Memory = 0;        ///< bytes in all
  std::uint64_t LargestBuffer = 0; ///< bytes that one allocation can have
  bool Double = false;             ///< whether it computes in double precision
};

/// The OpenCL devices of this machine: platform by platform, in the drivers' order. Empty where no
/// driver is installed. Looked for once a process; later calls give the same list.
VTKTIPPACCELERATORS_EXPORT const std::vector<DeviceDescription>& listDevices();

/// A sentence for users on a machine without OpenCL devices: what is missing and what to do.
VTKTIPPACCELERATORS_EXPORT std::string noDeviceAdvice();

/// The device that a choice means among `devices`, or nothing if OpenMP is to be used. Throws
/// AcceleratorError, which names the devices there are, if the chosen device is missing or has no
/// double precision. For Auto that is never an error.
VTKTIPPACCELERATORS_EXPORT std::optional<DeviceDescription> chooseDevice(
  const DeviceChoice& choice, const std::vector<DeviceDescription>& devices);

/// What a user can choose from these devices, as parseDeviceChoice() reads it: "auto", "openmp" and
/// for each device with double precision "opencl:NAME", or "opencl:INDEX" where its name means
/// another one.
VTKTIPPACCELERATORS_EXPORT std::vector<std::string> deviceChoices(
  const std::vector<DeviceDescription>& devices);

} // namespace tipp

#endif
