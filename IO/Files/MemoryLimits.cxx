// SPDX-License-Identifier: BSD-3-Clause
#include "Files/MemoryLimits.h"

#include <atomic>
#include <cstddef>
#include <mutex>
#include <set>
#include <shared_mutex>

namespace tipp
{
namespace
{

struct AllMemory
{
  std::shared_mutex Mutex;
  std::set<LimitedMemory*> Members;
  std::atomic<std::size_t> Count{ 0 }; ///< of members, read without the mutex
};

AllMemory& allMemory()
{
  static AllMemory all;
  return all;
}

} // namespace

void LimitedMemory::list()
{
  const std::lock_guard<std::shared_mutex> lock(allMemory().Mutex);
  allMemory().Members.insert(this);
  allMemory().Count = allMemory().Members.size();
}

void LimitedMemory::unlist()
{
  const std::lock_guard<std::shared_mutex> lock(allMemory().Mutex);
  allMemory().Members.erase(this);
  allMemory().Count = allMemory().Members.size();
}

void keepMemoryLimits()
{
  AllMemory& all = allMemory();
  if (all.Count.load(std::memory_order_relaxed) > 0)
  {
    const std::shared_lock<std::shared_mutex> lock(all.Mutex);
    for (LimitedMemory* const memory : all.Members)
    {
      memory->keepLimit();
    }
  }
}

} // namespace tipp
