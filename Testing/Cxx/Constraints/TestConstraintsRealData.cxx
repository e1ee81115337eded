// SPDX-License-Identifier: BSD-3-Clause
// Real boundaries and breaklines.
#include "Comparison.h"
#include "ConstrainedOracle.h"
#include "Constraints/ConstraintEdges.h"
#include "Constraints/Insertion/KeepInside.h"
#include "Constraints/ResolveCrossings.h"
#include "Constraints/TableConstraints.h"
#include "InMemory/TriangulateTable.h"
#include "RealData.h"

#include "Adcirc/AdcircGrid.h"
#include "Constraints/Insertion/TriangulateConstrained.h"

#include <fstream>
#include <string>

namespace
{

using namespace tipp;
using namespace tipp::test;

/// Reads a closed polygon. The file begins with the number of its corners.
Coordinates readPolygon(const std::string& path)
{
  std::ifstream file(path);
  std::size_t count = 0;
  int attributes = 0;
  file >> count >> attributes;
  Coordinates xy(2 * count);
  for (double& value : xy)
  {
    file >> value;
  }
  EXPECT_TRUE(file) << path;
  return xy;
}

std::vector<Constraint> closedChain(const Coordinates& xy)
{
  const std::int64_t count = std::int64_t(xy.size() / 2);
  std::vector<Constraint> chain;
  for (std::int64_t i = 0; i < count; ++i)
  {
    chain.push_back({ i, (i + 1) % count });
  }
  return chain;
}

class RealConstraints : public testing::TestWithParam<std::string>
{
};

TEST_P(RealConstraints, PolygonIsInTheTriangulation)
{
  TIPP_REQUIRE_REAL_DATA(path, "constraints/" + GetParam() + ".txt");
  const Coordinates xy = readPolygon(path);
  const std::vector<Constraint> chain = closedChain(xy);
  EXPECT_TRUE(isConstrained(xy, chain, triangulateConstrained(view(xy), chain)));
}

INSTANTIATE_TEST_SUITE_P(Files, RealConstraints, testing::Values("LakeSuperior", "Sweden"),
  [](const auto& info) { return info.param; });

/// With all edges of a mesh as constraints, the result must include all its triangles.
void expectElementsBack(const AdcircMesh& mesh)
{
  std::vector<Constraint> edges;
  Triangles elements;
  for (const Triangle& t : mesh.Elements)
  {
    elements.push_back(canonical(t[0], t[1], t[2]));
    for (std::size_t i = 0; i < 3; ++i)
    {
      edges.push_back({ t[i], t[(i + 1) % 3] });
    }
  }
  const ConstrainedTriangulation result =
    triangulateConstrained(view(mesh.Nodes), edges, CrossingRule::Refuse);
  const Triangles triangles = trianglesOf(result.Mesh);
  elements = sorted(std::move(elements));
  EXPECT_TRUE(std::includes(triangles.begin(), triangles.end(), elements.begin(), elements.end()));
  EXPECT_TRUE(isConstrained(mesh.Nodes, edges, result));
}

TEST(RealConstraints, ReproduceEveryElementOfEC95d)
{
  TIPP_REQUIRE_REAL_DATA(path, "adcirc/ec95d/ec95d.grd");
  expectElementsBack(readAdcirc(path));
}

TEST(RealConstraints, ReproduceEveryElementOfInternalOverflow)
{
  TIPP_REQUIRE_REAL_DATA(path, "adcirc/internal_overflow/internal_overflow.grd");
  expectElementsBack(readAdcirc(path));
}

/// A mesh in FreeFem's format: vertices, triangles and border edges, each with a label.
struct FreeFemMesh
{
  AdcircMesh Mesh;
  std::vector<Constraint> Border;
};

FreeFemMesh readFreeFem(const std::string& path)
{
  std::ifstream file(path);
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::size_t edges = 0;
  double label = 0;
  file >> vertices >> triangles >> edges;
  FreeFemMesh result;
  for (std::size_t i = 0; i < vertices; ++i)
  {
    double x = 0;
    double y = 0;
    file >> x >> y >> label;
    result.Mesh.Nodes.insert(result.Mesh.Nodes.end(), { x, y });
  }
  for (std::size_t i = 0; i < triangles; ++i)
  {
    std::int64_t a = 0;
    std::int64_t b = 0;
    std::int64_t c = 0;
    file >> a >> b >> c >> label;
    result.Mesh.Elements.push_back({ a - 1, b - 1, c - 1 });
  }
  for (std::size_t i = 0; i < edges; ++i)
  {
    Constraint edge{};
    file >> edge.A >> edge.B >> label;
    result.Border.push_back({ edge.A - 1, edge.B - 1 });
  }
  EXPECT_TRUE(file) << path;
  return result;
}

/// A weir is a slot in the mesh. Its two sides continue in other boundaries or meet at their ends.
TEST(RealConstraints, BoundariesCutGridsWithWeirs)
{
  for (const char* const name :
    { "adcirc/internal_overflow/internal_overflow.grd", "adcirc/ec95d/ec95d.grd" })
  {
    TIPP_REQUIRE_REAL_DATA(path, name);
    const AdcircGrid grid = readAdcircGrid(path);
    PointTable points;
    points.XY = grid.XY;
    TableConstraints constraints;
    constraints.Boundary = readBoundary(path);
    const ConstrainedTriangulation result = triangulateTable(points, constraints, {});
    EXPECT_EQ(grid.XY.size(), points.XY.size());
    // By Euler's formula, all triangulations of the inside have this number of triangles.
    EXPECT_EQ(grid.Triangles.size() / 3, result.Mesh.triangleCount()) << name;
  }
}

TEST(RealConstraints, ReproduceEveryElementOfLacLeman)
{
  TIPP_REQUIRE_REAL_DATA(path, "constraints/lac-leman-v4.msh");
  expectElementsBack(readFreeFem(path).Mesh);
}

/// The borders are the lake's shore and those of its islands, in any orientation.
TEST(RealConstraints, BorderOfLacLemanCutsTheLake)
{
  TIPP_REQUIRE_REAL_DATA(path, "constraints/lac-leman-v4.msh");
  const FreeFemMesh lake = readFreeFem(path);
  ConstrainedTriangulation result =
    triangulateConstrained(view(lake.Mesh.Nodes), lake.Border, CrossingRule::Refuse);
  const std::vector<IdSegment>& segments = result.Constraints.Segments;
  keepInside(view(lake.Mesh.Nodes), result.Mesh, segments, { {}, segments, {} });
  // By Euler's formula, all triangulations of the lake have this number of triangles.
  EXPECT_EQ(lake.Mesh.Elements.size(), result.Mesh.triangleCount());
}

/// The file lists one shoreline after the other. The last point of each equals its first.
TEST(RealConstraints, ShorelinesAreInTheTriangulation)
{
  TIPP_REQUIRE_REAL_DATA(path, "coast/gshhg-2.3.7-full-ec95d-box.lonlat.txt.xz");
  Coordinates xy = readCompressedTable(path, ' ', false, 0, 1);
  constexpr std::size_t most = 20000; // more take the oracle too long
  xy.resize(2 * most);
  std::vector<Constraint> constraints;
  for (std::size_t i = 1; i < most; ++i)
  {
    const double dx = xy[2 * i] - xy[2 * i - 2];
    const double dy = xy[2 * i + 1] - xy[2 * i - 1];
    constexpr double longest = 0.05; // in degrees; a longer step leads to the next shoreline
    if (dx * dx + dy * dy < longest * longest)
    {
      constraints.push_back({ std::int64_t(i - 1), std::int64_t(i) });
    }
  }
  EXPECT_TRUE(isConstrained(xy, constraints, triangulateConstrained(view(xy), constraints)));
}

} // namespace
