// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippThreadLimit_h
#define tippThreadLimit_h

#include "Parallel/ParallelFor.h"

#include <omp.h>

namespace tipp
{

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
