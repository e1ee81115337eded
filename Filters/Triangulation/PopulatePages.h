// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPopulatePages_h
#define tippPopulatePages_h

#include <cstddef>
#include <cstdint>

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace tipp
{

/// Commits the pages of fresh memory at once, which is faster than a page fault at the first touch
/// of each. The content stays. Does nothing if the system does not support it.
inline void populatePages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes)
{
#ifdef MADV_POPULATE_WRITE
  static const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto begin = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t first = (begin + page - 1) / page * page;
  const std::uintptr_t last = (begin + bytes) / page * page;
  // For a few pages the call costs as much as it saves.
  if (last > first + 8 * page)
  {
    // A failure is harmless: the pages are then committed when first touched.
    static_cast<void>(madvise(static_cast<char*>(memory) + (first - begin),
      std::size_t(last - first), MADV_POPULATE_WRITE));
  }
#endif
}

} // namespace tipp

#endif
