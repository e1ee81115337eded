// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/MeshTiling.h"

#include "ReferenceTree.h"

#include <gtest/gtest.h>

#include <cmath>

using tipp::Box3;
using tipp::RefinementTree;

namespace
{

const Box3 Square = { { 0, 0, 0 }, { 8, 8, 0 } };

} // namespace

TEST(RefinementTree, ItsStructureIsDepthFirst)
{
  RefinementTree tree(2, Square);
  EXPECT_EQ(tree.structure(), "0");
  tree.split(0);
  tree.split(3);
  tree.split(1);
  EXPECT_EQ(tree.structure(), "1100000100000");
}

TEST(RefinementTree, IsRestoredFromItsStructure)
{
  RefinementTree tree(2, Square);
  tree.split(0);
  tree.split(3);
  tree.split(7);
  RefinementTree copy(2, Square);
  copy.refine(tree.structure());
  EXPECT_EQ(copy.structure(), tree.structure());
  EXPECT_EQ(copy.size(), tree.size());
}

TEST(RefinementTree, RefiningAddsTheSplitsOfAnotherTree)
{
  const std::string root = "10000";
  const std::string first = "110000000";
  const std::string third = "100100000";
  const auto united = [](const std::string& a, const std::string& b)
  {
    RefinementTree tree(2, Square);
    tree.refine(a);
    tree.refine(b);
    return tree.structure();
  };
  EXPECT_EQ(united("0", "0"), "0");
  EXPECT_EQ(united("0", first), first);
  EXPECT_EQ(united(first, root), first);
  EXPECT_EQ(united(first, third), "1100000100000");
  EXPECT_EQ(united(third, first), "1100000100000");
}

TEST(RefinementTree, RefusesAnInvalidStructure)
{
  const std::string tooDeep = std::string(100, '1') + std::string(301, '0');
  const std::string broken[] = { "", "1", "1000", "100000", "x", "1000x", "1111111", tooDeep };
  for (const std::string& structure : broken)
  {
    RefinementTree tree(2, Square);
    expectFailure([&] { tree.refine(structure); }, "do not make a tree");
    RefinementTree split(2, Square);
    split.split(0);
    expectFailure([&] { split.refine(structure); }, "do not make a tree");
  }
}

TEST(RefinementTree, IsCutBackToATiling)
{
  RefinementTree tree(2, Square);
  tree.split(0);
  tree.split(2);
  tree.split(1);
  const tipp::BoxTiling tiling = tree.tiling([](std::int32_t node) { return node != 2; });
  const std::vector<std::int32_t> leaves{ 9, 10, 11, 12, 2, 3, 4 };
  ASSERT_EQ(tiling.count(), 7);
  for (std::size_t i = 0; i < leaves.size(); ++i)
  {
    EXPECT_EQ(tiling.box(std::int64_t(i)).Min, tree.box(leaves[i]).Min);
    EXPECT_EQ(tiling.box(std::int64_t(i)).Max, tree.box(leaves[i]).Max);
  }
}

TEST(RefinementTree, ABoxTooSmallForDoublesIsNotSplit)
{
  const Box3 thin = { { 1, 0, 0 }, { std::nextafter(1.0, 2.0), 1, 0 } };
  EXPECT_FALSE(RefinementTree(2, thin).canSplit(0));
  EXPECT_TRUE(RefinementTree(2, Square).canSplit(0));
  EXPECT_FALSE(RefinementTree(2, { { 1, 1, 0 }, { 1, 1, 0 } }).canSplit(0));
}
