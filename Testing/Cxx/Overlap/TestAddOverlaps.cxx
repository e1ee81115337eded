// SPDX-License-Identifier: BSD-3-Clause
#include "OverlapTesting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

using namespace tipp;
using namespace tipp::test;

namespace
{

OverlapSums overlapsOf(const ValuedMesh& target, const ValuedMesh& source, int threads = 2)
{
  OverlapSums sums(target.cells(), 2);
  EXPECT_TRUE(addOverlaps(target.view(), source.source(), sums, threads, {}));
  return sums;
}

ExactSums exactSums(const ValuedMesh& target, std::int64_t cell, const ValuedMesh& source)
{
  ExactSums sums;
  const ExactPolygon triangle = exactTriangle(target, cell);
  for (std::int64_t i = 0; i < source.cells() && !triangle.empty(); ++i)
  {
    ExactPolygon part = exactTriangle(source, i);
    for (std::size_t k = 0; k < 3 && !part.empty(); ++k)
    {
      const ExactPoint& a = triangle[k];
      const ExactPoint& b = triangle[(k + 1) % 3];
      part = exactlyClipped(part, a.X, a.Y, b.X, b.Y);
    }
    sums.add(source, i, part);
  }
  return sums;
}

void expectExact(const ValuedMesh& target, const ValuedMesh& source, double error)
{
  const OverlapSums sums = overlapsOf(target, source);
  for (std::int64_t i = 0; i < target.cells(); ++i)
  {
    expectNear(exactSums(target, i, source), sums.of(i), error);
  }
}

/// Expects that the integrals over all targets are those over all sources, which they cover.
void expectKept(const ValuedMesh& source, const OverlapSums& sums)
{
  ExactSums whole;
  for (std::int64_t i = 0; i < source.cells(); ++i)
  {
    whole.add(source, i, exactTriangle(source, i));
  }
  const mpq_class expected[3] = { whole.Area, whole.OfCells, whole.OfPoints };
  for (int k = 0; k < 3; ++k)
  {
    const mpq_class apart = (totalOf(sums, k) - expected[k]) / expected[0];
    EXPECT_LE(std::fabs(apart.get_d()), 1e-14) << k;
  }
}

/// A square of 2 x size x size triangles.
ValuedMesh grid(int size, Point2 low, double width)
{
  ValuedMesh mesh;
  for (int y = 0; y <= size; ++y)
  {
    for (int x = 0; x <= size; ++x)
    {
      mesh.Points.push_back({ low.x + x * width / size, low.y + y * width / size, 0 });
      mesh.OfPoints.push_back(x - 2.0 * y);
    }
  }
  for (int y = 0; y < size; ++y)
  {
    for (int x = 0; x < size; ++x)
    {
      const std::int64_t a = std::int64_t(y) * (size + 1) + x;
      const std::int64_t b = a + size + 1;
      mesh.Ids.insert(mesh.Ids.end(), { a, a + 1, b + 1, a, b + 1, b });
      mesh.OfCells.insert(mesh.OfCells.end(), { 1.0 + x * y, 3.0 - x });
    }
  }
  return mesh;
}

} // namespace

TEST(Overlaps, OfRandomMeshesAreExact)
{
  for (std::uint64_t seed = 0; seed < 5; ++seed)
  {
    expectExact(randomMesh(20, 2 * seed, false), randomMesh(25, 2 * seed + 1, false), 1e-16);
  }
}

TEST(Overlaps, OfMeshesFarFromTheOriginAreExact)
{
  const Point2 shift{ 0x1p30, -0x1p31 };
  expectExact(randomMesh(20, 1, false, shift), randomMesh(25, 2, false, shift), 1e-15);
}

TEST(Overlaps, OfClockwiseTrianglesAreTheSame)
{
  const ValuedMesh target = randomMesh(20, 1, false);
  ValuedMesh source = randomMesh(25, 2, false);
  for (std::size_t i = 0; i < source.Ids.size(); i += 6)
  {
    std::swap(source.Ids[i], source.Ids[i + 1]);
  }
  expectExact(target, source, 1e-16);
  expectExact(source, target, 1e-16);
}

