// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/Circumball.h"

#include "Predicates/Dyadic.h"
#include "Predicates/Vectors.h"

#include <vector>

namespace tipp
{
namespace
{

constexpr double Epsilon = 0x1p-53;

/// The distance of the centre from each finite side of a box, positive inside, times 2d, and the
/// squared radius times 4d^2, where d is the determinant of the edges from the first corner (d at
/// Circumdisk::Circumdisk(), D at BallOfCorners).
template <std::size_t D>
struct ExactBall
{
  ExactBall(const std::array<Point<D>, D + 1>& corners, const Box<D>& box)
  {
    std::array<std::array<Dyadic, D>, D> u;
    std::array<Dyadic, D> lift;
    for (std::size_t i = 0; i < D; ++i)
    {
      for (std::size_t k = 0; k < D; ++k)
      {
        u[i][k] = Dyadic(corners[i + 1][k]) - corners[0][k];
        lift[i] += u[i][k] * u[i][k];
      }
    }
    Dyadic twice;
    std::array<Dyadic, D> centre;
    if constexpr (D == 2)
    {
      twice = 2 * (u[0][0] * u[1][1] - u[0][1] * u[1][0]);
      centre[0] = u[1][1] * lift[0] - u[0][1] * lift[1];
      centre[1] = u[0][0] * lift[1] - u[1][0] * lift[0];
    }
    else
    {
      const auto cross = [&u](std::size_t i, std::size_t j, std::size_t k)
      { return u[i][(k + 1) % 3] * u[j][(k + 2) % 3] - u[i][(k + 2) % 3] * u[j][(k + 1) % 3]; };
      for (std::size_t k = 0; k < 3; ++k)
      {
        twice += 2 * u[0][k] * cross(1, 2, k);
        centre[k] = lift[0] * cross(1, 2, k) + lift[1] * cross(2, 0, k) + lift[2] * cross(0, 1, k);
      }
    }
    for (std::size_t k = 0; k < D; ++k)
    {
      this->Square += centre[k] * centre[k];
      if (std::isfinite(box.Min[k]))
      {
        this->Depths.push_back(centre[k] - twice * (Dyadic(box.Min[k]) - corners[0][k]));
      }
      if (std::isfinite(box.Max[k]))
      {
        this->Depths.push_back(twice * (Dyadic(box.Max[k]) - corners[0][k]) - centre[k]);
      }
    }
  }

  std::vector<Dyadic> Depths;
  Dyadic Square;
};

} // namespace

template <std::size_t D>
bool BallIntervals<D>::meetsExactly(const Box<D>& box) const
{
  const ExactBall<D> ball(this->Corners, box);
  Dyadic distance;
  for (const Dyadic& depth : ball.Depths)
  {
    // The centre lies beyond at most one side of each axis.
    if (depth.sign() < 0)
    {
      distance += depth * depth;
    }
  }
  return compare(distance, ball.Square) <= 0;
}

template <std::size_t D>
bool BallIntervals<D>::liesInsideExactly(const Box<D>& box) const
{
  const ExactBall<D> ball(this->Corners, box);
  return std::all_of(ball.Depths.begin(), ball.Depths.end(),
    [&ball](const Dyadic& depth)
    { return depth.sign() >= 0 && compare(depth * depth, ball.Square) >= 0; });
}

template class BallIntervals<2>;
template class BallIntervals<3>;

// With u = b - a, v = c - a, d = u x v > 0 and w = (vy |u|^2 - uy |v|^2, ux |v|^2 - vx |u|^2), the
// centre is a + w / 2d and the radius |w| / 2d.
//
// Error bounds, with e = Epsilon, ^ for computed values, D = |ux vy| + |uy vx|.
//
// d: |d^ - d| <= 4 e D (Shewchuk 1997: 3 e D and second order). D <= 2^48 d^ makes 1/d <= (4/3)/d^.
//
// w: an entry is two products of a rounded difference (1 e) and a sum of squares of such (4 e); the
// product and the last difference round too: |w^ - w| <= 8 e W, W the sum of the magnitudes.
//
// q = w / 2d: |q^ - q| <= (4/3) (8 e W + |w^| 4 e D / d^) / 2d^ + 2 e |q^|, with |w^| <= (1 + e) W:
// at most e (16 + 6 D / d^) W / 2d^. These are the errors.
//
// Underflow: let s be the longest entry of u and v. s <= 1e70, and d^ >= 1e-150 makes s > 1e-76.
// Products and sums are off by 2e70 * 2^-1074, so w by 1e-250, d by 1e-322, q by 1e-99 or 1e-170 q:
// below e r, for the longest edge is at least s and at most 2 r.
//
// Centre a + q: rounded in a + q, in the interval's ends, in bounds() and in inside(): 4 e |c|, and
// that e r.
//
// Radius |q^|: off by the sum of the errors; its own rounding is 3 e r; e r each for the interval's
// ends, their squares, bounds() and inside(); in meets() a squared distance is off by 5 e, its root
// by 2.5 e. With underflow less than 16 e r; 24 e r are allowed for.
Circumdisk::Circumdisk(const Point2& a, const Point2& b, const Point2& c)
  : BallIntervals<2>({ a, b, c })
{
  const Point2 u = b - a;
  const Point2 v = c - a;
  const double left = u.x * v.y;
  const double right = u.y * v.x;
  const double d = left - right;
  const double permanent = std::fabs(left) + std::fabs(right);
  const double longest =
    std::max({ std::fabs(u.x), std::fabs(u.y), std::fabs(v.x), std::fabs(v.y) });
  if (!(longest <= 1e70) || !(d >= 1e-150) || !(permanent <= 0x1p48 * d))
  {
    return;
  }
  const double u2 = u.x * u.x + u.y * u.y;
  const double v2 = v.x * v.x + v.y * v.y;
  const double half = 0.5 / d;
  const double error = Epsilon * (16.0 + 12.0 * permanent * half) * half;
  this->setIntervals({ (v.y * u2 - u.y * v2) * half, (u.x * v2 - v.x * u2) * half },
    { error * (std::fabs(v.y) * u2 + std::fabs(u.y) * v2),
      error * (std::fabs(u.x) * v2 + std::fabs(v.x) * u2) },
    24);
}

namespace
{

/// Of a tetrahedron: its volume times six, the square of its longest edge at a corner, and the
/// centre of its ball from there, times twelve volumes. With u = b - a, v = c - a, w = d - a these
/// are D = u . (v x w) > 0 and n = |u|^2 (v x w) + |v|^2 (w x u) + |w|^2 (u x v): the centre is
/// a + n / 2D and the radius |n| / 2D.
struct BallOfCorners
{
  BallOfCorners(const Point3& a, const Point3& b, const Point3& c, const Point3& d)
    : Edges{ b - a, c - a, d - a }
    , Lifts{ dot(this->Edges[0], this->Edges[0]), dot(this->Edges[1], this->Edges[1]),
      dot(this->Edges[2], this->Edges[2]) }
  {
    const auto& [u, v, w] = this->Edges;
    const auto& [uu, vv, ww] = this->Lifts;
    const Point3 vw = cross(v, w);
    const Point3 wu = cross(w, u);
    const Point3 uv = cross(u, v);
    this->Volume = dot(u, vw);
    this->Edge = std::max({ uu, vv, ww });
    this->Centre = { uu * vw.x + vv * wu.x + ww * uv.x, uu * vw.y + vv * wu.y + ww * uv.y,
      uu * vw.z + vv * wu.z + ww * uv.z };
  }

