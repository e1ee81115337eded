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

/// The OpenCL devices of all installed drivers, and what was opened of them.
class Drivers
{
public:
  Drivers();

  const std::vector<DeviceDescription>& descriptions() const { return this->Descriptions; }

  /// The device, opened when it is first asked for; `asCard`: see DeviceChoice. Any thread may ask.
  ComputeDevice& open(int index, bool asCard);

private:
  std::vector<DeviceDescription> Descriptions;
  std::vector<cl::Device> Devices;
  std::mutex Mutex;
  std::vector<std::unique_ptr<ComputeDevice>> Opened; ///< each as it is, and as a card
};

/// Those of this process, found on the first call.
Drivers& drivers();

} // namespace tipp

#endif
