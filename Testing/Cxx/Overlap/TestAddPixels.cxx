// SPDX-License-Identifier: BSD-3-Clause
#include "OverlapTesting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

using namespace tipp;
using namespace tipp::test;

namespace
{

Lattice latticeOf(Point2 first, Point2 delta, int columns, int rows)
{
  Lattice lattice;
  lattice.Min = { first.x, first.y, 0 };
  lattice.Delta = { delta.x, delta.y, 1 };
  lattice.Extent = { 0, columns - 1, 0, rows - 1, 0, 0 };
  return lattice;
}

OverlapSums pixelsOf(const Lattice& lattice, const ValuedMesh& mesh, int threads = 2)
{
  OverlapSums sums(lattice.samples(), 2);
  EXPECT_TRUE(addPixels(lattice, mesh.source(), sums, threads, {}));
  return sums;
}

/// Compares pixels whose borders are binary fractions with rational numbers.
void expectExact(const Lattice& lattice, const ValuedMesh& mesh, double error)
{
  const OverlapSums sums = pixelsOf(lattice, mesh);
  for (std::int64_t row = 0; row < lattice.size(1); ++row)
  {
    for (std::int64_t column = 0; column < lattice.size(0); ++column)
    {
      const mpq_class low[2] = { lattice.Min[0] + (double(column) - 0.5) * lattice.Delta[0],
        lattice.Min[1] + (double(row) - 0.5) * lattice.Delta[1] };
      const mpq_class high[2] = { low[0] + mpq_class(lattice.Delta[0]),
        low[1] + mpq_class(lattice.Delta[1]) };
      ExactSums expected;
      for (std::int64_t cell = 0; cell < mesh.cells(); ++cell)
      {
        ExactPolygon part = exactTriangle(mesh, cell);
        part = exactlyClipped(part, low[0], low[1], high[0], low[1]);
        part = exactlyClipped(part, high[0], low[1], high[0], high[1]);
        part = exactlyClipped(part, high[0], high[1], low[0], high[1]);
        part = exactlyClipped(part, low[0], high[1], low[0], low[1]);
        expected.add(mesh, cell, part);
      }
      expectNear(expected, sums.of(row * lattice.size(0) + column), error);
    }
  }
}

ValuedMesh twoTriangles(double low, double high)
{
  ValuedMesh mesh = oneTriangle({ low, low }, { high, low }, { high, high }, 1);
  mesh.Points.push_back({ low, high, 0 });
  mesh.Ids.insert(mesh.Ids.end(), { 0, 2, 3 });
  mesh.OfCells.push_back(3);
  mesh.OfPoints.push_back(7);
  return mesh;
}

std::vector<double> sharesOf(const Lattice& lattice, const ValuedMesh& mesh)
{
  return sharesOfPixels(lattice, { 0, 1 }, pixelsOf(lattice, mesh), 2);
}

} // namespace

TEST(Pixels, OfRandomMeshesAreExact)
{
  for (std::uint64_t seed = 0; seed < 3; ++seed)
  {
    const ValuedMesh mesh = randomMesh(15, seed, false);
    expectExact(latticeOf({ -0.125, -0.125 }, { 0.125, 0.25 }, 11, 6), mesh, 1e-16);
    expectExact(latticeOf({ 0.5, 0.25 }, { 0.03125, 0.0625 }, 9, 5), mesh, 1e-16);
    expectExact(latticeOf({ 0.5, 0.5 }, { 4, 4 }, 1, 1), mesh, 1e-15);
  }
}

TEST(Pixels, FarFromTheOriginAreExact)
{
  const Point2 shift{ 0x1p30, -0x1p31 };
  const Lattice lattice = latticeOf({ shift.x, shift.y }, { 0.125, 0.0625 }, 9, 17);
  expectExact(lattice, randomMesh(15, 5, false, shift), 1e-16);
}

TEST(Pixels, InLargeTrianglesAreExact)
{
  expectExact(latticeOf({ 0.5, 0.5 }, { 1, 1 }, 16, 16), twoTriangles(-3, 40), 1e-13);
  expectExact(latticeOf({ 0.5, 0.5 }, { 1, 1 }, 16, 16), twoTriangles(0, 16), 1e-13);
}

