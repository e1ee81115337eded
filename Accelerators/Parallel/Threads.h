// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippThreads_h
#define tippThreads_h

#include "vtkTIPPAcceleratorsModule.h"

#include <functional>

namespace tipp
{

/// @name Threads
/// Those of OpenMP, or of ThreadPool in a build without OpenMP.
///@{

/// Calls work(0) in this thread and work(1) ... work(threads - 1) in others, and returns when all
/// have returned. Makes fewer calls if the system cannot start that many threads, and only work(0)
/// within other such work. `work` must not throw.
VTKTIPPACCELERATORS_EXPORT void runOnThreads(int threads, const std::function<void(int)>& work);

/// The argument with which runOnThreads() called the innermost work in this thread; 0 outside.
VTKTIPPACCELERATORS_EXPORT int threadNumber();

/// The number of processors that this process may use.
VTKTIPPACCELERATORS_EXPORT int processorCount();

/// The number of threads to use if none is requested: OMP_NUM_THREADS, else one per processor,
/// unless this thread has set another.
VTKTIPPACCELERATORS_EXPORT int usualThreads();
VTKTIPPACCELERATORS_EXPORT void setUsualThreads(int threads);
///@}

} // namespace tipp

#endif
