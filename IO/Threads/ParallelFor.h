// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippParallelFor_h
#define tippParallelFor_h

#include <cstdint>
#include <functional>

namespace tipp
{

/// work(0) ... work(count - 1) on several threads (0: OpenMP's choice), begun in that order. If
/// some throw, what the lowest of them threw comes out of here, as in a plain loop.
void parallelFor(std::int64_t count, int threads, const std::function<void(std::int64_t)>& work);

/// How many threads that would be.
int threadCount(int threads);

} // namespace tipp

#endif
