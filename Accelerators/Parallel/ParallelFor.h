// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippParallelFor_h
#define tippParallelFor_h

#include "Parallel/Poll.h"
#include "Parallel/Threads.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>

namespace tipp
{

/// A progress callback. The thread that started the work calls it now and then with the fraction
/// done, 0 to 1; returning false stops the work.
using Report = std::function<bool(double)>;

/// Returns a callback that maps the progress of a part of the work to [begin, end], fractions of
/// the whole. `report` must outlive it.
inline Report partOf(const Report& report, double begin, double end)
{
  if (!report)
  {
    return {};
  }
  return [&report, begin, end](double done) { return report(begin + done * (end - begin)); };
}

/// Calls body(begin, end, thread) once for each chunk of at most `chunk` indices of [0, count).
/// Threads take chunks dynamically, in order. If bodies throw, the exception of the lowest chunk is
/// rethrown, as in a serial loop. Returns false if `report` stopped the loop.
template <typename Body>
bool forChunks(
  std::int64_t count, std::int64_t chunk, int threads, const Report& report, const Body& body)
{
  std::atomic<std::int64_t> next{ 0 };
  std::atomic<bool> stopped{ false };
  bool wanted = true;
  std::mutex mutex; ///< of the error
  std::exception_ptr error;
  std::int64_t errorBegin = count;
  const auto takeChunks = [&](int thread)
  {
    while (!stopped.load(std::memory_order_relaxed))
    {
      const std::int64_t begin = next.fetch_add(chunk, std::memory_order_relaxed);
      if (begin >= count)
      {
        break;
      }
      try
      {
        if (thread == 0)
        {
          ThreadPool::updateAffinity();
          if (report && !report(double(begin) / double(count)))
          {
            wanted = false;
            stopped = true;
            break;
          }
        }
        body(begin, std::min(begin + chunk, count), thread);
      }
      catch (...)
      {
        stopped = true;
        const std::lock_guard<std::mutex> lock(mutex);
        if (begin < errorBegin)
        {
          error = std::current_exception();
          errorBegin = begin;
        }
      }
    }
  };
  runOnThreads(count > chunk ? threads : 1, takeChunks);
  if (error)
  {
    std::rethrow_exception(error);
  }
  // The other threads may have taken all chunks before the calling thread started.
  return wanted && (!report || report(1));
}

/// The sum of body(begin, end) over the chunks of [0, count).
template <typename Body>
std::int64_t sumOfChunks(std::int64_t count, std::int64_t chunk, int threads, const Body& body)
{
  std::atomic<std::int64_t> sum{ 0 };
  forChunks(count, chunk, threads, {},
    [&](std::int64_t begin, std::int64_t end, int) { sum += std::int64_t(body(begin, end)); });
  return sum;
}

/// Sets `count` values on several threads.
template <typename T>
void fillInChunks(T* values, std::int64_t count, T value, int threads)
{
  forChunks(count, 1 << 16, threads, {},
    [&](std::int64_t begin, std::int64_t end, int)
    { std::fill(values + begin, values + end, value); });
}

/// The number of threads to use: as requested (0: usualThreads()), but at most the larger of 64 and
/// 4 per processor. Without that limit a large number would end the process, since OpenMP aborts if
/// it cannot start a thread.
inline int threadCount(int threads)
{
  const int most = std::max(64, 4 * processorCount());
  return std::min(threads > 0 ? threads : usualThreads(), most);
}

/// Calls work(0) ... work(count - 1) on several threads (0: usualThreads()), started in that
/// order. If some throw, the exception of the lowest index is rethrown, as in a serial loop.
template <typename Work>
void parallelFor(std::int64_t count, int threads, const Work& work)
{
  const int most =
    int(std::min<std::int64_t>(std::max<std::int64_t>(count, 1), threadCount(threads)));
  forChunks(count, 1, most, {}, [&](std::int64_t i, std::int64_t, int) { work(i); });
}

/// Calls work(0) ... work(count - 1) on usualThreads() or as many as given, in ranges of `chunk`
/// indices, by default as many as are enough for short work.
template <typename Work>
void forIndices(
  std::int64_t count, const Work& work, int threads = 0, std::int64_t chunk = std::int64_t(1) << 13)
{
  forChunks(count, chunk, threadCount(threads), {},
    [&](std::int64_t begin, std::int64_t end, int)
    {
      for (std::int64_t i = begin; i < end; ++i)
      {
        work(i);
      }
    });
}

/// While the object lives, the calling thread's work uses this many threads; 0: as before.
class ThreadLimit
{
public:
  explicit ThreadLimit(int threads)
    : Before(setUsualThreads(threads > 0 ? threadCount(threads) : usualThreads()))
  {
  }
  ~ThreadLimit() { setUsualThreads(this->Before); }
  ThreadLimit(const ThreadLimit&) = delete;
  void operator=(const ThreadLimit&) = delete;

private:
  int Before;
};

} // namespace tipp

#endif
