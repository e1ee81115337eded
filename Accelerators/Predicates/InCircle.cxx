// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/InCircle.h"

#include "Predicates/ExactDoubles.h"
#include "Predicates/ExactIntegers.h"

namespace tipp
{
namespace
{

// Computed with the coordinates themselves, because differences of coordinates with very different
// exponents have too many digits.
int inCircleAnyLength(Point2 a, Point2 b, Point2 c, Point2 p)
{
  const BinaryNumber x[4] = { binaryNumber(a.x), binaryNumber(b.x), binaryNumber(c.x),
    binaryNumber(p.x) };
  const BinaryNumber y[4] = { binaryNumber(a.y), binaryNumber(b.y), binaryNumber(c.y),
    binaryNumber(p.y) };
  // The even permutations of the four rows; swapping the first two gives the odd ones.
  constexpr unsigned char even[12][3] = { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 1 }, { 1, 0, 3 },
    { 1, 2, 0 }, { 1, 3, 2 }, { 2, 0, 1 }, { 2, 1, 3 }, { 2, 3, 0 }, { 3, 0, 2 }, { 3, 1, 0 },
    { 3, 2, 1 } };
  ProductSum<48, 212> determinant;
  for (const auto& [i, j, k] : even)
  {
    const BinaryNumber left = x[i] * y[j];
    const BinaryNumber right = -(x[j] * y[i]);
    for (const BinaryNumber& square : { x[k] * x[k], y[k] * y[k] })
    {
      determinant.add(left, square);
      determinant.add(right, square);
    }
  }
  return determinant.sign();
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
