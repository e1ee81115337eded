// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippThreads_h
#define tippThreads_h

#include "Parallel/ThreadPool.h"
#include "Parallel/UsableProcessors.h"
#include "vtkTIPPAcceleratorsModule.h"

namespace tipp
{

/// Calls work(0) ... work(threads - 1), once each, and returns when all have returned. work(0) is
/// called in this thread, the others in up to `threads` - 1 threads of the ThreadPool or in this
/// one; within other work all are called in this one. No call may wait for another to begin. `work`
/// must not throw.
template <typename Work>
void runOnThreads(int threads, const Work& work)
{
  ThreadPool::instance().run(threads,
    { &work, [](const void* object, int number) { (*static_cast<const Work*>(object))(number); } });
}

/// The argument with which runOnThreads() called the innermost work in this thread; 0 outside.
inline int threadNumber()
{
  return ThreadPool::number();
}

/// The number of threads to use if none is requested: that of "OMP_NUM_THREADS"; that of "OpenMP's
/// functions", if the application called omp_set_num_threads(); else usableProcessors().
VTKTIPPACCELERATORS_EXPORT ProcessorCount defaultThreads();

/// The same number, or what the calling thread has set instead.
VTKTIPPACCELERATORS_EXPORT int usualThreads();

/// Sets the number for the calling thread, 0: none. Returns what was set before.
VTKTIPPACCELERATORS_EXPORT int setUsualThreads(int threads);

} // namespace tipp

#endif
