// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/PopulatePages.h"

#include <cstdint>

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace tipp
{

#ifdef MADV_POPULATE_WRITE
void populatePages(void* memory, std::size_t bytes)
{
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
}
#else
void populatePages(void*, std::size_t) {}
#endif

} // namespace tipp
