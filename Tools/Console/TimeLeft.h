// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTimeLeft_h
#define tippTimeLeft_h

#include <string>

namespace tipp
{

/// Guesses how long a task will go on, from what has been done since the first report: what a
/// resumed task had done before took no time of this one.
class TimeLeft
{
public:
  /// Empty while there is too little to tell by, else as "about 12 min left". `seconds`: on a clock
  /// of the caller's.
  std::string update(double fraction, double seconds);

private:
  double FirstFraction = -1;
  double FirstSeconds = 0;
};

} // namespace tipp

#endif
