// SPDX-License-Identifier: BSD-3-Clause
#include "Kernel/KernelPool.h"

#include <mutex>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

class Pool
{
public:
  /// Returns a kernel that is not in use, or null.
  std::unique_ptr<DelaunayKernel> take()
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    if (this->Kernels.empty())
    {
      return nullptr;
    }
    std::unique_ptr<DelaunayKernel> kernel = std::move(this->Kernels.back());
    this->Kernels.pop_back();
    this->Bytes -= kernel->bytes();
    return kernel;
  }

  void give(std::unique_ptr<DelaunayKernel> kernel)
  {
    const std::size_t bytes = kernel->bytes();
    const std::lock_guard<std::mutex> lock(this->Mutex);
    if (this->Kernels.size() < this->Kernels.capacity() &&
      this->Bytes + bytes <= PooledKernel::MostBytesKept)
    {
      this->Bytes += bytes;
      this->Kernels.push_back(std::move(kernel));
    }
  }

  std::size_t bytes()
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    return this->Bytes;
  }

  Pool()
  {
    // Destructors return kernels to the pool, so returning one must not throw.
    constexpr std::size_t most = 64;
    this->Kernels.reserve(most);
  }

private:
  std::mutex Mutex;
  std::vector<std::unique_ptr<DelaunayKernel>> Kernels;
  std::size_t Bytes = 0;
};

Pool& pool()
{
  static Pool one;
  return one;
}

} // namespace

PooledKernel::PooledKernel()
  : Kernel(pool().take())
{
  if (!this->Kernel)
  {
    this->Kernel = std::make_unique<DelaunayKernel>();
  }
}

PooledKernel::~PooledKernel()
{
  pool().give(std::move(this->Kernel));
}

std::size_t PooledKernel::bytesKept()
{
  return pool().bytes();
}

} // namespace tipp
