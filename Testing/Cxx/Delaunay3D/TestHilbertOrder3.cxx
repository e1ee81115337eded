// SPDX-License-Identifier: BSD-3-Clause
#include "PointsInSpace.h"

#include "Kernel/InsertionOrder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{

using namespace tipp;
using namespace tipp::test;

} // namespace

TEST(InsertionOrder3, HasEveryPointOnce)
{
  for (const std::string& kind : kindsOfPoints())
  {
    const auto points = pointsInSpace(kind, 20000);
    InsertionOrder3 order;
    order.compute(points.data(), points.size());
    std::vector<bool> seen(points.size(), false);
    for (std::size_t k = 0; k < order.size(); ++k)
    {
      EXPECT_FALSE(seen[order[k]]) << kind;
      seen[order[k]] = true;
    }
    EXPECT_EQ(points.size(), order.size());
  }
}

TEST(InsertionOrder3, NeighboursOfALatticeFollowEachOther)
{
  // The last round has seven in eight of the points, in the order of a Hilbert curve. If it had all
  // points, consecutive ones would be neighbours.
  std::vector<Point3> points;
  for (int i = 0; i < 32 * 32 * 32; ++i)
  {
    points.push_back({ double(i % 32), double(i / 32 % 32), double(i / 32 / 32) });
  }
  InsertionOrder3 order;
  order.compute(points.data(), points.size());
  double sum = 0;
  const std::size_t from = points.size() / 4;
  for (std::size_t k = from; k < order.size(); ++k)
  {
    const Point3 step = points[order[k]] - points[order[k - 1]];
    sum += std::fabs(step.x) + std::fabs(step.y) + std::fabs(step.z);
  }
  EXPECT_LT(sum / double(order.size() - from), 1.4);
}
