// SPDX-License-Identifier: BSD-3-Clause
#include "Console/TimeLeft.h"

#include <fmt/format.h>

#include <cmath>

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

} // namespace tipp
