// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippProgressBar_h
#define tippProgressBar_h

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

  /// The fraction that is done; redrawn when the percentage changes.
  void update(double fraction);

private:
  std::string Task;
  bool OnTerminal;
  int Percent = -1;
};

} // namespace tipp

#endif
