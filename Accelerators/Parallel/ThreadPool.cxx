// SPDX-License-Identifier: BSD-3-Clause
#include "Parallel/ThreadPool.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <limits>
#include <thread>
#include <utility>

#include <pthread.h>

#ifdef _OPENMP
#include <omp.h>
#endif

#ifdef __linux__
#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

namespace tipp
{

namespace
{

thread_local int currentNumber = 0;
thread_local bool isInWork = false;

/// Does one share, and then restores this thread's state.
void doShare(int number, const SharedWork& work) noexcept
{
  const int numberBefore = std::exchange(currentNumber, number);
  const bool wasInWork = std::exchange(isInWork, true);
  work.Call(work.Object, number);
  currentNumber = numberBefore;
  isInWork = wasInWork;
}

/// Whether this thread does work already, ours or that of an OpenMP region of the application:
/// more threads would not make it faster.
bool isAlreadyParallel()
{
#ifdef _OPENMP
  return isInWork || omp_in_parallel() != 0;
#else
  return isInWork;
#endif
}

/// OMP_THREAD_LIMIT; without it and without OpenMP, any number.
int mostThreads()
{
#ifdef _OPENMP
  return omp_get_thread_limit();
#else
  return std::numeric_limits<int>::max();
#endif
}

#ifdef __linux__

/// The processors on which the system may run a thread of the pool.
struct ThreadAffinity
{
  int Thread = 0; ///< the system's number; 0 if it has not started
  cpu_set_t Set = {};
};

int currentThread()
{
  return static_cast<int>(syscall(SYS_gettid));
}

/// The processor on which the calling thread of a team runs.
class CallersProcessor
{
public:
  CallersProcessor()
    : HasOthers(sched_getaffinity(0, sizeof this->Allowed, &this->Allowed) == 0 &&
        CPU_COUNT(&this->Allowed) > 1)
  {
    this->update();
  }

  /// Returns whether the calling thread has moved to another processor.
  bool update()
  {
    const int now = this->HasOthers ? sched_getcpu() : -1;
    return now >= 0 && this->Number.exchange(now, std::memory_order_relaxed) != now;
  }

  /// Lets another thread run on all other processors that the calling thread may use.
  void excludeFrom(ThreadAffinity& other) const
  {
    const int number = this->Number.load(std::memory_order_relaxed);
    if (number < 0 || other.Thread == 0)
    {
      return;
    }
    cpu_set_t others = this->Allowed;
    CPU_CLR(number, &others);
    if (!CPU_EQUAL(&others, &other.Set))
    {
      other.Set = others;
      sched_setaffinity(other.Thread, sizeof others, &others); // if refused, work is only slower
    }
  }

private:
  cpu_set_t Allowed = {}; ///< the processors that the calling thread may use
  bool HasOthers;         ///< whether these are several
  std::atomic<int> Number{ -1 };
};

#else

struct ThreadAffinity
{
  int Thread = 0;
};

int currentThread()
{
  return 0;
}

/// Other systems do not say on which processor a thread runs.
class CallersProcessor
{
public:
  static bool update() { return false; }
  static void excludeFrom(ThreadAffinity& /*other*/) {}
};

#endif

} // namespace

/// One run(): its work, and the workers that help.
struct ThreadPool::Team
{
  const SharedWork Work;
  const int Shares;
  std::atomic<int> Next{ 1 }; ///< the first share that nobody has begun
  std::atomic<int> Busy{ 0 }; ///< workers that have begun and not finished
  Worker* First = nullptr;    ///< a list of all workers
  CallersProcessor Processor = {};
  std::condition_variable Finished = {};

  void doShares();
  void add(Worker& worker);
  void remove(const Worker& worker);
  void excludeProcessor() const;
  void waitBriefly() const;
};

struct ThreadPool::Worker
{
  std::condition_variable Wake;
  ThreadPool::Team* Team = nullptr; ///< null while it is idle
  Worker* Next = nullptr;           ///< in the team's list
  bool IsCalled = false;            ///< has not yet begun to work for its team
  ThreadAffinity Affinity = {};
};

void ThreadPool::Team::doShares()
{
  for (int share; (share = this->Next.fetch_add(1, std::memory_order_relaxed)) < this->Shares;)
  {
    doShare(share, this->Work);
  }
}

void ThreadPool::Team::add(Worker& worker)
{
  worker.Team = this;
  worker.IsCalled = true;
  worker.Next = std::exchange(this->First, &worker);
  this->Processor.excludeFrom(worker.Affinity);
}

void ThreadPool::Team::remove(const Worker& worker)
{
  Worker** link = &this->First;
  while (*link != &worker)
  {
    link = &(*link)->Next;
  }
  *link = worker.Next;
}

void ThreadPool::Team::excludeProcessor() const
{
  for (Worker* worker = this->First; worker; worker = worker->Next)
  {
    this->Processor.excludeFrom(worker->Affinity);
  }
}

/// Waits a little for the workers: to sleep and be woken takes longer than most of these waits.
void ThreadPool::Team::waitBriefly() const
{
  const auto end = std::chrono::steady_clock::now() + std::chrono::microseconds(20);
  while (this->Busy.load(std::memory_order_acquire) != 0 && std::chrono::steady_clock::now() < end)
  {
  }
}

thread_local ThreadPool::Team* ThreadPool::CurrentTeam = nullptr;

ThreadPool& ThreadPool::instance()
{
  // Never destroyed: its threads wait when the process ends.
  static ThreadPool* const pool = new ThreadPool;
  return *pool;
}

ThreadPool::ThreadPool()
{
  // A forked child has none of the threads, so it starts its own.
  pthread_atfork([] { instance().Mutex.lock(); }, [] { instance().Mutex.unlock(); },
    []
    {
      instance().Idle.clear();
      instance().Started = 0;
      instance().Mutex.unlock();
    });
}

int ThreadPool::number()
{
  return currentNumber;
}

void ThreadPool::run(int shares, const SharedWork& work)
{
  if (shares <= 1 || isAlreadyParallel())
  {
    for (int share = 0; share < shares; ++share)
    {
      doShare(share, work);
    }
    return;
  }
  Team team{ work, shares };
  Team* const outer = std::exchange(CurrentTeam, &team);
  this->callWorkers(team, std::min(shares, mostThreads()) - 1);
  doShare(0, work);
  team.doShares();
  this->release(team);
  CurrentTeam = outer;
}

void ThreadPool::updateAffinity()
{
  if (CurrentTeam && CurrentTeam->Processor.update())
  {
    const std::lock_guard<std::mutex> lock(instance().Mutex);
    CurrentTeam->excludeProcessor();
  }
}

/// Gives the team up to `count` workers: idle ones, then new ones.
void ThreadPool::callWorkers(Team& team, int count)
{
  NewWorkers added;
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    for (; count > 0 && !this->Idle.empty(); --count)
    {
      team.add(*this->Idle.back());
      this->Idle.back()->Wake.notify_one();
      this->Idle.pop_back();
    }
    added = this->addWorkers(team, count);
  }
  if (!added.empty())
  {
    this->start(added);
  }
}

