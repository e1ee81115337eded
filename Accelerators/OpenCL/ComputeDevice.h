// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippComputeDevice_h
#define tippComputeDevice_h

#include "OpenCL/Devices.h"
#include "vtkTIPPAcceleratorsModule.h"

// Every driver supports OpenCL 1.2, including PoCL and NVIDIA's.
#define CL_TARGET_OPENCL_VERSION 120
#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_HPP_ENABLE_EXCEPTIONS
#include <CL/opencl.hpp>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>

namespace tipp
{

/// The text of a .cl file, which the build embeds into the library as a header (see
/// tipp_embed_kernels): `#include "Folder/Name.cl.h"` defines `const KernelSource NameKernels`.
struct KernelSource
{
  const char* Name; ///< identifies the program
  const char* Text;
};

/// An open OpenCL device: a context, an in-order queue, and the programs built for it.
///
/// There is one per device and process, and any thread may use it. OpenCL errors inside run() are
/// thrown as AcceleratorError.
class VTKTIPPACCELERATORS_EXPORT ComputeDevice
{
public:
  /// Opens the chosen device; returns nullptr if OpenMP is to be used. The device is not owned by
  /// the caller. Throws AcceleratorError as chooseDevice() does, or if the device cannot be opened.
  static ComputeDevice* open(const DeviceChoice& choice);

  ComputeDevice(DeviceDescription description, const cl::Device& device, bool sharesHostMemory);
  ComputeDevice(const ComputeDevice&) = delete;
  ComputeDevice& operator=(const ComputeDevice&) = delete;

  const DeviceDescription& description() const { return this->Description; }
  const cl::Context& context() const { return this->Context; }
  const cl::CommandQueue& queue() const { return this->Queue; }

  /// Whether the device can use this process's memory without copies.
  bool sharesHostMemory() const { return this->SharesHostMemory; }

  /// Returns a new kernel, owned by the caller. Its program is built once per process for each set
  /// of compiler options.
  cl::Kernel kernel(const KernelSource& source, const char* name, const std::string& options = "");

  /// Enqueues a kernel with these arguments for `items` work items, rounded up to whole groups.
  template <typename... Arguments>
  void launch(cl::Kernel& kernel, std::size_t items, const Arguments&... arguments) const
  {
    if (items == 0)
    {
      return;
    }
    this->run(
      [&]
      {
        cl_uint index = 0;
        (kernel.setArg(index++, arguments), ...);
        this->enqueue(kernel, items);
      });
  }

  /// A read-only buffer with the `bytes` bytes at `data`, without a copy if the memory is shared.
  /// The data must stay valid until the kernels that read them have finished. At least one byte is
  /// allocated.
  cl::Buffer input(const void* data, std::size_t bytes) const;

  /// An uninitialised buffer of `bytes` bytes on the device. At least one byte is allocated.
  cl::Buffer room(std::size_t bytes) const;

  ///@{
  /// Copies to or from the device and waits until it is done. Large copies to and from a card go
  /// through page-locked memory, and OpenMP's threads copy between it and the caller's memory.
  void write(const cl::Buffer& buffer, const void* data, std::size_t bytes) const;
  void read(const cl::Buffer& buffer, void* data, std::size_t bytes) const;
  ///@}

  /// Total time of all copies, without that of kernels.
  double transferSeconds() const { return 1e-9 * double(this->TransferNanoseconds); }

  /// Calls `work`. If OpenCL throws, waits until the queue is empty, so that nothing uses the
  /// caller's memory any more, and throws an AcceleratorError.
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
  void enqueue(const cl::Kernel& kernel, std::size_t items) const;
  AcceleratorError failure(const cl::Error& error) const;
  cl::Program build(const KernelSource& source, const std::string& options) const;
  /// Enqueues a copy of `bytes` bytes, from the buffer's byte `offset`, from or to host memory.
  using Enqueue =
    std::function<void(std::size_t offset, std::size_t bytes, char* memory, cl::Event& done)>;
  void transfer(char* data, std::size_t bytes, bool toHost, const Enqueue& enqueue) const;
  void transferInStages(char* data, std::size_t bytes, bool toHost, const Enqueue& enqueue) const;

  /// Page-locked memory, mapped as long as the device is open.
  struct Stage
  {
    cl::Buffer Buffer;
    char* Memory = nullptr;
  };
  Stage& stage(std::size_t index) const;

  DeviceDescription Description;
  cl::Device Device;
  cl::Context Context;
  cl::CommandQueue Queue;
  bool SharesHostMemory;
  mutable std::atomic<std::uint64_t> TransferNanoseconds{ 0 };
  mutable std::mutex StageMutex; ///< held while a transfer uses Stages
  mutable std::array<Stage, 2> Stages;
  std::mutex Mutex;                            ///< held while Programs is used
  std::map<std::string, cl::Program> Programs; ///< built programs, by name and options
};

/// A host array that kernels write to, first filled with a byte. It is not copied if host and
/// device share memory.
class OutputArray
{
public:
  OutputArray(const ComputeDevice& device, void* data, std::size_t bytes)
    : Device(device)
    , Data(data)
    , Bytes(bytes)
    , Room(device.sharesHostMemory() ? device.run(
                                         [&] {
                                           return cl::Buffer(device.context(),
                                             CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR, bytes, data);
                                         })
                                     : device.room(bytes))
  {
  }

  const cl::Buffer& buffer() const { return this->Room; }

  void fill(unsigned char byte) const
  {
    this->Device.run(
      [&] { this->Device.queue().enqueueFillBuffer(this->Room, cl_uchar(byte), 0, this->Bytes); });
  }

  /// Waits for the kernels and makes their results visible.
  void fetch() const
  {
    if (!this->Device.sharesHostMemory())
    {
      this->Device.read(this->Room, this->Data, this->Bytes);
      return;
    }
    this->Device.run(
      [&]
      {
        void* const mapped = this->Device.queue().enqueueMapBuffer(
          this->Room, CL_TRUE, CL_MAP_READ | CL_MAP_WRITE, 0, this->Bytes);
        this->Device.queue().enqueueUnmapMemObject(this->Room, mapped);
        this->Device.queue().finish();
      });
  }

private:
  const ComputeDevice& Device;
  void* Data;
  std::size_t Bytes;
  cl::Buffer Room;
};

} // namespace tipp

#endif