TEST(Pixels, KeepTheIntegrals)
{
  const ValuedMesh mesh = randomMesh(3000, 1, true);
  const OverlapSums sums = pixelsOf(latticeOf({ 0.005, 0.005 }, { 0.01, 0.01 }, 100, 100), mesh);
  ExactSums whole;
  for (std::int64_t i = 0; i < mesh.cells(); ++i)
  {
    whole.add(mesh, i, exactTriangle(mesh, i));
  }
  const mpq_class expected[3] = { whole.Area, whole.OfCells, whole.OfPoints };
  for (int k = 0; k < 3; ++k)
  {
    const mpq_class apart = totalOf(sums, k) - expected[k];
    EXPECT_LE(std::fabs(apart.get_d()), 1e-14) << k;
  }
}

TEST(Pixels, WithBordersOnEdgesAreCoveredOnce)
{
  // 0.1 is no binary fraction: borders and corners are rounded.
  for (const double share :
    sharesOf(latticeOf({ 0.05, 0.05 }, { 0.1, 0.1 }, 10, 10), twoTriangles(0, 1)))
  {
    EXPECT_NEAR(share, 1, 1e-14);
  }
}

TEST(Pixels, BesideTheMeshAreNotCovered)
{
  const Lattice lattice = latticeOf({ 0.05 + 1e6, 0.05 + 1e6 }, { 0.1, 0.1 }, 14, 14);
  const std::vector<double> shares = sharesOf(lattice, twoTriangles(1e6 + 0.1, 1e6 + 0.9));
  for (std::size_t i = 0; i < shares.size(); ++i)
  {
    const bool isInside = i % 14 >= 1 && i % 14 < 9 && i / 14 >= 1 && i / 14 < 9;
    EXPECT_NEAR(shares[i], isInside ? 1 : 0, isInside ? 1e-8 : 0) << i;
  }
}

TEST(Pixels, InsideACellAreWhole)
{
  for (const double share : sharesOf(latticeOf({ 0.15, 0.25 }, { 0.1, 0.1 }, 20, 30),
         oneTriangle({ -9, -9 }, { 20, -9 }, { -9, 20 }, 5)))
  {
    EXPECT_EQ(share, 1);
  }
}

TEST(Pixels, CutByTheBorderHaveTheMeanOfTheirCoveredPart)
{
  const Lattice lattice = latticeOf({ 0.5, 0.5 }, { 1, 1 }, 1, 1);
  const ValuedMesh mesh = oneTriangle({ 0, 0 }, { 1, 0 }, { 0, 1 }, 6);
  EXPECT_EQ(sharesOf(lattice, mesh)[0], 0.5);
  EXPECT_EQ(pixelsOf(lattice, mesh).meanOf(0, 0), 6);
}

TEST(Pixels, OfAPartOfALatticeAreTheSame)
{
  const ValuedMesh mesh = randomMesh(100, 1, false);
  const Lattice whole = latticeOf({ 0.013, 0.017 }, { 0.03, 0.02 }, 30, 50);
  const OverlapSums all = pixelsOf(whole, mesh);
  Lattice part = whole;
  part.Extent = { 7, 21, 11, 47, 0, 0 };
  const OverlapSums some = pixelsOf(part, mesh);
  for (std::int64_t row = 11; row <= 47; ++row)
  {
    for (std::int64_t column = 7; column <= 21; ++column)
    {
      const RunningSum* const expected = all.of(row * 30 + column);
      const RunningSum* const found = some.of((row - 11) * 15 + column - 7);
      EXPECT_NEAR(found[0].value(), expected[0].value(), 1e-17);
      EXPECT_NEAR(found[2].value(), expected[2].value(), 1e-17);
    }
  }
}

TEST(Pixels, DoNotDependOnThreads)
{
  const ValuedMesh mesh = randomMesh(2000, 1, true);
  const Lattice lattice = latticeOf({ 0, 0 }, { 0.007, 0.007 }, 140, 140);
  const OverlapSums one = pixelsOf(lattice, mesh, 1);
  const OverlapSums several = pixelsOf(lattice, mesh, 5);
  for (std::int64_t i = 0; i < one.targets(); ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_EQ(one.of(i)[k].Sum, several.of(i)[k].Sum);
      EXPECT_EQ(one.of(i)[k].Rest, several.of(i)[k].Rest);
    }
  }
}
