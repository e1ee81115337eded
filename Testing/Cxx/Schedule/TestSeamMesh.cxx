// SPDX-License-Identifier: BSD-3-Clause
#include "ScheduleTesting.h"

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

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

/// The same in the simplest way: all triangles ever added.
class Model
{
public:
  void add(const SeamTriangle& triangle, const std::set<PartitionIndex>& met)
  {
    this->All.push_back({ triangle, met });
  }

  void finish(PartitionIndex p)
  {
    this->Finished.insert(p);
    this->All.erase(std::remove_if(this->All.begin(), this->All.end(),
                      [p](const Member& m) { return m.Met.count(p) > 0; }),
      this->All.end());
  }

  bool isFinal(const std::set<PartitionIndex>& met) const
  {
    return std::includes(this->Finished.begin(), this->Finished.end(), met.begin(), met.end());
  }

  std::vector<SeamTriangle> belonging(PartitionIndex p) const
  {
    std::vector<SeamTriangle> triangles;
    for (const Member& m : this->All)
    {
      if (m.Met.count(p) > 0)
      {
        triangles.push_back(m.Corners);
      }
    }
    return triangles;
  }

  std::size_t size() const { return this->All.size(); }

private:
  struct Member
  {
    SeamTriangle Corners;
    std::set<PartitionIndex> Met;
  };
  std::vector<Member> All;
  std::set<PartitionIndex> Finished;
};

/// Slots are used again hundreds of times here.
class SeamMeshBesideAModel : public testing::Test
{
public:
  static constexpr PartitionIndex Partitions = 30;

  /// Some triangles, each of a few partitions side by side.
  void addSome()
  {
    for (int i = 0; i < 40; ++i)
    {
      std::set<PartitionIndex> met;
      const auto first = PartitionIndex(this->Random() % Partitions);
      for (PartitionIndex p = first; p < std::min(Partitions, first + 1 + i % 4); ++p)
      {
        met.insert(p);
      }
      const auto label = [this] { return std::uint32_t(this->Random() % (4 * Partitions)); };
      const SeamTriangle t = seamTriangle(this->NextId += 3, label(), label(), label());
      this->Mesh.add(
        seamTriangles({ { t, std::vector<PartitionIndex>(met.begin(), met.end()) } }), this->Final);
      if (this->Expected.isFinal(met))
      {
        this->ExpectedFinal.push_back(t);
      }
      else
      {
        this->Expected.add(t, met);
      }
    }
  }

  /// All partitions, one after the other.
  template <typename Check>
  void run(Check&& check)
  {
    std::vector<PartitionIndex> order(static_cast<std::size_t>(Partitions));
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), this->Random);
    this->addSome();
    for (std::size_t i = 0; i < order.size(); ++i)
    {
      this->Mesh.finish(order[i]);
      this->Expected.finish(order[i]);
      this->addSome();
      for (std::size_t j = i + 1; j < order.size(); ++j)
      {
        check(order[j]);
      }
    }
  }

  SeamMesh Mesh{ Partitions };
  Model Expected;
  std::vector<SeamTriangle> Final;
  std::vector<SeamTriangle> ExpectedFinal;
  std::mt19937_64 Random{ 4 };
  std::int64_t NextId = 0;
};

TEST_F(SeamMeshBesideAModel, GathersTheSameTriangles)
{
  std::vector<SeamTriangle> gathered;
  this->run(
    [&](PartitionIndex p)
    {
      this->Mesh.reach(p); // which drops superseded entries
      this->Mesh.gather(p, gathered);
      ASSERT_EQ(idsOf(this->Expected.belonging(p)), idsOf(gathered));
      ASSERT_EQ(this->Expected.size(), this->Mesh.size());
    });
  EXPECT_EQ(idsOf(this->ExpectedFinal), idsOf(this->Final));
  EXPECT_EQ(0U, this->Mesh.size());
}

/// A label too many makes a partition wait; one too few would let conflicting ones be active.
TEST_F(SeamMeshBesideAModel, ReachMissesNoLabel)
{
  this->run(
    [&](PartitionIndex p)
    {
      const Labels reach = this->Mesh.reach(p);
      const std::set<std::uint32_t> labels(reach.begin(), reach.end());
      ASSERT_EQ(labels.size(), reach.size()) << "a label is named twice";
      for (const SeamTriangle& t : this->Expected.belonging(p))
      {
        ASSERT_TRUE(
          labels.count(t[0].Label) && labels.count(t[1].Label) && labels.count(t[2].Label));
      }
    });
}

TEST(SeamTriangles, AppendingKeepsWhatEachTriangleMeets)
{
  SeamTriangles all =
    seamTriangles({ { seamTriangle(1, 0, 0, 0), { 5, 6 } }, { seamTriangle(4, 0, 0, 0), {} } });
  all.appendTriangles(seamTriangles({ { seamTriangle(7, 0, 0, 0), { 8 } } }));
  all.appendTriangles(SeamTriangles());
  const auto met = [&](std::size_t i)
  { return std::vector<PartitionIndex>(all.metBegin(i), all.metEnd(i)); };
  ASSERT_EQ(3U, all.size());
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
  triangles.add(tiling, { 0, 1, 2 }, Circumdisk(a, b, c));
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
