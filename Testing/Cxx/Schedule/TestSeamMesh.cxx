// SPDX-License-Identifier: BSD-3-Clause
#include "ScheduleTesting.h"

#include <algorithm>

namespace
{

using namespace tipp;
using namespace tipp::test;

using Labels = std::vector<std::uint32_t>;

/// A mesh of four partitions, and what is final so far.
class SeamMeshOfFour : public testing::Test
{
public:
  void add(const std::vector<std::pair<SeamTriangle, std::vector<PartitionIndex>>>& list)
  {
    this->Mesh.add(seamTriangles(list), this->Final);
  }

  Triangles gathered(PartitionIndex partition) const
  {
    std::vector<SeamTriangle> triangles(3); // what was there has to go
    this->Mesh.gather(partition, triangles);
    return idsOf(triangles);
  }

  Labels reach(PartitionIndex partition)
  {
    Labels labels = this->Mesh.reach(partition);
    std::sort(labels.begin(), labels.end());
    return labels;
  }

  SeamMesh Mesh{ 4 };
  std::vector<SeamTriangle> Final;
  const SeamTriangle A = seamTriangle(10, 0, 1, 4);
  const SeamTriangle B = seamTriangle(20, 4, 4, 8);
  const SeamTriangle C = seamTriangle(30, 9, 12, 15);
};

TEST_F(SeamMeshOfFour, GathersWhatBelongsToEachPartition)
{
  this->add({ { this->A, { 0, 1 } }, { this->B, { 1, 2 } }, { this->C, { 2 } } });
  EXPECT_EQ(idsOf({ this->A }), this->gathered(0));
  EXPECT_EQ(idsOf({ this->A, this->B }), this->gathered(1));
  EXPECT_EQ(idsOf({ this->B, this->C }), this->gathered(2));
  EXPECT_TRUE(this->gathered(3).empty());
}

TEST_F(SeamMeshOfFour, AFinishedPartitionsTrianglesAreGoneForItsNeighboursToo)
{
  this->add({ { this->A, { 0, 1 } }, { this->B, { 1, 2 } }, { this->C, { 2 } } });
  this->Mesh.finish(1);
  EXPECT_TRUE(this->gathered(0).empty());
  EXPECT_EQ(idsOf({ this->C }), this->gathered(2));
}

TEST_F(SeamMeshOfFour, KnowsWhatIsFinished)
{
  this->Mesh.finish(2);
  EXPECT_TRUE(this->Mesh.isFinished(2));
  EXPECT_FALSE(this->Mesh.isFinished(1));
}

TEST_F(SeamMeshOfFour, ATriangleThatMeetsNoUnfinishedPartitionIsHandedBack)
{
  this->Mesh.finish(0);
  this->Mesh.finish(1);
  this->add({ { this->A, { 0, 1 } }, { this->B, { 1, 2 } }, { this->C, {} } });
  EXPECT_EQ(idsOf({ this->A, this->C }), idsOf(this->Final));
  EXPECT_EQ(1U, this->Mesh.size());
  EXPECT_EQ(idsOf({ this->B }), this->gathered(2));
}

TEST_F(SeamMeshOfFour, AFinalTriangleFollowsThoseThatWereFinalBefore)
{
  this->add({ { this->A, {} } });
  this->add({ { this->B, {} } });
  EXPECT_EQ(idsOf({ this->A, this->B }), idsOf(this->Final));
}

TEST_F(SeamMeshOfFour, CountsEachTriangleOnce)
{
  EXPECT_EQ(0U, this->Mesh.size());
  this->add({ { this->A, { 0, 1, 2, 3 } }, { this->B, { 1 } } });
  EXPECT_EQ(2U, this->Mesh.size());
  this->Mesh.finish(3);
  EXPECT_EQ(1U, this->Mesh.size());
  this->Mesh.finish(1);
  EXPECT_EQ(0U, this->Mesh.size());
}

TEST_F(SeamMeshOfFour, ReachNamesTheLabelsOfAPartitionsTrianglesOnce)
{
  this->add({ { this->A, { 0, 1 } }, { this->B, { 1, 2 } }, { this->C, { 2 } } });
  EXPECT_EQ((Labels{ 0, 1, 4 }), this->reach(0));
  EXPECT_EQ((Labels{ 0, 1, 4, 8 }), this->reach(1));
  EXPECT_EQ((Labels{ 4, 8, 9, 12, 15 }), this->reach(2));
  EXPECT_TRUE(this->reach(3).empty());
}

TEST_F(SeamMeshOfFour, ReachFollowsTrianglesThatAreAdded)
{
  this->add({ { this->A, { 0 } } });
  EXPECT_EQ((Labels{ 0, 1, 4 }), this->reach(0));
  this->add({ { this->C, { 0 } } });
  EXPECT_EQ((Labels{ 0, 1, 4, 9, 12, 15 }), this->reach(0));
}

TEST_F(SeamMeshOfFour, ReachLeavesOutTrianglesThatAreSuperseded)
{
  this->add({ { this->A, { 0, 1 } } });
  EXPECT_EQ((Labels{ 0, 1, 4 }), this->reach(1));
  this->Mesh.finish(0);
  this->add({ { this->C, { 0, 1 } } });
  EXPECT_EQ((Labels{ 9, 12, 15 }), this->reach(1));
}

/// A slot used again must not bring its new triangle to partitions that knew the old one.
TEST_F(SeamMeshOfFour, ASupersededTrianglesNeighboursDoNotSeeWhatReplacesIt)
{
  this->add({ { this->A, { 0, 1, 2 } } });
  this->Mesh.finish(0);
  for (int i = 0; i < 10; ++i)
  {
    this->add({ { seamTriangle(100 + 10 * i, 12, 12, 12), { 3 } } });
  }
  EXPECT_TRUE(this->gathered(1).empty());
  EXPECT_TRUE(this->gathered(2).empty());
  EXPECT_EQ(10U, this->gathered(3).size());
}

TEST_F(SeamMeshOfFour, ASlotUsedAgainHoldsItsNewTriangle)
{
  this->add({ { this->A, { 0 } }, { this->B, { 1 } } });
  this->Mesh.finish(0);
  this->add({ { this->C, { 2 } } });
  EXPECT_EQ(idsOf({ this->B }), this->gathered(1));
  EXPECT_EQ(idsOf({ this->C }), this->gathered(2));
  EXPECT_EQ(2U, this->Mesh.size());
}

TEST(SeamTriangles, AppendingKeepsWhatEachTriangleMeets)
{
  SeamTriangles all =
    seamTriangles({ { seamTriangle(1, 0, 0, 0), { 5, 6 } }, { seamTriangle(4, 0, 0, 0), {} } });
  all.append(seamTriangles({ { seamTriangle(7, 0, 0, 0), { 8 } } }));
  all.append(SeamTriangles());
  const auto met = [&](std::size_t i)
  { return std::vector<PartitionIndex>(all.metBegin(i), all.metEnd(i)); };
  ASSERT_EQ(3U, all.Triangles.size());
  EXPECT_EQ((std::vector<PartitionIndex>{ 5, 6 }), met(0));
  EXPECT_TRUE(met(1).empty());
  EXPECT_EQ((std::vector<PartitionIndex>{ 8 }), met(2));
}

TEST(SeamTriangles, AddingNotesThePartitionsThatTheDiskMeets)
{
  const Tiling tiling = Tiling::grid({ 0, 0, 4, 4 }, 4, 4);
  const Point2 a{ 0.9, 0.5 };
  const Point2 b{ 1.1, 0.5 };
  const Point2 c{ 1, 0.6 };
  SeamTriangles triangles;
  triangles.add(tiling, seamTriangle(1, 0, 0, 0), Circumdisk(a, b, c));
  std::vector<PartitionIndex> met(triangles.metBegin(0), triangles.metEnd(0));
  std::sort(met.begin(), met.end());
  std::vector<PartitionIndex> expected{ tiling.locate(a), tiling.locate(b) };
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(expected, met);
}

TEST(SeamVertex, ItsLabelTellsPartitionAndQuadrant)
{
  const Tiling tiling = Tiling::grid({ 0, 0, 4, 4 }, 2, 2);
  const PartitionIndex p = tiling.locate({ 3, 3 });
  Labels labels;
  for (const Point2 at :
    { Point2{ 2.1, 2.1 }, Point2{ 3.9, 2.1 }, Point2{ 2.1, 3.9 }, Point2{ 3.9, 3.9 } })
  {
    const SeamVertex v = makeSeamVertex(tiling, p, at, 7);
    EXPECT_EQ(p, v.partition());
    EXPECT_FALSE(v.isArtificial());
    labels.push_back(v.Label);
  }
  std::sort(labels.begin(), labels.end());
  EXPECT_EQ(labels.end(), std::unique(labels.begin(), labels.end()));
}

TEST(SeamVertex, ANegativeIdIsArtificial)
{
  EXPECT_TRUE(makeSeamVertex(Tiling::grid({ 0, 0, 4, 4 }, 2, 2), 0, { -1, -1 }, -1).isArtificial());
}

} // namespace
