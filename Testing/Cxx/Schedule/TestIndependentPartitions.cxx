// SPDX-License-Identifier: BSD-3-Clause
#include "InitialScene.h"

#include "Triangulation/IndependentPartitions.h"

#include <algorithm>
#include <set>

namespace
{

using namespace tipp;
using namespace tipp::test;

using Partitions = std::vector<PartitionIndex>;

/// 8 x 8 partitions with the initial mesh of a few hundred points.
class PartitionsOfAMesh : public testing::TestWithParam<std::string>
{
public:
  PartitionsOfAMesh()
    : Scene(GetParam(), 2500, 8, 8)
    , Mesh(this->Scene.Boxes.size(), this->Scene.Mesh)
    , All(this->Scene.partitionsWithPoints())
  {
  }

  bool conflict(PartitionIndex p, PartitionIndex q)
  {
    const std::vector<std::uint32_t> a = this->Mesh.reach(p);
    const std::vector<std::uint32_t> b = this->Mesh.reach(q);
    return std::any_of(a.begin(), a.end(),
      [&b](std::uint32_t label) { return std::find(b.begin(), b.end(), label) != b.end(); });
  }

  bool conflictsWithOneOf(PartitionIndex p, const Partitions& others)
  {
    return std::any_of(others.begin(), others.end(),
      [&](PartitionIndex q) { return p != q && this->conflict(p, q); });
  }

  InitialScene Scene;
  MeshReach Mesh;
  Partitions All;
};

TEST_P(PartitionsOfAMesh, AStagesPartitionsShareNoLabel)
{
  IndependentPartitions waiting(this->Mesh, this->All);
  while (!waiting.isEmpty())
  {
    const Partitions stage = waiting.nextStage();
    for (const PartitionIndex p : stage)
    {
      ASSERT_FALSE(this->conflictsWithOneOf(p, stage));
    }
    std::for_each(stage.begin(), stage.end(), [&](PartitionIndex p) { waiting.deactivate(p); });
  }
}

/// Which is what independence is for: no edge has a triangle of each.
TEST_P(PartitionsOfAMesh, AStagesPartitionsShareNoVertexOfTheMesh)
{
  IndependentPartitions waiting(this->Mesh, this->All);
  std::set<std::int64_t> seen;
  for (const PartitionIndex p : waiting.nextStage())
  {
    const SeamTriangles& mesh = this->Scene.Mesh;
    std::set<std::int64_t> own;
    for (std::size_t i = 0; i < mesh.size(); ++i)
    {
      if (std::count(mesh.metBegin(i), mesh.metEnd(i), p) > 0)
      {
        own.insert({ mesh[i][0].Id, mesh[i][1].Id, mesh[i][2].Id });
      }
    }
    for (const std::int64_t id : own)
    {
      EXPECT_TRUE(seen.insert(id).second) << "vertex " << id;
    }
  }
}

TEST_P(PartitionsOfAMesh, NoPartitionCanJoinAStage)
{
  IndependentPartitions waiting(this->Mesh, this->All);
  Partitions left = this->All;
  while (!waiting.isEmpty())
  {
    const Partitions stage = waiting.nextStage();
    ASSERT_FALSE(stage.empty());
    for (const PartitionIndex p : stage)
    {
      left.erase(std::find(left.begin(), left.end(), p));
      waiting.deactivate(p);
    }
    for (const PartitionIndex p : left)
    {
      ASSERT_TRUE(this->conflictsWithOneOf(p, stage));
    }
  }
}

TEST_P(PartitionsOfAMesh, StagesNameEveryPartitionOnce)
{
  IndependentPartitions waiting(this->Mesh, this->All);
  Partitions named;
  while (!waiting.isEmpty())
  {
    for (const PartitionIndex p : waiting.nextStage())
    {
      named.push_back(p);
      waiting.deactivate(p);
    }
  }
  std::sort(named.begin(), named.end());
  EXPECT_EQ(this->All, named);
}

TEST_P(PartitionsOfAMesh, APartitionHandedOutIsIndependentOfAllActiveOnes)
{
  IndependentPartitions waiting(this->Mesh, this->All);
  Partitions active;
  Partitions named;
  while (!waiting.isEmpty())
  {
    const PartitionIndex p = waiting.activateNext();
    if (p < 0)
    {
      ASSERT_FALSE(active.empty()) << "nothing can go on";
      // An older one, so that those of different ages are active together.
      waiting.deactivate(active.front());
      active.erase(active.begin());
      continue;
    }
    ASSERT_FALSE(this->conflictsWithOneOf(p, active));
    active.push_back(p);
    named.push_back(p);
  }
  std::sort(named.begin(), named.end());
  EXPECT_EQ(this->All, named);
}

INSTANTIATE_TEST_SUITE_P(PointSets, PartitionsOfAMesh,
  testing::Values("uniform", "clustered", "lattice-shuffled", "survey-lines"),
  [](const auto& info)
  {
    std::string name = info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
  });

/// Partitions 0 and 1 share a triangle, 2 has one of its own; 3 has none.
class ThreePartitionsAndOne : public testing::Test
{
public:
  MeshReach Mesh{ 4,
    seamTriangles(
      { { seamTriangle(10, 0, 1, 4), { 0, 1 } }, { seamTriangle(20, 8, 9, 9), { 2 } } }) };
};

TEST_F(ThreePartitionsAndOne, AConflictingPartitionWaits)
{
  IndependentPartitions waiting(this->Mesh, { 0, 1, 2 });
  EXPECT_EQ(0, waiting.activateNext());
  EXPECT_EQ(2, waiting.activateNext());
  EXPECT_EQ(-1, waiting.activateNext());
  EXPECT_FALSE(waiting.isEmpty());
}

TEST_F(ThreePartitionsAndOne, ADeactivatedPartitionFreesThoseInConflict)
{
  IndependentPartitions waiting(this->Mesh, { 0, 1 });
  EXPECT_EQ(0, waiting.activateNext());
  EXPECT_EQ(-1, waiting.activateNext());
  waiting.deactivate(0);
  EXPECT_EQ(1, waiting.activateNext());
  EXPECT_TRUE(waiting.isEmpty());
}

/// What it locked is freed, whatever its reach has become since.
TEST_F(ThreePartitionsAndOne, DeactivatingFreesWhatWasReachedOnActivation)
{
  IndependentPartitions waiting(this->Mesh, { 0, 1 });
  EXPECT_EQ(0, waiting.activateNext());
  this->Mesh = MeshReach(4, seamTriangles({ { seamTriangle(30, 0, 4, 5), { 1 } } }));
  waiting.deactivate(0);
  EXPECT_EQ(1, waiting.activateNext());
}

TEST(IndependentPartitions, ThoseWithTheFewestConflictsComeFirst)
{
  // Partition 1 conflicts with 0 and 2, which are independent of each other.
  MeshReach chain(3,
    seamTriangles({ { seamTriangle(1, 0, 0, 4), { 0 } }, { seamTriangle(4, 4, 5, 5), { 1 } },
      { seamTriangle(7, 5, 8, 8), { 2 } } }));
  IndependentPartitions waiting(chain, { 1, 0, 2 });
  EXPECT_EQ((Partitions{ 0, 2 }), waiting.nextStage());
}

TEST_F(ThreePartitionsAndOne, WithoutPartitionsThereIsNothingToDo)
{
  IndependentPartitions waiting(this->Mesh, {});
  EXPECT_TRUE(waiting.isEmpty());
  EXPECT_TRUE(waiting.nextStage().empty());
  EXPECT_EQ(-1, waiting.activateNext());
}

} // namespace
