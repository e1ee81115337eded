// SPDX-License-Identifier: BSD-3-Clause
// Two runs with the same options give the same triangles in the same order.
#include "Comparison.h"

#include <algorithm>

namespace
{

using namespace tipp;
using namespace tipp::test;

class Determinism : public testing::TestWithParam<Schedule>
{
};

bool sameOrder(const Triangulation& a, const Triangulation& b)
{
  return std::equal(a.Ids32.begin(), a.Ids32.end(), b.Ids32.begin(), b.Ids32.end()) &&
    std::equal(a.Ids64.begin(), a.Ids64.end(), b.Ids64.begin(), b.Ids64.end());
}

TEST_P(Determinism, TheOrderOfTrianglesDependsOnlyOnTheOptions)
{
  const Coordinates xy = makePointSet("clustered", 60000);
  TriangulationOptions options;
  options.Order = GetParam();
  options.Threads = 4;
  for (const int columns : { 0, 8 })
  {
    options.Columns = columns;
    options.Rows = columns;
    const Triangulation first = triangulate(view(xy), options);
    ASSERT_GT(first.triangleCount(), 0u);
    for (int again = 0; again < 5; ++again)
    {
      EXPECT_TRUE(sameOrder(first, triangulate(view(xy), options))) << describe(options);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Schedules, Determinism,
  testing::Values(Schedule::Stages, Schedule::Dynamic),
  [](const auto& info) { return info.param == Schedule::Stages ? "Stages" : "Dynamic"; });

TEST(Determinism, TheOrderOfPointsChangesOnlyIds)
{
  // Ties are broken by coordinates, not by ids.
  const Coordinates xy = makePointSet("lattice", 2500);
  const std::int64_t count = std::int64_t(xy.size() / 2);
  Coordinates reversed;
  for (std::int64_t i = count - 1; i >= 0; --i)
  {
    reversed.push_back(xy[std::size_t(2 * i)]);
    reversed.push_back(xy[std::size_t(2 * i + 1)]);
  }
  Triangles renamed;
  for (const Triangle& t : trianglesOf(triangulate(view(reversed))))
  {
    renamed.push_back(canonical(count - 1 - t[0], count - 1 - t[1], count - 1 - t[2]));
  }
  const Triangles expected = trianglesOf(triangulate(view(xy)));
  EXPECT_TRUE(sameTriangles(xy, sorted(std::move(renamed)), expected));
}

} // namespace
