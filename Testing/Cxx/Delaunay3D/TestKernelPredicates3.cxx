// SPDX-License-Identifier: BSD-3-Clause
// The kernel's predicates agree with the exact ones, even after they have found a common unit of
// the coordinates and then rely on doubles.
#include "Kernel/KernelPredicates.h"
#include "Predicates/ExactPredicates3.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>
#include <vector>

namespace
{

using namespace tipp;

/// Points of a lattice. Half of them are close together, and many of these lie on common spheres.
/// The others lie almost on common spheres, which sums of products in doubles cannot decide.
std::vector<Point3> latticePoints(double unit, double offset, std::mt19937& random)
{
  std::vector<Point3> points(1); // index 0 is the infinite vertex
  std::uniform_int_distribution<int> near(0, 6);
  std::uniform_int_distribution<int> beside(-1, 1);
  for (int i = 0; i < 4000; ++i)
  {
    const auto coordinate = [&] {
      return offset + unit * (i % 2 == 0 ? near(random) : 0x1p49 * near(random) + beside(random));
    };
    const double x = coordinate();
    const double y = coordinate();
    points.push_back({ x, y, coordinate() });
  }
  return points;
}

class KernelPredicates3On : public testing::TestWithParam<std::pair<double, double>>
{
};

TEST_P(KernelPredicates3On, Lattice)
{
  const auto [unit, offset] = GetParam();
  std::mt19937 random(7);
  const std::vector<Point3> points = latticePoints(unit, offset, random);
  KernelPredicates3 predicates;
  predicates.restart(points.data(), points.size());
  std::uniform_int_distribution<TetrahedronMesh::Index> any(1, points.size() - 1);
  int ties = 0;
  for (int trial = 0; trial < 100000; ++trial)
  {
    TetrahedronMesh::Index v[4] = { any(random), any(random), any(random), any(random) };
    const Point3& p = points[any(random)];
    const int side = orientation3(points[v[0]], points[v[1]], points[v[2]], points[v[3]]);
    ASSERT_EQ(side, predicates.orientation(points[v[0]], points[v[1]], points[v[2]], points[v[3]]));
    if (side == 0)
    {
      continue;
    }
    if (side < 0)
    {
      std::swap(v[0], v[1]);
    }
    const Point3& a = points[v[0]];
    const Point3& b = points[v[1]];
    const Point3& c = points[v[2]];
    const Point3& d = points[v[3]];
    ties += inSphere(a, b, c, d, p) == 0 ? 1 : 0;
    ASSERT_EQ(inSpherePerturbed(a, b, c, d, p), predicates.isInFiniteConflict(v, p));
  }
  EXPECT_GT(ties, 100); // enough calls that the predicates have looked for a common unit
}

// Units whose fifth powers are in the range of doubles, and some whose are not. Multiples of 0.1
// have no common unit, since they are rounded.
INSTANTIATE_TEST_SUITE_P(Units, KernelPredicates3On,
  testing::Values(std::pair(1.0, 0.0), std::pair(0.25, 4096.0), std::pair(0.1, 0.0),
    std::pair(0x1p-170, 0.0), std::pair(0x1p-200, 0.0), std::pair(0x1p170, 0.0)));

} // namespace
