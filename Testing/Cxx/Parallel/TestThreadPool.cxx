// SPDX-License-Identifier: BSD-3-Clause
#include "Parallel/ThreadPool.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <thread>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

namespace
{

using Counts = std::array<std::atomic<int>, 4>;

/// How often the pool calls the work of each number.
std::vector<int> countCalls(int threads)
{
  Counts counts = {};
  tipp::ThreadPool::instance().run(threads,
    [&counts](int number)
    {
      EXPECT_EQ(number, tipp::ThreadPool::number());
      ++counts[std::size_t(number)];
    });
  return { counts.begin(), counts.end() };
}

} // namespace

TEST(ThreadPool, CallsWorkOnceForEachNumber)
{
  for (int repetition = 0; repetition < 100; ++repetition)
  {
    EXPECT_EQ((std::vector<int>{ 1, 0, 0, 0 }), countCalls(1));
    EXPECT_EQ((std::vector<int>{ 1, 1, 1, 1 }), countCalls(4));
    EXPECT_EQ((std::vector<int>{ 1, 1, 0, 0 }), countCalls(2));
  }
}

TEST(ThreadPool, NumbersAreThoseOfDifferentThreads)
{
  std::array<std::thread::id, 2> ids;
  tipp::ThreadPool::instance().run(
    2, [&ids](int number) { ids[std::size_t(number)] = std::this_thread::get_id(); });
  EXPECT_EQ(std::this_thread::get_id(), ids[0]);
  EXPECT_NE(ids[0], ids[1]);
}

TEST(ThreadPool, WorkWithinWorkStaysInItsThread)
{
  std::atomic<int> calls{ 0 };
  tipp::ThreadPool::instance().run(3,
    [&calls](int number)
    {
      const std::thread::id outer = std::this_thread::get_id();
      tipp::ThreadPool::instance().run(3,
        [&](int inner)
        {
          EXPECT_EQ(0, inner);
          EXPECT_EQ(outer, std::this_thread::get_id());
          ++calls;
        });
      EXPECT_EQ(number, tipp::ThreadPool::number());
    });
  EXPECT_EQ(3, calls);
}

TEST(ThreadPool, SeveralThreadsRunWorkAtOnce)
{
  std::vector<std::thread> callers;
  for (int i = 0; i < 4; ++i)
  {
    callers.emplace_back(
      []
      {
        for (int repetition = 0; repetition < 50; ++repetition)
        {
          EXPECT_EQ((std::vector<int>{ 1, 1, 1, 0 }), countCalls(3));
        }
      });
  }
  for (std::thread& caller : callers)
  {
    caller.join();
  }
}

// ThreadSanitizer supports no threads in a forked child.
#ifndef __SANITIZE_THREAD__
#if !defined(__has_feature)
#define __has_feature(x) 0
#endif
#if !__has_feature(thread_sanitizer)
TEST(ThreadPool, ForkedChildStartsItsOwnThreads)
{
  EXPECT_EQ((std::vector<int>{ 1, 1, 1, 0 }), countCalls(3));
  const pid_t child = fork();
  if (child == 0)
  {
    alarm(60); // ends the child if it waits for threads that it does not have
    _exit(countCalls(3) == std::vector<int>{ 1, 1, 1, 0 } ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(child, waitpid(child, &status, 0));
  EXPECT_EQ(0, status);
  EXPECT_EQ((std::vector<int>{ 1, 1, 1, 0 }), countCalls(3));
}
#endif
#endif
