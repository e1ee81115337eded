// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTimeLeft_h
#define tippTimeLeft_h

#include <string>

namespace tipp
{

/// Estimates the remaining time of a task from the progress since the first report: work that an
/// earlier, interrupted run did is not counted.
class TimeLeft
{
public:
  /// Returns text such as "about 12 min left"; empty while there is too little data. `seconds` is
  /// the time on any clock of the caller's.
  std::string update(double fraction, double seconds);

private:
  double FirstFraction = -1;
  double FirstSeconds = 0;
};

} // namespace tipp

#endif
