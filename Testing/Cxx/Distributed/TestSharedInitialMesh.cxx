// SPDX-License-Identifier: BSD-3-Clause
// Ranks make parts of the initial mesh. Each part must agree with the whole mesh, and together they
// must show all conflicts.
#include "../Engine/DataflowScene.h"

#include "Distributed/SharedInitialMesh.h"
#include "Ranks/Archive.h"
#include "Triangulation/InitialMesh.h"

#include <set>

namespace
{

using namespace tipp;
using namespace tipp::test;

/// The vertex ids of each triangle, and the partitions that it meets.
using MetTriangles = std::set<std::pair<std::array<std::int64_t, 3>, std::vector<PartitionIndex>>>;

MetTriangles trianglesThatMeet(const BoundaryTriangles& mesh, const std::vector<char>& isChosen)
{
  MetTriangles triangles;
  for (std::size_t i = 0; i < mesh.size(); ++i)
  {
    std::vector<PartitionIndex> met(mesh.metBegin(i), mesh.metEnd(i));
    if (std::any_of(
          met.begin(), met.end(), [&](PartitionIndex p) { return isChosen[std::size_t(p)] != 0; }))
    {
      const BoundaryTriangle t = mesh[i];
      std::array<std::int64_t, 3> ids = { t[0].Id, t[1].Id, t[2].Id };
      std::sort(ids.begin(), ids.end());
      triangles.emplace(ids, met);
    }
  }
  return triangles;
}

struct SharedScene
{
  SharedScene(const std::string& set, std::size_t count, int partitions)
    : XY(makePointSet(set, count))
    , Tiles(Tiling::balanced(test::boundsOf(this->XY), asPoints(this->XY), partitions))
    , Buckets(bucketPoints<std::int32_t>(view(this->XY), this->Tiles, 1))
    , Boxes(this->Tiles, this->Buckets, 1)
    , Artificial(makeArtificialPoints(this->Tiles))
    , Initial(chooseInitialPoints(this->Tiles, this->Buckets, 8, 1))
  {
    keepOneOfEachPosition(this->Initial);
    std::vector<BoundaryVertex> all = this->Initial;
    all.insert(all.end(), this->Artificial.begin(), this->Artificial.end());
    this->Whole = triangulateVertices<2>(this->Boxes, all, 1);
  }
  SharedScene(const SharedScene&) = delete;
  SharedScene& operator=(const SharedScene&) = delete;

  InitialMeshPart part(const std::vector<char>& isChosen, int threads = 1) const
  {
    return InitialMeshPart(this->Boxes, this->Initial, this->Artificial, isChosen, threads);
  }

  Coordinates XY;
  Tiling Tiles;
  PointBuckets<std::int32_t> Buckets;
  Regions Boxes;
  std::vector<BoundaryVertex> Artificial;
  std::vector<BoundaryVertex> Initial;
  BoundaryTriangles Whole;
};

class SharedInitialMesh : public testing::TestWithParam<std::string>
{
};

TEST_P(SharedInitialMesh, PartsAreThoseOfTheWholeMesh)
{
  for (const int partitions : { 7, 60, 400 })
  {
    const SharedScene scene(GetParam(), 5000, partitions);
    const std::size_t count = scene.Boxes.areUsed().size();
    // If partitions do not pay, nearly all of them conflict, and conflicts are not computed.
    const bool partitionsPay = tipp::partitionsPay(scene.Whole);
    const auto expected = partitionsPay ? findConflicts(scene.Whole, count) : std::nullopt;
    for (const std::size_t ranks : { std::size_t(1), std::size_t(5), std::size_t(40) })
    {
      std::vector<PartConflicts> parts;
      std::int64_t triangles = 0;
      std::int64_t met = 0;
      for (std::size_t rank = 0; rank < ranks; ++rank)
      {
        std::vector<char> isChosen(count, 0);
        for (std::size_t p = 0; p < count; ++p)
        {
          isChosen[p] = p * ranks / count == rank;
        }
        const InitialMeshPart part = scene.part(isChosen, 1 + int(rank % 3));
        ASSERT_EQ(trianglesThatMeet(scene.Whole, isChosen), trianglesThatMeet(part.Mesh, isChosen))
          << partitions << " partitions, rank " << rank << " of " << ranks;
        part.countMet(triangles, met);
        if (partitionsPay)
        {
          parts.push_back(part.conflicts());
        }
      }
      EXPECT_EQ(partitionsPay, tipp::partitionsPay(triangles, met));
      const auto conflicts = joinConflicts(parts, count);
      for (PartitionIndex p = 0; partitionsPay && std::size_t(p) < count; ++p)
      {
        ASSERT_TRUE(expected && conflicts);
        ASSERT_EQ(expected->neighbours(p), conflicts->neighbours(p))
          << "partition " << p << " of " << partitions << ", " << ranks << " ranks";
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, SharedInitialMesh,
  testing::Values("uniform", "clustered", "lattice-shuffled", "survey-lines", "cocircular",
    "duplicates", "circle", "collinear-and-one"));

/// A part is made from the initial points around it only.
TEST(InitialMeshPart, APartHasFewVertices)
{
  const SharedScene scene("uniform", 40000, 4000);
  std::vector<char> isChosen(scene.Boxes.areUsed().size(), 0);
  std::fill_n(isChosen.begin(), 16, char(1));
  const InitialMeshPart part = scene.part(isChosen);
  EXPECT_LT(part.Mesh.Vertices.size(), scene.Initial.size() / 5);
}

TEST(InitialMeshPart, DamagedConflictsAreRejected)
{
  const SharedScene scene("uniform", 2000, 40);
  const PartConflicts good = scene.part(scene.Boxes.areUsed()).conflicts();
  EXPECT_THROW(joinConflicts({ good }, 3), std::runtime_error); // ids of too many partitions
  const Bytes bytes = packed(good);
  SaveArchive shortened;
  shortened.raw(bytes.data(), bytes.size() - 4);
  EXPECT_THROW(unpacked<PartConflicts>(shortened.take()), std::runtime_error);
}

} // namespace
