// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippParallelFor_h
#define tippParallelFor_h

#include "Parallel/Poll.h"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>

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
  std::exception_ptr error;
  std::int64_t errorBegin = count;
#pragma omp parallel num_threads(threads) if (count > chunk)
  {
    const int thread = omp_get_thread_num();
    while (!stopped.load(std::memory_order_relaxed))
    {
      const std::int64_t begin = next.fetch_add(chunk, std::memory_order_relaxed);
      if (begin >= count)
      {
        break;
      }
      try
      {
        if (thread == 0 && report && !report(double(begin) / double(count)))
        {
          wanted = false;
          stopped = true;
          break;
        }
        body(begin, std::min(begin + chunk, count), thread);
      }
      catch (...)
      {
        stopped = true;
#pragma omp critical(tippForChunks)
        if (begin < errorBegin)
        {
          error = std::current_exception();
          errorBegin = begin;
        }
      }
    }
  }
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

/// The number of threads to use: as requested (0: OpenMP's default), but at most the larger of 64
/// and 4 per processor. Without that limit a large number would end the process, since OpenMP
/// aborts if it cannot start a thread.
inline int threadCount(int threads)
{
  const int most = std::max(64, 4 * omp_get_num_procs());
  return std::min(threads > 0 ? threads : omp_get_max_threads(), most);
}

/// Calls work(0) ... work(count - 1) on several threads (0: OpenMP's default), started in that
/// order. If some throw, the exception of the lowest index is rethrown, as in a serial loop.
template <typename Work>
void parallelFor(std::int64_t count, int threads, const Work& work)
{
  const int most =
    int(std::min<std::int64_t>(std::max<std::int64_t>(count, 1), threadCount(threads)));
  forChunks(count, 1, most, {}, [&](std::int64_t i, std::int64_t, int) { work(i); });
}

/// While the object lives, the calling thread's OpenMP regions use this many threads; 0: OpenMP's
/// default.
class ThreadLimit
{
public:
  explicit ThreadLimit(int threads)
    : Before(omp_get_max_threads())
  {
    omp_set_num_threads(threadCount(threads));
  }
  ~ThreadLimit() { omp_set_num_threads(this->Before); }
  ThreadLimit(const ThreadLimit&) = delete;
  void operator=(const ThreadLimit&) = delete;

private:
  int Before;
};

} // namespace tipp

#endif
