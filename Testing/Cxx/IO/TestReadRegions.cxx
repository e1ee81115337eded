// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/ReadRegions.h"

#include "ExpectIOError.h"
#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

class ReadRegions : public testing::Test
{
protected:
  const std::string Lines = "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n1 0\n1 1 2\n0\n"; ///< and no hole
  const TemporaryFolder Folder;
};

TEST_F(ReadRegions, OfAPolyFileHaveTheirAreas)
{
  const std::vector<RegionLimit> regions = readRegions(this->Folder.file(
    "a.poly", this->Lines + "3\n1 0.25 0.5 7 0.01\n2 0.5 0.25 0.02\n3 1 2 7 -1\n"));
  ASSERT_EQ(regions.size(), 3U);
  EXPECT_EQ(regions[0].Seed, (Point2{ 0.25, 0.5 }));
  EXPECT_EQ(regions[0].LargestArea, 0.01);
  EXPECT_EQ(regions[1].LargestArea, 0.02); // the attribute, as there is no other number
  EXPECT_TRUE(std::isinf(regions[2].LargestArea));
}

TEST_F(ReadRegions, OfPointsHaveAreasOrSizes)
{
  const std::vector<RegionLimit> areas =
    readRegions(this->Folder.file("a.csv", "x,y,area\n1,2,0.5\n3,4,2\n"));
  ASSERT_EQ(areas.size(), 2U);
  EXPECT_EQ(areas[1].Seed, (Point2{ 3, 4 }));
  EXPECT_EQ(areas[1].LargestArea, 2);
  const std::vector<RegionLimit> sizes =
    readRegions(this->Folder.file("b.csv", "x,y,size\n1,2,2\n"));
  ASSERT_EQ(sizes.size(), 1U);
  EXPECT_DOUBLE_EQ(sizes[0].LargestArea, std::sqrt(3.0)); // of the equilateral triangle
}

TEST_F(ReadRegions, WithoutALimitOrARegionAreRefused)
{
  const auto expectRefused = [](const std::string& path, const std::string& words)
  { expectIOError(path, words, [&] { readRegions(path); }); };
  expectRefused(this->Folder.file("a.csv", "x,y,depth\n1,2,3\n"), "no column 'area' or 'size'");
  expectRefused(this->Folder.file("b.csv", "x,y,area,size\n1,2,3,4\n"), "'area' and 'size'");
  expectRefused(this->Folder.file("c.csv", "x,y,area\n1,2,0\n"), "give numbers above 0");
  expectRefused(this->Folder.file("a.poly", this->Lines), "no regions");
  expectRefused(this->Folder.file("b.poly", this->Lines + "2\n1 0 0 1 1\n"), "b.poly");
}

} // namespace
