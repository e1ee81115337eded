// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/InCircle.h"

#include "Predicates/BitSpan.h"
#include "Predicates/CommonExponent.h"
#include "Predicates/ExactDifference.h"
#include "Predicates/IntegerSigns.h"

namespace tipp
{
namespace
{

int inCircleAnyLength(Point2 a, Point2 b, Point2 c, Point2 p)
{
  const auto v = toCommonExponent<8>({ a.x, a.y, b.x, b.y, c.x, c.y, p.x, p.y });
  const mpz_class ax = v[0] - v[6];
  const mpz_class ay = v[1] - v[7];
  const mpz_class bx = v[2] - v[6];
  const mpz_class by = v[3] - v[7];
  const mpz_class cx = v[4] - v[6];
  const mpz_class cy = v[5] - v[7];
  const mpz_class determinant = (ax * ax + ay * ay) * (bx * cy - by * cx) +
    (bx * bx + by * by) * (cx * ay - cy * ax) + (cx * cx + cy * cy) * (ax * by - ay * bx);
  return sgn(determinant);
}

} // namespace

int inCircleExact(Point2 a, Point2 b, Point2 c, Point2 p)
{
  const ExactDifference differences[6] = { exactDifference(a.x, p.x), exactDifference(a.y, p.y),
    exactDifference(b.x, p.x), exactDifference(b.y, p.y), exactDifference(c.x, p.x),
    exactDifference(c.y, p.y) };
  BitSpan span;
  for (const ExactDifference& difference : differences)
  {
    span.include(difference.head);
    span.include(difference.tail);
  }
  if (!span.fits(63))
  {
    return inCircleAnyLength(a, b, c, p);
  }
  const double scale = span.scale();
  const InCircleIntegers integers = { scaledToInteger(differences[0], scale),
    scaledToInteger(differences[1], scale), scaledToInteger(differences[2], scale),
    scaledToInteger(differences[3], scale), scaledToInteger(differences[4], scale),
    scaledToInteger(differences[5], scale) };
  return span.fits(31) ? inCircleSign31(integers) : inCircleSign63(integers);
}

} // namespace tipp
