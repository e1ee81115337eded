// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippStopwatch_h
#define tippStopwatch_h

#include <chrono>

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

} // namespace tipp

#endif
