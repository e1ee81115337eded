// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBenchmarkMeasure_h
#define tippBenchmarkMeasure_h

#include "Engines.h"

#include <functional>

namespace tipp
{
namespace benchmark
{

struct Measurement
{
  Run Result;
  double PeakMegabytes = 0; ///< of the whole process, including the input
  double OwnMegabytes = 0;  ///< the peak minus the resident memory before the work
};

/// Runs `work` in a process of its own, so that memory, caches and allocators start equal for each
/// measurement. Short work is repeated there, and the fastest run counts. The calling process must
/// not have started threads. Throws std::runtime_error if the work fails.
Measurement measure(const std::function<Run()>& work);

} // namespace benchmark
} // namespace tipp

#endif
