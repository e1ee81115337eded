// SPDX-License-Identifier: BSD-3-Clause
#include "Partition/ClassifyCells.h"

#include "CellSets.h"
#include "ExpectAcceleratorError.h"
#include "RequireDevice.h"

#include <gtest/gtest.h>

#include <cmath>

using tipp::Box3;
using tipp::BoxTiling;
using tipp::classifyCells;
using tipp::ClassifyOptions;
using tipp::Membership;

namespace
{

ClassifyOptions threads(int count)
{
  ClassifyOptions options;
  options.Device.Kind = tipp::Device::OpenMP;
  options.Threads = count;
  return options;
}

ClassifyOptions openCl(std::uint64_t memory = 0)
{
  ClassifyOptions options;
  options.Device.Kind = tipp::Device::OpenCL;
  options.DeviceMemory = memory;
  return options;
}

void expectExact(const CellSet& cells, const BoxTiling& tiling)
{
  expectEqual(bruteForce(cells, tiling), classifyCells(cells.view(), tiling, threads(2)));
}

void expectSameOnDevice(const CellSet& cells, const BoxTiling& tiling, std::uint64_t memory = 0)
{
  expectEqual(classifyCells(cells.view(), tiling, threads(2)),
    classifyCells(cells.view(), tiling, openCl(memory)));
}

BoxTiling gridOf(const CellSet& cells, int n)
{
  return BoxTiling::grid(cells.Dimension, cells.bounds(), { n, n, n });
}

CellSet oneTriangle(double x0, double y0, double x1, double y1, double x2, double y2)
{
  CellSet cells;
  cells.Coordinates = { x0, y0, x1, y1, x2, y2 };
  return cells;
}

} // namespace

TEST(ClassifyCells, TheLowestPartitionMetOwnsAndTheOthersBorrow)
{
  const BoxTiling tiling = BoxTiling::grid(2, { { 0, 0, 0 }, { 4, 4, 0 } }, { 2, 2, 1 });
  // The triangle meets the lower two boxes and the upper right one, but not the upper left one.
  const CellSet cells = oneTriangle(1, 1, 3, 1, 3, 2.5);
  const Membership result = classifyCells(cells.view(), tiling, threads(1));
  EXPECT_EQ(result.Owner, (std::vector<std::int32_t>{ 0 }));
  EXPECT_EQ(result.BorrowerStart, (std::vector<std::int64_t>{ 0, 2 }));
  EXPECT_EQ(result.Borrowers, (std::vector<std::int32_t>{ 1, 3 }));
}

TEST(ClassifyCells, TouchingAPartitionsCornerCounts)
{
  const BoxTiling tiling = BoxTiling::grid(2, { { 0, 0, 0 }, { 4, 4, 0 } }, { 2, 2, 1 });
  const CellSet cells = oneTriangle(3, 3, 2, 2, 3, 2.5);
  const Membership result = classifyCells(cells.view(), tiling, threads(1));
  EXPECT_EQ(result.Owner[0], 0);
  EXPECT_EQ(result.Borrowers, (std::vector<std::int32_t>{ 1, 2, 3 }));
}

TEST(ClassifyCells, WithoutCellsThereAreNoMembers)
{
  const CellSet cells;
  const BoxTiling tiling = BoxTiling::grid(2, { { 0, 0, 0 }, { 1, 1, 0 } }, { 2, 2, 1 });
  const Membership result = classifyCells(cells.view(), tiling, threads(2));
  EXPECT_TRUE(result.Owner.empty());
  EXPECT_EQ(result.BorrowerStart, (std::vector<std::int64_t>{ 0 }));
}

TEST(ClassifyCells, ExactInAGridWhoseBordersPassThroughTheNodes)
{
  const CellSet triangles = latticeTriangles(12, 0.0);
  expectExact(triangles, gridOf(triangles, 4));
  const CellSet tetrahedra = latticeTetrahedra(4, 0.0);
  expectExact(tetrahedra, gridOf(tetrahedra, 2));
}

TEST(ClassifyCells, ExactInAGridWhoseBordersPassNextToTheNodes)
{
  const CellSet triangles = latticeTriangles(14, 0.0);
  expectExact(triangles, gridOf(triangles, 5));
  const CellSet tetrahedra = latticeTetrahedra(4, 0.0);
  expectExact(tetrahedra, gridOf(tetrahedra, 3));
}

