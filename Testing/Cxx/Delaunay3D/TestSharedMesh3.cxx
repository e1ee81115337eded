// SPDX-License-Identifier: BSD-3-Clause
// Threads that insert points into one mesh, and threads that triangulate partitions.
#include "PointsInSpace.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace
{

using namespace tipp;
using namespace tipp::test;

Tetrahedralization meshOf(const std::vector<Point3>& points, int threads, int partitions = 1)
{
  TetrahedralizationOptions options;
  options.Threads = threads;
  options.Partitions = partitions;
  return tetrahedralize(points.data(), points.size(), options);
}

void expectSame(
  const Tetrahedralization& one, const Tetrahedralization& other, const std::string& what)
{
  EXPECT_TRUE(std::equal(one.Ids.begin(), one.Ids.end(), other.Ids.begin(), other.Ids.end()))
    << what;
  EXPECT_TRUE(std::equal(one.Duplicates.begin(), one.Duplicates.end(), other.Duplicates.begin(),
    other.Duplicates.end(),
    [](const Duplicate& a, const Duplicate& b)
    { return a.Point == b.Point && a.Representative == b.Representative; }))
    << what;
}

} // namespace

TEST(SharedMesh3, AnyNumberOfThreadsMakesTheSameTetrahedra)
{
  for (const std::string& kind : kindsOfPoints())
  {
    if (kind == "lines")
    {
      continue; // too many tetrahedra: their number is quadratic in that of points
    }
    const auto points = pointsInSpace(kind, kind == "of many sizes" ? 20000 : 60000, 3);
    const Tetrahedralization one = meshOf(points, 1);
    for (const int threads : { 2, 3, 4, 7 })
    {
      expectSame(one, meshOf(points, threads), kind + " " + std::to_string(threads));
    }
  }
}

TEST(SharedMesh3, ThreadsOfPartitionsMakeTheSameTetrahedra)
{
  for (const char* const kind : { "uniform", "clustered", "coarse" })
  {
    const auto points = pointsInSpace(kind, 20000, 5);
    const Tetrahedralization one = meshOf(points, 1);
    for (const int threads : { 2, 4 })
    {
      expectSame(one, meshOf(points, threads, 24), kind + std::to_string(threads));
    }
  }
}
