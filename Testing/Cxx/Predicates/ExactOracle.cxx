// SPDX-License-Identifier: BSD-3-Clause
#include "ExactOracle.h"

#include <cmath>

namespace oracle
{

Point exact(tipp::Point2 p)
{
  return { Rational(p.x), Rational(p.y) };
}

int orientation(tipp::Point2 a, tipp::Point2 b, tipp::Point2 c)
{
  return static_cast<int>(CGAL::orientation(exact(a), exact(b), exact(c)));
}

int inCircle(tipp::Point2 a, tipp::Point2 b, tipp::Point2 c, tipp::Point2 p)
{
  return static_cast<int>(CGAL::side_of_oriented_circle(exact(a), exact(b), exact(c), exact(p)));
}

Disk::Disk(tipp::Point2 a, tipp::Point2 b, tipp::Point2 c)
  : Centre(CGAL::circumcenter(exact(a), exact(b), exact(c)))
  , Square(CGAL::squared_distance(Centre, exact(a)))
{
}

namespace
{

Rational squaredGap(const Rational& centre, double low, double high)
{
  Rational gap = 0;
  if (std::isfinite(low) && centre < Rational(low))
  {
    gap = Rational(low) - centre;
  }
  if (std::isfinite(high) && centre > Rational(high))
  {
    gap = centre - Rational(high);
  }
  return gap * gap;
}

bool fits(const Rational& centre, const Rational& square, double low, double high)
{
  const auto deep = [&square](const Rational& depth)
  { return CGAL::sign(depth) != CGAL::NEGATIVE && depth * depth >= square; };
  return (std::isinf(low) || deep(centre - Rational(low))) &&
    (std::isinf(high) || deep(Rational(high) - centre));
}

} // namespace

bool Disk::meets(const tipp::Box2& box) const
{
  return squaredGap(this->Centre.x(), box.Min.x, box.Max.x) +
    squaredGap(this->Centre.y(), box.Min.y, box.Max.y) <=
    this->Square;
}

bool Disk::inside(const tipp::Box2& box) const
{
  return fits(this->Centre.x(), this->Square, box.Min.x, box.Max.x) &&
    fits(this->Centre.y(), this->Square, box.Min.y, box.Max.y);
}

} // namespace oracle
