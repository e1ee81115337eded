// SPDX-License-Identifier: BSD-3-Clause
// OpenMP reads OMP_THREAD_LIMIT, which is 2 here, when a program starts.
#include "Parallel/Threads.h"

#include <gtest/gtest.h>

#include <chrono>
#include <mutex>
#include <set>
#include <thread>

TEST(ThreadLimit, OfOpenMPIsTheMostThreads)
{
  std::mutex mutex;
  std::set<std::thread::id> ids;
  for (int repetition = 0; repetition < 100; ++repetition)
  {
    tipp::runOnThreads(4,
      [&](int)
      {
        std::this_thread::sleep_for(std::chrono::microseconds(100));
        const std::lock_guard<std::mutex> lock(mutex);
        ids.insert(std::this_thread::get_id());
      });
  }
  EXPECT_EQ(2, ids.size());
}
