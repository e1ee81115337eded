// SPDX-License-Identifier: BSD-3-Clause
// Boundary triangles in groups, and a master's mesh of them.
#include "../Schedule/ScheduleTesting.h"

#include "Distributed/GroupMesh.h"
#include "Distributed/VertexLabelling.h"
#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

/// Two triangles that meet partitions 0 and 1, one that meets 1 and 2, one that meets 0 alone.
SeamTriangles exampleSeams()
{
  return seamTriangles(
    { { seamTriangle(10, 0, 1, 4), { 0, 1 } }, { seamTriangle(20, 5, 6, 8), { 1, 2 } },
      { seamTriangle(30, 0, 2, 5), { 0, 1 } }, { seamTriangle(40, 1, 2, 3), { 0 } } });
}

std::set<std::int64_t> idsOf(const SeamGroups& groups, std::size_t g)
{
  std::set<std::int64_t> ids;
  for (const PlainVertex& v : groups.vertices(g))
  {
    ids.insert(v.Id);
  }
  return ids;
}

std::size_t groupOf(const SeamGroups& groups, const std::vector<PartitionIndex>& met)
{
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    const auto have = groups.met(g);
    if (std::vector<PartitionIndex>(have.begin(), have.end()) == met)
    {
      return g;
    }
  }
  ADD_FAILURE() << "no group meets just these partitions";
  return 0;
}

std::set<std::int64_t> gathered(const GroupMesh& mesh, PartitionIndex partition)
{
  std::vector<PlainVertex> vertices;
  mesh.gather(partition, vertices);
  std::set<std::int64_t> ids;
  for (const PlainVertex& v : vertices)
  {
    ids.insert(v.Id);
  }
  return ids;
}

Bytes saved(const GroupMesh& mesh)
{
  ByteWriter writer;
  mesh.save(writer);
  return writer.take();
}

void restore(GroupMesh& mesh, const Bytes& bytes)
{
  ByteReader reader(bytes);
  mesh.restore(reader);
}

TEST(SeamGrouping, TrianglesThatMeetTheSamePartitionsShareAGroup)
{
  const SeamGroups groups = SeamGrouping().group(exampleSeams());
  ASSERT_EQ(groups.size(), 3u);
  const std::size_t both = groupOf(groups, { 0, 1 });
  EXPECT_EQ(groups.triangles(both).size(), 2u);
  EXPECT_EQ(idsOf(groups, both), (std::set<std::int64_t>{ 10, 11, 12, 30, 31, 32 }));
  const auto labels = groups.labels(both);
  EXPECT_EQ(std::set<std::uint32_t>(labels.begin(), labels.end()),
    (std::set<std::uint32_t>{ 0, 1, 2, 4, 5 }));
}

TEST(SeamGrouping, AFinishedPartitionIsLeftOut)
{
  const SeamGroups groups = SeamGrouping().group(exampleSeams(), 1);
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups.triangles(groupOf(groups, { 0 })).size(), 3u);
  EXPECT_EQ(groups.triangles(groupOf(groups, { 2 })).size(), 1u);
}

TEST(SeamGrouping, AVertexComesOnceInAGroup)
{
  SeamTriangles seams = exampleSeams();
  seams.Triangles[2][0] = seams.Triangles[0][1];
  const SeamGroups groups = SeamGrouping().group(seams);
  EXPECT_EQ(groups.vertices(groupOf(groups, { 0, 1 })).size(), 5u);
}

TEST(LabelVertices, GivesEachVertexOnceWithItsBoxsLabel)
{
  const Tiling boxes = Tiling::grid({ 0, 0, 2, 1 }, 2, 1);
  std::vector<PlainVertex> vertices = { { { 1.6, 0.7 }, 9 }, { { 0.1, 0.2 }, 4 },
    { { 1.6, 0.7 }, 9 }, { { 1.2, 0.1 }, -2 } };
  const std::vector<SeamVertex> labelled = labelVertices(boxes, vertices);
  ASSERT_EQ(labelled.size(), 3u);
  for (const SeamVertex& v : labelled)
  {
    EXPECT_EQ(v.partition(), boxes.locate(v.Place)) << v.Id;
    EXPECT_EQ(v.Label, makeSeamVertex(boxes, v.partition(), v.Place, v.Id).Label);
  }
}

TEST(SeamGroups, ComeBackFromTheirBytes)
{
  const SeamGroups groups = SeamGrouping().group(exampleSeams());
  ByteWriter writer;
  groups.write(writer);
  const Bytes bytes = writer.take();
  ByteReader reader(bytes);
  const SeamGroups back = SeamGroups::read(reader);
  EXPECT_EQ(reader.left(), 0u);
  ASSERT_EQ(back.size(), groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    EXPECT_EQ(idsOf(back, g), idsOf(groups, g));
    EXPECT_EQ(back.triangles(g).size(), groups.triangles(g).size());
  }
}

