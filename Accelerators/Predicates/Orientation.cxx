// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/Orientation.h"

#include "Predicates/BitSpan.h"
#include "Predicates/ExactDifference.h"
#include "Predicates/IntegerSigns.h"
#include "Predicates/ProductSum.h"

namespace tipp
{
namespace
{

// Computed with the coordinates themselves, because differences of coordinates with very different
// exponents have too many digits.
int orientationAnyLength(Point2 a, Point2 b, Point2 c)
{
  const BinaryNumber x[3] = { binaryNumber(a.x), binaryNumber(b.x), binaryNumber(c.x) };
  const BinaryNumber y[3] = { binaryNumber(a.y), binaryNumber(b.y), binaryNumber(c.y) };
  ProductSum<6, 106> determinant;
  for (int i = 0; i < 3; ++i)
  {
    const int next = (i + 1) % 3;
    determinant.add(x[i], y[next]);
    determinant.add(-x[next], y[i]);
  }
  return determinant.sign();
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
