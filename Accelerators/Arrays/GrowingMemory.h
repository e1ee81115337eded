// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippGrowingMemory_h
#define tippGrowingMemory_h

#include <cstddef>

namespace tipp
{

/// Memory of zeros with fixed addresses, of which a growing part at the beginning may be used. The
/// destructor frees it.
class GrowingMemory
{
public:
  GrowingMemory() = default;
  virtual ~GrowingMemory() = default;
  GrowingMemory(const GrowingMemory&) = delete;
  GrowingMemory& operator=(const GrowingMemory&) = delete;

  virtual void* data() = 0;
  /// Makes at least the first `bytes` usable, and returns how many are; threads may call it at the
  /// same time. Throws if the memory is full.
  virtual std::size_t grow(std::size_t bytes) = 0;
};

} // namespace tipp

#endif
