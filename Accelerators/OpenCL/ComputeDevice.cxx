// SPDX-License-Identifier: BSD-3-Clause
#include "OpenCL/ComputeDevice.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Stopwatch.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <optional>
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

constexpr std::size_t stageBytes = std::size_t(8) << 20; ///< of a ComputeDevice::Stage

void copyOnThreads(char* to, const char* from, std::size_t bytes)
{
  forChunks(std::int64_t(bytes), 1 << 18, threadCount(0), {},
    [&](std::int64_t begin, std::int64_t end, int)
    { std::memcpy(to + begin, from + begin, std::size_t(end - begin)); });
}

DeviceDescription describe(const cl::Platform& platform, const cl::Device& device)
{
  DeviceDescription description;
  description.Name = trimmed(device.getInfo<CL_DEVICE_NAME>());
  description.Platform = trimmed(platform.getInfo<CL_PLATFORM_NAME>());
  const cl_device_type type = device.getInfo<CL_DEVICE_TYPE>();
  description.Type = (type & CL_DEVICE_TYPE_GPU) != 0 ? DeviceType::Gpu
    : (type & CL_DEVICE_TYPE_CPU) != 0                ? DeviceType::Cpu
                                                      : DeviceType::Other;
  description.Memory = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
  description.LargestBuffer = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
  description.Double = device.getInfo<CL_DEVICE_DOUBLE_FP_CONFIG>() != 0;
  return description;
}

// The errors that users meet; the specification's other codes indicate programming errors.
std::string meaningOf(cl_int code)
{
  switch (code)
  {
    case CL_DEVICE_NOT_AVAILABLE:
      return "the device is not available";
    case CL_COMPILER_NOT_AVAILABLE:
      return "the driver has no compiler";
    case CL_MEM_OBJECT_ALLOCATION_FAILURE:
    case CL_OUT_OF_RESOURCES:
      return "the device has not enough memory";
    case CL_OUT_OF_HOST_MEMORY:
      return "the driver has not enough memory";
    case CL_BUILD_PROGRAM_FAILURE:
      return "the driver cannot compile the kernels";
    default:
      return "error " + std::to_string(code);
  }
}

std::string firstLine(const std::string& text)
{
  const std::size_t begin = text.find_first_not_of(" \t\n");
  return begin == std::string::npos ? "" : text.substr(begin, text.find('\n', begin) - begin);
}

/// The OpenCL devices of all installed drivers, and the ones opened so far.
class Drivers
{
public:
  Drivers()
  {
    std::vector<cl::Platform> platforms;
    ignoreErrors([&] { cl::Platform::get(&platforms); }); // there may be no driver
    for (const cl::Platform& platform : platforms)
    {
      std::vector<cl::Device> devices;
      // A driver may have no device, for example because a card was removed.
      ignoreErrors([&] { platform.getDevices(CL_DEVICE_TYPE_ALL, &devices); });
      for (const cl::Device& device : devices)
      {
        ignoreErrors(
          [&]
          {
            DeviceDescription description = describe(platform, device);
            description.Index = static_cast<int>(this->Devices.size());
            this->Descriptions.push_back(description);
            this->Devices.push_back(device);
          });
      }
    }
    this->Opened.resize(2 * this->Devices.size());
  }

  const std::vector<DeviceDescription>& descriptions() const { return this->Descriptions; }

  /// Returns the device, opened on the first call; `asCard`: see DeviceChoice. Thread-safe.
  ComputeDevice& open(int index, bool asCard)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    const auto entry = static_cast<std::size_t>(index);
    std::unique_ptr<ComputeDevice>& opened = this->Opened.at(2 * entry + std::size_t(asCard));
    if (!opened)
    {
      DeviceDescription description = this->Descriptions[entry];
      description.Type = asCard ? DeviceType::Gpu : description.Type;
      const cl::Device& device = this->Devices[entry];
      const bool shares = !asCard && device.getInfo<CL_DEVICE_HOST_UNIFIED_MEMORY>() == CL_TRUE;
      opened = std::make_unique<ComputeDevice>(std::move(description), device, shares);
    }
    return *opened;
  }

