// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/Circumball.h"

#include "Predicates/ExactArithmetic.h"

#include <cmath>
#include <limits>

// With u = b - a, v = c - a, w = d - a, D = u . (v x w) > 0 and
// n = |u|^2 (v x w) + |v|^2 (w x u) + |w|^2 (u x v), the centre is a + n / 2D and the radius
// |n| / 2D.
namespace tipp
{
namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double Epsilon = 0x1p-53;

using Vector = std::array<double, 3>;

Vector difference(const Point3& p, const Point3& q)
{
  return { p.x - q.x, p.y - q.y, p.z - q.z };
}

double square(const Vector& u)
{
  return u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
}

double longestEntry(const Vector& u)
{
  return std::max({ std::fabs(u[0]), std::fabs(u[1]), std::fabs(u[2]) });
}

/// A cross product, and the sums of its products' magnitudes.
struct Cross
{
  Cross(const Vector& u, const Vector& v)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      const double left = u[(k + 1) % 3] * v[(k + 2) % 3];
      const double right = u[(k + 2) % 3] * v[(k + 1) % 3];
      this->Value[k] = left - right;
      this->Permanent[k] = std::fabs(left) + std::fabs(right);
    }
  }

  Vector Value;
  Vector Permanent;
};

/// The distance of the centre from each side of a box, positive inside, times 2D; and the squared
/// radius times 4D^2. Coordinates are scaled by one power of two to integers.
struct ExactBall
{
  ExactBall(const std::array<Point3, 4>& p, const Box3& box)
  {
    const auto n = toCommonExponent<18>(
      { p[0].x, p[0].y, p[0].z, p[1].x, p[1].y, p[1].z, p[2].x, p[2].y, p[2].z, p[3].x, p[3].y,
        p[3].z, box.Min[0], box.Min[1], box.Min[2], box.Max[0], box.Max[1], box.Max[2] });
    std::array<std::array<mpz_class, 3>, 3> u;
    std::array<mpz_class, 3> lift;
    for (std::size_t i = 0; i < 3; ++i)
    {
      for (std::size_t k = 0; k < 3; ++k)
      {
        u[i][k] = n[3 * i + 3 + k] - n[k];
        lift[i] += u[i][k] * u[i][k];
      }
    }
    const auto cross = [&u](std::size_t i, std::size_t j, std::size_t k) -> mpz_class
    { return u[i][(k + 1) % 3] * u[j][(k + 2) % 3] - u[i][(k + 2) % 3] * u[j][(k + 1) % 3]; };
    mpz_class twice;
    for (std::size_t k = 0; k < 3; ++k)
    {
      twice += 2 * u[0][k] * cross(1, 2, k);
    }
    for (std::size_t k = 0; k < 3; ++k)
    {
      const mpz_class centre =
        lift[0] * cross(1, 2, k) + lift[1] * cross(2, 0, k) + lift[2] * cross(0, 1, k);
      this->Square += centre * centre;
      this->Depths[2 * k] = centre - twice * (n[12 + k] - n[k]);
      this->Depths[2 * k + 1] = twice * (n[15 + k] - n[k]) - centre;
    }
  }

  std::array<mpz_class, 6> Depths;
  mpz_class Square;
};

} // namespace

Circumball::Circumball(const Point3& a, const Point3& b, const Point3& c, const Point3& d)
  : Corners{ a, b, c, d }
{
  if (!this->computeIntervals())
  {
    this->leaveOpen();
  }
}

// Error bounds, with e = Epsilon, ^ for computed values, P = |u| . |v x w| in magnitudes of all
// products, W likewise for an entry of n.
//
// D: a difference rounds once (1 e), an entry of v x w is off by 4 e of its permanent, the product
// with u and two sums make 8 e P. P <= 2^48 D^ makes 1/D <= (4/3) / D^.
//
// n: a lift is off by 5 e, the cross product by 4 e, the product and two sums: |n^ - n| <= 12 e W.
//
// q = n / 2D: |q^ - q| <= (4/3) (12 e W + |n^| 8 e P / D^) / 2D^ + 2 e |q^|: at most
// e (20 + 12 P / D^) W / 2D^, with second order.
//
// Underflow: let s be the longest entry of u, v, w. s <= 1e50, and D^ >= 1e-150 makes s > 1e-51.
// Products below the normal range are off by 2^-1074, so n by 1e-221 and q by 1e-71: below e r.
//
// Centre a + q: rounded in a + q and in the interval's ends: 4 e |c|, and that e r.
//
// Radius |q^|: off by the sum of q's errors; its own rounding is 4 e r; e r each for the interval's
// ends and their squares; in meets() a squared distance is off by 6 e, its root by 3 e. 32 e r are
// allowed for.
bool Circumball::computeIntervals()
{
  const Vector u = difference(this->Corners[1], this->Corners[0]);
  const Vector v = difference(this->Corners[2], this->Corners[0]);
  const Vector w = difference(this->Corners[3], this->Corners[0]);
  const std::array<Cross, 3> crosses = { Cross(v, w), Cross(w, u), Cross(u, v) };
  const std::array<double, 3> lifts = { square(u), square(v), square(w) };
  double d = 0;
  double permanent = 0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    d += u[k] * crosses[0].Value[k];
    permanent += std::fabs(u[k]) * crosses[0].Permanent[k];
  }
  const double longest = std::max({ longestEntry(u), longestEntry(v), longestEntry(w) });
  if (!(longest <= 1e50) || !(d >= 1e-150) || !(permanent <= 0x1p48 * d))
  {
    return false;
  }
  const double half = 0.5 / d;
  const double relative = Epsilon * (20.0 + 24.0 * permanent * half) * half;
  Vector q = {};
  Vector errors = {};
  for (std::size_t k = 0; k < 3; ++k)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      q[k] += lifts[i] * crosses[i].Value[k];
      errors[k] += lifts[i] * crosses[i].Permanent[k];
    }
    q[k] *= half;
    errors[k] *= relative;
  }
  const double radius = std::sqrt(square(q));
  const double radiusError = errors[0] + errors[1] + errors[2] + 32.0 * Epsilon * radius;
  // Within this limit squares of the radius and of similar distances are finite. False for NaN.
  if (!(radius + radiusError <= 1e150))
  {
    return false;
  }
  const Vector first = { this->Corners[0].x, this->Corners[0].y, this->Corners[0].z };
  for (std::size_t k = 0; k < 3; ++k)
  {
    const double centre = first[k] + q[k];
    const double error = errors[k] + Epsilon * (4.0 * std::fabs(centre) + radius);
    this->Low[k] = centre - error;
    this->High[k] = centre + error;
  }
  const double largest = radius + radiusError;
  const double smallest = std::max(0.0, radius - radiusError);
  this->LargestSquare = largest * largest;
  this->SmallestSquare = smallest * smallest;
  return true;
}

