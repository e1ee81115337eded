// SPDX-License-Identifier: BSD-3-Clause
// The triangles are those of CGAL for every input, partitioning, thread count and schedule.
#include "Comparison.h"

#include <cctype>

namespace
{

using namespace tipp;
using namespace tipp::test;

struct Grid
{
  int Columns;
  int Rows;
};

struct PointSet
{
  std::string Name;
  std::size_t Count;
};

/// Keeps the last reference, since the tests of one input follow each other.
const Reference& cachedReference(const std::string& name, const Coordinates& xy)
{
  static std::string of;
  static Reference cached;
  if (of != name)
  {
    cached = reference(xy);
    of = name;
  }
  return cached;
}

class Exactness : public testing::TestWithParam<std::tuple<PointSet, Grid>>
{
};

TEST_P(Exactness, IsCgalsForAllThreadsAndSchedules)
{
  const auto& [set, grid] = GetParam();
  const Coordinates xy = makePointSet(set.Name, set.Count);
  const Reference& expected = cachedReference(set.Name, xy);
  ASSERT_GT(expected.Mesh.size(), 0u);
  TriangulationOptions options;
  options.Columns = grid.Columns;
  options.Rows = grid.Rows;
  for (const Schedule schedule : { Schedule::Stages, Schedule::Dynamic })
  {
    for (int threads = 1; threads <= 4; ++threads)
    {
      options.Order = schedule;
      options.Threads = threads;
      ASSERT_TRUE(matches(xy, triangulate(view(xy), options), expected)) << describe(options);
    }
  }
}

const PointSet pointSets[] = { { "uniform", 5000 }, { "clustered", 5000 }, { "kuzmin", 5000 },
  { "lattice", 4900 }, { "lattice-shuffled", 4900 }, { "coast", 5000 }, { "lattice-tenths", 4900 },
  { "lattice-jittered", 4900 }, { "circle", 1000 }, { "cocircular", 1500 },
  { "collinear-and-one", 1500 }, { "survey-lines", 3000 }, { "duplicates", 5000 },
  { "duplicate-lattice", 6000 }, { "tiny-1e-300", 2000 }, { "denormal", 2000 },
  { "huge-1e300", 2000 }, { "steps-at-1e12", 4000 }, { "largest-doubles", 1000 },
  { "negative", 4000 }, { "one-far-away", 4000 }, { "two-clusters", 4000 }, { "parabola", 1500 },
  { "spiral", 3000 }, { "sorted", 4000 }, { "with-rejected", 3000 } };

const Grid grids[] = { { 0, 0 }, { 1, 1 }, { 2, 2 }, { 5, 3 }, { 8, 8 }, { 32, 32 } };

std::string nameOf(const testing::TestParamInfo<Exactness::ParamType>& info)
{
  const auto& [set, grid] = info.param;
  std::string name = set.Name + "_" +
    (grid.Columns == 0 ? "automatic"
                       : std::to_string(grid.Columns) + "x" + std::to_string(grid.Rows));
  for (char& c : name)
  {
    c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(PointSets, Exactness,
  testing::Combine(testing::ValuesIn(pointSets), testing::ValuesIn(grids)), nameOf);

/// Large enough for many boxes in a tiling of automatic size.
class ManyPoints : public testing::TestWithParam<std::string>
{
};

TEST_P(ManyPoints, AutomaticPartitionsGiveCgalsTriangles)
{
  const Coordinates xy = makePointSet(GetParam(), 160000, 7);
  TriangulationOptions options;
  options.Threads = 2;
  ASSERT_TRUE(matches(xy, triangulate(view(xy), options), reference(xy)));
}

INSTANTIATE_TEST_SUITE_P(PointSets, ManyPoints,
  testing::Values("uniform", "clustered", "kuzmin", "coast", "lattice", "duplicates", "sorted"),
  [](const auto& info) { return info.param; });

} // namespace
