// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/PopulatePages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace
{

using tipp::populatePages;

TEST(PopulatePages, KeepsTheContentOfMemory)
{
  std::vector<char> memory(1000001, 'x');
  populatePages(memory.data() + 3, memory.size() - 3);
  EXPECT_EQ(std::ptrdiff_t(memory.size()), std::count(memory.begin(), memory.end(), 'x'));
}

TEST(PopulatePages, AcceptsRangesSmallerThanAPage)
{
  char memory[100] = {};
  populatePages(nullptr, 0);
  populatePages(memory, sizeof(memory));
  EXPECT_EQ(100, std::count(memory, memory + 100, 0));
}

#ifdef MADV_POPULATE_WRITE
/// Only whole pages are committed: other data may lie in the pages at the ends.
TEST(PopulatePages, CommitsWholePagesOfFreshMemory)
{
  const auto page = std::size_t(sysconf(_SC_PAGESIZE));
  constexpr std::size_t count = 64;
  void* const fresh =
    mmap(nullptr, count * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(MAP_FAILED, fresh);
  const auto present = [&]
  {
    std::vector<unsigned char> pages(count);
    EXPECT_EQ(0, mincore(fresh, count * page, pages.data()));
    return std::count_if(pages.begin(), pages.end(), [](unsigned char p) { return p & 1; });
  };
  ASSERT_EQ(0, present());
  populatePages(static_cast<char*>(fresh) + 1, (count - 1) * page);
  const auto after = present();
  const bool isKnown = madvise(fresh, page, MADV_POPULATE_WRITE) == 0; // since Linux 5.14
  EXPECT_EQ(isKnown ? std::ptrdiff_t(count) - 2 : 0, after);
  munmap(fresh, count * page);
}
#endif

} // namespace
