// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippExactVector_h
#define tippExactVector_h

#include "Check/ExactNumber.h"
#include "Check/ExactTests.h"

namespace tipp
{
namespace check
{

/// The vector from one position to another, without any rounding.
class ExactVector
{
public:
  ExactVector(Position from, Position to)
    : X(ExactNumber(to.x) - ExactNumber(from.x))
    , Y(ExactNumber(to.y) - ExactNumber(from.y))
  {
  }

  ExactNumber dot(const ExactVector& other) const { return this->X * other.X + this->Y * other.Y; }
  ExactNumber cross(const ExactVector& other) const
  {
    return this->X * other.Y - this->Y * other.X;
  }
  /// Returns the squared length.
  ExactNumber square() const { return this->dot(*this); }

private:
  ExactNumber X;
  ExactNumber Y;
};

} // namespace check
} // namespace tipp

#endif
