// SPDX-License-Identifier: BSD-3-Clause
#include "DataflowScene.h"

#include <set>

namespace
{

using namespace tipp;
using namespace tipp::test;

using Partitions = std::vector<PartitionIndex>;

/// An artificial mesh: triangle i meets the partitions `met[i]`. `neighbours` lists the pairs of
/// triangles with a common edge.
BoundaryTriangles meshOf(const std::vector<Partitions>& met,
  const std::vector<std::pair<std::size_t, std::size_t>>& neighbours)
{
  BoundaryTriangles mesh;
  for (const Partitions& partitions : met)
  {
    mesh.add({ 0, 0, 0 }, partitions.data(), partitions.data() + partitions.size());
  }
  for (const auto& [one, other] : neighbours)
  {
    mesh.AdjacentSets.emplace_back(mesh.SetOf[one], mesh.SetOf[other]);
  }
  return mesh;
}

PartitionOrder orderOf(std::size_t partitions, const BoundaryTriangles& mesh)
{
  return PartitionOrder(std::vector<char>(partitions, 1), mesh);
}

/// Four partitions in a path, whose middle ones have most conflicts, and one without conflicts.
TEST(ConflictGraph, ConflictingPartitionsGetDifferentColours)
{
  std::vector<ConflictGraph::Pair> pairs;
  for (const auto& [a, b] : { std::pair{ 0, 1 }, { 1, 2 }, { 2, 3 }, { 1, 2 } })
  {
    pairs.emplace_back(a, b);
  }
  ConflictGraph graph(5);
  graph.add({ pairs.begin(), pairs.begin() + 2 });
  graph.add({ pairs.begin() + 2, pairs.end() });
  EXPECT_EQ((Partitions{ 0, 2 }), graph.neighbours(1));
  EXPECT_TRUE(graph.neighbours(4).empty());
  EXPECT_EQ((std::vector<std::uint32_t>{ 1, 0, 1, 0, 0 }), graph.colours());
}

TEST(PartitionOrder, PartitionsThatATriangleMeetsConflict)
{
  const PartitionOrder order = orderOf(4, meshOf({ { 0, 2 }, { 1 }, { 3 } }, {}));
  EXPECT_TRUE(conflict(order, 0, 2));
  for (const auto& [p, q] : { std::pair{ 0, 1 }, { 0, 3 }, { 1, 2 }, { 1, 3 }, { 2, 3 } })
  {
    EXPECT_FALSE(conflict(order, p, q)) << p << " and " << q;
  }
}

TEST(PartitionOrder, PartitionsAcrossAnEdgeConflict)
{
  const PartitionOrder order = orderOf(3, meshOf({ { 0 }, { 1 }, { 2 } }, { { 0, 1 } }));
  EXPECT_TRUE(conflict(order, 0, 1));
  EXPECT_FALSE(conflict(order, 0, 2));
  EXPECT_FALSE(conflict(order, 1, 2));
}

TEST(PartitionOrder, PartitionsTwoEdgesApartDoNotConflict)
{
  const PartitionOrder order = orderOf(2, meshOf({ { 0 }, {}, { 1 } }, { { 0, 1 }, { 1, 2 } }));
  EXPECT_FALSE(conflict(order, 0, 1));
}

TEST(PartitionOrder, UnusedPartitionsAreNotInTheSequence)
{
  const PartitionOrder order({ 1, 0, 1, 0 }, meshOf({ { 0, 2 } }, {}));
  Partitions sequence = order.sequence();
  std::sort(sequence.begin(), sequence.end());
  EXPECT_EQ((Partitions{ 0, 2 }), sequence);
}

TEST(PartitionOrder, WithoutPartitionsTheSequenceIsEmpty)
{
  const PartitionOrder order({ 0, 0 }, meshOf({ {} }, {}));
  EXPECT_TRUE(order.sequence().empty());
  EXPECT_EQ(0U, order.colourCount());
}

class PartitionOrderOf : public testing::TestWithParam<std::string>
{
};

TEST_P(PartitionOrderOf, EachPartitionWithPointsComesOnce)
{
  const DataflowScene scene(GetParam(), 900, 6, 6);
  Partitions sequence = scene.order().sequence();
  std::sort(sequence.begin(), sequence.end());
  Partitions expected;
  for (PartitionIndex p = 0; p < scene.Tiles.size(); ++p)
  {
    if (scene.Buckets.count(p) > 0)
    {
      expected.push_back(p);
    }
  }
  EXPECT_EQ(expected, sequence);
}

TEST_P(PartitionOrderOf, PartitionsOfOneColourDoNotConflict)
{
  const DataflowScene scene(GetParam(), 900, 6, 6);
  const PartitionOrder order = scene.order();
  std::size_t total = 0;
  for (std::size_t colour = 0; colour < order.colourCount(); ++colour)
  {
    total += order.colourSize(colour);
  }
  EXPECT_EQ(order.sequence().size(), total);
  for (const PartitionIndex p : order.sequence())
  {
    for (const PartitionIndex q : order.later(p))
    {
      EXPECT_LT(order.colourOf(p), order.colourOf(q));
    }
  }
}

TEST_P(PartitionOrderOf, LaterPartitionsComeInOrder)
{
  std::mt19937_64 random(1);
  const DataflowScene scene(GetParam(), 900, 6, 6);
  std::vector<std::int32_t> windows(36);
  for (std::int32_t& window : windows)
  {
    window = std::int32_t(random() % 5);
  }
  const PartitionOrder order = scene.order(windows);
  for (std::size_t i = 0; i < order.sequence().size(); ++i)
  {
    const PartitionIndex p = order.sequence()[i];
    EXPECT_EQ(i, order.position(p));
    std::size_t last = i;
    for (const PartitionIndex q : order.later(p))
    {
      EXPECT_LT(last, order.position(q));
      EXPECT_LE(windows[std::size_t(p)], windows[std::size_t(q)]);
      last = order.position(q);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(PointSets, PartitionOrderOf,
  testing::Values("uniform", "clustered", "lattice-shuffled", "survey-lines"),
  [](const auto& info)
  {
    std::string name = info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
  });

TEST(PartitionOrder, TheFirstOfASetIsTheEarliestInTheSequence)
{
  const DataflowScene scene("uniform", 900, 6, 6);
  const PartitionOrder order = scene.order();
  Partitions some{ 3, 17, 20, 31 };
  std::sort(some.begin(), some.end(),
    [&](PartitionIndex a, PartitionIndex b) { return order.position(a) > order.position(b); });
  EXPECT_EQ(some.back(), order.first(some.data(), some.data() + some.size()));
}

TEST(PartitionOrder, UniformPointsNeedFewColours)
{
  const DataflowScene scene("uniform", 20000, 16, 16);
  EXPECT_LE(scene.order().colourCount(), 12U);
}

/// The partitions form one set, so that the conflicting pairs need not be listed.
TEST(PartitionOrder, IsTotalIfTooManyPartitionsConflict)
{
  constexpr PartitionIndex count = 5000;
  Partitions all(count);
  for (PartitionIndex p = 0; p < count; ++p)
  {
    all[std::size_t(p)] = p;
  }
  const PartitionOrder order = orderOf(count, meshOf({ all }, {}));
  EXPECT_TRUE(order.isTotal());
  EXPECT_EQ(std::size_t(count), order.colourCount());
  EXPECT_EQ(std::size_t(count) - 1, order.later(order.sequence().front()).size());
  EXPECT_EQ(0U, order.later(order.sequence().back()).size());
}

} // namespace
