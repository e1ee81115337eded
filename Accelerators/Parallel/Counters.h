// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCounters_h
#define tippCounters_h

#include <atomic>
#include <cstdint>
#include <memory>

namespace tipp
{

/// Counters that several threads increment.
using SharedCounters = std::unique_ptr<std::atomic<std::uint32_t>[]>;

/// Increments a counter and returns its previous value. A single thread avoids the locked
/// instruction.
inline std::uint32_t addOne(std::atomic<std::uint32_t>& counter, bool isAlone)
{
  if (!isAlone)
  {
    return counter.fetch_add(1, std::memory_order_relaxed);
  }
  const std::uint32_t before = counter.load(std::memory_order_relaxed);
  counter.store(before + 1, std::memory_order_relaxed);
  return before;
}

} // namespace tipp

#endif
