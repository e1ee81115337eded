// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippComputeDevice_h
#define tippComputeDevice_h

#include "OpenCL/AcceleratorError.h"
#include "OpenCL/DeviceList.h"
#include "OpenCL/OpenCLHeaders.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <cstddef>
#include <map>
#include <mutex>
#include <string>

namespace tipp
{

/// The text of a .cl file, which the build embeds into the library as a header (see
/// tipp_embed_kernels): `#include "Folder/Name.cl.h"` gives `const KernelSource NameKernels`.
struct KernelSource
{
  const char* Name; ///< tells programs apart
  const char* Text;
};

/// An open OpenCL device: a context, an in-order queue, and the programs built for it.
///
/// There is one for each device and process, and any thread may use it. Failures of OpenCL are
/// thrown as AcceleratorError if the calls stand in run().
class VTKTIPPACCELERATORS_EXPORT ComputeDevice
{
public:
  /// The device that a choice means, opened; nullptr if OpenMP is to be used. Throws
  /// AcceleratorError as chooseDevice() does, or if the device cannot be opened.
  static ComputeDevice* open(const DeviceChoice& choice);

  ComputeDevice(DeviceDescription description, const cl::Device& device);
  ComputeDevice(const ComputeDevice&) = delete;
  ComputeDevice& operator=(const ComputeDevice&) = delete;

  const DeviceDescription& description() const { return this->Description; }
  const cl::Context& context() const { return this->Context; }
  const cl::CommandQueue& queue() const { return this->Queue; }

  /// Whether buffers over memory of this process need no copy.
  bool sharesHostMemory() const { return this->SharesHostMemory; }

  /// A kernel of its own for the caller, of a program that is built once a process.
  cl::Kernel kernel(const KernelSource& source, const char* name);

  /// `bytes` of this process for a kernel to read: without a copy where the memory is shared. They
  /// must stay until the kernels that read them have finished. At least one byte is allocated.
  cl::Buffer input(const void* data, std::size_t bytes) const;

  /// Room for `bytes` on the device. At least one byte is allocated.
  cl::Buffer room(std::size_t bytes) const;

  /// Copies from the device and waits until it is done.
  void read(const cl::Buffer& buffer, void* data, std::size_t bytes) const;

  /// Calls `work` and makes an AcceleratorError of what OpenCL throws, once the queue is empty:
  /// then nothing uses the caller's memory any more.
  template <typename Work>
  auto run(Work&& work) const -> decltype(work())
  {
    try
    {
      return work();
    }
    catch (const cl::Error& error)
    {
      throw this->failure(error);
    }
  }

private:
  AcceleratorError failure(const cl::Error& error) const;
  cl::Program build(const KernelSource& source) const;

  DeviceDescription Description;
  cl::Device Device;
  cl::Context Context;
  cl::CommandQueue Queue;
  bool SharesHostMemory;
  std::mutex Mutex;
  std::map<std::string, cl::Program> Programs;
};

} // namespace tipp

#endif
