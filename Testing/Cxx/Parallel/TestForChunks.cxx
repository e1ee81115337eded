// SPDX-License-Identifier: BSD-3-Clause
#include "Parallel/ParallelFor.h"
#include "Parallel/Stopwatch.h"

#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

TEST(ForChunks, DoesEachPieceOnce)
{
  for (const int threads : { 1, 3 })
  {
    std::vector<int> counts(1001, 0);
    const bool completed = tipp::forChunks(1001, 10, threads, {},
      [&](std::int64_t begin, std::int64_t end, int thread)
      {
        EXPECT_LT(thread, threads);
        for (std::int64_t i = begin; i < end; ++i)
        {
          ++counts[std::size_t(i)];
        }
      });
    EXPECT_TRUE(completed);
    EXPECT_EQ(counts, std::vector<int>(1001, 1));
  }
}

TEST(ForChunks, ThrowsTheExceptionOfTheLowestChunk)
{
  for (int repetition = 0; repetition < 50; ++repetition)
  {
    try
    {
      tipp::forChunks(100, 1, 4, {},
        [](std::int64_t i, std::int64_t, int)
        {
          if (i >= 5)
          {
            throw std::runtime_error(std::to_string(i));
          }
        });
      FAIL();
    }
    catch (const std::runtime_error& error)
    {
      EXPECT_STREQ(error.what(), "5");
    }
  }
}

TEST(ForChunks, StopsWhenProgressReturnsFalse)
{
  int pieces = 0;
  const bool completed = tipp::forChunks(
    100, 1, 1, [](double done) { return done < 0.5; },
    [&](std::int64_t, std::int64_t, int) { ++pieces; });
  EXPECT_FALSE(completed);
  EXPECT_EQ(pieces, 50);
}

TEST(ForChunks, NestedProgressIsAPartOfTheWhole)
{
  std::vector<double> heard;
  const tipp::Report whole = [&](double done)
  {
    heard.push_back(done);
    return true;
  };
  const tipp::Report half = tipp::partOf(whole, 0.5, 1);
  half(0);
  half(0.5);
  EXPECT_EQ(heard, (std::vector<double>{ 0.5, 0.75 }));
  EXPECT_FALSE(tipp::partOf({}, 0, 1));
}

TEST(ParallelFor, RunsEachOnceOnAnyNumberOfThreads)
{
  for (const int threads : { 0, 1, 5 })
  {
    for (const int count : { 0, 1, 77 })
    {
      std::vector<int> counts(std::size_t(count), 0);
      tipp::parallelFor(count, threads, [&](std::int64_t i) { ++counts[std::size_t(i)]; });
      EXPECT_EQ(counts, std::vector<int>(std::size_t(count), 1));
    }
  }
}

TEST(ParallelFor, FinishesLowerIndicesBeforeAFailureIsThrown)
{
  std::vector<int> done(40, 0);
  EXPECT_THROW(tipp::parallelFor(40, 4,
                 [&](std::int64_t i)
                 {
                   if (i == 30)
                   {
                     throw std::runtime_error("30");
                   }
                   done[std::size_t(i)] = 1;
                 }),
    std::runtime_error);
  EXPECT_EQ(std::vector<int>(done.begin(), done.begin() + 30), std::vector<int>(30, 1));
}

TEST(Stopwatch, CountsFromItsStartOrRestart)
{
  const tipp::Stopwatch whole;
  tipp::Stopwatch lap;
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_GE(lap.restart(), 0.005);
  const double since = lap.seconds();
  EXPECT_GE(whole.seconds(), since + 0.005);
}
