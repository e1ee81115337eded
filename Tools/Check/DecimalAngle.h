// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDecimalAngle_h
#define tippDecimalAngle_h

#include "Check/ExactNumber.h"

#include <string>

namespace tipp
{
namespace check
{

/// Two numbers with another one between them, or both equal to it.
struct Enclosure
{
  ExactNumber Low;
  ExactNumber High;

  /// Low, within a relative error of 2^-52.
  double roundLow() const;
};

/// An angle as a decimal text: 20.7 means exactly 207/10 degrees.
class DecimalAngle
{
public:
  /// `text`: digits, with or without a decimal point. Throws std::invalid_argument, with a sentence
  /// for the user, for other text.
  explicit DecimalAngle(const std::string& text);

  bool isAbove(int degrees) const;

  /// Returns bounds of the squared cosine, for angles up to 60 degrees, that differ by at most
  /// 2^-bits or about that.
  Enclosure squaredCosine(long bits) const;

private:
  bool is(int degrees) const;
  /// squaredCosine() where that is irrational: by MPFR, and in the Python wheel by ExactNumber.
  Enclosure encloseIrrational(long bits) const;

  std::string Whole;    ///< digits before the decimal point, without leading zeros
  std::string Fraction; ///< digits after it, without trailing zeros
};

} // namespace check
} // namespace tipp

#endif
