// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/Circumball.h"
#include "Predicates/ExactPredicates.h"
#include "Predicates/ExactPredicates3.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace
{

using namespace tipp;
using Vector = std::array<mpq_class, 3>;

Vector exact(const Point3& p)
{
  return { mpq_class(p.x), mpq_class(p.y), mpq_class(p.z) };
}

/// The centre and the squared radius of a tetrahedron's circumscribed ball.
struct Ball
{
  explicit Ball(const std::array<Point3, 4>& p)
  {
    std::array<Vector, 3> u;
    std::array<mpq_class, 3> lift;
    const Vector first = exact(p[0]);
    for (std::size_t i = 0; i < 3; ++i)
    {
      const Vector other = exact(p[i + 1]);
      for (std::size_t k = 0; k < 3; ++k)
      {
        u[i][k] = other[k] - first[k];
        lift[i] += u[i][k] * u[i][k];
      }
    }
    const auto cross = [&](std::size_t i, std::size_t j, std::size_t k) -> mpq_class
    { return u[i][(k + 1) % 3] * u[j][(k + 2) % 3] - u[i][(k + 2) % 3] * u[j][(k + 1) % 3]; };
    mpq_class twice;
    for (std::size_t k = 0; k < 3; ++k)
    {
      twice += 2 * u[0][k] * cross(1, 2, k);
    }
    for (std::size_t k = 0; k < 3; ++k)
    {
      const mpq_class shift =
        (lift[0] * cross(1, 2, k) + lift[1] * cross(2, 0, k) + lift[2] * cross(0, 1, k)) / twice;
      this->Centre[k] = first[k] + shift;
      this->Square += shift * shift;
    }
  }

  int sideOf(const Point3& p) const
  {
    mpq_class distance;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const mpq_class d = exact(p)[k] - this->Centre[k];
      distance += d * d;
    }
    return sgn(mpq_class(this->Square - distance));
  }

  bool meets(const Box3& box) const
  {
    mpq_class distance;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const mpq_class below = mpq_class(box.Min[k]) - this->Centre[k];
      const mpq_class above = this->Centre[k] - mpq_class(box.Max[k]);
      const mpq_class gap = below > above ? below : above;
      distance += gap > 0 ? mpq_class(gap * gap) : mpq_class(0);
    }
    return distance <= this->Square;
  }

  Vector Centre;
  mpq_class Square;
};

/// Draws points with coordinates of very different magnitudes, and small integers for ties.
class Hard
{
public:
  explicit Hard(unsigned seed)
    : Generator(seed)
  {
  }

  Point3 point()
  {
    const auto coordinate = [this]
    {
      const double u = this->Uniform(this->Generator);
      switch (this->Generator() % 6)
      {
        case 0:
          return std::ldexp(u, -int(this->Generator() % 300));
        case 1:
          return u;
        case 2:
          return 1e6 + u;
        default:
          return double(int(4 * u));
      }
    };
    return { coordinate(), coordinate(), coordinate() };
  }

  /// A tetrahedron of positive orientation.
  std::array<Point3, 4> tetrahedron()
  {
    for (;;)
    {
      std::array<Point3, 4> p = { this->point(), this->point(), this->point(), this->point() };
      const int side = orientation3(p[0], p[1], p[2], p[3]);
      if (side < 0)
      {
        std::swap(p[0], p[1]);
      }
      if (side != 0)
      {
        return p;
      }
    }
  }

private:
  std::mt19937_64 Generator;
  std::uniform_real_distribution<double> Uniform{ 0, 1 };
};

} // namespace

TEST(InSphere, EqualsRationals)
{
  Hard hard(1);
  int ties = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const auto t = hard.tetrahedron();
    const Point3 p = hard.point();
    const int side = Ball(t).sideOf(p);
    ties += side == 0 ? 1 : 0;
    EXPECT_EQ(side, inSphere(t[0], t[1], t[2], t[3], p));
    EXPECT_EQ(side, inSphereExact(t[0], t[1], t[2], t[3], p));
  }
  EXPECT_GT(ties, 10);
}

TEST(InSphere, AlmostOnTheSphereEqualsRationals)
{
  std::mt19937_64 generator(2);
  std::normal_distribution<double> normal;
  const auto onSphere = [&]() -> Point3
  {
    const Point3 p{ normal(generator), normal(generator), normal(generator) };
    const double length = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
    return { p.x / length, p.y / length, p.z / length };
  };
  for (int i = 0; i < 5000; ++i)
  {
    std::array<Point3, 4> t = { onSphere(), onSphere(), onSphere(), onSphere() };
    if (orientation3(t[0], t[1], t[2], t[3]) < 0)
    {
      std::swap(t[0], t[1]);
    }
    const Point3 p = onSphere();
    EXPECT_EQ(Ball(t).sideOf(p), inSphere(t[0], t[1], t[2], t[3], p));
  }
}

TEST(InSphere, TiesDoNotDependOnTheOrderOfCorners)
{
  const Point3 p{ 1, 1, 1 };
  std::array<Point3, 4> t = { { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } };
  ASSERT_EQ(0, inSphere(t[0], t[1], t[2], t[3], p));
  const bool inside = inSpherePerturbed(t[0], t[1], t[2], t[3], p);
  EXPECT_FALSE(inside); // the lexicographically largest point is outside
  EXPECT_EQ(inside, inSpherePerturbed(t[1], t[2], t[0], t[3], p));
  EXPECT_EQ(inside, inSpherePerturbed(t[1], t[0], t[3], t[2], p));
}