TEST(Overlaps, KeepTheIntegrals)
{
  const ValuedMesh source = randomMesh(3000, 1, true);
  const ValuedMesh target = randomMesh(2000, 2, true);
  expectKept(source, overlapsOf(target, source));
}

TEST(Overlaps, KeepTheIntegralsInOneCell)
{
  const ValuedMesh source = randomMesh(20000, 1, true);
  expectKept(source, overlapsOf(oneTriangle({ -1, -1 }, { 5, -1 }, { -1, 5 }, 0), source));
}

TEST(Overlaps, KeepTheIntegralOfOneCell)
{
  const ValuedMesh source = oneTriangle({ 0.1, 0.2 }, { 0.9, 0.3 }, { 0.4, 0.8 }, 3);
  expectKept(source, overlapsOf(randomMesh(20000, 1, true), source));
}

TEST(Overlaps, OfAMeshWithItselfAreItsCells)
{
  const ValuedMesh mesh = randomMesh(500, 3, false);
  const OverlapSums sums = overlapsOf(mesh, mesh);
  const std::vector<double> shares = sharesOfTriangles(mesh.view(), sums, 2);
  for (std::int64_t i = 0; i < mesh.cells(); ++i)
  {
    const double value = mesh.OfCells[std::size_t(i)];
    EXPECT_EQ(shares[std::size_t(i)], 1);
    EXPECT_NEAR(sums.meanOf(i, 0), value, 2e-16 * std::fabs(value));
  }
}

TEST(Overlaps, OfNestedMeshesAreWholeCells)
{
  const ValuedMesh coarse = grid(4, { 0, 0 }, 4);
  const ValuedMesh fine = grid(16, { 0, 0 }, 4);
  expectExact(coarse, fine, 1e-14);
  expectExact(fine, coarse, 1e-14);
  for (const double share : sharesOfTriangles(fine.view(), overlapsOf(fine, coarse), 2))
  {
    EXPECT_EQ(share, 1);
  }
}

TEST(Overlaps, OfMeshesThatTouchAreEmpty)
{
  const ValuedMesh left = grid(5, { 0.1, 0.3 }, 1.1);
  ValuedMesh right = grid(3, { 0.1 + 1.1, 0 }, 1.7);
  const OverlapSums sums = overlapsOf(left, right);
  for (std::int64_t i = 0; i < left.cells(); ++i)
  {
    EXPECT_EQ(sums.areaOf(i), 0);
    EXPECT_TRUE(std::isnan(sums.meanOf(i, 0)));
  }
}

TEST(Overlaps, OfMeshesApartAreEmpty)
{
  const ValuedMesh mesh = grid(5, { 0, 0 }, 1);
  EXPECT_EQ(totalOf(overlapsOf(mesh, grid(5, { 7, 7 }, 1)), 0), 0);
}

TEST(Overlaps, AreDecidedExactly)
{
  // The next double above the diagonal.
  const Point2 corner{ 1.0 / 3, std::nextafter(1.0 / 3, 1) };
  const ValuedMesh below = oneTriangle({ 0, 0 }, { 1, 0 }, { 1, 1 }, 1);
  const ValuedMesh above = oneTriangle(corner, { 0, 0.9 }, { 0, 0.5 }, 1);
  const ValuedMesh across = oneTriangle({ 1.0 / 3, 1.0 / 3 - 1e-12 }, { 0, 0.9 }, { 0, 0.5 }, 1);
  EXPECT_EQ(overlapsOf(below, above).areaOf(0), 0);
  EXPECT_GT(overlapsOf(below, across).areaOf(0), 0);
}