TEST(SeamGroups, DamagedBytesAreRefusedOrStillWithinBounds)
{
  ByteWriter writer;
  SeamGrouping().group(exampleSeams()).write(writer);
  const Bytes good = writer.take();
  int refused = 0;
  for (std::size_t at = 0; at < good.size(); ++at)
  {
    Bytes bytes(good.size());
    std::copy(good.begin(), good.end(), bytes.begin());
    bytes[at] = static_cast<char>(bytes[at] ^ 0x5b);
    try
    {
      ByteReader reader(bytes);
      const SeamGroups groups = SeamGroups::read(reader);
      for (std::size_t g = 0; g < groups.size(); ++g)
      {
        for (const SeamGroups::Corners& corners : groups.triangles(g))
        {
          EXPECT_LT(std::max({ corners[0], corners[1], corners[2] }), groups.vertices(g).size());
        }
      }
    }
    catch (const std::runtime_error&)
    {
      ++refused;
    }
  }
  EXPECT_GT(refused, 0);
}

TEST(GroupMesh, HandsBackWhatMeetsFinishedPartitionsOnly)
{
  GroupMesh mesh(3, { 1, 2 });
  const SeamGroups groups = SeamGrouping().group(exampleSeams());
  const std::size_t ofZero = groupOf(groups, { 0 });
  const GroupMesh::Final final = mesh.add(groups);
  ASSERT_EQ(final.Indices.size(), 1u);
  EXPECT_EQ(final.Indices[0], ofZero);
  EXPECT_EQ(mesh.size(), 3u);
}

TEST(GroupMesh, GathersTheVerticesOfAPartitionsTriangles)
{
  GroupMesh mesh(3, { 0, 1, 2 });
  mesh.add(SeamGrouping().group(exampleSeams()));
  EXPECT_EQ(gathered(mesh, 2), (std::set<std::int64_t>{ 20, 21, 22 }));
  EXPECT_EQ(gathered(mesh, 0), (std::set<std::int64_t>{ 10, 11, 12, 30, 31, 32, 40, 41, 42 }));
}

TEST(GroupMesh, FinishingAPartitionTakesItsTrianglesFromTheOthers)
{
  GroupMesh mesh(3, { 0, 1, 2 });
  mesh.add(SeamGrouping().group(exampleSeams()));
  mesh.finish(0);
  EXPECT_EQ(mesh.size(), 1u);
  EXPECT_EQ(gathered(mesh, 1), (std::set<std::int64_t>{ 20, 21, 22 }));
  mesh.finish(2);
  EXPECT_EQ(mesh.size(), 0u);
}

/// One triangle for each pair of neighbours in a row of partitions, and one for each three.
SeamTriangles rowOfSeams(PartitionIndex partitions)
{
  std::vector<std::pair<SeamTriangle, std::vector<PartitionIndex>>> seams;
  for (PartitionIndex p = 0; p + 2 < partitions; ++p)
  {
    seams.push_back({ seamTriangle(100 * p, 0, 1, 4), { p, p + 1 } });
    seams.push_back({ seamTriangle(100 * p + 50, 0, 1, 4), { p, p + 1, p + 2 } });
  }
  return seamTriangles(seams);
}

TEST(GroupMesh, KeepsTheOthersTrianglesWhateverIsFinished)
{
  constexpr PartitionIndex partitions = 9;
  std::vector<PartitionIndex> all(partitions);
  std::iota(all.begin(), all.end(), 0);
  GroupMesh mesh(partitions, all);
  mesh.add(SeamGrouping().group(rowOfSeams(partitions)));
  for (const PartitionIndex finished : { 4, 5, 3, 0, 8, 7, 1 })
  {
    mesh.finish(finished);
    for (PartitionIndex p = 0; p < partitions; ++p)
    {
      std::set<std::int64_t> expected;
      const auto live = [&](PartitionIndex q) { return !mesh.isFinished(q); };
      for (PartitionIndex q = 0; live(p) && q + 2 < partitions; ++q)
      {
        for (const PartitionIndex last : { q + 1, q + 2 })
        {
          const std::int64_t id = 100 * q + (last == q + 1 ? 0 : 50);
          if (q <= p && p <= last && live(q) && live(q + 1) && live(last))
          {
            expected.insert({ id, id + 1, id + 2 });
          }
        }
      }
      ASSERT_EQ(expected, gathered(mesh, p)) << finished << " " << p;
    }
  }
}

