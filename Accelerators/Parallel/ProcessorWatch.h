// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippProcessorWatch_h
#define tippProcessorWatch_h

#include <ctime>

namespace tipp
{

/// Measures the CPU time of the calling thread. Unlike a Stopwatch it excludes time when other
/// threads use the core, so it measures a part of the work even with more threads than cores.
class ProcessorWatch
{
public:
  /// CPU seconds of the calling thread since the start.
  double seconds() const { return now() - this->Start; }

private:
  static double now()
  {
    std::timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
  }

  double Start = now();
};

} // namespace tipp

#endif
