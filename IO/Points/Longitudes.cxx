// SPDX-License-Identifier: BSD-3-Clause
#include "Points/Longitudes.h"

#include "Files/IOError.h"
#include "Files/TextFile.h"

namespace tipp
{

void wrapLongitudes(const std::string& path, int top, std::vector<double>& xy)
{
  constexpr double turn = 360;
  for (std::size_t i = 0; top > 0 && i < xy.size(); i += 2)
  {
    double& x = xy[i];
    if (!std::isfinite(x))
    {
      continue;
    }
    if (std::fabs(x) > turn)
    {
      throw IOError(
        path, "has x = " + exactText(x) + ", which is no longitude in degrees; leave out --wrap.");
    }
    x = x < top - turn ? x + turn : x;
    x = x >= top ? x - turn : x; // also where the sum above was rounded
  }
}

void LongitudeSpan::add(double x, double y)
{
  if (!std::isfinite(x) || !std::isfinite(y))
  {
    return;
  }
  constexpr double turn = 360;
  const double turned = x < 0 ? x + turn : x > turn / 2 ? x - turn : x;
  this->Given.add(x, x);
  this->Turned.add(turned, turned);
  this->IsInDegrees = this->IsInDegrees && std::fabs(x) <= turn && std::fabs(y) <= turn / 4;
}

void LongitudeSpan::add(const std::vector<double>& xy)
{
  for (std::size_t i = 0; i < xy.size(); i += 2)
  {
    this->add(xy[i], xy[i + 1]);
  }
}

void LongitudeSpan::add(const LongitudeSpan& other)
{
  this->Given.add(other.Given.Low, other.Given.High);
  this->Turned.add(other.Turned.Low, other.Turned.High);
  this->IsInDegrees = this->IsInDegrees && other.IsInDegrees;
}

std::string LongitudeSpan::warning() const
{
  constexpr double large = 60; // degrees that the triangles would cross needlessly
  const double given = this->Given.High - this->Given.Low;
  const double turned = this->Turned.High - this->Turned.Low;
  if (!this->IsInDegrees || !(given > 360 - large) || !(given <= 360) || !(turned < given - large))
  {
    return "";
  }
  const bool isEastern = this->Given.Low >= 0; // 0 to 360
  return std::string("the points lie on both sides of ") +
    (isEastern ? "0 degrees of longitude, where it follows 360"
               : "180 degrees of longitude, where -180 follows") +
    ", so triangles go around the world; if these are longitudes, give --wrap " +
    (isEastern ? "180." : "360.");
}

} // namespace tipp
