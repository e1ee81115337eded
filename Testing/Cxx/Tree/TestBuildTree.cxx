// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/MeshTiling.h"

#include "ReferenceTree.h"

#include "Files/IOError.h"
#include "Partition/ClassifyCells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

using tipp::BoxTiling;
using tipp::buildTree;
using tipp::TreeOptions;

namespace
{

TreeOptions options(std::int64_t threshold, std::int64_t chunk = 1 << 20)
{
  TreeOptions result;
  result.Threshold = threshold;
  result.ChunkCells = chunk;
  result.Threads = 2;
  return result;
}

BoxTiling build(const CellSet& cells, std::int64_t threshold, std::int64_t chunk = 1 << 20)
{
  return buildTree(sourceOf(cells), cells.bounds(), options(threshold, chunk));
}

void expectSameTree(const BoxTiling& expected, const BoxTiling& actual)
{
  EXPECT_EQ(expected.children(), actual.children());
}

// Slivers beside each other along the square's diagonal.
CellSet slivers(std::size_t count)
{
  CellSet cells;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double shift = 1e-6 * static_cast<double>(i);
    cells.Coordinates.insert(
      cells.Coordinates.end(), { 0.0, shift, 1.0 - shift, 1.0, 1.0 - 1.5 * shift, 1.0 });
  }
  return cells;
}

} // namespace

TEST(BuildTree, EqualsTheReferenceTreeForTriangles)
{
  for (const CellSet& cells : { latticeTriangles(16, 0.0), latticeTriangles(15, 0.4) })
  {
    for (const std::int64_t threshold : { 1000, 50, 10, 3 })
    {
      expectTree(referenceTree(cells, threshold), build(cells, threshold));
    }
  }
}

TEST(BuildTree, EqualsTheReferenceTreeForTetrahedra)
{
  for (const CellSet& cells : { latticeTetrahedra(4, 0.0), latticeTetrahedra(4, 0.4) })
  {
    for (const std::int64_t threshold : { 200, 60 })
    {
      expectTree(referenceTree(cells, threshold), build(cells, threshold));
    }
  }
}

TEST(BuildTree, EqualsTheReferenceTreeForCellsOfAllSizes)
{
  const CellSet triangles = cellSoup(2, 3, 500, 1);
  expectTree(referenceTree(triangles, 20), build(triangles, 20));
  const CellSet tetrahedra = cellSoup(3, 4, 150, 2);
  expectTree(referenceTree(tetrahedra, 20), build(tetrahedra, 20));
  const CellSet around = fan(300);
  expectTree(referenceTree(around, 10), build(around, 10));
}

TEST(BuildTree, ChunksChangeNothing)
{
  for (const CellSet& cells : { latticeTriangles(24, 0.4), cellSoup(2, 3, 1000, 3), fan(1000),
         latticeTetrahedra(6, 0.3), cellSoup(3, 4, 500, 4) })
  {
    const BoxTiling whole = build(cells, 25);
    for (const std::int64_t chunk : { 1, 7, 100, 999 })
    {
      expectSameTree(whole, build(cells, 25, chunk));
    }
  }
}

TEST(BuildTree, TheOrderOfTheCellsChangesNothing)
{
  const CellSet cells = cellSoup(2, 3, 2000, 5);
  CellSet reversed = cells;
  std::reverse(reversed.Coordinates.begin(), reversed.Coordinates.end());
  // Each corner is now (y, x); exchanges the coordinates.
  for (std::size_t i = 0; i < reversed.Coordinates.size(); i += 2)
  {
    std::swap(reversed.Coordinates[i], reversed.Coordinates[i + 1]);
  }
  expectSameTree(build(cells, 30), build(reversed, 30, 300));
}

TEST(BuildTree, ThreadsChangeNothing)
{
  const CellSet cells = cellSoup(3, 4, 3000, 6);
  TreeOptions one = options(100);
  one.Threads = 1;
  TreeOptions five = options(100);
  five.Threads = 5;
  expectSameTree(buildTree(sourceOf(cells), cells.bounds(), one),
    buildTree(sourceOf(cells), cells.bounds(), five));
}

TEST(BuildTree, SmallCellsLeaveNoLeafAboveTheThreshold)
{
  const CellSet cells = latticeTriangles(60, 0.3);
  const BoxTiling tree = build(cells, 100, 500);
  const tipp::Membership members = tipp::classifyCells(cells.view(), tree);
  std::vector<std::int64_t> counts(std::size_t(tree.count()), 0);
  for (const auto* const ids : { &members.Owner, &members.Borrowers })
  {
    for (const std::int32_t id : *ids)
    {
      ++counts[std::size_t(id)];
    }
  }
  EXPECT_LE(*std::max_element(counts.begin(), counts.end()), 100);
}

