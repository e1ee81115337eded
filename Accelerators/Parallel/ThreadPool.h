// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippThreadPool_h
#define tippThreadPool_h

#include "vtkTIPPAcceleratorsModule.h"

#include <cstddef>
#include <functional>
#include <mutex>
#include <vector>

namespace tipp
{

/// Threads for parallel work in builds without OpenMP. They wait between two pieces of work, and
/// are never ended. Any number of threads may run work at the same time, also in a forked child.
class VTKTIPPACCELERATORS_EXPORT ThreadPool
{
public:
  /// The only one.
  static ThreadPool& instance();

  /// Calls work(0) in this thread and work(1) ... work(threads - 1) in others, and returns when all
  /// have returned. Makes fewer calls if the system cannot start that many threads, and only
  /// work(0) within other work. `work` must not throw.
  void run(int threads, const std::function<void(int)>& work);

  /// The argument with which run() called the innermost work in this thread; 0 outside of work.
  static int number();

private:
  struct Team;
  struct Worker;

  ThreadPool();
  Worker* takeWorker();
  void serve(Worker& worker);

  std::mutex Mutex; ///< of all data here, in workers and in teams
  std::vector<Worker*> Idle;
  std::size_t Started = 0; ///< number of workers, which are never ended
};

} // namespace tipp

#endif