private:
  template <typename Work>
  static void ignoreErrors(const Work& work)
  {
    try
    {
      work();
    }
    catch (const cl::Error&)
    {
    }
  }

  std::vector<DeviceDescription> Descriptions;
  std::vector<cl::Device> Devices;
  std::mutex Mutex;
  std::vector<std::unique_ptr<ComputeDevice>> Opened; ///< per device: opened as it is, and AsCard
};

/// The drivers of this process, enumerated on the first call.
Drivers& drivers()
{
  // Never destroyed: at exit the drivers' own libraries may be unloaded already.
  static Drivers* const instance = new Drivers;
  return *instance;
}

} // namespace

const std::vector<DeviceDescription>& listDevices()
{
  return drivers().descriptions();
}

std::string noDeviceAdvice()
{
  return "This machine has no OpenCL device: install the device's OpenCL driver (pocl-opencl-icd "
         "makes one of the processor), or use OpenMP.";
}

ComputeDevice* ComputeDevice::open(const DeviceChoice& choice)
{
  if (choice.Kind == tipp::Device::OpenMP)
  {
    return nullptr;
  }
  const std::optional<DeviceDescription> description = chooseDevice(choice, listDevices());
  if (!description)
  {
    return nullptr;
  }
  try
  {
    return &drivers().open(description->Index, choice.AsCard);
  }
  catch (const cl::Error& error)
  {
    throw AcceleratorError("The OpenCL device '" + description->Name +
      "' cannot be used: " + meaningOf(error.err()) + " (" + error.what() + ").");
  }
}

ComputeDevice::ComputeDevice(
  DeviceDescription description, const cl::Device& device, bool sharesHostMemory)
  : Description(std::move(description))
  , Device(device)
  , Context(device)
  , Queue(this->Context, device)
  , SharesHostMemory(sharesHostMemory)
{
}

cl::Kernel ComputeDevice::kernel(
  const KernelSource& source, const char* name, const std::string& options)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  const std::string key = source.Name + (" " + options);
  auto found = this->Programs.find(key);
  if (found == this->Programs.end())
  {
    found = this->Programs.emplace(key, this->build(source, options)).first;
  }
  return this->run([&] { return cl::Kernel(found->second, name); });
}

cl::Program ComputeDevice::build(const KernelSource& source, const std::string& options) const
{
  return this->run(
    [&]
    {
      cl::Program program(this->Context, std::string(source.Text));
      try
      {
        program.build({ this->Device }, ("-cl-std=CL1.2 " + options).c_str());
      }
      catch (const cl::BuildError& error)
      {
        const auto logs = error.getBuildLog();
        throw AcceleratorError("The OpenCL driver of '" + this->Description.Name +
          "' cannot compile the kernels of " + source.Name + ": " +
          (logs.empty() ? meaningOf(error.err()) : firstLine(logs.front().second)));
      }
      return program;
    });
}

cl::Buffer ComputeDevice::input(const void* data, std::size_t bytes) const
{
  if (bytes == 0)
  {
    return this->room(0);
  }
  if (!this->SharesHostMemory)
  {
    cl::Buffer copy = this->room(bytes);
    this->write(copy, data, bytes);
    return copy;
  }
  return this->run(
    [&]
    {
      // The const_cast is safe: with CL_MEM_READ_ONLY kernels do not write to the memory.
      return cl::Buffer(
        this->Context, CL_MEM_READ_ONLY | CL_MEM_USE_HOST_PTR, bytes, const_cast<void*>(data));
    });
}

cl::Buffer ComputeDevice::room(std::size_t bytes) const
{
  return this->run(
    [&] { return cl::Buffer(this->Context, CL_MEM_READ_WRITE, std::max<std::size_t>(bytes, 1)); });
}

void ComputeDevice::read(const cl::Buffer& buffer, void* data, std::size_t bytes) const
{
  this->transfer(static_cast<char*>(data), bytes, true,
    [&](std::size_t offset, std::size_t count, char* memory, cl::Event& done)
    { this->Queue.enqueueReadBuffer(buffer, CL_FALSE, offset, count, memory, nullptr, &done); });
}

