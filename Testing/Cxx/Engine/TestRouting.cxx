// SPDX-License-Identifier: BSD-3-Clause
#include "DataflowScene.h"
#include "Triangulation/InitialMesh.h"

namespace
{

using namespace tipp;
using namespace tipp::test;

using Final = FinalBoundary<std::int64_t>;

BoundaryTriangle triangleOf(std::int64_t a, std::int64_t b, std::int64_t c)
{
  return { BoundaryVertex{ { 0, 0 }, a, 1 }, BoundaryVertex{ { 1, 0 }, b, 2 },
    BoundaryVertex{ { 0, 1 }, c, 3 } };
}

TEST(FinalBoundary, TrianglesBeginWithTheLowestIdAndKeepTheirOrientation)
{
  BoundaryTriangle triangle = triangleOf(9, 4, 7);
  for (int turn = 0; turn < 3; ++turn)
  {
    Final final;
    final.add(triangle);
    ASSERT_EQ(1U, final.Triangles.size());
    EXPECT_EQ((std::array<std::int64_t, 3>{ 4, 7, 9 }), final.Triangles[0].Ids);
    EXPECT_EQ(2, final.Triangles[0].Partition);
    std::rotate(triangle.begin(), triangle.begin() + 1, triangle.end());
  }
}

TEST(FinalBoundary, KeepsTheTrueCornersOfTrianglesAtArtificialPoints)
{
  Final final;
  final.add(triangleOf(9, -4, 7));
  final.add(triangleOf(-1, -2, 3));
  EXPECT_TRUE(final.Triangles.empty());
  std::vector<std::int64_t> ids;
  for (const BoundaryVertex& v : final.HullVertices)
  {
    ids.push_back(v.Id);
  }
  EXPECT_EQ((std::vector<std::int64_t>{ 9, 7, 3 }), ids);
}

TEST(FinalBoundary, HullRepairCompletesTheTriangulation)
{
  const Coordinates xy = makePointSet("uniform", 300);
  const Tiling tiles = Tiling::grid(test::boundsOf(xy), 3, 3);
  const std::vector<BoundaryVertex> artificial = makeArtificialPoints(tiles);
  std::vector<BoundaryVertex> vertices = artificial;
  const std::vector<Point2> points = asPoints(xy);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    vertices.push_back({ points[i], std::int64_t(i), tiles.locate(points[i]) });
  }
  Final final;
  for (const BoundaryTriangle& triangle : listOf(triangulateVertices<2>(tiles, vertices, 1)))
  {
    final.add(triangle);
  }
  EXPECT_LT(final.Triangles.size(), reference(xy).Mesh.size());
  repairHull(std::move(final.HullVertices), artificial, final);
  Triangles made;
  for (const auto& triangle : final.Triangles)
  {
    made.push_back(canonical(triangle.Ids[0], triangle.Ids[1], triangle.Ids[2]));
  }
  EXPECT_TRUE(sameTriangles(xy, sorted(std::move(made)), reference(xy).Mesh));
}

/// Each triangle goes to the first partition that it meets.
TEST(Routing, SendsTheInitialMeshToTheFirstPartitions)
{
  const DataflowScene scene("uniform", 800, 4, 4);
  const PartitionOrder order = scene.order();
  std::vector<Inbox> inboxes(16);
  for (auto& [to, message] : sendInitialMesh(scene.Mesh, order))
  {
    inboxes[std::size_t(to)].put(std::move(message));
  }
  std::vector<std::int64_t> expected(16, 0);
  for (std::size_t i = 0; i < scene.Mesh.size(); ++i)
  {
    if (scene.Mesh.metBegin(i) != scene.Mesh.metEnd(i))
    {
      ++expected[std::size_t(order.first(scene.Mesh.metBegin(i), scene.Mesh.metEnd(i)))];
    }
  }
  for (std::size_t p = 0; p < inboxes.size(); ++p)
  {
    const std::vector<VertexMessage> messages = inboxes[p].take();
    EXPECT_EQ(expected[p] > 0 ? 1U : 0U, messages.size());
    for (const VertexMessage& message : messages)
    {
      EXPECT_EQ(-1, message.Sender);
      EXPECT_EQ(expected[p], message.Cells);
    }
  }
}

} // namespace
