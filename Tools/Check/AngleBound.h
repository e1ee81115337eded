// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippAngleBound_h
#define tippAngleBound_h

#include "Check/DecimalAngle.h"
#include "Check/ExactTests.h"

#include <string>

namespace tipp
{
namespace check
{

/// A lower bound on the angles of triangles. All tests are exact, and always decide.
class AngleBound
{
public:
  /// `degrees`: digits, with or without a decimal point: 0 to 60. The text is taken exactly: 20.7
  /// means 207/10. Throws std::invalid_argument, with a sentence for the user, for other text.
  explicit AngleBound(const std::string& degrees);

  /// Returns whether an angle of the triangle a, b, c is below the bound. The corners are finite.
  bool isMissedBy(Position a, Position b, Position c) const
  {
    return this->isBelow(a, b, c) || this->isBelow(b, c, a) || this->isBelow(c, a, b);
  }

private:
  bool isBelow(Position apex, Position p, Position q) const;
  bool isBelowExactly(Position apex, Position p, Position q) const;

  DecimalAngle Degrees;
  Enclosure Square;   ///< of the squared cosine
  double RoundSquare; ///< the squared cosine, within a relative error of 2^-52
};

} // namespace check
} // namespace tipp

#endif
