// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/Orientation.h"

#include "Predicates/BitSpan.h"
#include "Predicates/CommonExponent.h"
#include "Predicates/ExactDifference.h"
#include "Predicates/IntegerSigns.h"

namespace tipp
{
namespace
{

int orientationAnyLength(Point2 a, Point2 b, Point2 c)
{
  // Each product has an x and a y: the two axes may have different powers of two.
  const auto x = toCommonExponent<3>({ a.x, b.x, c.x });
  const auto y = toCommonExponent<3>({ a.y, b.y, c.y });
  const mpz_class determinant = (x[0] - x[2]) * (y[1] - y[2]) - (y[0] - y[2]) * (x[1] - x[2]);
  return sgn(determinant);
}

BitSpan spanOf(ExactDifference first, ExactDifference second)
{
  BitSpan span;
  span.include(first.head);
  span.include(first.tail);
  span.include(second.head);
  span.include(second.tail);
  return span;
}

} // namespace

int orientationExact(Point2 a, Point2 b, Point2 c)
{
  const ExactDifference ux = exactDifference(a.x, c.x);
  const ExactDifference uy = exactDifference(a.y, c.y);
  const ExactDifference vx = exactDifference(b.x, c.x);
  const ExactDifference vy = exactDifference(b.y, c.y);
  const BitSpan x = spanOf(ux, vx);
  const BitSpan y = spanOf(uy, vy);
  if (!x.fits(63) || !y.fits(63))
  {
    return orientationAnyLength(a, b, c);
  }
  return orientationSign63(scaledToInteger(ux, x.scale()), scaledToInteger(uy, y.scale()),
    scaledToInteger(vx, x.scale()), scaledToInteger(vy, y.scale()));
}

} // namespace tipp
