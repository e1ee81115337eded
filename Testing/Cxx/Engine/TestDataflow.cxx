// SPDX-License-Identifier: BSD-3-Clause
// Whole runs: for every tiling and order, the triangles are those of CGAL.
#include "DataflowScene.h"

#include <set>

namespace
{

using namespace tipp;
using namespace tipp::test;

std::vector<std::int32_t> randomWindows(PartitionIndex count, std::mt19937_64& random)
{
  std::vector<std::int32_t> windows(std::size_t(count), 0);
  for (std::int32_t& window : windows)
  {
    window = std::int32_t(random() % std::uint64_t(count));
  }
  return windows;
}

/// A grid, or boxes that hold equal numbers of points of a random sample.
Tiling randomTiling(const Coordinates& xy, std::mt19937_64& random)
{
  const Box2 bounds = test::boundsOf(xy);
  if (random() % 2 == 0)
  {
    return Tiling::grid(bounds, 1 + int(random() % 7), 2 + int(random() % 6));
  }
  std::vector<Point2> sample = asPoints(xy);
  std::shuffle(sample.begin(), sample.end(), random);
  sample.resize(std::max<std::size_t>(2, sample.size() / (1 + random() % 8)));
  return Tiling::balanced(bounds, sample, 2 + int(random() % 40));
}

class Dataflow : public testing::TestWithParam<std::string>
{
};

TEST_P(Dataflow, AnyTilingAndOrderGiveTheSameTriangles)
{
  std::mt19937_64 random(7);
  for (int draw = 0; draw < 12; ++draw)
  {
    const Coordinates xy = makePointSet(GetParam(), 150 + random() % 500, 1 + random() % 99);
    const Tiling tiling = randomTiling(xy, random);
    DataflowScene scene(xy, tiling);
    const PartitionOrder order = scene.order(
      draw % 3 == 0 ? std::vector<std::int32_t>() : randomWindows(tiling.size(), random));
    DataflowRun run(scene, order);
    ASSERT_TRUE(sameTriangles(xy, run.run(random), reference(xy).Mesh)) << "draw " << draw;
    ASSERT_EQ(order.sequence().size(), run.Done);
  }
}

/// Lemma 5. Every triangle that ever exists in a run is in the mesh after some partition. So these
/// meshes are searched for triangles that meet two partitions between which there is no conflict.
TEST_P(Dataflow, NoTriangleMeetsPartitionsThatDoNotConflict)
{
  std::mt19937_64 random(11);
  DataflowScene scene(GetParam(), 400, 5, 4);
  const PartitionOrder order = scene.order();
  Coordinates xy = scene.XY;
  Ids inserted;
  for (const BoundaryVertex& v : scene.Initial)
  {
    inserted.push_back(v.isArtificial() ? std::int64_t(xy.size() / 2) : v.Id);
    if (v.isArtificial())
    {
      xy.insert(xy.end(), { v.Position.x, v.Position.y });
    }
  }
  const std::vector<Point2> points = asPoints(xy);
  const Ids representatives = reference(scene.XY).Representative;
  for (const PartitionIndex p : order.sequence())
  {
    std::vector<std::int32_t> ids;
    scene.Buckets.copyIds(p, ids);
    for (const std::int32_t id : ids)
    {
      inserted.push_back(representatives[std::size_t(id)]);
    }
    std::sort(inserted.begin(), inserted.end());
    inserted.erase(std::unique(inserted.begin(), inserted.end()), inserted.end());
    for (const Triangle& t : delaunay(xy, inserted))
    {
      std::vector<PartitionIndex> met;
      scene.Boxes.visitMet(
        Circumdisk(points[std::size_t(t[0])], points[std::size_t(t[1])], points[std::size_t(t[2])]),
        [&](PartitionIndex q) { met.push_back(q); });
      for (std::size_t i = 1; i < met.size(); ++i)
      {
        ASSERT_TRUE(conflict(order, met[0], met[i])) << met[0] << " and " << met[i];
      }
    }
  }
}

TEST_P(Dataflow, AnInboxHoldsEachVertexOfASenderOnce)
{
  std::mt19937_64 random(3);
  DataflowScene scene(GetParam(), 500, 4, 5);
  const PartitionOrder order = scene.order();
  DataflowRun run(scene, order);
  std::size_t messages = 0;
  run.Look = [&](PartitionIndex p, const std::vector<VertexMessage>& inbox)
  {
    std::set<PartitionIndex> senders;
    for (const VertexMessage& message : inbox)
    {
      ++messages;
      EXPECT_TRUE(senders.insert(message.Sender).second);
      if (message.Sender >= 0)
      {
        EXPECT_LT(order.position(message.Sender), order.position(p));
        EXPECT_TRUE(conflict(order, message.Sender, p));
      }
      std::set<std::int64_t> ids;
      for (const BoundaryVertex& v : message.Vertices)
      {
        EXPECT_TRUE(ids.insert(v.Id).second);
      }
      EXPECT_LE(message.Cells, 2 * std::int64_t(message.Vertices.size()));
    }
  };
  run.run(random);
  EXPECT_GT(messages, order.sequence().size());
}

/// The messages that a partition receives: sender and vertex ids, in the inbox's order.
using Sent = std::vector<std::pair<PartitionIndex, std::vector<std::int64_t>>>;

std::vector<Sent> inboxesOf(DataflowScene& scene, const PartitionOrder& order, std::uint64_t seed)
{
  std::mt19937_64 random(seed);
  std::vector<Sent> inboxes(order.partitionCount());
  DataflowRun run(scene, order);
  run.Look = [&](PartitionIndex p, const std::vector<VertexMessage>& inbox)
  {
    for (const VertexMessage& message : inbox)
    {
      std::vector<std::int64_t> ids;
      for (const BoundaryVertex& v : message.Vertices)
      {
        ids.push_back(v.Id);
      }
      inboxes[std::size_t(p)].emplace_back(message.Sender, std::move(ids));
    }
  };
  run.run(random);
  return inboxes;
}

/// Partitions commute if every order of execution sends each partition the same messages.
TEST_P(Dataflow, PartitionsThatDoNotConflictCommute)
{
  const Coordinates xy = makePointSet(GetParam(), 700);
  const Tiling tiling = Tiling::grid(test::boundsOf(xy), 6, 5);
  std::vector<Sent> expected;
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
  {
    DataflowScene scene(xy, tiling); // a run overwrites the points of its scene
    const std::vector<Sent> inboxes = inboxesOf(scene, scene.order(), seed);
    expected = seed == 1 ? inboxes : expected;
    EXPECT_TRUE(expected == inboxes) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(PointSets, Dataflow,
  testing::Values("uniform", "clustered", "lattice-shuffled", "lattice-tenths", "survey-lines",
    "cocircular", "kuzmin", "duplicates", "circle", "collinear-and-one"),
  [](const auto& info)
  {
    std::string name = info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
  });

} // namespace
