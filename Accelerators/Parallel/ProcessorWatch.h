// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippProcessorWatch_h
#define tippProcessorWatch_h

#include <ctime>

namespace tipp
{

/// Unlike a Stopwatch it does not count the times when other threads had the processor: what a
/// part of the work costs where there are more threads than cores.
class ProcessorWatch
{
public:
  /// Of the calling thread, since the start.
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
