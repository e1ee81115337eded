// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/Circumdisk.h"

#include "Predicates/ExactArithmetic.h"

#include <cmath>
#include <limits>

// With u = b - a, v = c - a, d = u x v > 0 and w = (vy |u|^2 - uy |v|^2, ux |v|^2 - vx |u|^2), the
// centre is a + w / 2d and the radius |w| / 2d.
namespace tipp
{
namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double Epsilon = 0x1p-53;

double longestEntry(Point2 u, Point2 v)
{
  return std::max({ std::fabs(u.x), std::fabs(u.y), std::fabs(v.x), std::fabs(v.y) });
}

Box2 widened(Point2 centre, double x, double y)
{
  return { centre.x - x, centre.y - y, centre.x + x, centre.y + y };
}

// The triangle and the box scaled by one power of two to integers. An infinite bound of the box is
// replaced by zero and must not be used.
struct ExactCircumdisk
{
  ExactCircumdisk(Point2 a, Point2 b, Point2 c, const Box2& box)
  {
    const auto finite = [](double bound) { return std::isfinite(bound) ? bound : 0.0; };
    const auto n = toCommonExponent<10>({ a.x, a.y, b.x, b.y, c.x, c.y, finite(box.xmin),
      finite(box.ymin), finite(box.xmax), finite(box.ymax) });
    const mpz_class ux = n[2] - n[0];
    const mpz_class uy = n[3] - n[1];
    const mpz_class vx = n[4] - n[0];
    const mpz_class vy = n[5] - n[1];
    const mpz_class u2 = ux * ux + uy * uy;
    const mpz_class v2 = vx * vx + vy * vy;
    const mpz_class d2 = 2 * (ux * vy - uy * vx);
    const mpz_class wx = vy * u2 - uy * v2;
    const mpz_class wy = ux * v2 - vx * u2;
    this->Square = wx * wx + wy * wy;
    this->Left = wx - d2 * (n[6] - n[0]);
    this->Bottom = wy - d2 * (n[7] - n[1]);
    this->Right = d2 * (n[8] - n[0]) - wx;
    this->Top = d2 * (n[9] - n[1]) - wy;
  }

  // All scaled by 2d. The distance of the centre from each side of the box, positive inside:
  mpz_class Left;
  mpz_class Bottom;
  mpz_class Right;
  mpz_class Top;
  // And the squared radius, times 4d^2.
  mpz_class Square;
};

} // namespace

Circumdisk::Circumdisk(Point2 a, Point2 b, Point2 c)
  : A(a)
  , B(b)
  , C(c)
{
  if (!this->computeIntervals())
  {
    this->leaveOpen();
  }
}

