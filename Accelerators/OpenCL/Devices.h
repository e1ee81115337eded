// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDevices_h
#define tippDevices_h

#include "vtkTIPPAcceleratorsModule.h"

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace tipp
{

/// Thrown if a device cannot do a computation, or if the input is invalid. what() is one sentence
/// for the user: which device or input, what is wrong and what to do.
class VTKTIPPACCELERATORS_EXPORT AcceleratorError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
  ~AcceleratorError() override;
};

/// Thrown if no device has the index or the name that the user chose. Nothing else should do the
/// work then, because the user asked for this device.
class VTKTIPPACCELERATORS_EXPORT UnknownDevice : public AcceleratorError
{
public:
  using AcceleratorError::AcceleratorError;
  ~UnknownDevice() override;
};

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
  /// With OpenCL and no Index: a substring of the device's name or, if no device has such a name,
  /// of its platform's, ignoring case; empty for the first GPU with double precision, or else the
  /// first device with it.
  std::string Name;
  /// With OpenCL: use a CPU device like a graphics card, with copies of all data and small work
  /// items. Slower; for testing the code paths of GPUs on machines without one.
  bool AsCard = false;
};

/// Parses "auto", "openmp", "opencl", "opencl:INDEX" or "opencl:NAME" (see DeviceChoice). Throws
/// AcceleratorError for anything else. A NAME of digits alone is an INDEX.
VTKTIPPACCELERATORS_EXPORT DeviceChoice parseDeviceChoice(const std::string& text);

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

/// The chosen device among `devices`; nullopt if OpenMP is to be used. Throws UnknownDevice, which
/// lists the available devices, if none has the chosen index or name, and AcceleratorError if there
/// is no device at all, or the chosen one has no double precision. Auto never throws.
VTKTIPPACCELERATORS_EXPORT std::optional<DeviceDescription> chooseDevice(
  const DeviceChoice& choice, const std::vector<DeviceDescription>& devices);

/// The choices that these devices offer, in the syntax of parseDeviceChoice(): "auto", "openmp" and
/// for each device with double precision "opencl:NAME", or "opencl:INDEX" if its name selects
/// another device.
VTKTIPPACCELERATORS_EXPORT std::vector<std::string> deviceChoices(
  const std::vector<DeviceDescription>& devices);

} // namespace tipp

#endif
