// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippParallelFor_h
#define tippParallelFor_h

#include "Parallel/ForChunks.h"

namespace tipp
{

/// As many threads as asked for, 0: OpenMP's choice; but no more than can be of use. Without that
/// limit a large number ends the process: OpenMP reports no failure to start a thread.
inline int threadCount(int threads)
{
  const int most = std::max(64, 4 * omp_get_num_procs());
  return std::min(threads > 0 ? threads : omp_get_max_threads(), most);
}

/// work(0) ... work(count - 1) on several threads (0: OpenMP's choice), begun in that order. If
/// some throw, what the lowest of them threw comes out of here, as in a plain loop.
template <typename Work>
void parallelFor(std::int64_t count, int threads, const Work& work)
{
  const int most =
    int(std::min<std::int64_t>(std::max<std::int64_t>(count, 1), threadCount(threads)));
  forChunks(count, 1, most, {}, [&](std::int64_t i, std::int64_t, int) { work(i); });
}

} // namespace tipp

#endif
