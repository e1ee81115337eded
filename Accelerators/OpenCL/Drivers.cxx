// SPDX-License-Identifier: BSD-3-Clause
#include "OpenCL/Drivers.h"

#include <utility>

namespace tipp
{
namespace
{

std::string trimmed(const std::string& text)
{
  const std::string spaces(" \t\n\0", 4);
  const std::size_t first = text.find_first_not_of(spaces);
  const std::size_t last = text.find_last_not_of(spaces);
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

DeviceType typeOf(const cl::Device& device)
{
  const cl_device_type type = device.getInfo<CL_DEVICE_TYPE>();
  if ((type & CL_DEVICE_TYPE_GPU) != 0)
  {
    return DeviceType::Gpu;
  }
  return (type & CL_DEVICE_TYPE_CPU) != 0 ? DeviceType::Cpu : DeviceType::Other;
}

DeviceDescription describe(const cl::Platform& platform, const cl::Device& device)
{
  DeviceDescription description;
  description.Name = trimmed(device.getInfo<CL_DEVICE_NAME>());
  description.Platform = trimmed(platform.getInfo<CL_PLATFORM_NAME>());
  description.Type = typeOf(device);
  description.Memory = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
  description.LargestBuffer = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
  description.Double = device.getInfo<CL_DEVICE_DOUBLE_FP_CONFIG>() != 0;
  return description;
}

std::vector<cl::Platform> platforms()
{
  std::vector<cl::Platform> result;
  try
  {
    cl::Platform::get(&result);
  }
  catch (const cl::Error&)
  {
    // The loader throws this if no driver is installed.
    result.clear();
  }
  return result;
}

std::vector<cl::Device> devicesOf(const cl::Platform& platform)
{
  std::vector<cl::Device> result;
  try
  {
    platform.getDevices(CL_DEVICE_TYPE_ALL, &result);
  }
  catch (const cl::Error&)
  {
    // A driver without a device, for example after a card was removed.
    result.clear();
  }
  return result;
}

} // namespace

Drivers::Drivers()
{
  for (const cl::Platform& platform : platforms())
  {
    for (const cl::Device& device : devicesOf(platform))
    {
      try
      {
        DeviceDescription description = describe(platform, device);
        description.Index = static_cast<int>(this->Devices.size());
        this->Descriptions.push_back(description);
        this->Devices.push_back(device);
      }
      catch (const cl::Error&)
      {
        // Skip devices that cannot be queried.
        continue;
      }
    }
  }
  this->Opened.resize(2 * this->Devices.size());
}

ComputeDevice& Drivers::open(int index, bool asCard)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  const auto place = static_cast<std::size_t>(index);
  std::unique_ptr<ComputeDevice>& opened = this->Opened.at(2 * place + std::size_t(asCard));
  if (!opened)
  {
    DeviceDescription description = this->Descriptions[place];
    description.Type = asCard ? DeviceType::Gpu : description.Type;
    const cl::Device& device = this->Devices[place];
    const bool shares = !asCard && device.getInfo<CL_DEVICE_HOST_UNIFIED_MEMORY>() == CL_TRUE;
    opened = std::make_unique<ComputeDevice>(std::move(description), device, shares);
  }
  return *opened;
}

Drivers& drivers()
{
  // Never destroyed: at exit the drivers' own libraries may be unloaded already.
  static Drivers* const instance = new Drivers;
  return *instance;
}

const std::vector<DeviceDescription>& listDevices()
{
  return drivers().descriptions();
}

std::string noDeviceAdvice()
{
  return "This machine has no OpenCL device: install the device's OpenCL driver (pocl-opencl-icd "
         "makes one of the processor), or use OpenMP.";
}

} // namespace tipp
