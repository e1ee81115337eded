// SPDX-License-Identifier: BSD-3-Clause
#include "QueryTesting.h"

#include "Predicates/ExactPredicates.h"
#include "Query/Queries.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace tipp;
using namespace tipp::test;

TEST(Regions, ContainPointsOnTheirBorder)
{
  const ZoneShape shape(
    { rectangle(0.25, 0.75, 0.25, 0.5), rectangle(0.375, 0.5, 0.375, 0.5, true) }, 0);
  EXPECT_TRUE(shape.holds({ 0.25, 0.3 }));
  EXPECT_TRUE(shape.holds({ 0.75, 0.5 }));
  EXPECT_TRUE(shape.holds({ 0.4, 0.375 }));
  EXPECT_TRUE(shape.holds({ 0.3, 0.4 }));
  EXPECT_FALSE(shape.holds({ 0.4, 0.4 }));
  EXPECT_FALSE(shape.holds({ 0.1, 0.25 }));
  EXPECT_FALSE(shape.holds({ 0.8, 0.5 }));
  EXPECT_FALSE(shape.holds({ std::nextafter(0.25, 0.0), 0.3 }));
}

TEST(Regions, BoxesOfTetrahedraAreTheSameForAnyPieces)
{
  const SourceMesh source = makeSource(latticeTetrahedra(4, 0));
  const Region box = { { { 0.25, 0.25, 0.5 }, { 0.6, 0.75, 0.5 } }, {} };
  const ResidentMesh whole(inMemory(source));
  const std::vector<std::int64_t> cells = cellsIn(whole, box, false);
  const std::vector<std::int64_t> points = pointsIn(whole, box);
  EXPECT_EQ(6U, points.size()); // 2 x 3 lattice points on the plane z = 0.5
  EXPECT_LT(20U, cells.size());
  EXPECT_TRUE(cellsIn(whole, box, true).empty());
  EXPECT_EQ(source.cells(), cellsIn(whole, { { { 0, 0, 0 }, { 1, 1, 1 } }, {} }, true).size());
  withEachMesh(source,
    [&](const ResidentMesh& mesh)
    {
      EXPECT_EQ(cells, cellsIn(mesh, box, false));
      EXPECT_EQ(points, pointsIn(mesh, box));
    });
}

TEST(Regions, BoxesMayBeInfinite)
{
  const double all = HUGE_VAL;
  const ResidentMesh triangles(inMemory(makeSource(latticeTriangles(8, 0.3))));
  const ResidentMesh tetrahedra(inMemory(makeSource(latticeTetrahedra(4, 0.3))));
  for (const ResidentMesh* const mesh : { &triangles, &tetrahedra })
  {
    // Few of the cells that the strip meets have a corner in it.
    const auto cells = [mesh](double end) {
      return cellsIn(*mesh, { { { 0.4, -end, -end }, { 0.401, end, end } }, {} }, false);
    };
    EXPECT_LT(5U, cells(9).size());
    EXPECT_EQ(cells(9), cells(all));
  }
}

TEST(Regions, PolygonsOverTetrahedraAreColumns)
{
  for (const double jitter : { 0.0, 0.3 })
  {
    const SourceMesh source = makeSource(latticeTetrahedra(4, jitter));
    const ResidentMesh whole(inMemory(source));
    // A rectangle over all heights is a box.
    const Region box = { { { 0.3, 0.2, -9 }, { 0.6, 0.75, 9 } }, {} };
    const Region column = { {}, { rectangle(0.3, 0.6, 0.2, 0.75) } };
    const Region notch = { {}, { { { { -1, -1 }, { 2, -1 }, { 2, 2 }, { 0.4, 0.3 } }, false } } };
    const std::vector<std::int64_t> cells = cellsIn(whole, box, false);
    EXPECT_LT(20U, cells.size());
    EXPECT_EQ(cells, cellsIn(whole, column, false));
    EXPECT_EQ(cellsIn(whole, box, true), cellsIn(whole, column, true));
    EXPECT_EQ(pointsIn(whole, box), pointsIn(whole, column));
    // A cell lies in a polygon that is not convex if all of it does, not only its corners.
    const ZoneShape shape(notch.Polygons, 0);
    std::vector<std::int64_t> met;
    std::vector<std::int64_t> inside;
    for (std::size_t cell = 0; cell < source.cells(); ++cell)
    {
      std::vector<Point2> corners;
      for (std::size_t i = 0; i < 4; ++i)
      {
        const Point3 p = pointOf(source, source.Cells[4 * cell + i]);
        corners.push_back({ p.x, p.y });
      }
      bool meets = false;
      bool isInside = true;
      for (std::size_t i = 0; i < 64; ++i) // all triangles of three corners
      {
        const Point2 face[3] = { corners[i % 4], corners[i / 4 % 4], corners[i / 16] };
        const ZoneShape::Relation relation = shape.relationTo(face);
        const bool isFlat = orientation(face[0], face[1], face[2]) == 0;
        meets = meets || (!isFlat && relation != ZoneShape::Relation::Apart);
        isInside = isInside && (isFlat || relation == ZoneShape::Relation::Inside);
      }
      if (meets)
      {
        met.push_back(std::int64_t(cell));
      }
      if (isInside)
      {
        inside.push_back(std::int64_t(cell));
      }
    }
    EXPECT_LT(inside.size(), met.size());
    withEachMesh(source,
      [&](const ResidentMesh& mesh)
      {
        EXPECT_EQ(cells, cellsIn(mesh, column, false));
        EXPECT_EQ(met, cellsIn(mesh, notch, false));
        EXPECT_EQ(inside, cellsIn(mesh, notch, true));
      });
  }
}