TEST(ClassifyCells, ExactForJitteredMeshesInGridsAndTrees)
{
  const CellSet triangles = latticeTriangles(12, 0.4);
  expectExact(triangles, gridOf(triangles, 5));
  expectExact(triangles, randomTree(2, triangles.bounds(), 4, 1));
  const CellSet tetrahedra = latticeTetrahedra(4, 0.4);
  expectExact(tetrahedra, gridOf(tetrahedra, 3));
  expectExact(tetrahedra, randomTree(3, tetrahedra.bounds(), 2, 2));
}

TEST(ClassifyCells, ExactForCellsOfAllLengthsInGridsAndTrees)
{
  const CellSet triangles = cellSoup(2, 3, 400, 1);
  expectExact(triangles, gridOf(triangles, 8));
  expectExact(triangles, randomTree(2, triangles.bounds(), 5, 3));
  const CellSet tetrahedra = cellSoup(3, 4, 200, 2);
  expectExact(tetrahedra, gridOf(tetrahedra, 4));
  expectExact(tetrahedra, randomTree(3, tetrahedra.bounds(), 3, 4));
}

TEST(ClassifyCells, ExactForManyCellsAtOnePoint)
{
  const CellSet cells = fan(400);
  expectExact(cells, randomTree(2, cells.bounds(), 5, 5));
}

TEST(ClassifyCells, ExactForTrianglesInSpace)
{
  const CellSet cells = surface(latticeTriangles(10, 0.0));
  expectExact(cells, gridOf(cells, 3));
  expectExact(cells, randomTree(3, cells.bounds(), 3, 6));
}

TEST(ClassifyCells, ATilingOfThePlaneUsesXAndYOfTrianglesInSpace)
{
  const CellSet flat = latticeTriangles(10, 0.3);
  const CellSet inSpace = surface(flat);
  const BoxTiling tiling = gridOf(flat, 4);
  expectEqual(classifyCells(flat.view(), tiling, threads(2)),
    classifyCells(inSpace.view(), tiling, threads(2)));
}

TEST(ClassifyCells, TheNumberOfThreadsChangesNothing)
{
  const CellSet cells = cellSoup(2, 3, 100000, 3);
  const BoxTiling tiling = gridOf(cells, 16);
  const Membership one = classifyCells(cells.view(), tiling, threads(1));
  expectEqual(one, classifyCells(cells.view(), tiling, threads(2)));
  expectEqual(one, classifyCells(cells.view(), tiling, threads(7)));
}

TEST(ClassifyCells, ADomainWithoutExtentIsOnePartitionAlongThatAxis)
{
  CellSet cells = oneTriangle(0, 5, 1, 5, 3, 5);
  const Membership result = classifyCells(cells.view(), gridOf(cells, 3), threads(1));
  EXPECT_EQ(result.Owner[0], 0);
  EXPECT_EQ(result.Borrowers, (std::vector<std::int32_t>{ 1, 2 }));
}

TEST(ClassifyCells, ReportsTheFirstInvalidCell)
{
  CellSet cells = latticeTriangles(100, 0.0);
  const BoxTiling tiling = gridOf(cells, 4);
  cells.Coordinates[6 * 19000 + 3] = std::nan("");
  cells.Coordinates[6 * 700 + 2] = HUGE_VAL;
  expectAcceleratorError([&] { classifyCells(cells.view(), tiling, threads(2)); },
    "Cell 700 has a corner whose coordinates are not finite");
  cells.Coordinates[6 * 300 + 0] = 7.0;
  cells.Coordinates[6 * 300 + 2] = 7.0;
  cells.Coordinates[6 * 300 + 4] = 7.0;
  expectAcceleratorError([&] { classifyCells(cells.view(), tiling, threads(2)); },
    "Cell 300 lies outside the domain that is partitioned");
}

TEST(ClassifyCells, ACellWhoseBoundingBoxAloneMeetsTheDomainLiesOutside)
{
  const BoxTiling tiling = BoxTiling::grid(2, { { 0, 0, 0 }, { 1, 1, 0 } }, { 1, 1, 1 });
  const CellSet cells = oneTriangle(0.5, 3, 3, 0.5, 3, 3);
  expectAcceleratorError(
    [&] { classifyCells(cells.view(), tiling, threads(1)); }, "Cell 0 lies outside the domain");
  const CellSet touching = oneTriangle(0, 2, 2, 0, 3, 3);
  EXPECT_EQ(classifyCells(touching.view(), tiling, threads(1)).Owner[0], 0);
}

