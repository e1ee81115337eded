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
  this->draw(0, "");
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
  if (!this->OnTerminal)
  {
    return;
  }
  const double now = this->Watch.seconds();
  const std::string left = this->Left.update(fraction, now);
  const int percent = int(100 * std::clamp(fraction, 0.0, 1.0));
  if (percent != this->Percent || now >= this->DrawnAt + 1)
  {
    this->DrawnAt = now;
    this->draw(fraction, left);
  }
}

void ProgressBar::draw(double fraction, const std::string& left)
{
  if (!this->OnTerminal)
  {
    return;
  }
  this->Percent = int(100 * std::clamp(fraction, 0.0, 1.0));
  constexpr int width = 40;
  const std::string done(std::size_t(this->Percent * width / 100), '#');
  fmt::print(stderr, "\r{} [{:<{}}] {:3} % {}\033[K", this->Task, done, width, this->Percent, left);
  std::fflush(stderr);
}

} // namespace tipp
