// SPDX-License-Identifier: BSD-3-Clause
#include "KernelTesting.h"

#include "Kernel/HalfEdgeMesh.h"

namespace
{

using namespace tipp;
using namespace tipp::test;
using Index = HalfEdgeMesh::Index;

/// Triangles at both ends of the index range. A triangle's index is that of its first half-edge, a
/// multiple of 8.
constexpr Index Named[] = { 0, 8, 16, 24, 1000 * 8, 0x7ffffff0, 0x7ffffff8 };

TEST(HalfEdgeMesh, AHalfEdgeKnowsItsTriangle)
{
  for (const Index t : Named)
  {
    for (Index i = 0; i < 3; ++i)
    {
      EXPECT_EQ(t, HalfEdgeMesh::triangleOf(t + i));
    }
  }
}

TEST(HalfEdgeMesh, NextAndPreviousStayInTheTriangle)
{
  for (const Index t : Named)
  {
    for (Index i = 0; i < 3; ++i)
    {
      EXPECT_EQ(nextOf(t + i), HalfEdgeMesh::next(t + i));
      EXPECT_EQ(previousOf(t + i), HalfEdgeMesh::previous(t + i));
    }
  }
}

TEST(HalfEdgeMesh, LinkingMakesTwinsOfBoth)
{
  HalfEdgeMesh mesh;
  mesh.reserve(2);
  mesh.link(1, 8 + 2);
  EXPECT_EQ(8 + 2, mesh.twin(1));
  EXPECT_EQ(1, mesh.twin(8 + 2));
}

TEST(HalfEdgeMesh, TheTwinsOfNextAndPreviousAreWhereEachHalfEdgePoints)
{
  HalfEdgeMesh mesh;
  mesh.reserve(2);
  for (Index i = 0; i < 3; ++i)
  {
    mesh.link(i, 8 + (i + 1) % 3);
  }
  for (Index h : { 0, 1, 2, 8, 9, 10 })
  {
    EXPECT_EQ(mesh.twin(nextOf(h)), HalfEdgeMesh::twinOfNext(mesh.slots(), h));
    EXPECT_EQ(mesh.twin(previousOf(h)), HalfEdgeMesh::twinOfPrevious(mesh.slots(), h));
  }
}

TEST(HalfEdgeMesh, LinksAndVerticesDoNotShareSlots)
{
  HalfEdgeMesh mesh;
  mesh.reserve(2);
  for (Index h : { 0, 1, 2, 8, 9, 10 })
  {
    mesh.slots()[h] = 100 + h;
  }
  for (Index i = 0; i < 3; ++i)
  {
    mesh.link(i, 8 + i);
  }
  for (Index h : { 0, 1, 2, 8, 9, 10 })
  {
    EXPECT_EQ(100 + h, mesh.vertex(h));
  }
}

TEST(HalfEdgeMesh, ReservingMoreKeepsTheTriangles)
{
  HalfEdgeMesh mesh;
  mesh.reserve(4);
  mesh.setEnd(32);
  for (Index i = 0; i < 32; ++i)
  {
    mesh.slots()[i] = 7 * i;
  }
  mesh.reserve(100000);
  EXPECT_EQ(32, mesh.end());
  for (Index i = 0; i < 32; ++i)
  {
    ASSERT_EQ(7 * i, mesh.slots()[i]);
  }
}

TEST(HalfEdgeMesh, ReservingLessKeepsTheCapacity)
{
  HalfEdgeMesh mesh;
  mesh.reserve(100);
  const Index* const slots = mesh.slots();
  mesh.reserve(10);
  EXPECT_EQ(slots, mesh.slots());
}

TEST(HalfEdgeMesh, AClearedMeshHasNoTriangles)
{
  HalfEdgeMesh mesh;
  mesh.reserve(4);
  mesh.setEnd(32);
  mesh.clear();
  EXPECT_EQ(0, mesh.end());
}

} // namespace
