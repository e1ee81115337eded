// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippStopwatch_h
#define tippStopwatch_h

#include <chrono>
#include <ctime>

namespace tipp
{

class Stopwatch
{
public:
  /// Wall-clock seconds since the start, or the last restart.
  double seconds() const
  {
    return std::chrono::duration<double>(Clock::now() - this->Start).count();
  }
  double restart()
  {
    const double seconds = this->seconds();
    this->Start = Clock::now();
    return seconds;
  }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point Start = Clock::now();
};

/// Measures the CPU time of the calling thread. Unlike a Stopwatch it excludes the time when other
/// threads use the core, so it is meaningful even with more threads than cores.
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