TEST(InSphere, ACornerIsOutside)
{
  Hard hard(3);
  for (int i = 0; i < 200; ++i)
  {
    const auto t = hard.tetrahedron();
    for (const Point3& corner : t)
    {
      EXPECT_FALSE(inSpherePerturbed(t[0], t[1], t[2], t[3], corner));
    }
  }
}

TEST(Circumball, SurelySmallBallsReachNoFartherThanTheirDiameter)
{
  Hard hard(5);
  int small = 0;
  for (int i = 0; i < 5000; ++i)
  {
    const auto t = hard.tetrahedron();
    const Ball rational(t);
    const Point3 reach = hard.point() - t[0];
    const double diameter = std::fabs(reach.x) + std::fabs(reach.y);
    if (!Circumball::isSurelySmall(t[0], t[1], t[2], t[3], diameter))
    {
      continue;
    }
    ++small;
    constexpr double far = 1e8;
    const Point3& at = t[0];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      Box3 beyond{ { -far, -far, -far }, { far, far, far } };
      beyond.Min[axis] = at[axis] + diameter;
      EXPECT_FALSE(rational.meets(beyond));
      beyond.Min[axis] = -far;
      beyond.Max[axis] = at[axis] - diameter;
      EXPECT_FALSE(rational.meets(beyond));
    }
  }
  EXPECT_GT(small, 100);
}

TEST(Circumball, MeetsBoxesAsInRationals)
{
  Hard hard(4);
  int meetings = 0;
  for (int i = 0; i < 5000; ++i)
  {
    const auto t = hard.tetrahedron();
    const Circumball ball(t[0], t[1], t[2], t[3]);
    const Ball rational(t);
    for (int k = 0; k < 4; ++k)
    {
      const Point3 a = hard.point();
      const Point3 b = hard.point();
      const Box3 box{ { std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z) },
        { std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z) } };
      const bool meets = rational.meets(box);
      meetings += meets ? 1 : 0;
      EXPECT_EQ(meets, ball.meets(box));
      if (Circumball::isSurelyInside(t[0], t[1], t[2], t[3], box))
      {
        EXPECT_TRUE(meets);
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          Box3 beyond = box;
          beyond.Min[axis] = box.Max[axis];
          EXPECT_FALSE(rational.meets(beyond));
        }
      }
    }
  }
  EXPECT_GT(meetings, 1000);
}

TEST(Circumball, TouchingIsMeeting)
{
  // The unit sphere touches the plane x = 1 at (1, 0, 0).
  const Circumball ball({ 1, 0, 0 }, { 0, 1, 0 }, { -1, 0, 0 }, { 0, 0, 1 });
  EXPECT_TRUE(ball.meets({ { 1, -1, -1 }, { 2, 1, 1 } }));
  EXPECT_FALSE(ball.meets({ { std::nextafter(1.0, 2.0), -1, -1 }, { 2, 1, 1 } }));
}

TEST(NormalAxis, IsTheLastOfTheLargestComponents)
{
  EXPECT_EQ(normalAxis({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }), 2);
  EXPECT_EQ(normalAxis({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 0, 1 }), 1);
  EXPECT_EQ(normalAxis({ 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }), 0);
  EXPECT_EQ(normalAxis({ 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }), 2); // the normal is (1, 1, 1)
  EXPECT_EQ(normalAxis({ 1, 0, 0 }, { 0, 1, 0 }, { 0, 1, 1 }), 1); // the normal is (1, 1, 0)
}

TEST(NormalAxis, ComparesComponentsExactly)
{
  // The normal is (-1, 0, 1 + 2^-52) in the first plane, and (-1 - 2^-52, 0, 1) in the second one.
  const double more = std::nextafter(1.0, 2.0);
  EXPECT_EQ(normalAxis({ 0, 0, 0 }, { more, 0, 1 }, { 0, 1, 0 }), 2);
  EXPECT_EQ(normalAxis({ 0, 0, 0 }, { 1, 0, more }, { 0, 1, 0 }), 0);
  // Products of these coordinates overflow or vanish.
  EXPECT_EQ(normalAxis({ 0, 0, 0 }, { 1e300, 0, 2e300 }, { 0, 1e300, 0 }), 0);
  EXPECT_EQ(normalAxis({ 0, 0, 0 }, { 2e-300, 0, 1e-300 }, { 0, 1e-300, 0 }), 2);
}

TEST(NormalAxis, IsTheSameForAnyCornersOfAPlane)
{
  std::mt19937 random(5);
  std::uniform_int_distribution<int> whole(-1000, 1000);
  for (int round = 0; round < 100; ++round)
  {
    const double u = whole(random);
    const double v = whole(random);
    const auto onPlane = [&]
    {
      const double x = whole(random);
      const double y = whole(random);
      return Point3{ x, y, u * x + v * y };
    };
    const int asked = std::abs(u) > std::max(std::abs(v), 1.0) ? 0 : std::abs(v) > 1 ? 1 : 2;
    const Point3 a = onPlane();
    const Point3 b = onPlane();
    const Point3 c = onPlane();
    if (orientation(Point2{ a.x, a.y }, Point2{ b.x, b.y }, Point2{ c.x, c.y }) != 0)
    {
      EXPECT_EQ(normalAxis(a, b, c), asked);
    }
  }
}