  Point3 Edges[3];
  double Lifts[3]; ///< squared lengths of the edges
  double Volume;
  double Edge;
  Point3 Centre;
};

/// Of a cross product, the sums of its products' magnitudes.
Point3 crossPermanent(const Point3& p, const Point3& q)
{
  return { std::fabs(p.y * q.z) + std::fabs(p.z * q.y), std::fabs(p.z * q.x) + std::fabs(p.x * q.z),
    std::fabs(p.x * q.y) + std::fabs(p.y * q.x) };
}

} // namespace

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
Circumball::Circumball(const Point3& a, const Point3& b, const Point3& c, const Point3& d)
  : BallIntervals<3>({ a, b, c, d })
{
  const BallOfCorners ball(a, b, c, d);
  const auto& [u, v, w] = ball.Edges;
  const Vector permanents[3] = { crossPermanent(v, w), crossPermanent(w, u), crossPermanent(u, v) };
  const double permanent = std::fabs(u.x) * permanents[0].x + std::fabs(u.y) * permanents[0].y +
    std::fabs(u.z) * permanents[0].z;
  double longest = 0;
  for (const Point3& edge : ball.Edges)
  {
    longest = std::max({ longest, std::fabs(edge.x), std::fabs(edge.y), std::fabs(edge.z) });
  }
  if (!(longest <= 1e50) || !(ball.Volume >= 1e-150) || !(permanent <= 0x1p48 * ball.Volume))
  {
    return;
  }
  const double half = 0.5 / ball.Volume;
  const double relative = Epsilon * (20.0 + 24.0 * permanent * half) * half;
  Vector errors = {};
  for (std::size_t k = 0; k < 3; ++k)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      errors[k] += ball.Lifts[i] * permanents[i][k];
    }
    errors[k] *= relative;
  }
  this->setIntervals(
    { ball.Centre.x * half, ball.Centre.y * half, ball.Centre.z * half }, errors, 32);
}

// With s the longest entry of u, v and w, and thus P <= 6 s^3 and W <= 18 s^4: where D^ is at least
// 2^-10 s^3, the error of q is below e (20 + 12 * 6 * 2^10) 9 * 2^10 s < 1e-7 s by the bounds
// above, and so is that of the radius, 2e-7 s for all three entries. 1e-6 s are allowed for, plus
// 16 e of the coordinates for their rounding.
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
  const double radius = std::sqrt(dot(q, q)) + 1e-6 * s;
  const auto isBetween = [radius](double low, double centre, double high)
  {
    const double reach = radius + 16 * Epsilon * std::fabs(centre);
    return low < centre - reach && centre + reach < high;
  };
  return isBetween(box.Min.x, a.x + q.x, box.Max.x) && isBetween(box.Min.y, a.y + q.y, box.Max.y) &&
    isBetween(box.Min.z, a.z + q.z, box.Max.z);
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
    dot(ball.Centre, ball.Centre) < margin * volume * (diameter * diameter);
}

} // namespace tipp
