// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippProgressBar_h
#define tippProgressBar_h

#include "Console/TimeLeft.h"
#include "Parallel/Stopwatch.h"

#include <string>

namespace tipp
{

/// A line on stderr that goes away in the end; nothing at all if stderr is not a terminal.
class ProgressBar
{
public:
  explicit ProgressBar(const std::string& task);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// The fraction that is done; redrawn when the percentage changes or a second has gone by.
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
