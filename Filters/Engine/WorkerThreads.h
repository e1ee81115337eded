// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippWorkerThreads_h
#define tippWorkerThreads_h

#include "Engine/ReadyPartitions.h"

#include <exception>
#include <thread>
#include <vector>

namespace tipp
{

/// Threads that are joined when the work ends, also by an exception.
class WorkerThreads
{
public:
  explicit WorkerThreads(ReadyPartitions& ready)
    : Ready(ready)
  {
  }
  ~WorkerThreads()
  {
    this->Ready.stop();
    for (std::thread& thread : this->Threads)
    {
      thread.join();
    }
  }
  WorkerThreads(const WorkerThreads&) = delete;
  WorkerThreads& operator=(const WorkerThreads&) = delete;

  template <typename Work>
  void start(const Work& work)
  {
    this->Threads.emplace_back(
      [this, work]()
      {
        try
        {
          work();
        }
        catch (...)
        {
          this->Ready.stop(std::current_exception());
        }
      });
  }

private:
  ReadyPartitions& Ready;
  std::vector<std::thread> Threads;
};

} // namespace tipp

#endif
