// SPDX-License-Identifier: BSD-3-Clause
#include "Parallel/ThreadPool.h"

#include <condition_variable>
#include <exception>
#include <memory>
#include <thread>
#include <utility>

#include <pthread.h>

namespace tipp
{

/// The threads of one run().
struct ThreadPool::Team
{
  const std::function<void(int)>& Work;
  int Busy = 0; ///< workers that have not finished
  std::condition_variable Done = {};
};

struct ThreadPool::Worker
{
  std::condition_variable Wake;
  ThreadPool::Team* Team = nullptr; ///< null while it is idle
  int Number = 0;
};

namespace
{

thread_local int currentNumber = 0;
thread_local bool isInWork = false;

/// Calls work(number), and then restores this thread's state.
void callAs(int number, const std::function<void(int)>& work) noexcept
{
  const int numberBefore = std::exchange(currentNumber, number);
  const bool wasInWork = std::exchange(isInWork, true);
  work(number);
  currentNumber = numberBefore;
  isInWork = wasInWork;
}

} // namespace

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

/// Returns an idle or a new worker, or null if the system refuses another thread.
ThreadPool::Worker* ThreadPool::takeWorker()
{
  if (!this->Idle.empty())
  {
    Worker* const worker = this->Idle.back();
    this->Idle.pop_back();
    return worker;
  }
  try
  {
    auto worker = std::make_unique<Worker>();
    this->Idle.reserve(this->Started + 1); // so that workers return without an allocation
    std::thread([this, w = worker.get()] { this->serve(*w); }).detach();
    ++this->Started;
    return worker.release();
  }
  catch (const std::exception&) // no more threads or memory
  {
    return nullptr;
  }
}

void ThreadPool::serve(Worker& worker)
{
  std::unique_lock<std::mutex> lock(this->Mutex);
  for (;;)
  {
    worker.Wake.wait(lock, [&worker] { return worker.Team != nullptr; });
    Team& team = *worker.Team;
    lock.unlock();
    callAs(worker.Number, team.Work);
    lock.lock();
    worker.Team = nullptr;
    this->Idle.push_back(&worker);
    if (--team.Busy == 0)
    {
      team.Done.notify_one();
    }
  }
}

void ThreadPool::run(int threads, const std::function<void(int)>& work)
{
  Team team{ work };
  std::unique_lock<std::mutex> lock(this->Mutex, std::defer_lock);
  if (threads > 1 && !isInWork)
  {
    lock.lock();
    for (int number = 1; number < threads; ++number)
    {
      Worker* const worker = this->takeWorker();
      if (!worker)
      {
        break;
      }
      worker->Team = &team;
      worker->Number = number;
      ++team.Busy;
      worker->Wake.notify_one();
    }
    lock.unlock();
  }
  callAs(0, work);
  lock.lock();
  team.Done.wait(lock, [&team] { return team.Busy == 0; });
}

} // namespace tipp
