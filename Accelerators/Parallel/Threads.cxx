// SPDX-License-Identifier: BSD-3-Clause
#include "Parallel/Threads.h"

#ifdef _OPENMP
#include <omp.h>
#endif

#include <cstdlib>
#include <utility>

namespace tipp
{

namespace
{

thread_local int chosenThreads = 0;

} // namespace

ProcessorCount defaultThreads()
{
  static const char* const text = std::getenv("OMP_NUM_THREADS");
#ifdef _OPENMP
  if (const int number = omp_get_max_threads(); text || number != omp_get_num_procs())
  {
    return { number, text ? "OMP_NUM_THREADS" : "OpenMP's functions" };
  }
#else
  static const int number = text ? std::atoi(text) : 0; // of a list, the first
  if (number > 0)
  {
    return { number, "OMP_NUM_THREADS" };
  }
#endif
  return usableProcessors();
}

int usualThreads()
{
  return chosenThreads > 0 ? chosenThreads : defaultThreads().Count;
}

int setUsualThreads(int threads)
{
  return std::exchange(chosenThreads, threads);
}

} // namespace tipp
