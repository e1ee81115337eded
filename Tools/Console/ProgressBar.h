// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippProgressBar_h
#define tippProgressBar_h

#include "Parallel/Stopwatch.h"

#include <string>

namespace tipp
{

/// Estimates the remaining time of a task from the progress since the first update. Work that an
/// earlier, interrupted run did is not counted.
class TimeLeft
{
public:
  /// Returns text such as "about 12 min left"; empty while there is too little data. `fraction`:
  /// finished, 0 to 1. `seconds`: the time on any clock.
  std::string update(double fraction, double seconds);

private:
  double FirstFraction = -1;
  double FirstSeconds = 0;
};

/// A progress line on stderr, removed at the end. Prints nothing if stderr is not a terminal.
class ProgressBar
{
public:
  explicit ProgressBar(const std::string& task);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Sets the finished fraction (0 to 1). Redraws when the percentage changes or a second has
  /// passed.
  void update(double fraction);

private:
  void draw(double fraction, const std::string& left);

  std::string Task;
  bool OnTerminal;
  int Percent = -1;
  Stopwatch Watch;
  double DrawnAt = 0; ///< in seconds
  TimeLeft Left;
};

} // namespace tipp

#endif
