// SPDX-License-Identifier: BSD-3-Clause
#include "ExpectIOError.h"
#include "Series/MeshSeries.h"
#include "SharedData.h"
#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;
using Doubles = std::vector<double>;
using Ids = std::vector<std::int64_t>;

const SeriesOptions wrapped{ {}, true };

class LongitudesOfCells : public testing::Test
{
protected:
  TemporaryFolder Folder;
  /// Two triangles, of which the second crosses the 180th meridian; depths are 1 to 4.
  const std::string Grid = this->Folder.file(
    "fort.14", "title\n2 4\n1 170 0 1\n2 178 0 2\n3 178 5 3\n4 -179 2 4\n1 3 1 2 3\n2 3 2 4 3\n");
};

TEST_F(LongitudesOfCells, AreOnBothSidesOfTheMeridianWhereTheyCrossIt)
{
  const auto series = openMeshSeries(this->Grid, wrapped);
  EXPECT_EQ(7, series->Nodes);
  const SeriesMesh mesh = series->readMesh();
  EXPECT_EQ((Ids{ 0, 1, 1 }), mesh.OriginalCells);
  EXPECT_EQ((Doubles{ 170, 0, 178, 0, 178, 5, -179, 2, 181, 2, -182, 0, -182, 5 }), mesh.XY);
  EXPECT_EQ((Ids{ 0, 1, 2, 1, 4, 2, 5, 3, 6 }), mesh.Triangles);
  Doubles depth;
  series->read(0, 0, depth);
  EXPECT_EQ((Doubles{ 1, 2, 3, 4, 4, 2, 3 }), depth);
}

TEST_F(LongitudesOfCells, AroundTheEarthNeedWrap)
{
  expectIOError(this->Grid, "give --wrap", [&] { openMeshSeries(this->Grid)->readMesh(); });
}

TEST_F(LongitudesOfCells, AreNotWrappedInMetres)
{
  const std::string grid =
    this->Folder.file("fort.14", "title\n1 3\n1 1000 0 1\n2 1300 0 2\n3 1000 300 3\n1 3 1 2 3\n");
  expectIOError(grid, "no longitude and latitude", [&] { openMeshSeries(grid, wrapped); });
}

TEST_F(LongitudesOfCells, OfACellAroundAPoleAreLeftOutWithItsIndex)
{
  const std::string grid = this->Folder.file(
    "fort.14", "title\n2 4\n1 -120 80 1\n2 0 80 2\n3 120 80 3\n4 10 70 4\n1 3 1 2 3\n2 3 2 1 4\n");
  const auto series = openMeshSeries(grid, wrapped);
  const SeriesMesh mesh = series->readMesh();
  EXPECT_EQ((Ids{ 1 }), mesh.OriginalCells);
  ASSERT_EQ(1U, series->LeftOut.size());
  EXPECT_EQ("cell 0", series->LeftOut[0].Name);
}

TEST(RealLongitudes, OfAGlobalMeshCoverTheGlobeOnce)
{
  TIPP_REQUIRE_DATA(path, "adcirc/global/fort.14");
  const auto series = openMeshSeries(path, wrapped);
  const SeriesMesh mesh = series->readMesh();
  // 376 triangles cross the meridian, and one of them is around the pole.
  EXPECT_EQ(50859 + 375 - 1, std::int64_t(mesh.Triangles.size() / 3));
  double widest = 0;
  for (std::size_t t = 0; t < mesh.Triangles.size(); t += 3)
  {
    const auto x = [&](std::size_t corner)
    { return mesh.XY[2 * std::size_t(mesh.Triangles[t + corner])]; };
    widest = std::max({ widest, std::fabs(x(0) - x(1)), std::fabs(x(1) - x(2)) });
  }
  EXPECT_LE(widest, 180);
}

} // namespace