void ComputeDevice::write(const cl::Buffer& buffer, const void* data, std::size_t bytes) const
{
  // The const_cast is safe: nothing writes to the memory.
  this->transfer(static_cast<char*>(const_cast<void*>(data)), bytes, false,
    [&](std::size_t offset, std::size_t count, char* memory, cl::Event& done)
    { this->Queue.enqueueWriteBuffer(buffer, CL_FALSE, offset, count, memory, nullptr, &done); });
}

void ComputeDevice::transfer(
  char* data, std::size_t bytes, bool toHost, const Enqueue& enqueue) const
{
  if (bytes == 0)
  {
    return;
  }
  const bool isStaged = bytes > stageBytes && !this->SharesHostMemory;
  // Held until run() has emptied the queue after an error.
  std::unique_lock<std::mutex> lock(this->StageMutex, std::defer_lock);
  if (isStaged)
  {
    lock.lock();
  }
  this->run(
    [&]
    {
      this->Queue.finish(); // the time of kernels does not count
      const Stopwatch watch;
      if (!isStaged)
      {
        cl::Event done;
        enqueue(0, bytes, data, done);
        done.wait();
      }
      else
      {
        this->transferInStages(data, bytes, toHost, enqueue);
      }
      this->TransferNanoseconds += std::uint64_t(1e9 * watch.seconds());
    });
}

void ComputeDevice::transferInStages(
  char* data, std::size_t bytes, bool toHost, const Enqueue& enqueue) const
{
  const std::size_t parts = (bytes + stageBytes - 1) / stageBytes;
  const std::size_t stages = this->Stages.size();
  const auto sizeOf = [&](std::size_t part)
  { return std::min(stageBytes, bytes - part * stageBytes); };
  std::vector<cl::Event> done(stages);
  // While the threads copy to or from one stage, the device copies from or to the other.
  for (std::size_t part = 0; part < parts + stages; ++part)
  {
    const std::size_t index = part % stages;
    char* const memory = this->stage(index).Memory;
    if (part >= stages)
    {
      done[index].wait();
    }
    if (part >= stages && toHost)
    {
      const std::size_t before = part - stages;
      copyOnThreads(data + before * stageBytes, memory, sizeOf(before));
    }
    if (part < parts)
    {
      if (!toHost)
      {
        copyOnThreads(memory, data + part * stageBytes, sizeOf(part));
      }
      enqueue(part * stageBytes, sizeOf(part), memory, done[index]);
      this->Queue.flush();
    }
  }
}

ComputeDevice::Stage& ComputeDevice::stage(std::size_t index) const
{
  Stage& stage = this->Stages[index];
  if (!stage.Memory)
  {
    // Drivers page-lock memory that they allocate for the host.
    stage.Buffer = cl::Buffer(this->Context, CL_MEM_READ_WRITE | CL_MEM_ALLOC_HOST_PTR, stageBytes);
    stage.Memory = static_cast<char*>(this->Queue.enqueueMapBuffer(
      stage.Buffer, CL_TRUE, CL_MAP_READ | CL_MAP_WRITE, 0, stageBytes));
  }
  return stage;
}

void ComputeDevice::enqueue(const cl::Kernel& kernel, std::size_t items) const
{
  // Rounded up to whole work groups: for a prime number of items some drivers choose groups of one.
  constexpr std::size_t usual = 64;
  const auto own = kernel.getWorkGroupInfo<CL_KERNEL_COMPILE_WORK_GROUP_SIZE>(this->Device);
  const std::size_t group = own[0] == 0 ? usual : own[0];
  const std::size_t rounded = (items + group - 1) / group * group;
  this->Queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(rounded), cl::NDRange(group));
}

AcceleratorError ComputeDevice::failure(const cl::Error& error) const
{
  clFinish(this->Queue());
  return AcceleratorError("The OpenCL device '" + this->Description.Name +
    "' failed: " + meaningOf(error.err()) + " (" + error.what() + ").");
}

} // namespace tipp
