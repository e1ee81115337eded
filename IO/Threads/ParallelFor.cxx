// SPDX-License-Identifier: BSD-3-Clause
#include "Threads/ParallelFor.h"

#include <atomic>
#include <exception>
#include <limits>
#include <mutex>

#include <omp.h>

namespace tipp
{
namespace
{

class FirstFailure
{
public:
  bool isBefore(std::int64_t index) const { return this->Index < index; }

  void keep(std::int64_t index, std::exception_ptr failure)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    if (index < this->Index)
    {
      this->Index = index;
      this->Failure = std::move(failure);
    }
  }

  void rethrow() const
  {
    if (this->Failure)
    {
      std::rethrow_exception(this->Failure);
    }
  }

private:
  std::atomic<std::int64_t> Index{ std::numeric_limits<std::int64_t>::max() };
  std::exception_ptr Failure;
  std::mutex Mutex;
};

} // namespace

int threadCount(int threads)
{
  return threads > 0 ? threads : omp_get_max_threads();
}

void parallelFor(std::int64_t count, int threads, const std::function<void(std::int64_t)>& work)
{
  const int most = count < threadCount(threads) ? int(count) : threadCount(threads);
  if (most <= 1)
  {
    for (std::int64_t i = 0; i < count; ++i)
    {
      work(i);
    }
    return;
  }
  FirstFailure failure;
#pragma omp parallel for num_threads(most) schedule(dynamic, 1)
  for (std::int64_t i = 0; i < count; ++i)
  {
    try
    {
      if (!failure.isBefore(i))
      {
        work(i);
      }
    }
    catch (...)
    {
      failure.keep(i, std::current_exception());
    }
  }
  failure.rethrow();
}

} // namespace tipp
