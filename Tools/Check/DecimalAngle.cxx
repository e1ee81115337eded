// SPDX-License-Identifier: BSD-3-Clause
#include "Check/DecimalAngle.h"

#include <array>
#include <cstddef>
#include <stdexcept>

namespace tipp
{
namespace check
{

DecimalAngle::DecimalAngle(const std::string& text)
{
  const std::size_t point = text.find('.');
  this->Whole = text.substr(0, point);
  this->Fraction = point == std::string::npos ? "" : text.substr(point + 1);
  const std::string digits = this->Whole + this->Fraction;
  if (digits.empty() || digits.find_first_not_of("0123456789") != std::string::npos)
  {
    throw std::invalid_argument(
      "the angle '" + text + "' is no number of degrees; give digits, such as 30 or 20.7.");
  }
  this->Whole.erase(0, this->Whole.find_first_not_of('0'));
  this->Fraction.erase(this->Fraction.find_last_not_of('0') + 1);
}

bool DecimalAngle::isAbove(int degrees) const
{
  const std::string whole = degrees == 0 ? "" : std::to_string(degrees);
  if (this->Whole.size() != whole.size())
  {
    return this->Whole.size() > whole.size();
  }
  return this->Whole > whole || (this->Whole == whole && !this->Fraction.empty());
}

bool DecimalAngle::is(int degrees) const
{
  return this->Fraction.empty() && this->Whole == (degrees == 0 ? "" : std::to_string(degrees));
}

/// By Niven's theorem (Irrational Numbers, 1956, corollary 3.12) the cosine of twice an angle of
/// rational degrees, and with it the squared cosine, is rational only for multiples of 30 and 45
/// degrees. Their squares are exact; all others are irrational.
Enclosure DecimalAngle::squaredCosine(long bits) const
{
  struct Known
  {
    int Degrees;
    double Square;
  };
  constexpr std::array<Known, 4> known{ { { 0, 1 }, { 30, 0.75 }, { 45, 0.5 }, { 60, 0.25 } } };
  for (const auto& [degrees, square] : known)
  {
    if (this->is(degrees))
    {
      return { ExactNumber(square), ExactNumber(square) };
    }
  }
  return this->encloseIrrational(bits);
}

} // namespace check
} // namespace tipp
