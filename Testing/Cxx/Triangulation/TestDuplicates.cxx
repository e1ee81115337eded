// SPDX-License-Identifier: BSD-3-Clause
// Every point is a vertex, a duplicate with its representative, or rejected.
#include "Comparison.h"

#include <set>

namespace
{

using namespace tipp;
using namespace tipp::test;

TEST(Duplicates, EveryPointIsAccountedFor)
{
  Coordinates xy = makePointSet("with-rejected", 3000);
  for (std::size_t i = 0; i < 2000; ++i)
  {
    xy.push_back(xy[i]);
  }
  const Triangulation result = triangulate(view(xy));
  std::set<PointId> told;
  for (const Triangle& t : trianglesOf(result))
  {
    told.insert(t.begin(), t.end());
  }
  const std::size_t vertices = told.size();
  for (const Duplicate& d : result.Duplicates)
  {
    EXPECT_TRUE(told.count(d.Representative)) << "of duplicate " << d.Point;
    told.insert(d.Point);
  }
  told.insert(result.Rejected.begin(), result.Rejected.end());
  EXPECT_EQ(xy.size() / 2, told.size());
  EXPECT_EQ(xy.size() / 2, vertices + result.Duplicates.size() + result.Rejected.size());
}

TEST(Duplicates, TheRepresentativeIsTheLowestIdEvenIfACopyIsInsertedFirst)
{
  // The copies of each corner lie far apart in the input.
  Coordinates xy = makePointSet("uniform", 1000);
  const Coordinates once(xy);
  for (std::size_t i = once.size(); i > 0; i -= 2)
  {
    xy.push_back(once[i - 2]);
    xy.push_back(once[i - 1]);
  }
  const Triangulation result = triangulate(view(xy));
  ASSERT_EQ(1000u, result.Duplicates.size());
  for (const Duplicate& d : result.Duplicates)
  {
    EXPECT_EQ(1999 - d.Point, d.Representative);
  }
}

TEST(Duplicates, CopiesOnPartitionBordersAreFound)
{
  // 8 x 8 partitions of [0, 8] x [0, 8]. Every point lies on a border, and occurs four times.
  Coordinates xy;
  for (int copy = 0; copy < 4; ++copy)
  {
    for (int i = 0; i < 81; ++i)
    {
      xy.push_back(i % 9);
      xy.push_back(i / 9);
    }
  }
  TriangulationOptions options;
  options.Columns = 8;
  options.Rows = 8;
  for (int threads = 1; threads <= 4; ++threads)
  {
    options.Threads = threads;
    ASSERT_TRUE(matches(xy, triangulate(view(xy), options), reference(xy))) << describe(options);
  }
}

TEST(Duplicates, ManyCopiesOfOnePointAmongOthers)
{
  Coordinates xy = makePointSet("uniform", 500);
  for (int i = 0; i < 20000; ++i)
  {
    xy.push_back(0.25);
    xy.push_back(0.75);
  }
  TriangulationOptions options;
  for (const int columns : { 0, 4 })
  {
    options.Columns = columns;
    options.Rows = columns;
    ASSERT_TRUE(matches(xy, triangulate(view(xy), options), reference(xy))) << describe(options);
  }
}

} // namespace
