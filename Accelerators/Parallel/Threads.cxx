// SPDX-License-Identifier: BSD-3-Clause
#include "Parallel/Threads.h"

#ifdef _OPENMP
#include <omp.h>
#include <pthread.h>

#include <atomic>
#else
#include "Parallel/ThreadPool.h"

#include <algorithm>
#include <cstdlib>
#include <thread>

#ifdef __linux__
#include <sched.h>
#endif
#endif

namespace tipp
{

#ifdef _OPENMP

namespace
{

std::atomic<bool> isForked{ false };

/// Returns `threads`, or 1 in a process that was forked after its parent had asked for several.
/// GNU's OpenMP library would wait there forever for the parent's threads, which do not exist.
int usableThreads(int threads)
{
  if (threads <= 1 || isForked)
  {
    return 1;
  }
  // Not before: the child of a process without threads may start its own.
  static const int registered = pthread_atfork(nullptr, nullptr, [] { isForked = true; });
  return registered == 0 ? threads : 1;
}

} // namespace

void runOnThreads(int threads, const std::function<void(int)>& work)
{
  const int usable = usableThreads(threads);
#pragma omp parallel num_threads(usable) if (usable > 1)
  work(omp_get_thread_num());
}

int threadNumber()
{
  return omp_get_thread_num();
}

int processorCount()
{
  return omp_get_num_procs();
}

int usualThreads()
{
  return omp_get_max_threads();
}

void setUsualThreads(int threads)
{
  omp_set_num_threads(threads);
}

#else

void runOnThreads(int threads, const std::function<void(int)>& work)
{
  ThreadPool::instance().run(threads, work);
}

int threadNumber()
{
  return ThreadPool::number();
}

int processorCount()
{
#ifdef __linux__
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof allowed, &allowed) == 0)
  {
    return CPU_COUNT(&allowed);
  }
#endif
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

namespace
{

int threadsOfEnvironment()
{
  const char* const text = std::getenv("OMP_NUM_THREADS");
  const int number = text ? std::atoi(text) : 0;
  return number > 0 ? number : processorCount();
}

thread_local int chosenThreads = 0;

} // namespace

int usualThreads()
{
  static const int ofProcess = threadsOfEnvironment();
  return chosenThreads > 0 ? chosenThreads : ofProcess;
}

void setUsualThreads(int threads)
{
  chosenThreads = threads;
}

#endif

} // namespace tipp