/// Gives the team up to `count` new workers, which have no threads yet; fewer without memory.
ThreadPool::NewWorkers ThreadPool::addWorkers(Team& team, int count)
{
  NewWorkers added;
  try
  {
    added.reserve(std::size_t(count));
    // So that workers become idle without an allocation.
    this->Idle.reserve(this->Started + std::size_t(count));
    for (int i = 0; i < count; ++i)
    {
      added.push_back(new Worker);
      team.add(*added.back());
      ++this->Started;
    }
  }
  catch (const std::bad_alloc&)
  {
  }
  return added;
}

/// Waits for the workers that have begun, and makes all of them idle.
void ThreadPool::release(Team& team)
{
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    for (Worker* worker = team.First; worker; worker = worker->Next)
    {
      worker->IsCalled = false;
    }
  }
  team.waitBriefly();
  std::unique_lock<std::mutex> lock(this->Mutex);
  team.Finished.wait(lock, [&team] { return team.Busy == 0; });
  for (Worker* worker = team.First; worker; worker = worker->Next)
  {
    worker->Team = nullptr;
    this->Idle.push_back(worker);
  }
}

/// What a worker's thread does.
void ThreadPool::serve(Worker& worker)
{
  std::unique_lock<std::mutex> lock(this->Mutex);
  worker.Affinity.Thread = currentThread();
  if (worker.Team)
  {
    worker.Team->Processor.excludeFrom(worker.Affinity);
  }
  for (;;)
  {
    worker.Wake.wait(lock, [&worker] { return worker.IsCalled; });
    worker.IsCalled = false;
    Team& team = *worker.Team;
    ++team.Busy;
    lock.unlock();
    team.doShares();
    lock.lock();
    if (--team.Busy == 0)
    {
      team.Finished.notify_one();
    }
  }
}

/// Removes workers for which there are no threads: all from the given one on.
void ThreadPool::discard(const NewWorkers& workers, std::size_t first)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  for (std::size_t i = first; i < workers.size(); ++i)
  {
    Worker* const worker = workers[i];
    if (worker->Team)
    {
      worker->Team->remove(*worker);
    }
    else
    {
      this->Idle.erase(std::find(this->Idle.begin(), this->Idle.end(), worker));
    }
    delete worker;
    --this->Started;
  }
}

#ifdef _OPENMP

/// Starts the threads of new workers: those of one region that never ends. It is begun by a new
/// thread, because the threads of the application's own regions belong to the thread that begins
/// those. OMP_PLACES and OMP_PROC_BIND apply as in any region.
void ThreadPool::start(const NewWorkers& workers)
{
  const auto serveAll = [this, workers]
  {
    const int count = static_cast<int>(workers.size());
    omp_set_dynamic(0); // else OpenMP may start fewer, by the machine's load
#pragma omp parallel num_threads(count)
    {
#pragma omp single nowait
      this->discard(workers, std::size_t(omp_get_num_threads())); // it may still start fewer
      this->serve(*workers[std::size_t(omp_get_thread_num())]);
    }
  };
  try
  {
    std::thread(serveAll).detach();
  }
  catch (const std::exception&) // no more threads or memory
  {
    this->discard(workers, 0);
  }
}

#else

/// Starts the threads of new workers.
void ThreadPool::start(const NewWorkers& workers)
{
  for (std::size_t i = 0; i < workers.size(); ++i)
  {
    try
    {
      std::thread([this, worker = workers[i]] { this->serve(*worker); }).detach();
    }
    catch (const std::exception&) // no more threads or memory
    {
      this->discard(workers, i);
      break;
    }
  }
}

#endif

} // namespace tipp
