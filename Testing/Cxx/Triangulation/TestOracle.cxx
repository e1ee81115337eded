// SPDX-License-Identifier: BSD-3-Clause
// Tests the oracle itself in rational arithmetic. No neighbour's apex lies inside a triangle's
// circumdisk, and ties do not depend on the order of insertion.
#include "Comparison.h"
#include "ExactDisk.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <random>

namespace
{

using namespace tipp;
using namespace tipp::test;

class Oracle : public testing::TestWithParam<std::string>
{
};

/// For each directed edge, the third corner of the triangle on its left.
std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> apexes(const Triangles& mesh)
{
  std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> result;
  for (const Triangle& t : mesh)
  {
    for (int i = 0; i < 3; ++i)
    {
      result[{ t[std::size_t(i)], t[std::size_t((i + 1) % 3)] }] = t[std::size_t((i + 2) % 3)];
    }
  }
  return result;
}

TEST_P(Oracle, IsLocallyDelaunayInRationalArithmetic)
{
  const Coordinates xy = makePointSet(GetParam(), 400);
  const Reference expected = reference(xy);
  ASSERT_GT(expected.Mesh.size(), 0u);
  const auto apex = apexes(expected.Mesh);
  EXPECT_EQ(3 * expected.Mesh.size(), apex.size()) << "an edge has two triangles on one side";
  for (const Triangle& t : expected.Mesh)
  {
    ASSERT_EQ(1, orientationOf(xy, t));
    for (std::size_t i = 0; i < 3; ++i)
    {
      const auto beyond = apex.find({ t[(i + 1) % 3], t[i] });
      if (beyond != apex.end())
      {
        const auto at = std::size_t(2 * beyond->second);
        ASSERT_GE(sideOfDisk(xy, t, xy[at], xy[at + 1]), 0);
      }
    }
  }
}

TEST_P(Oracle, BreaksTiesByCoordinatesAlone)
{
  const Coordinates xy = makePointSet(GetParam(), 400);
  const Reference expected = reference(xy);
  Ids ids;
  for (std::size_t i = 0; i < expected.Representative.size(); ++i)
  {
    if (expected.Representative[i] == std::int64_t(i))
    {
      ids.push_back(std::int64_t(i));
    }
  }
  std::mt19937_64 random(3);
  for (int order = 0; order < 5; ++order)
  {
    std::shuffle(ids.begin(), ids.end(), random);
    // The same points with other ids; CGAL also changes the order, since it sorts the points.
    Coordinates shuffled;
    for (const std::int64_t id : ids)
    {
      shuffled.push_back(xy[std::size_t(2 * id)]);
      shuffled.push_back(xy[std::size_t(2 * id + 1)]);
    }
    Triangles renamed;
    for (const Triangle& t : reference(shuffled).Mesh)
    {
      renamed.push_back(
        canonical(ids[std::size_t(t[0])], ids[std::size_t(t[1])], ids[std::size_t(t[2])]));
    }
    EXPECT_TRUE(sameTriangles(xy, sorted(std::move(renamed)), expected.Mesh));
  }
}

INSTANTIATE_TEST_SUITE_P(PointSets, Oracle,
  testing::Values("uniform", "clustered", "lattice", "lattice-tenths", "cocircular", "denormal",
    "tiny-1e-300", "huge-1e300", "steps-at-1e12", "duplicates", "survey-lines", "one-far-away",
    "parabola"),
  [](const auto& info)
  {
    std::string name = info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
  });

} // namespace
