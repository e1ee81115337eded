// SPDX-License-Identifier: BSD-3-Clause
#include "Console/ProgressBar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include <unistd.h>

namespace tipp
{

ProgressBar::ProgressBar(const std::string& task)
  : Task(task)
  , OnTerminal(isatty(STDERR_FILENO) == 1)
{
  this->update(0);
}

ProgressBar::~ProgressBar()
{
  if (this->OnTerminal)
  {
    fmt::print(stderr, "\r\033[K");
    std::fflush(stderr);
  }
}

void ProgressBar::update(double fraction)
{
  const int percent = int(100 * std::clamp(fraction, 0.0, 1.0));
  if (!this->OnTerminal || percent == this->Percent)
  {
    return;
  }
  this->Percent = percent;
  constexpr int width = 40;
  const std::string done(std::size_t(percent * width / 100), '#');
  fmt::print(stderr, "\r{} [{:<{}}] {:3} %", this->Task, done, width, percent);
  std::fflush(stderr);
}

} // namespace tipp