// Error bounds, with e = Epsilon, ^ for computed values, D = |ux vy| + |uy vx|.
//
// d: |d^ - d| <= 4 e D (Shewchuk 1997: 3 e D and second order). D <= 2^48 d^ makes 1/d <= (4/3)/d^.
//
// w: an entry is two products of a rounded difference (1 e) and a sum of squares of such (4 e); the
// product and the last difference round too: |w^ - w| <= 8 e W, W the sum of the magnitudes.
//
// q = w / 2d: |q^ - q| <= (4/3) (8 e W + |w^| 4 e D / d^) / 2d^ + 2 e |q^|, with |w^| <= (1 + e) W:
// at most e (16 + 6 D / d^) W / 2d^. This is xError, yError.
//
// Underflow: let s be the longest entry of u and v. s <= 1e70, and d^ >= 1e-150 makes s > 1e-76.
// Products and sums are off by 2e70 * 2^-1074, so w by 1e-250, d by 1e-322, q by 1e-99 or 1e-170 q:
// below e r, for the longest edge is at least s and at most 2 r.
//
// Centre a + q: rounded in a + q, in the interval's ends and in Outer and Inner: 4 e |c|, and that
// e r.
//
// Radius |q^|: off by xError + yError; its own rounding is 3 e r; e r each for the interval's ends,
// their squares, Outer and Inner; in meets() a squared distance is off by 5 e, its root by 2.5 e.
// With underflow less than 16 e r; 24 e r are allowed for.
bool Circumdisk::computeIntervals()
{
  const Point2 u = { this->B.x - this->A.x, this->B.y - this->A.y };
  const Point2 v = { this->C.x - this->A.x, this->C.y - this->A.y };
  const double left = u.x * v.y;
  const double right = u.y * v.x;
  const double d = left - right;
  const double permanent = std::fabs(left) + std::fabs(right);
  if (!(longestEntry(u, v) <= 1e70) || !(d >= 1e-150) || !(permanent <= 0x1p48 * d))
  {
    return false;
  }
  const double u2 = u.x * u.x + u.y * u.y;
  const double v2 = v.x * v.x + v.y * v.y;
  const double half = 0.5 / d;
  const double x = (v.y * u2 - u.y * v2) * half;
  const double y = (u.x * v2 - v.x * u2) * half;
  const double error = Epsilon * (16.0 + 12.0 * permanent * half) * half;
  const double xError = error * (std::fabs(v.y) * u2 + std::fabs(u.y) * v2);
  const double yError = error * (std::fabs(u.x) * v2 + std::fabs(v.x) * u2);
  const double radius = std::sqrt(x * x + y * y);
  const double radiusError = xError + yError + 24.0 * Epsilon * radius;
  // Within this limit squares of the radius and of similar distances are finite. False for NaN.
  if (!(radius + radiusError <= 1e150))
  {
    return false;
  }
  const Point2 centre = { this->A.x + x, this->A.y + y };
  this->Centre = widened(centre, xError + Epsilon * (4.0 * std::fabs(centre.x) + radius),
    yError + Epsilon * (4.0 * std::fabs(centre.y) + radius));
  const double largest = radius + radiusError;
  const double smallest = std::max(0.0, radius - radiusError);
  this->LargestSquare = largest * largest;
  this->SmallestSquare = smallest * smallest;
  this->Outer = { this->Centre.xmin - largest, this->Centre.ymin - largest,
    this->Centre.xmax + largest, this->Centre.ymax + largest };
  this->Inner = { this->Centre.xmax - smallest, this->Centre.ymax - smallest,
    this->Centre.xmin + smallest, this->Centre.ymin + smallest };
  return true;
}

// Makes the intervals infinite, so that every test uses exact arithmetic.
void Circumdisk::leaveOpen()
{
  this->Centre = { -Infinity, -Infinity, Infinity, Infinity };
  this->Outer = this->Centre;
  this->Inner = { Infinity, Infinity, -Infinity, -Infinity };
  this->LargestSquare = Infinity;
  this->SmallestSquare = -1.0;
}

bool Circumdisk::meetsExactly(const Box2& box) const
{
  const ExactCircumdisk disk(this->A, this->B, this->C, box);
  mpz_class distance = 0;
  const auto addGap = [&distance](const mpz_class& depth, double bound)
  {
    // The centre lies beyond at most one side of each axis.
    if (std::isfinite(bound) && depth < 0)
    {
      distance += depth * depth;
    }
  };
  addGap(disk.Left, box.xmin);
  addGap(disk.Right, box.xmax);
  addGap(disk.Bottom, box.ymin);
  addGap(disk.Top, box.ymax);
  return distance <= disk.Square;
}

bool Circumdisk::liesInsideExactly(const Box2& box) const
{
  const ExactCircumdisk disk(this->A, this->B, this->C, box);
  const auto deepEnough = [&disk](const mpz_class& depth, double bound)
  { return !std::isfinite(bound) || (depth >= 0 && depth * depth >= disk.Square); };
  return deepEnough(disk.Left, box.xmin) && deepEnough(disk.Right, box.xmax) &&
    deepEnough(disk.Bottom, box.ymin) && deepEnough(disk.Top, box.ymax);
}

} // namespace tipp
