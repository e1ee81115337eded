// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippParallelFor_h
#define tippParallelFor_h

#include "Parallel/ForChunks.h"

namespace tipp
{

/// The number of threads to use: as requested (0: OpenMP's default), but at most the larger of 64
/// and 4 per processor. Without that limit a large number ends the process: OpenMP does not report
/// that a thread cannot be started.
inline int threadCount(int threads)
{
  const int most = std::max(64, 4 * omp_get_num_procs());
  return std::min(threads > 0 ? threads : omp_get_max_threads(), most);
}

/// Calls work(0) ... work(count - 1) on several threads (0: OpenMP's default), started in that
/// order. If some throw, the exception of the lowest index is rethrown, as in a serial loop.
template <typename Work>
void parallelFor(std::int64_t count, int threads, const Work& work)
{
  const int most =
    int(std::min<std::int64_t>(std::max<std::int64_t>(count, 1), threadCount(threads)));
  forChunks(count, 1, most, {}, [&](std::int64_t i, std::int64_t, int) { work(i); });
}

} // namespace tipp

#endif
