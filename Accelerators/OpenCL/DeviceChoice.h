// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDeviceChoice_h
#define tippDeviceChoice_h

#include "vtkTIPPAcceleratorsModule.h"

#include <string>

namespace tipp
{

/// The back end of a computation over flat arrays.
enum class Device
{
  Auto,   ///< the first OpenCL GPU with double precision, else OpenMP
  OpenMP, ///< threads of this process
  OpenCL  ///< a device of an OpenCL driver
};

/// A user's choice of a device. By default Auto.
struct DeviceChoice
{
  Device Kind = Device::Auto;
  /// With OpenCL: the device's index in listDevices(), or -1.
  int Index = -1;
  /// With OpenCL and no Index: a substring of the device's name, ignoring case; empty for the first
  /// GPU with double precision, or else the first device with it.
  std::string Name;
  /// With OpenCL: use a CPU device like a graphics card, with copies of all data and small work
  /// items. Slower; for testing the code paths of cards on machines without one.
  bool AsCard = false;
};

/// Parses "auto", "openmp", "opencl", "opencl:INDEX" or "opencl:NAME" (see DeviceChoice). Throws
/// AcceleratorError for anything else. A NAME of digits alone is an INDEX.
VTKTIPPACCELERATORS_EXPORT DeviceChoice parseDeviceChoice(const std::string& text);

} // namespace tipp

#endif