TEST(BuildTree, AMeshIsReadFewTimes)
{
  const CellSet cells = latticeTriangles(60, 0.3);
  tipp::CellSource source = sourceOf(cells);
  std::int64_t cellsRead = 0;
  const auto read = source.Read;
  source.Read = [&](std::int64_t first, std::int64_t count, std::vector<double>& coordinates)
  {
    cellsRead += count;
    read(first, count, coordinates);
  };
  buildTree(source, cells.bounds(), options(100, 500));
  EXPECT_LE(cellsRead, 3 * source.Cells);
  cellsRead = 0;
  buildTree(source, cells.bounds(), options(100)); // one chunk
  EXPECT_EQ(cellsRead, source.Cells);
}

TEST(BuildTree, ManyCellsAtOnePointAreNotSplitForEver)
{
  // All triangles have the centre as a corner, and are at least a quarter of the square long.
  CellSet cells;
  for (int i = 0; i < 500; ++i)
  {
    const double angle = 6.283 * i / 500;
    cells.Coordinates.insert(cells.Coordinates.end(),
      { 0.3, 0.3, 0.3 + std::cos(angle), 0.3 + std::sin(angle), 0.3 + std::cos(angle + 0.01),
        0.3 + std::sin(angle + 0.01) });
  }
  const BoxTiling tree = build(cells, 10);
  EXPECT_LE(tree.count(), 64);
}

TEST(BuildTree, SliversBesideEachOtherAreNotSplitForEver)
{
  const BoxTiling tree = build(slivers(500), 10);
  EXPECT_LE(tree.count(), 16);
}

TEST(BuildTree, TinyCellsAtOnePointEndAtTheGreatestDepth)
{
  CellSet cells = latticeTriangles(2, 0.0);
  for (int i = 0; i < 100; ++i)
  {
    const double tiny = 1e-12;
    cells.Coordinates.insert(
      cells.Coordinates.end(), { 0.3, 0.3, 0.3 + tiny, 0.3, 0.3, 0.3 + tiny });
  }
  const BoxTiling tree = build(cells, 10);
  EXPECT_EQ(tree.count(), 1 + 3 * BoxTiling::MaxDepth);
}

// A lattice with one point far away. The cells at this point are as wide as the domain, so no box
// meets only a few of them.
TEST(BuildTree, CellsThatOverlapEverywhereAreRefused)
{
  const auto pointAt = [](int i, int j)
  {
    return i == 1 && j == 1 ? std::array<double, 2>{ 2147483647, 3 }
                            : std::array<double, 2>{ double(i), double(j) };
  };
  CellSet cells;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      for (const auto& corner : { pointAt(i, j), pointAt(i + 1, j), pointAt(i + 1, j + 1),
             pointAt(i, j), pointAt(i + 1, j + 1), pointAt(i, j + 1) })
      {
        cells.Coordinates.insert(cells.Coordinates.end(), corner.begin(), corner.end());
      }
    }
  }
  try
  {
    build(cells, 4);
    ADD_FAILURE() << "a tree was built";
  }
  catch (const tipp::IOError& error)
  {
    EXPECT_NE(std::string::npos, std::string(error.what()).find("overlap")) << error.what();
  }
}

TEST(BuildTree, WithoutCellsThereIsOneLeaf)
{
  CellSet cells = latticeTriangles(2, 0.0);
  const tipp::Box3 domain = cells.bounds();
  cells.Coordinates.clear();
  const BoxTiling tree = buildTree(sourceOf(cells), domain, options(1));
  EXPECT_EQ(tree.count(), 1);
}

TEST(BuildTree, AFlatMeshInSpaceIsCutAlongItsTwoAxes)
{
  CellSet cells;
  cells.Dimension = 3;
  const CellSet flat = latticeTriangles(16, 0.2);
  for (std::size_t i = 0; i < flat.Coordinates.size(); i += 2)
  {
    cells.Coordinates.insert(
      cells.Coordinates.end(), { flat.Coordinates[i], 5.0, flat.Coordinates[i + 1] });
  }
  expectSameTree(build(flat, 30), build(cells, 30));
}

TEST(BuildTree, ReportsAnInvalidCell)
{
  CellSet cells = latticeTriangles(20, 0.0);
  const tipp::Box3 domain = cells.bounds();
  cells.Coordinates[6 * 333 + 1] = std::nan("");
  expectFailure([&] { buildTree(sourceOf(cells), domain, options(30, 100)); },
    "Cell 333 has a corner whose coordinates are not finite");
  for (const std::size_t i : { 0, 2, 4 })
  {
    cells.Coordinates[6 * 333 + i] = 7.0;
    cells.Coordinates[6 * 333 + i + 1] = 7.0;
  }
  expectFailure([&] { buildTree(sourceOf(cells), domain, options(30, 100)); },
    "Cell 333 lies outside the domain");
}

TEST(BuildTree, RefusesAnInvalidDomain)
{
  const CellSet cells = latticeTriangles(2, 0.0);
  const tipp::Box3 inverted = { { 1, 0, 0 }, { 0, 1, 0 } };
  expectFailure(
    [&] { buildTree(sourceOf(cells), inverted, options(9)); }, "no finite bounds along axis 0");
}
