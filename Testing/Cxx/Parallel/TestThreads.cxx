// SPDX-License-Identifier: BSD-3-Clause
#include "Parallel/Threads.h"

#include "Parallel/ParallelFor.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

#include <sys/wait.h>
#include <unistd.h>

namespace
{

using namespace tipp;

std::int64_t sumOnThreads()
{
  return sumOfChunks(1000, 1, 4, [](std::int64_t begin, std::int64_t end) { return end - begin; });
}

TEST(Threads, NumberIsTheRequestedOneWithinALimit)
{
  EXPECT_EQ(1, threadCount(1));
  EXPECT_EQ(3, threadCount(3));
  EXPECT_GE(threadCount(0), 1);
  EXPECT_LT(threadCount(std::numeric_limits<int>::max()), 100000);
}

TEST(Threads, UsualNumberIsWhatTheThreadHasSet)
{
  const int before = usualThreads();
  EXPECT_EQ(0, setUsualThreads(5));
  EXPECT_EQ(5, usualThreads());
  {
    const ThreadLimit limit(3);
    EXPECT_EQ(3, usualThreads());
  }
  EXPECT_EQ(5, setUsualThreads(0));
  EXPECT_EQ(before, usualThreads());
}

TEST(Threads, AForkedChildDoesNotHang)
{
  ASSERT_EQ(1000, sumOnThreads());
  const pid_t child = fork();
  if (child == 0)
  {
    alarm(60); // ends a child that hangs
    _exit(sumOnThreads() == 1000 ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(child, waitpid(child, &status, 0));
  EXPECT_EQ(0, status);
  EXPECT_EQ(1000, sumOnThreads()); // the parent goes on as before
}

} // namespace
