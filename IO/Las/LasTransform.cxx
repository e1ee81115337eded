// SPDX-License-Identifier: BSD-3-Clause
#include "Las/LasTransform.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace tipp
{
namespace
{

/// Returns 10^-places, rounded once.
double decimalScale(int places)
{
  const double power = std::pow(10.0, std::abs(places)); // exact up to 10^22
  return places >= 0 ? 1 / power : power;
}

/// Returns the multiple of a scale next to an offset: the offset if it is one but for rounding.
double multipleNear(double scale, double offset)
{
  constexpr double slack = 1e-6; // of a step
  const double steps = offset / scale;
  const double whole = std::nearbyint(steps);
  return std::fabs(steps - whole) <= slack ? offset : whole * scale;
}

} // namespace

void AxisSurvey::add(double coordinate)
{
  if (!std::isfinite(coordinate))
  {
    return;
  }
  this->Low = std::min(this->Low, coordinate);
  this->High = std::max(this->High, coordinate);
  constexpr double mostDigits = 0x1p53;
  constexpr std::array<double, mostPlaces + 1> powers = { 1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8,
    1e9, 1e10, 1e11, 1e12 };
  for (; this->Places <= mostPlaces; ++this->Places)
  {
    const double power = powers[std::size_t(this->Places)];
    const double digits = std::nearbyint(coordinate * power);
    if (std::fabs(digits) < mostDigits && digits / power == coordinate)
    {
      return;
    }
  }
}

double AxisSurvey::finestScale() const
{
  int places = mostPlaces;
  while (!this->fits(decimalScale(places), this->offset(decimalScale(places), 0, true)))
  {
    --places;
  }
  return decimalScale(places);
}

double AxisSurvey::scale() const
{
  return this->isEmpty() ? 1 : std::max(this->finestScale(), decimalScale(this->Places));
}

bool AxisSurvey::isRounded() const
{
  return !this->isEmpty() && this->scale() > decimalScale(this->Places);
}

double AxisSurvey::offset(double scale, double wanted, bool isMultiple) const
{
  const auto adapt = [&](double offset)
  { return isMultiple ? multipleNear(scale, offset) : offset; };
  const double first = adapt(wanted);
  if (this->isEmpty() || this->fits(scale, first))
  {
    return first;
  }
  const double middle = this->Low / 2 + this->High / 2;
  const double whole = adapt(std::nearbyint(middle));
  return this->fits(scale, whole) ? whole : std::nearbyint(middle / scale) * scale;
}

bool AxisSurvey::fits(double scale, double offset) const
{
  constexpr double least = std::numeric_limits<std::int32_t>::min();
  constexpr double most = std::numeric_limits<std::int32_t>::max();
  const auto fitsOne = [&](double coordinate)
  {
    const double stored = std::nearbyint((coordinate - offset) / scale);
    return stored >= least && stored <= most;
  };
  return this->isEmpty() || (fitsOne(this->Low) && fitsOne(this->High));
}

} // namespace tipp
