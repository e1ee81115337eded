// SPDX-License-Identifier: BSD-3-Clause
#include "Parallel/Threads.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#ifdef __linux__
#include <sched.h>
#endif
#include <sys/wait.h>
#include <unistd.h>

namespace
{

using Counts = std::array<std::atomic<int>, 4>;

/// How often the pool does the share of each number.
std::vector<int> countCalls(int shares)
{
  Counts counts = {};
  tipp::runOnThreads(shares,
    [&counts](int number)
    {
      EXPECT_EQ(number, tipp::threadNumber());
      ++counts[std::size_t(number)];
    });
  EXPECT_EQ(0, tipp::threadNumber());
  return { counts.begin(), counts.end() };
}

/// Waits until `value` is as expected; fails after a minute.
template <typename T>
void waitFor(const std::atomic<T>& value, T expected)
{
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (value != expected)
  {
    ASSERT_LT(std::chrono::steady_clock::now(), end);
    std::this_thread::yield();
  }
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

TEST(ThreadPool, OtherThreadsDoSharesWhileTheCallerDoesTheFirst)
{
  std::array<std::thread::id, 2> ids;
  std::atomic<int> begun{ 0 };
  tipp::runOnThreads(2,
    [&](int number)
    {
      ids[std::size_t(number)] = std::this_thread::get_id();
      ++begun;
      waitFor(begun, 2);
    });
  EXPECT_EQ(std::this_thread::get_id(), ids[0]);
  EXPECT_NE(ids[0], ids[1]);
}

TEST(ThreadPool, TheCallerDoesTheSharesThatNobodyHasBegun)
{
  const std::thread::id caller = std::this_thread::get_id();
  std::atomic<int> ofCaller{ 0 };
  constexpr int repetitions = 1000;
  for (int repetition = 0; repetition < repetitions; ++repetition)
  {
    tipp::runOnThreads(2, [&](int) { ofCaller += std::this_thread::get_id() == caller ? 1 : 0; });
  }
  // A share is done long before another thread is awake.
  EXPECT_GT(ofCaller, repetitions);
}

TEST(ThreadPool, WorkWithinWorkStaysInItsThread)
{
  std::atomic<int> calls{ 0 };
  tipp::runOnThreads(3,
    [&calls](int number)
    {
      const std::thread::id outer = std::this_thread::get_id();
      int expected = 0;
      tipp::runOnThreads(3,
        [&](int inner)
        {
          EXPECT_EQ(expected++, inner);
          EXPECT_EQ(outer, std::this_thread::get_id());
          ++calls;
        });
      EXPECT_EQ(number, tipp::threadNumber());
    });
  EXPECT_EQ(9, calls);
}

#ifdef _OPENMP
TEST(ThreadPool, WorkWithinAnApplicationsRegionStaysInItsThread)
{
  std::atomic<int> calls{ 0 };
#pragma omp parallel num_threads(2)
  {
    const std::thread::id outer = std::this_thread::get_id();
    tipp::runOnThreads(3,
      [&](int)
      {
        EXPECT_EQ(outer, std::this_thread::get_id());
        ++calls;
      });
  }
  EXPECT_EQ(6, calls);
}
#endif

#ifdef __linux__
TEST(ThreadPool, OtherThreadsDoNotRunOnTheCallersProcessor)
{
  cpu_set_t allowed;
  ASSERT_EQ(0, sched_getaffinity(0, sizeof allowed, &allowed));
  if (CPU_COUNT(&allowed) < 2)
  {
    GTEST_SKIP() << "This process may use one processor only.";
  }
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu)
  {
    if (!CPU_ISSET(cpu, &allowed))
    {
      continue;
    }
    std::atomic<int> begun{ 0 };
    std::atomic<bool> moved{ false };
    tipp::runOnThreads(2,
      [&](int number)
      {
        ++begun;
        waitFor(begun, 2);
        if (number == 0)
        {
          cpu_set_t one;
          CPU_ZERO(&one);
          CPU_SET(cpu, &one);
          EXPECT_EQ(0, sched_setaffinity(0, sizeof one, &one));
          tipp::ThreadPool::updateAffinity();
          moved = true;
          return;
        }
        waitFor(moved, true);
        cpu_set_t mine;
        EXPECT_EQ(0, sched_getaffinity(0, sizeof mine, &mine));
        EXPECT_FALSE(CPU_ISSET(cpu, &mine));
        EXPECT_EQ(CPU_COUNT(&allowed) - 1, CPU_COUNT(&mine));
      });
    EXPECT_EQ(0, sched_setaffinity(0, sizeof allowed, &allowed));
  }
}
#endif

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
