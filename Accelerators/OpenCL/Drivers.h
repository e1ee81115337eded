// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDrivers_h
#define tippDrivers_h

#include "OpenCL/ComputeDevice.h"
#include "OpenCL/DeviceList.h"
#include "OpenCL/OpenCLHeaders.h"

#include <memory>
#include <mutex>
#include <vector>

namespace tipp
{

/// The OpenCL devices of all installed drivers, and those of them that are open.
class Drivers
{
public:
  Drivers();

  const std::vector<DeviceDescription>& descriptions() const { return this->Descriptions; }

  /// Returns the device, opened on the first call; `asCard`: see DeviceChoice. Thread-safe.
  ComputeDevice& open(int index, bool asCard);

private:
  std::vector<DeviceDescription> Descriptions;
  std::vector<cl::Device> Devices;
  std::mutex Mutex;
  std::vector<std::unique_ptr<ComputeDevice>> Opened; ///< each as it is, and as a card
};

/// The drivers of this process, enumerated on the first call.
Drivers& drivers();

} // namespace tipp

#endif
