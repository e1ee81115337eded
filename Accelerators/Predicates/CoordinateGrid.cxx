// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/CoordinateGrid.h"

#include "Predicates/ExactArithmetic.h"
#include "Predicates/ExactPredicates.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace tipp
{
namespace
{

// Differences below 2^k units. In-circle terms are multiples of unit^4, and the partial sums of the
// three are below 3 * 2^(2k+1) * 2^(2k+1) < 2^(4k+4): at k = 12, 52 bits, exact in doubles.
// Orientation needs 2k+1 = 25.
constexpr int DoublesDigits = 12;
// See ExactIntegers.h.
constexpr int Int128Digits = 31;
constexpr int Int256Digits = 63;

// With units of 2^-255 and more, unit^4 is a normal number; with at most 2^12 * 2^230, a
// determinant below 2^52 * (2^230)^4 = 2^972 does not overflow.
constexpr double SmallestUnitForDoubles = 0x1p-255;
constexpr double LargestUnitForDoubles = 0x1p230;

struct Extent
{
  double low;
  double high;

  void include(double value)
  {
    this->low = value < this->low ? value : this->low;
    this->high = value > this->high ? value : this->high;
  }
  // Rounding is monotone: if this is below a power of two, so is the exact extent.
  double size() const { return this->high - this->low; }
};

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

std::int64_t longUnits(double x, double y, double scale)
{
  return scaledToInteger(exactDifference(x, y), scale);
}

template <typename ToUnits>
InCircleIntegers integersOf(Point2 a, Point2 b, Point2 c, Point2 p, double scale, ToUnits toUnits)
{
  return { toUnits(a.x, p.x, scale), toUnits(a.y, p.y, scale), toUnits(b.x, p.x, scale),
    toUnits(b.y, p.y, scale), toUnits(c.x, p.x, scale), toUnits(c.y, p.y, scale) };
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
  Extent x = { reference.x, reference.x };
  Extent y = { reference.y, reference.y };
  constexpr std::size_t blockSize = 256;
  for (std::size_t begin = 0; begin < count; begin += blockSize)
  {
    const std::size_t end = std::min(count, begin + blockSize);
    for (std::size_t i = begin; i < end; ++i)
    {
      x.include(points[i].x);
      y.include(points[i].y);
      span.include(exactDifference(points[i].x, reference.x));
      span.include(exactDifference(points[i].y, reference.y));
    }
    if (!span.fits(Int256Digits))
    {
      this->Mode = Exactness::General;
      return;
    }
  }
  this->Scale = span.scale();
  this->Mode = modeOf(std::max(x.size(), y.size()), this->Scale);
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
