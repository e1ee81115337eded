// SPDX-License-Identifier: BSD-3-Clause
// When may two partitions be active together? Not as soon as no circumdisk meets both: an edge
// between two triangles, one belonging to each, lets their points meet across it.
#include "Comparison.h"
#include "Scene.h"

#include <random>
#include <set>

namespace
{

using namespace tipp::test;

/// A triangle belongs to both.
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

/// A triangle belongs to both, or two that share an edge belong to one each.
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

/// The ids 0 and 1 are a and b, 2 and 3 the apexes of their triangles; the last two are x and y.
struct Counterexample
{
  Coordinates XY{ -1,
    0,
    1,
    0,
    0.5,
    1.5,
    0.5,
    -1.5,
    -0.5,
    1.75,
    -0.5,
    -1.75,
    2,
    0,
    -2,
    0,
    8,
    8,
    -8,
    8,
    -8,
    -8,
    8,
    -8,
    0,
    0.63,
    0,
    -0.63 };
  Ids Inserted{ 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11 };
  std::int64_t X = 12;
  std::int64_t Y = 13;
  Box P{ -0.1, 0.62, 0.1, 0.82 };
  Box Q{ -0.1, -0.82, 0.1, -0.62 };
};

TEST(Independence, NoCommonDiskIsNotEnough)
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

TEST(Independence, ACommonEdgeShowsTheConflict)
{
  const Counterexample example;
  const Triangles mesh = delaunay(example.XY, example.Inserted);
  EXPECT_TRUE(
    shareAnEdge(belonging(example.XY, mesh, example.P), belonging(example.XY, mesh, example.Q)));
}

/// A random box of at most a fifth of the unit square's width.
Box randomBox(std::mt19937_64& random)
{
  const auto unit = [&] { return double(random() >> 11) * 0x1p-53; };
  const double x = 0.9 * unit();
  const double y = 0.9 * unit();
  return { x, y, x + 0.02 + 0.18 * unit(), y + 0.02 + 0.18 * unit() };
}

/// `count` points on a lattice of `steps` x `steps` in the box, none of them there before.
Ids addPoints(Coordinates& xy, const Box& box, std::mt19937_64& random, int count)
{
  Ids ids;
  for (int i = 0; i < count; ++i)
  {
    const double x = box.XMin + (box.XMax - box.XMin) * double(random() >> 11) * 0x1p-53;
    const double y = box.YMin + (box.YMax - box.YMin) * double(random() >> 11) * 0x1p-53;
    ids.push_back(std::int64_t(xy.size() / 2));
    xy.insert(xy.end(), { x, y });
  }
  return ids;
}

TEST(Independence, PartitionsWithoutACommonEdgeCommute)
{
  std::mt19937_64 random(11);
  int pairs = 0;
  for (int draw = 0; draw < 400; ++draw)
  {
    Scene scene = makeScene("uniform", 60, 1, 1, 0.5, std::uint64_t(draw));
    const Box boxes[2] = { randomBox(random), randomBox(random) };
    const Ids inserted = scene.initialMesh();
    const Triangles mesh = delaunay(scene.XY, inserted);
    if (shareAnEdge(belonging(scene.XY, mesh, boxes[0]), belonging(scene.XY, mesh, boxes[1])))
    {
      continue;
    }
    ++pairs;
    const Ids points[2] = { addPoints(scene.XY, boxes[0], random, 12),
      addPoints(scene.XY, boxes[1], random, 12) };
    const Triangles both = delaunay(scene.XY, together(together(inserted, points[0]), points[1]));
    for (int i = 0; i < 2; ++i)
    {
      const Triangles alone = delaunay(scene.XY, together(inserted, points[i]));
      ASSERT_TRUE(sameTriangles(
        scene.XY, belonging(scene.XY, both, boxes[i]), belonging(scene.XY, alone, boxes[i])))
        << "draw " << draw;
    }
  }
  EXPECT_GT(pairs, 100) << "too few independent pairs to say anything";
}

} // namespace