/// Everything that a mesh tells of vertices.
void expectSame(const GroupMesh& a, const GroupMesh& b)
{
  EXPECT_EQ(a.size(), b.size());
  for (PartitionIndex p = 0; p < a.partitions(); ++p)
  {
    EXPECT_EQ(gathered(a, p), gathered(b, p)) << p;
    std::multiset<std::int64_t> ofA;
    std::multiset<std::int64_t> ofB;
    a.visitVertices(p, p + 2, [&](const PlainVertex& v) { ofA.insert(v.Id); });
    b.visitVertices(p, p + 2, [&](const PlainVertex& v) { ofB.insert(v.Id); });
    EXPECT_EQ(ofA, ofB) << p;
  }
  const Bytes savedA = saved(a);
  const Bytes savedB = saved(b);
  EXPECT_TRUE(std::equal(savedA.begin(), savedA.end(), savedB.begin(), savedB.end()));
}

TEST(GroupMesh, IsTheSameWithItsVerticesInAFile)
{
  const TemporaryFolder folder;
  VertexFile file(folder.path("rim"));
  constexpr PartitionIndex partitions = 9;
  std::vector<PartitionIndex> all(partitions);
  std::iota(all.begin(), all.end(), 0);
  GroupMesh inMemory(partitions, all);
  GroupMesh spilled(partitions, all);
  inMemory.add(SeamGrouping().group(rowOfSeams(partitions)));
  spilled.add(SeamGrouping().group(rowOfSeams(partitions)));
  spilled.spillTo(file, 0);
  EXPECT_EQ(spilled.vertexBytes(), file.used());
  EXPECT_EQ(inMemory.vertexBytes(), file.used());
  expectSame(inMemory, spilled);
  for (const PartitionIndex finished : { 4, 5, 3, 0, 8, 7, 1 })
  {
    for (GroupMesh* mesh : { &inMemory, &spilled })
    {
      mesh->finish(finished);
      mesh->add(SeamGrouping().group(rowOfSeams(partitions), finished));
    }
    expectSame(inMemory, spilled);
  }
}

TEST(GroupMesh, SpillsNothingThatThereIsMemoryFor)
{
  const TemporaryFolder folder;
  VertexFile file(folder.path("rim"));
  GroupMesh mesh(9, { 0, 1, 2, 3, 4, 5, 6, 7, 8 });
  mesh.spillTo(file, 1 << 20);
  mesh.add(SeamGrouping().group(rowOfSeams(9)));
  EXPECT_EQ(0U, file.written());
  EXPECT_EQ(0U, folder.fileCount());
}

TEST(GroupMesh, LeavesTheFileEmptyWhenAllIsFinished)
{
  const TemporaryFolder folder;
  VertexFile file(folder.path("rim"));
  GroupMesh mesh(3, { 0, 1, 2 });
  mesh.spillTo(file, 0);
  mesh.add(SeamGrouping().group(exampleSeams()));
  EXPECT_GT(file.used(), 0U);
  for (const PartitionIndex p : { 0, 1, 2 })
  {
    mesh.finish(p);
  }
  EXPECT_EQ(0U, file.used());
  EXPECT_EQ(0U, mesh.vertexBytes());
}

TEST(GroupMesh, IsMadeAgainOfWhatWasSaved)
{
  GroupMesh mesh(3, { 0, 1, 2 });
  mesh.add(SeamGrouping().group(exampleSeams()));
  mesh.finish(2);
  GroupMesh again(3, { 0, 1 });
  restore(again, saved(mesh));
  EXPECT_EQ(mesh.size(), again.size());
  for (const PartitionIndex p : { 0, 1, 2 })
  {
    EXPECT_EQ(gathered(mesh, p), gathered(again, p));
    EXPECT_EQ(mesh.isMet(p), again.isMet(p));
  }
}

TEST(GroupMesh, ReachIsTheLabelsOfAPartitionsTriangles)
{
  GroupMesh mesh(3, { 0, 1, 2 });
  mesh.add(SeamGrouping().group(exampleSeams()));
  const auto reach = [&](PartitionIndex p)
  {
    const std::vector<std::uint32_t>& labels = mesh.reach(p);
    return std::set<std::uint32_t>(labels.begin(), labels.end());
  };
  EXPECT_EQ(reach(2), (std::set<std::uint32_t>{ 5, 6, 8 }));
  EXPECT_EQ(reach(1), (std::set<std::uint32_t>{ 0, 1, 2, 4, 5, 6, 8 }));
  EXPECT_EQ(reach(1).size(), mesh.reach(1).size()) << "each label once";
}

} // namespace
