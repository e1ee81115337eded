// SPDX-License-Identifier: BSD-3-Clause
// Which partitions may be triangulated at the same time? It is not enough that no circumdisk meets
// both. If two triangles with a common edge belong to one partition each, an edge across it may
// join a point of one partition to a point of the other.
#include "Comparison.h"
#include "Scene.h"

#include <random>
#include <set>

namespace
{

using namespace tipp;
using namespace tipp::test;

/// Whether a triangle belongs to both partitions.
bool shareATriangle(const Triangles& p, const Triangles& q)
{
  Triangles common;
  std::set_intersection(p.begin(), p.end(), q.begin(), q.end(), std::back_inserter(common));
  return !common.empty();
}

std::set<std::pair<std::int64_t, std::int64_t>> edgesOf(const Triangles& triangles)
{
  std::set<std::pair<std::int64_t, std::int64_t>> edges;
  for (const Triangle& t : triangles)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      edges.insert(std::minmax(t[i], t[(i + 1) % 3]));
    }
  }
  return edges;
}

/// Whether a triangle belongs to both, or of two triangles with a common edge one to each.
bool shareAnEdge(const Triangles& p, const Triangles& q)
{
  const auto edges = edgesOf(p);
  for (const auto& edge : edgesOf(q))
  {
    if (edges.count(edge))
    {
      return true;
    }
  }
  return false;
}

/// Ids 0 and 1 are the ends a and b of the common edge, 2 and 3 the apexes of its triangles. The
/// last two are x in P and y in Q, which a new edge joins.
struct Counterexample
{
  Coordinates XY{ -1, 0, 1, 0, 0.5, 1.5, 0.5, -1.5, -0.5, 1.75, -0.5, -1.75, 2, 0, -2, 0, 8, 8, -8,
    8, -8, -8, 8, -8, 0, 0.63, 0, -0.63 };
  Ids Inserted{ 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11 };
  std::int64_t X = 12;
  std::int64_t Y = 13;
  Box2 P{ -0.1, 0.62, 0.1, 0.82 };
  Box2 Q{ -0.1, -0.82, 0.1, -0.62 };
};

TEST(ConflictRule, NoCommonDiskIsNotEnough)
{
  const Counterexample example;
  const Triangles mesh = delaunay(example.XY, example.Inserted);
  ASSERT_TRUE(std::binary_search(mesh.begin(), mesh.end(), canonical(0, 1, 2)));
  ASSERT_TRUE(std::binary_search(mesh.begin(), mesh.end(), canonical(1, 0, 3)));
  const Triangles ofP = belonging(example.XY, mesh, example.P);
  const Triangles ofQ = belonging(example.XY, mesh, example.Q);
  ASSERT_FALSE(shareATriangle(ofP, ofQ));

  const auto workerP = together(verticesOf(ofP), { example.X });
  const auto workerQ = together(verticesOf(ofQ), { example.Y });
  const auto both = together(example.Inserted, { example.X, example.Y });
  const auto edge = std::make_pair(example.X, example.Y);
  EXPECT_EQ(0u, edgesOf(delaunay(example.XY, workerP)).count(edge));
  EXPECT_EQ(0u, edgesOf(delaunay(example.XY, workerQ)).count(edge));
  EXPECT_EQ(1u, edgesOf(delaunay(example.XY, both)).count(edge));
}

TEST(ConflictRule, ACommonEdgeShowsTheConflict)
{
  const Counterexample example;
  const Triangles mesh = delaunay(example.XY, example.Inserted);
  EXPECT_TRUE(
    shareAnEdge(belonging(example.XY, mesh, example.P), belonging(example.XY, mesh, example.Q)));
}

/// A random box in the unit square, at most 0.2 wide and high.
Box2 randomBox(std::mt19937_64& random)
{
  const auto unit = [&] { return double(random() >> 11) * 0x1p-53; };
  const double x = 0.9 * unit();
  const double y = 0.9 * unit();
  return { x, y, x + 0.02 + 0.18 * unit(), y + 0.02 + 0.18 * unit() };
}

/// An initial mesh, two boxes, and the points in each box.
struct Draw
{
  Coordinates XY;
  Ids Inserted;
  Box2 Boxes[2];
  Ids Points[2];

  std::int64_t add(double x, double y)
  {
    this->XY.insert(this->XY.end(), { x, y });
    return std::int64_t(this->XY.size() / 2) - 1;
  }
};

Draw drawUniform(std::mt19937_64& random)
{
  Draw draw;
  const Scene scene = makeScene("uniform", 60, 1, 1, 0.5, random());
  draw.XY = scene.XY;
  draw.Inserted = scene.initialMesh();
  for (int i = 0; i < 2; ++i)
  {
    const Box2 box = draw.Boxes[i] = randomBox(random);
    for (int n = 0; n < 12; ++n)
    {
      const double x = box.Min.x + (box.Max.x - box.Min.x) * double(random() >> 11) * 0x1p-53;
      const double y = box.Min.y + (box.Max.y - box.Min.y) * double(random() >> 11) * 0x1p-53;
      draw.Points[i].push_back(draw.add(x, y));
    }
  }
  return draw;
}

/// Many co-circular points, and disks that touch boxes.
Draw drawLattice(std::mt19937_64& random)
{
  Draw draw;
  std::set<std::pair<int, int>> used;
  const auto add = [&](Ids& ids, int x, int y)
  {
    if (used.emplace(x, y).second)
    {
      ids.push_back(draw.add(x, y));
    }
  };
  for (const int x : { -7, 19 })
  {
    add(draw.Inserted, x, -7);
    add(draw.Inserted, x, 19);
  }
  for (int n = 0; n < 55; ++n)
  {
    const int x = int(random() % 13);
    add(draw.Inserted, x, int(random() % 13));
  }
  for (int i = 0; i < 2; ++i)
  {
    const int x = int(random() % 11);
    const int y = int(random() % 11);
    draw.Boxes[i] = { double(x), double(y), double(x + 2), double(y + 1) };
    for (int n = 0; n < 6; ++n)
    {
      add(draw.Points[i], x + n % 3, y + n / 3);
    }
  }
  return draw;
}

using Drawing = Draw (*)(std::mt19937_64&);

class Independence : public testing::TestWithParam<Drawing>
{
};

TEST_P(Independence, PartitionsWithoutACommonEdgeCommute)
{
  std::mt19937_64 random(11);
  int pairs = 0;
  for (int n = 0; n < 600; ++n)
  {
    const Draw draw = GetParam()(random);
    const Triangles mesh = delaunay(draw.XY, draw.Inserted);
    if (shareAnEdge(
          belonging(draw.XY, mesh, draw.Boxes[0]), belonging(draw.XY, mesh, draw.Boxes[1])))
    {
      continue;
    }
    ++pairs;
    const Ids all = together(together(draw.Inserted, draw.Points[0]), draw.Points[1]);
    const Triangles both = delaunay(draw.XY, all);
    for (int i = 0; i < 2; ++i)
    {
      const Triangles alone = delaunay(draw.XY, together(draw.Inserted, draw.Points[i]));
      ASSERT_TRUE(sameTriangles(
        draw.XY, belonging(draw.XY, both, draw.Boxes[i]), belonging(draw.XY, alone, draw.Boxes[i])))
        << "draw " << n;
    }
  }
  EXPECT_GT(pairs, 100) << "too few independent pairs to say anything";
}

INSTANTIATE_TEST_SUITE_P(Meshes, Independence, testing::Values(drawUniform, drawLattice),
  [](const auto& info) { return info.index == 0 ? "Uniform" : "Lattice"; });

} // namespace
