// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/ExactPredicates.h"

#include "Predicates/Dyadic.h"
#include "Predicates/ExactArithmetic.h"

#include <algorithm>
#include <cstdint>

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

} // namespace

int orientationExact(Point2 a, Point2 b, Point2 c)
{
  BitSpan x;
  BitSpan y;
  x.includeDifference(a.x, c.x);
  x.includeDifference(b.x, c.x);
  y.includeDifference(a.y, c.y);
  y.includeDifference(b.y, c.y);
  if (!x.fits(63) || !y.fits(63))
  {
    return orientationAnyLength(a, b, c);
  }
  return orientationSign63(longUnits(a.x, c.x, x.scale()), longUnits(a.y, c.y, y.scale()),
    longUnits(b.x, c.x, x.scale()), longUnits(b.y, c.y, y.scale()));
}

Point2 crossingPoint(Point2 a, Point2 b, Point2 c, Point2 d)
{
  const Dyadic abX = Dyadic(b.x) - a.x;
  const Dyadic abY = Dyadic(b.y) - a.y;
  const Dyadic cdX = Dyadic(d.x) - c.x;
  const Dyadic cdY = Dyadic(d.y) - c.y;
  const Dyadic part = (Dyadic(c.x) - a.x) * cdY - (Dyadic(c.y) - a.y) * cdX;
  const Dyadic whole = abX * cdY - abY * cdX;
  return { nearestQuotient(a.x * whole + abX * part, whole),
    nearestQuotient(a.y * whole + abY * part, whole) };
}

namespace
{

template <typename ToUnits>
InCircleIntegers integersOf(Point2 a, Point2 b, Point2 c, Point2 p, double scale, ToUnits toUnits)
{
  return { toUnits(a.x, p.x, scale), toUnits(a.y, p.y, scale), toUnits(b.x, p.x, scale),
    toUnits(b.y, p.y, scale), toUnits(c.x, p.x, scale), toUnits(c.y, p.y, scale) };
}

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
  BitSpan span;
  for (const Point2 corner : { a, b, c })
  {
    span.includeDifference(corner.x, p.x);
    span.includeDifference(corner.y, p.y);
  }
  if (!span.fits(63))
  {
    return inCircleAnyLength(a, b, c, p);
  }
  const InCircleIntegers integers = integersOf(a, b, c, p, span.scale(), longUnits);
  return span.fits(31) ? inCircleSign31(integers) : inCircleSign63(integers);
}

namespace
{

// Differences below 2^k units. In-circle terms are multiples of unit^4, and the partial sums of the
// three are below 3 * 2^(2k+1) * 2^(2k+1) < 2^(4k+4): at k = 12, 52 bits, exact in doubles.
// Orientation needs 2k+1 = 25.
constexpr int DoublesDigits = 12;
// See orientationSign31() and its like.
constexpr int Int128Digits = 31;
constexpr int Int256Digits = 63;

// With units of 2^-255 and more, unit^4 is a normal number; with at most 2^12 * 2^230, a
// determinant below 2^52 * (2^230)^4 = 2^972 does not overflow.
constexpr double SmallestUnitForDoubles = 0x1p-255;
constexpr double LargestUnitForDoubles = 0x1p230;

Exactness modeOf(double size, double scale)
{
  const double units = size * scale;
  const double unit = 1.0 / scale;
  if (units < std::ldexp(1.0, DoublesDigits) && unit >= SmallestUnitForDoubles &&
    unit <= LargestUnitForDoubles)
  {
    return Exactness::Doubles;
  }
  if (units < std::ldexp(1.0, Int128Digits))
  {
    return Exactness::Int128;
  }
  return units < std::ldexp(1.0, Int256Digits) ? Exactness::Int256 : Exactness::General;
}

// The difference x - y in units, for sets whose differences are exact in doubles (up to 53 digits).
std::int64_t units(double x, double y, double scale)
{
  return static_cast<std::int64_t>((x - y) * scale);
}

} // namespace

void CoordinateGrid::analyse(const Point2* points, std::size_t count)
{
  this->Mode = Exactness::Doubles;
  this->Scale = 1.0;
  if (count == 0)
  {
    return;
  }
  // The difference of any two points is the difference of their differences to the first one, and
  // so a multiple of the same unit.
  const Point2 reference = points[0];
  BitSpan span;
  Box2 box = Box2::of(reference);
  constexpr std::size_t blockSize = 256;
  for (std::size_t begin = 0; begin < count; begin += blockSize)
  {
    const std::size_t end = std::min(count, begin + blockSize);
    for (std::size_t i = begin; i < end; ++i)
    {
      box.extend(points[i]);
      span.includeDifference(points[i].x, reference.x);
      span.includeDifference(points[i].y, reference.y);
    }
    if (!span.fits(Int256Digits))
    {
      this->Mode = Exactness::General;
      return;
    }
  }
  this->Scale = span.scale();
  // Rounding is monotone: if this size is below a power of two, so is the exact one.
  this->Mode = modeOf(std::max(box.width(0), box.width(1)), this->Scale);
}

int CoordinateGrid::orientation(Point2 a, Point2 b, Point2 c) const
{
  const double scale = this->Scale;
  switch (this->Mode)
  {
    case Exactness::Doubles:
      return signOf((a.x - c.x) * (b.y - c.y) - (a.y - c.y) * (b.x - c.x));
    case Exactness::Int128:
      return orientationSign31(units(a.x, c.x, scale), units(a.y, c.y, scale),
        units(b.x, c.x, scale), units(b.y, c.y, scale));
    case Exactness::Int256:
      return orientationSign63(longUnits(a.x, c.x, scale), longUnits(a.y, c.y, scale),
        longUnits(b.x, c.x, scale), longUnits(b.y, c.y, scale));
    case Exactness::General:
      break;
  }
  return orientationExact(a, b, c);
}

int CoordinateGrid::inCircle(Point2 a, Point2 b, Point2 c, Point2 p) const
{
  switch (this->Mode)
  {
    case Exactness::Doubles:
      return signOf(inCircleValue(a, b, c, p).determinant);
    case Exactness::Int128:
      return inCircleSign31(integersOf(a, b, c, p, this->Scale, units));
    case Exactness::Int256:
      return inCircleSign63(integersOf(a, b, c, p, this->Scale, longUnits));
    case Exactness::General:
      break;
  }
  return inCircleExact(a, b, c, p);
}

} // namespace tipp
