// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/MeshTiling.h"

#include <gtest/gtest.h>

using tipp::TilingChoice;

TEST(TilingChoice, ReadsGridsAndTrees)
{
  EXPECT_EQ("grid:4x3", TilingChoice::parse("grid:4x3")->text(2));
  EXPECT_EQ("grid:4x3x1", TilingChoice::parse("grid:4x3")->text(3));
  EXPECT_EQ("grid:4x3x2", TilingChoice::parse("grid:4x3x2")->text(3));
  EXPECT_EQ("quadtree:1000", TilingChoice::parse("quadtree:1000")->text(2));
  EXPECT_EQ("octree:1000", TilingChoice::parse("octree:1000")->text(3));
}

TEST(TilingChoice, RefusesOtherTexts)
{
  for (const char* const text : { "", "grid", "grid:", "grid:4", "grid:4x", "grid:0x4", "grid:4x-1",
         "grid:4x4x4x4", "grid:4x4x", "grid:10001x1", "4x4", "quadtree:0",
         "quadtree:", "quadtree:1k", "octree:-5", "grid: 4x4" })
  {
    EXPECT_FALSE(TilingChoice::parse(text)) << text;
  }
}
