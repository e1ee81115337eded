// SPDX-License-Identifier: BSD-3-Clause
// Meshes of storm-surge models, shores and surveys (see the folder TIPP_SHARED_DATA).
#include "Comparison.h"
#include "RealData.h"

#include <algorithm>

namespace
{

using namespace tipp;
using namespace tipp::test;

/// The elements of the mesh, counted from 1 as in the file, that are not among the triangles.
std::vector<std::size_t> lackingElements(const AdcircMesh& mesh, const Triangles& triangles)
{
  std::vector<std::size_t> lacking;
  for (std::size_t i = 0; i < mesh.Elements.size(); ++i)
  {
    if (!std::binary_search(triangles.begin(), triangles.end(), mesh.Elements[i]))
    {
      lacking.push_back(i + 1);
    }
  }
  return lacking;
}

TriangulationOptions twoThreads()
{
  TriangulationOptions options;
  options.Threads = 2;
  return options;
}

TEST(RealData, TheNodesOfEC95dGiveItsMesh)
{
  TIPP_REQUIRE_REAL_DATA(path, "adcirc/ec95d/ec95d.grd");
  const AdcircMesh mesh = readAdcirc(path);
  const Triangles triangles = trianglesOf(triangulate(view(mesh.Nodes), twoThreads()));
  // 2 n - 2 - h triangles, where h = 36 of the n = 31,435 nodes lie on the hull's border as
  // doubles. One of these lies in the middle of a side: 62,833 triangles would include one without
  // area.
  EXPECT_EQ(62832u, triangles.size());
  // One element at the open boundary is not Delaunay.
  EXPECT_EQ(std::vector<std::size_t>{ 58167 }, lackingElements(mesh, triangles));
}

TEST(RealData, TheNodesOfInternalOverflowGiveItsMesh)
{
  TIPP_REQUIRE_REAL_DATA(path, "adcirc/internal_overflow/internal_overflow.grd");
  const AdcircMesh mesh = readAdcirc(path);
  const Triangles triangles = trianglesOf(triangulate(view(mesh.Nodes), twoThreads()));
  EXPECT_EQ(5377u, triangles.size());
  EXPECT_EQ(std::vector<std::size_t>{}, lackingElements(mesh, triangles));
}

class AdcircNodes : public testing::TestWithParam<std::string>
{
};

TEST_P(AdcircNodes, AreTriangulatedAsByCgal)
{
  TIPP_REQUIRE_REAL_DATA(path, "adcirc/" + GetParam());
  const Coordinates nodes = readAdcirc(path).Nodes;
  const Reference expected = reference(nodes);
  TriangulationOptions options = twoThreads();
  for (const int columns : { 0, 1, 8, 32 })
  {
    options.Columns = columns;
    options.Rows = columns;
    ASSERT_TRUE(matches(nodes, triangulate(view(nodes), options), expected)) << describe(options);
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, AdcircNodes,
  testing::Values("ec95d/ec95d.grd", "internal_overflow/internal_overflow.grd", "apes/fort.14",
    "shinnecock/fort.14", "global/fort.14"),
  [](const auto& info)
  {
    std::string name = info.param.substr(0, info.param.find('/'));
    return name;
  });

struct Table
{
  const char* Name;
  const char* Path;
  char Separator;
  bool Header;
  std::size_t X;
  std::size_t Y;
};

class Survey : public testing::TestWithParam<Table>
{
};

TEST_P(Survey, IsTriangulatedAsByCgal)
{
  const Table& table = GetParam();
  TIPP_REQUIRE_REAL_DATA(path, table.Path);
  const Coordinates xy = readCompressedTable(path, table.Separator, table.Header, table.X, table.Y);
  EXPECT_TRUE(matches(xy, triangulate(view(xy), twoThreads()), reference(xy)));
}

INSTANTIATE_TEST_SUITE_P(Tables, Survey,
  testing::Values(Table{ "magnetic", "points/osborne-magnetic.csv.xz", ',', true, 1, 2 },
    Table{ "gravity", "points/southern-africa-gravity.csv.xz", ',', true, 0, 1 },
    Table{ "shores", "coast/gshhg-2.3.7-full-ec95d-box.lonlat.txt.xz", ' ', false, 0, 1 }),
  [](const auto& info) { return std::string(info.param.Name); });

} // namespace