// With s the longest entry of u, v and w, and thus P <= 6 s^3 and W <= 18 s^4: where D^ is at least
// 2^-10 s^3, the error of q is below e (20 + 12 * 6 * 2^10) 9 * 2^10 s < 1e-7 s by the bounds
// above, and so is that of the radius, 2e-7 s for all three entries. 1e-6 s are allowed for, plus
// 16 e of the coordinates for their rounding.
namespace
{

/// Of a tetrahedron: its volume times six, the square of its longest edge at a corner, and the
/// centre of its ball from there, times twelve volumes.
struct BallOfCorners
{
  BallOfCorners(const Point3& a, const Point3& b, const Point3& c, const Point3& d)
  {
    const Point3 u = b - a;
    const Point3 v = c - a;
    const Point3 w = d - a;
    const auto cross = [](const Point3& p, const Point3& q) -> Point3 {
      return { p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x };
    };
    const Point3 vw = cross(v, w);
    const Point3 wu = cross(w, u);
    const Point3 uv = cross(u, v);
    const double uu = square(u);
    const double vv = square(v);
    const double ww = square(w);
    this->Volume = u.x * vw.x + u.y * vw.y + u.z * vw.z;
    this->Edge = std::max({ uu, vv, ww });
    this->Centre = { uu * vw.x + vv * wu.x + ww * uv.x, uu * vw.y + vv * wu.y + ww * uv.y,
      uu * vw.z + vv * wu.z + ww * uv.z };
  }

  static double square(const Point3& p) { return p.x * p.x + p.y * p.y + p.z * p.z; }

  double Volume;
  double Edge;
  Point3 Centre;
};

} // namespace

bool Circumball::isSurelyInside(
  const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Box3& box)
{
  const BallOfCorners ball(a, b, c, d);
  const double s = std::sqrt(ball.Edge); // at least the longest entry
  if (!(ball.Volume >= 0x1p-10 * (s * s * s)) || !(s >= 1e-50) || !(s <= 1e50))
  {
    return false;
  }
  const double half = 0.5 / ball.Volume;
  const Point3 q = { half * ball.Centre.x, half * ball.Centre.y, half * ball.Centre.z };
  const double radius = std::sqrt(BallOfCorners::square(q)) + 1e-6 * s;
  const auto isBetween = [radius](double low, double centre, double high)
  {
    const double reach = radius + 16 * Epsilon * std::fabs(centre);
    return low < centre - reach && centre + reach < high;
  };
  return isBetween(box.Min[0], a.x + q.x, box.Max[0]) &&
    isBetween(box.Min[1], a.y + q.y, box.Max[1]) && isBetween(box.Min[2], a.z + q.z, box.Max[2]);
}

// The same filter, squared: without root and division. The radius is at least half an edge, so the
// rounding errors are far below the margin.
bool Circumball::isSurelySmall(
  const Point3& a, const Point3& b, const Point3& c, const Point3& d, double diameter)
{
  constexpr double margin = 0.999;
  const BallOfCorners ball(a, b, c, d);
  const double volume = ball.Volume * ball.Volume;
  return ball.Volume > 0 && ball.Edge >= 1e-40 && ball.Edge <= 1e40 &&
    volume >= 0x1p-20 * (ball.Edge * ball.Edge * ball.Edge) &&
    BallOfCorners::square(ball.Centre) < margin * volume * (diameter * diameter);
}

// Makes the intervals infinite, so that every test uses exact arithmetic.
void Circumball::leaveOpen()
{
  this->Low.fill(-Infinity);
  this->High.fill(Infinity);
  this->LargestSquare = Infinity;
  this->SmallestSquare = -1.0;
}

bool Circumball::meetsExactly(const Box3& box) const
{
  const ExactBall ball(this->Corners, box);
  mpz_class distance = 0;
  for (const mpz_class& depth : ball.Depths)
  {
    // The centre lies beyond at most one side of each axis.
    if (depth < 0)
    {
      distance += depth * depth;
    }
  }
  return distance <= ball.Square;
}

} // namespace tipp