TEST(Overlaps, LeaveOutCellsWithoutArea)
{
  ValuedMesh source = grid(2, { 0, 0 }, 1);
  source.Ids.insert(source.Ids.end(), { 0, 4, 8, 3, 3, 5 });
  source.OfCells.insert(source.OfCells.end(), { 1e9, 1e9 });
  ValuedMesh target = grid(3, { 0, 0 }, 1);
  target.Ids.insert(target.Ids.end(), { 0, 5, 10 });
  target.OfCells.push_back(0);
  const OverlapSums sums = overlapsOf(target, source);
  EXPECT_EQ(sums.areaOf(target.cells() - 1), 0);
  EXPECT_EQ(sharesOfTriangles(target.view(), sums, 1).back(), 0);
  expectExact(target, source, 1e-15);
}

TEST(Overlaps, OfThinCellsKeepTheirAreas)
{
  const double thin = 1e-9;
  const ValuedMesh source = oneTriangle({ 0, 0 }, { 1, thin }, { 0.5, 2 * thin }, 2);
  const ValuedMesh target = randomMesh(200, 4, true);
  const OverlapSums sums = overlapsOf(target, source);
  const double area = exactArea(exactTriangle(source, 0)).get_d();
  EXPECT_NEAR(totalOf(sums, 0).get_d(), area, 1e-6 * area);
}

TEST(Overlaps, OfCellsThatOverlapCountTwice)
{
  ValuedMesh source = oneTriangle({ 0, 0 }, { 1, 0 }, { 0, 1 }, 2);
  source.Ids.insert(source.Ids.end(), { 0, 1, 2 });
  source.OfCells.push_back(4);
  const ValuedMesh target = oneTriangle({ 0, 0 }, { 0.5, 0 }, { 0, 0.5 }, 0);
  const OverlapSums sums = overlapsOf(target, source);
  EXPECT_EQ(sharesOfTriangles(target.view(), sums, 1)[0], 2);
  EXPECT_EQ(sums.meanOf(0, 0), 3);
}

TEST(Overlaps, LeaveOutCellsWithCornersThatAreNotFinite)
{
  ValuedMesh source = grid(2, { 0, 0 }, 1);
  source.Points[0].x = NAN;
  source.Points[8].y = INFINITY;
  const OverlapSums sums = overlapsOf(grid(1, { 0, 0 }, 1), source);
  EXPECT_EQ(totalOf(sums, 0), mpq_class(1, 2));
}

TEST(Overlaps, DoNotDependOnThreads)
{
  const ValuedMesh source = randomMesh(6000, 1, true);
  const ValuedMesh target = randomMesh(5000, 2, true);
  const OverlapSums one = overlapsOf(target, source, 1);
  const OverlapSums several = overlapsOf(target, source, 5);
  for (std::int64_t i = 0; i < target.cells(); ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_EQ(one.of(i)[k].Sum, several.of(i)[k].Sum);
      EXPECT_EQ(one.of(i)[k].Rest, several.of(i)[k].Rest);
    }
  }
}

TEST(Overlaps, OfPartsOfASourceAddUp)
{
  const ValuedMesh source = randomMesh(300, 1, true);
  const ValuedMesh target = randomMesh(200, 2, true);
  OverlapSums sums(target.cells(), 2);
  for (const std::int64_t begin : { std::int64_t(0), source.cells() / 3 })
  {
    OverlapSource part = source.source();
    part.Mesh.Ids = source.Ids.data() + 3 * begin;
    part.Mesh.Cells = (begin == 0 ? source.cells() / 3 : source.cells()) - begin;
    part.Fields[0].Values += begin;
    EXPECT_TRUE(addOverlaps(target.view(), part, sums, 2, {}));
  }
  expectKept(source, sums);
}

TEST(Overlaps, StopOnRequest)
{
  const ValuedMesh mesh = grid(5, { 0, 0 }, 1);
  OverlapSums sums(mesh.cells(), 2);
  EXPECT_FALSE(addOverlaps(mesh.view(), mesh.source(), sums, 1, [](double) { return false; }));
}
