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
  double PeakMegabytes = 0; ///< of the whole process, input included
  double OwnMegabytes = 0;  ///< the peak less what was resident before the call
};

/// Runs `work` in a process of its own: every figure is its own, caches and allocators start equal.
/// Short work is done several times there, and the fastest counts.
/// The calling process must not have started threads. Throws std::runtime_error if the work fails.
Measurement measure(const std::function<Run()>& work);

} // namespace benchmark
} // namespace tipp

#endif