TEST(ClassifyCells, RefusesCellsOfOtherKinds)
{
  CellSet cells = latticeTriangles(1, 0.0);
  const BoxTiling tiling = gridOf(cells, 1);
  const BoxTiling inSpace = BoxTiling::grid(3, cells.bounds(), { 1, 1, 1 });
  expectAcceleratorError([&] { classifyCells(cells.view(), inSpace, threads(1)); },
    "Partitions of 3 dimensions do not go with triangles in the plane");
  const CellSet tetrahedra = latticeTetrahedra(1, 0.0);
  expectAcceleratorError([&] { classifyCells(tetrahedra.view(), tiling, threads(1)); },
    "Partitions of 2 dimensions do not go with tetrahedra");
  cells.Corners = 4;
  expectAcceleratorError([&] { classifyCells(cells.view(), tiling, threads(1)); },
    "Cells are triangles, or tetrahedra in space");
}

TEST(ClassifyOnDevice, GivesTheSameIdsInGrids)
{
  TIPP_REQUIRE_OPENCL();
  for (const CellSet& cells : { latticeTriangles(64, 0.0), latticeTriangles(61, 0.4),
         cellSoup(2, 3, 20000, 4), latticeTetrahedra(12, 0.0), latticeTetrahedra(11, 0.4),
         cellSoup(3, 4, 5000, 5), surface(latticeTriangles(40, 0.0)) })
  {
    for (const int n : { 1, 2, 5, 8 })
    {
      expectSameOnDevice(cells, gridOf(cells, n));
    }
  }
}

TEST(ClassifyOnDevice, GivesTheSameIdsInTrees)
{
  TIPP_REQUIRE_OPENCL();
  for (const CellSet& cells : { latticeTriangles(64, 0.0), cellSoup(2, 3, 20000, 6), fan(5000),
         latticeTetrahedra(10, 0.4), cellSoup(3, 4, 3000, 7) })
  {
    expectSameOnDevice(cells, randomTree(cells.Dimension, cells.bounds(), 4, 7));
    expectSameOnDevice(cells, BoxTiling::tree(cells.Dimension, cells.bounds(), { -1 }));
  }
}

TEST(ClassifyOnDevice, GivesTheSameIdsForTinyAndHugeCoordinates)
{
  TIPP_REQUIRE_OPENCL();
  for (const int exponent : { -1060, -1000, -340, -150, 150, 340, 500, 1000 })
  {
    for (CellSet cells : { cellSoup(2, 3, 2000, 8), cellSoup(3, 4, 500, 9) })
    {
      for (double& value : cells.Coordinates)
      {
        value = std::ldexp(value - 0.5, exponent);
      }
      expectSameOnDevice(cells, gridOf(cells, 4));
    }
  }
}

TEST(ClassifyOnDevice, ATilingOfThePlaneUsesXAndYOfTrianglesInSpace)
{
  TIPP_REQUIRE_OPENCL();
  const CellSet flat = latticeTriangles(10, 0.3);
  expectSameOnDevice(surface(flat), gridOf(flat, 4));
}

TEST(ClassifyOnDevice, ChunksLargerThanItsMemoryAreDivided)
{
  TIPP_REQUIRE_OPENCL();
  const CellSet triangles = cellSoup(2, 3, 700, 10);
  const CellSet tetrahedra = cellSoup(3, 4, 300, 11);
  for (const std::uint64_t memory : { 1, 200, 1000, 30000 })
  {
    expectSameOnDevice(triangles, gridOf(triangles, 9), memory);
    expectSameOnDevice(tetrahedra, gridOf(tetrahedra, 5), memory);
    expectSameOnDevice(triangles, randomTree(2, triangles.bounds(), 5, 8), memory);
  }
}

TEST(ClassifyOnDevice, WithoutCellsThereAreNoMembers)
{
  TIPP_REQUIRE_OPENCL();
  CellSet cells = latticeTriangles(2, 0.0);
  const BoxTiling tiling = gridOf(cells, 2);
  cells.Coordinates.clear();
  expectSameOnDevice(cells, tiling);
}

TEST(ClassifyOnDevice, ReportsTheSameInvalidCell)
{
  TIPP_REQUIRE_OPENCL();
  CellSet cells = latticeTriangles(40, 0.0);
  const BoxTiling tiling = gridOf(cells, 4);
  cells.Coordinates[6 * 900 + 3] = std::nan("");
  expectAcceleratorError([&] { classifyCells(cells.view(), tiling, openCl()); },
    "Cell 900 has a corner whose coordinates are not finite");
  for (const std::size_t i : { 0, 2, 4 })
  {
    cells.Coordinates[6 * 300 + i] = -7.0;
  }
  expectAcceleratorError([&] { classifyCells(cells.view(), tiling, openCl()); },
    "Cell 300 lies outside the domain that is partitioned");
}
