// SPDX-License-Identifier: BSD-3-Clause
#include "OpenCL/ComputeDevice.h"

#include "OpenCL/Drivers.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <omp.h>

namespace tipp
{
namespace
{

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

} // namespace

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
  , Queue(this->Context, device, CL_QUEUE_PROFILING_ENABLE)
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
      // CL_MEM_READ_ONLY: kernels do not write through the const_cast pointer.
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
  if (bytes != 0)
  {
    this->run(
      [&]
      {
        cl::Event event;
        this->Queue.enqueueReadBuffer(buffer, CL_TRUE, 0, bytes, data, nullptr, &event);
        this->countTransfer(event);
      });
  }
}

void ComputeDevice::write(const cl::Buffer& buffer, const void* data, std::size_t bytes) const
{
  if (bytes != 0)
  {
    this->run(
      [&]
      {
        cl::Event event;
        this->Queue.enqueueWriteBuffer(buffer, CL_TRUE, 0, bytes, data, nullptr, &event);
        this->countTransfer(event);
      });
  }
}

void ComputeDevice::countTransfer(const cl::Event& event) const
{
  this->TransferNanoseconds += event.getProfilingInfo<CL_PROFILING_COMMAND_END>() -
    event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
}

void ComputeDevice::enqueue(const cl::Kernel& kernel, std::size_t items) const
{
  if (this->Description.Type == DeviceType::Cpu)
  {
    // After a parallel loop OpenMP's threads spin for some milliseconds, on cores that the device
    // needs.
    omp_pause_resource_all(omp_pause_soft);
  }
  // Rounded up to whole groups: for a prime number some drivers choose groups of one.
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
