// SPDX-License-Identifier: BSD-3-Clause
#include "InitialScene.h"

#include "Triangulation/FinalSeams.h"

#include <algorithm>
#include <array>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

using Corners = std::array<std::int64_t, 3>;

TEST(FinalSeams, TrianglesBeginWithTheLowestIdAndKeepTheirTurn)
{
  const SeamTriangle t = { SeamVertex{ {}, 9, 0 }, SeamVertex{ {}, 4, 8 },
    SeamVertex{ {}, 7, 12 } };
  for (std::ptrdiff_t turn = 0; turn < 3; ++turn)
  {
    SeamTriangle turned = t;
    std::rotate(turned.begin(), turned.begin() + turn, turned.end());
    const FinalSeams seams = finalSeams({ turned });
    ASSERT_EQ(1U, seams.triangles().size());
    EXPECT_EQ((Corners{ 4, 7, 9 }), seams.triangles()[0].Ids);
    EXPECT_EQ(2, seams.triangles()[0].Partition);
  }
}

TEST(FinalSeams, TrianglesAtArtificialPointsAreHeldBack)
{
  const SeamTriangle t = { SeamVertex{ { 0, 0 }, 3, 0 }, SeamVertex{ { 1, 0 }, -1, 0 },
    SeamVertex{ { 0, 1 }, 5, 0 } };
  EXPECT_TRUE(finalSeams({ t }).triangles().empty());
}

/// Brought in several parts, as workers do.
TEST(FinalSeams, WithoutArtificialPointsTheyAreTheTriangulation)
{
  const Coordinates xy = makePointSet("uniform", 300);
  const Tiling boxes = Tiling::grid(boundsOf(xy), 3, 3);
  const std::vector<SeamVertex> artificial = makeArtificialPoints(boxes);
  std::vector<SeamVertex> vertices = artificial;
  const std::vector<Point2> points = asPoints(xy);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    vertices.push_back(makeSeamVertex(boxes, boxes.locate(points[i]), points[i], std::int64_t(i)));
  }
  FinalSeams seams;
  for (const SeamTriangle& triangle : listOf(triangulateVertices(boxes, vertices, 1)))
  {
    seams.add({ triangle });
  }
  EXPECT_LT(seams.triangles().size(), reference(xy).Mesh.size());
  seams.removeArtificialPoints(artificial);
  EXPECT_TRUE(sameTriangles(xy, idsOf(seams), reference(xy).Mesh));
}

} // namespace
