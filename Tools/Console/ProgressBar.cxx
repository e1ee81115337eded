// SPDX-License-Identifier: BSD-3-Clause
#include "Console/ProgressBar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tipp
{
namespace
{

std::string textOf(double exactly)
{
  const double seconds = exactly - 1e-6; // so that a rounding error does not add a second
  if (seconds < 60)
  {
    return fmt::format("about {:.0f} s left", std::ceil(seconds));
  }
  const double minutes = std::ceil(seconds / 60);
  return minutes < 60 ? fmt::format("about {:.0f} min left", minutes)
                      : fmt::format("about {:.0f} h {:02.0f} min left", std::floor(minutes / 60),
                          std::fmod(minutes, 60));
}

} // namespace

std::string TimeLeft::update(double fraction, double seconds)
{
  if (this->FirstFraction < 0)
  {
    this->FirstFraction = fraction;
    this->FirstSeconds = seconds;
  }
  constexpr double leastSeconds = 0.5;
  constexpr double leastFraction = 0.02;
  const double done = fraction - this->FirstFraction;
  const double taken = seconds - this->FirstSeconds;
  return taken < leastSeconds || done < leastFraction || fraction >= 1
    ? std::string()
    : textOf((1 - fraction) * taken / done);
}

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
