// SPDX-License-Identifier: BSD-3-Clause
#include "NearDegenerate.h"

#include <cmath>
#include <ios>
#include <limits>

namespace tipp
{
void PrintTo(const Point2& point, std::ostream* out)
{
  *out << std::hexfloat << "(" << point.x << ", " << point.y << ")" << std::defaultfloat;
}
}

namespace
{

double nudgedBy(double value, int ulps)
{
  const double towards =
    ulps < 0 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
  for (int i = 0; i < std::abs(ulps); ++i)
  {
    value = std::nextafter(value, towards);
  }
  return value;
}

} // namespace

NearDegenerate::Points NearDegenerate::lattice(int size, double step, tipp::Point2 offset)
{
  Points points;
  for (tipp::Point2& point : points)
  {
    point.x = offset.x + step * this->integer(0, size - 1);
    point.y = offset.y + step * this->integer(0, size - 1);
  }
  return points;
}

NearDegenerate::Points NearDegenerate::cocircular(double step, tipp::Point2 offset)
{
  // Integer vectors of length 5, 25 or 65; their mirror images are used as well.
  static const int legs[][2] = { { 3, 4 }, { 5, 0 }, { 7, 24 }, { 15, 20 }, { 25, 0 }, { 16, 63 },
    { 25, 60 }, { 33, 56 }, { 39, 52 }, { 65, 0 } };
  static const int first[] = { 0, 2, 5 };
  static const int last[] = { 1, 4, 9 };
  const int circle = this->integer(0, 2);
  Points points;
  for (tipp::Point2& point : points)
  {
    const int* leg = legs[this->integer(first[circle], last[circle])];
    const int swap = this->integer(0, 1);
    const double x = leg[swap] * (this->integer(0, 1) != 0 ? 1 : -1);
    const double y = leg[1 - swap] * (this->integer(0, 1) != 0 ? 1 : -1);
    point = this->nudged({ offset.x + step * x, offset.y + step * y });
  }
  return points;
}

NearDegenerate::Points NearDegenerate::collinear(double step, tipp::Point2 offset)
{
  const int dx = this->integer(-20, 20);
  const int dy = this->integer(-20, 20);
  Points points;
  for (tipp::Point2& point : points)
  {
    const int t = this->integer(-30, 30);
    point = this->nudged({ offset.x + step * (t * dx), offset.y + step * (t * dy) });
  }
  return points;
}

NearDegenerate::Points NearDegenerate::mixedExponents(int lowest, int highest)
{
  Points points;
  for (tipp::Point2& point : points)
  {
    point.x = std::ldexp(this->real(-1, 1), this->integer(lowest, highest));
    point.y = std::ldexp(this->real(-1, 1), this->integer(lowest, highest));
  }
  return points;
}

NearDegenerate::Points NearDegenerate::fewMagnitudes(int lowest, int highest)
{
  const double magnitudes[] = { 0, std::ldexp(1, this->integer(lowest, highest)),
    std::ldexp(1, this->integer(lowest, highest)) };
  Points points;
  for (tipp::Point2& point : points)
  {
    point.x = this->integer(-2, 2) * magnitudes[this->integer(0, 2)];
    point.y = this->integer(-2, 2) * magnitudes[this->integer(0, 2)];
  }
  return points;
}

NearDegenerate::Points NearDegenerate::unitCircle()
{
  Points points;
  for (tipp::Point2& point : points)
  {
    const double angle = this->real(0, 6.3);
    point = { std::cos(angle), std::sin(angle) };
  }
  return points;
}

std::int64_t NearDegenerate::bits(int count)
{
  return static_cast<std::int64_t>(this->Engine() >> (64 - count));
}

tipp::Point2 NearDegenerate::nudged(tipp::Point2 point)
{
  // Half of all points are not moved, so that exact ties remain.
  if (this->integer(0, 1) != 0)
  {
    return point;
  }
  return { nudgedBy(point.x, this->integer(-2, 2)), nudgedBy(point.y, this->integer(-2, 2)) };
}

NearDegenerate::Points scaled(NearDegenerate::Points points, int exponent)
{
  for (tipp::Point2& point : points)
  {
    point = { std::ldexp(point.x, exponent), std::ldexp(point.y, exponent) };
  }
  return points;
}
