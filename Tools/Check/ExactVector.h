// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippExactVector_h
#define tippExactVector_h

#include "Check/ExactTests.h"

#include <gmpxx.h>

namespace tipp
{
namespace check
{

/// The vector from one position to another, as rationals: without any rounding.
class ExactVector
{
public:
  ExactVector(Position from, Position to)
    : X(mpq_class(to.x) - mpq_class(from.x))
    , Y(mpq_class(to.y) - mpq_class(from.y))
  {
  }

  mpq_class dot(const ExactVector& other) const { return this->X * other.X + this->Y * other.Y; }
  mpq_class cross(const ExactVector& other) const { return this->X * other.Y - this->Y * other.X; }
  /// Returns the squared length.
  mpq_class square() const { return this->dot(*this); }

private:
  mpq_class X;
  mpq_class Y;
};

} // namespace check
} // namespace tipp

#endif
