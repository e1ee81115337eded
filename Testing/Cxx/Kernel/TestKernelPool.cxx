// SPDX-License-Identifier: BSD-3-Clause
#include "KernelTesting.h"

#include "Kernel/DelaunayKernel.h"

namespace
{

using namespace tipp;
using namespace tipp::test;

TEST(KernelPool, TheNextKernelReusesTheMemory)
{
  const std::vector<Point2> points = pointSet("uniform", 5000);
  std::size_t used = 0;
  {
    PooledKernel pooled;
    insert(*pooled, points);
    used = (*pooled).bytes();
  }
  EXPECT_LE(5000 * (2 * 32 + sizeof(Point2)), used);
  EXPECT_LE(used, PooledKernel::bytesKept());
  PooledKernel next;
  EXPECT_EQ(used, (*next).bytes());
}

TEST(KernelPool, AKernelUsedBeforeGivesTheSameTriangles)
{
  {
    PooledKernel pooled;
    insert(*pooled, pointSet("lattice", 2500));
  }
  const std::vector<Point2> points = pointSet("clustered", 700);
  PooledKernel pooled;
  (*pooled).clear();
  insert(*pooled, points);
  DelaunayKernel fresh;
  insert(fresh, points);
  EXPECT_EQ(finiteTriangles(fresh), finiteTriangles(*pooled));
  EXPECT_TRUE(isDelaunay(*pooled, points));
}

TEST(KernelPool, KernelsInUseAtTheSameTimeAreDifferent)
{
  PooledKernel a;
  PooledKernel b;
  EXPECT_NE(&*a, &*b);
}

TEST(KernelPool, ALargeKernelIsNotKept)
{
  const std::vector<Point2> points = pointSet("uniform", 200000);
  {
    PooledKernel pooled;
    insert(*pooled, points);
    ASSERT_LT(PooledKernel::MostBytesKept, (*pooled).bytes());
  }
  EXPECT_GE(PooledKernel::MostBytesKept, PooledKernel::bytesKept());
  PooledKernel next;
  EXPECT_GE(PooledKernel::MostBytesKept, (*next).bytes());
}

} // namespace
