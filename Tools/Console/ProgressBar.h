// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippProgressBar_h
#define tippProgressBar_h

#include "Console/TimeLeft.h"
#include "Parallel/Stopwatch.h"

#include <string>

namespace tipp
{

/// A progress line on stderr, cleared at the end; prints nothing if stderr is not a terminal.
class ProgressBar
{
public:
  explicit ProgressBar(const std::string& task);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Sets the fraction done; redraws when the percentage changes or a second has passed.
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
