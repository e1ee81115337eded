// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippThreadPool_h
#define tippThreadPool_h

#include "vtkTIPPAcceleratorsModule.h"

#include <cstddef>
#include <mutex>
#include <vector>

namespace tipp
{

/// Work in numbered shares: call(object, number) does one of them, and does not throw.
struct SharedWork
{
  const void* Object;
  void (*Call)(const void* object, int number);
};

/// Threads for parallel work, made by OpenMP where the build has it. They sleep between two pieces
/// of work, and are never ended. Any number of threads may run work at the same time, also in a
/// forked child.
///
/// A busy machine must not make several threads slower than one. OpenMP's own parallel regions do:
/// each waits at its end for every thread, and while it waits it uses the processor that the other
/// needs. Here no thread waits for another to begin: the calling thread does all shares that are
/// left, and then sleeps until those that others have begun are done. On Linux the other threads
/// may not run on the calling thread's processor: the system often moves them there if the rest are
/// busy.
class VTKTIPPACCELERATORS_EXPORT ThreadPool
{
public:
  /// The only one.
  static ThreadPool& instance();

  /// Does each share, 0 to `shares` - 1, once, and returns when all are done. Share 0 is done by
  /// this thread, the others by up to `shares` - 1 other threads or this one. Within other work,
  /// this thread does all.
  void run(int shares, const SharedWork& work);

  /// Call it now and then in work: if the system has moved the thread that called run() to another
  /// processor, excludes that one from the affinity of the other threads. Does nothing in these.
  static void updateAffinity();

  /// The number of the innermost share that this thread does; 0 outside of work.
  static int number();

private:
  struct Team;
  struct Worker;

  using NewWorkers = std::vector<Worker*>;

  ThreadPool();
  void callWorkers(Team& team, int count);
  NewWorkers addWorkers(Team& team, int count);
  void start(const NewWorkers& workers);
  void serve(Worker& worker);
  void discard(const NewWorkers& workers, std::size_t first);
  void release(Team& team);

  static thread_local Team* CurrentTeam; ///< that of this thread's run()

  std::mutex Mutex; ///< of all data here, in workers and in teams
  std::vector<Worker*> Idle;
  std::size_t Started = 0; ///< number of workers, which are never ended
};

} // namespace tipp

#endif
