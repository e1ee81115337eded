// SPDX-License-Identifier: BSD-3-Clause
// Each rank also builds the tree alone, and compares it with that of all ranks.
#include "Partitioning/MeshTiling.h"
#include "Ranks/Communicator.h"

#include "CellSets.h"
#include "ReferenceTree.h"

#include "vtkDummyController.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

#include <cmath>

using tipp::BoxTiling;
using tipp::buildTree;
using tipp::Communicator;
using tipp::TreeOptions;

namespace
{

vtkMultiProcessController* world()
{
  return vtkMultiProcessController::GetGlobalController();
}

TreeOptions options(std::int64_t threshold, std::int64_t chunk)
{
  TreeOptions result;
  result.Threshold = threshold;
  result.ChunkCells = chunk;
  result.Threads = 1;
  return result;
}

void expectTreeOfOneRank(const CellSet& cells, std::int64_t threshold)
{
  const tipp::CellSource source = sourceOf(cells);
  const BoxTiling alone = buildTree(source, cells.bounds(), options(threshold, 1 << 20), nullptr);
  for (const std::int64_t chunk : { 1 << 20, 37 })
  {
    const BoxTiling together =
      buildTree(source, cells.bounds(), options(threshold, chunk), world());
    EXPECT_EQ(alone.children(), together.children());
  }
}

} // namespace

TEST(TreeRanks, AnyNumberOfRanksMakesTheTreeOfOneForTriangles)
{
  for (const std::int64_t threshold : { 1, 2, 4, 30, 200, 100000 })
  {
    expectTreeOfOneRank(latticeTriangles(20, 0.4), threshold);
    expectTreeOfOneRank(cellSoup(2, 3, 700, 1), threshold);
  }
  expectTreeOfOneRank(latticeTriangles(20, 0.0), 20);
  expectTreeOfOneRank(fan(1000), 20);
}

TEST(TreeRanks, AnyNumberOfRanksMakesTheTreeOfOneForTetrahedra)
{
  for (const std::int64_t threshold : { 5, 40, 300 })
  {
    expectTreeOfOneRank(latticeTetrahedra(6, 0.4), threshold);
    expectTreeOfOneRank(cellSoup(3, 4, 300, 2), threshold);
  }
}

TEST(TreeRanks, EqualsTheReferenceTree)
{
  const CellSet cells = cellSoup(2, 3, 300, 3);
  expectTree(
    referenceTree(cells, 15), buildTree(sourceOf(cells), cells.bounds(), options(15, 20), world()));
}

TEST(TreeRanks, AcceptsFewerCellsThanRanks)
{
  expectTreeOfOneRank(latticeTriangles(1, 0.0), 1);
}

TEST(TreeRanks, ADummyControllerIsOneRank)
{
  const CellSet cells = cellSoup(2, 3, 300, 4);
  vtkNew<vtkDummyController> dummy;
  const BoxTiling alone = buildTree(sourceOf(cells), cells.bounds(), options(15, 1000), nullptr);
  const BoxTiling withDummy = buildTree(sourceOf(cells), cells.bounds(), options(15, 1000), dummy);
  EXPECT_EQ(alone.children(), withDummy.children());
}

TEST(TreeRanks, AnErrorOnOneRankIsReportedOnAll)
{
  CellSet cells = latticeTriangles(20, 0.0);
  const tipp::Box3 domain = cells.bounds();
  cells.Coordinates[6 * 799] = std::nan("");
  expectFailure([&] { buildTree(sourceOf(cells), domain, options(15, 100), world()); },
    "Cell 799 has a corner");
}

TEST(TreeRanks, AReaderThatFailsOnOneFailsOnAll)
{
  const CellSet cells = latticeTriangles(20, 0.0);
  tipp::CellSource source = sourceOf(cells);
  const auto read = source.Read;
  source.Read = [&](std::int64_t first, std::int64_t count, std::vector<double>& coordinates)
  {
    if (first + count == source.Cells)
    {
      throw std::runtime_error("The disk is gone.");
    }
    read(first, count, coordinates);
  };
  if (Communicator(world()).size() > 1)
  {
    expectFailure(
      [&] { buildTree(source, cells.bounds(), options(15, 100), world()); }, "The disk is gone.");
  }
}

TEST(TreeRanks, ReduceMergesEachRanksBytesOnceInOrder)
{
  Communicator ranks(world());
  const std::string all = ranks.reduce(std::string(1, static_cast<char>('a' + ranks.rank())),
    [](const std::string& a, const std::string& b) { return a + b; });
  EXPECT_EQ(all,
    ranks.isFirst() ? std::string("abcdefgh").substr(0, std::size_t(ranks.size())) : std::string());
}

TEST(TreeRanks, AMergeThatFailsOnOneFailsOnAll)
{
  Communicator ranks(world());
  if (ranks.size() > 1)
  {
    expectFailure(
      [&]
      {
        ranks.reduce("x",
          [](const std::string&, const std::string&) -> std::string
          { throw std::runtime_error("They do not go together."); });
      },
      "They do not go together.");
  }
}
