// SPDX-License-Identifier: BSD-3-Clause
#include "ExpectIOError.h"
#include "MeshChecks.h"
#include "TemporaryFolder.h"

#include "Flat/FlatMesh.h"
#include "Partitioning/PartitionMesh.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>

namespace fs = std::filesystem;
using namespace tipp;
using namespace tipp::test;

namespace
{

class Publication : public testing::Test
{
protected:
  Publication()
    : Source(makeSource(latticeTriangles(8, 0.3)))
  {
    writeFlat(this->Source, this->Folder.path("flat"));
  }

  PartitionStatistics make(const PartitionOptions& options = {}) const
  {
    return partitionMesh(
      openFlatMesh(this->Folder.path("flat")), this->Folder.path("mesh"), options);
  }

  SourceMesh Source;
  TemporaryFolder Folder;
};

TEST_F(Publication, LeavesNothingBesideTheMesh)
{
  this->make();
  EXPECT_EQ(2U, this->Folder.fileCount());
  for (const auto& [name, content] : filesOf(this->Folder.path("mesh")))
  {
    EXPECT_NE('.', name[0]) << name;
  }
}

TEST_F(Publication, LeavesNothingOfARunThatIsStopped)
{
  for (int calls = 0; calls < 6; ++calls)
  {
    PartitionOptions options;
    int left = calls;
    options.ChunkCells = 40;
    options.Progress = [&left](double) { return left-- > 0; };
    EXPECT_TRUE(this->make(options).Aborted);
    EXPECT_EQ(1U, this->Folder.fileCount());
  }
}

TEST_F(Publication, EndsAtTheFirstWishToStopWhereverItComes)
{
  int calls = 0;
  for (bool aborted = true; aborted; ++calls)
  {
    PartitionOptions options;
    int made = 0;
    options.ChunkCells = 40;
    options.Tiling = *TilingChoice::parse("quadtree:40");
    options.DuplicateBorrowers = true;
    options.Progress = [&](double) { return made++ < calls; };
    aborted = this->make(options).Aborted;
    if (aborted)
    {
      ASSERT_EQ(calls + 1, made);
      ASSERT_EQ(1U, this->Folder.fileCount());
    }
  }
  EXPECT_GT(calls, 50);
}

TEST_F(Publication, AsksInEveryPhaseWhetherToGoOnHoweverLargeTheChunks)
{
  writeFlat(makeSource(latticeTriangles(300, 0.3)), this->Folder.path("flat")); // 180,000 cells
  std::map<double, int> calls; // by the fraction that was done
  PartitionOptions options;
  options.Threads = 1;
  options.Tiling = *TilingChoice::parse("quadtree:20000");
  options.Progress = [&calls](double fraction)
  {
    ++calls[fraction];
    return true;
  };
  this->make(options);
  const auto count = [&calls](double from, double to)
  {
    int sum = 0;
    for (auto at = calls.lower_bound(from); at != calls.lower_bound(to); ++at)
    {
      sum += at->second;
    }
    return sum;
  };
  EXPECT_GT(count(0, 0.3), 15) << "tiling and cells";
  EXPECT_GT(count(0.5, 0.6), 2) << "points";
  EXPECT_GT(count(0.7, 0.95), 50) << "pieces";
}

TEST_F(Publication, ToldToStopWhenTheMeshIsThereKeepsIt)
{
  PartitionOptions options;
  options.Progress = [](double fraction) { return fraction < 1; };
  EXPECT_FALSE(this->make(options).Aborted);
  expectHolds(this->Folder.path("mesh"), this->Source);
}

TEST_F(Publication, RefusesMorePiecesThanAMeshCanHave)
{
  PartitionOptions options;
  options.Tiling = *TilingChoice::parse("grid:10000x10000");
  expectIOError(this->Folder.path("flat"), "coarser tiling", [&] { this->make(options); });
  EXPECT_EQ(1U, this->Folder.fileCount());
}

TEST_F(Publication, LeavesTheSourceAlone)
{
  const auto before = filesOf(this->Folder.path("flat"));
  this->make();
  EXPECT_TRUE(before == filesOf(this->Folder.path("flat")));
}

TEST_F(Publication, ReplacesAnOldMesh)
{
  PartitionOptions options;
  options.Tiling = *TilingChoice::parse("grid:5x5");
  this->make(options);
  this->make();
  EXPECT_EQ(2U, this->Folder.fileCount());
  EXPECT_EQ(16U, openPartitionedMesh(this->Folder.path("mesh")).Pieces.size());
  expectHolds(this->Folder.path("mesh"), this->Source);
}

TEST_F(Publication, KeepsAnOldMeshWhenARunIsStopped)
{
  this->make();
  const auto before = filesOf(this->Folder.path("mesh"));
  PartitionOptions options;
  options.Tiling = *TilingChoice::parse("grid:5x5");
  options.Progress = [](double fraction) { return fraction < 0.9; };
  EXPECT_TRUE(this->make(options).Aborted);
  EXPECT_TRUE(before == filesOf(this->Folder.path("mesh")));
}

TEST_F(Publication, TakesAnEmptyFolder)
{
  fs::create_directory(this->Folder.path("mesh"));
  this->make();
  expectHolds(this->Folder.path("mesh"), this->Source);
}

TEST_F(Publication, RefusesAFolderOfOtherThings)
{
  fs::create_directory(this->Folder.path("mesh"));
  this->Folder.file("mesh/thesis.tex", "years of work");
  expectIOError(this->Folder.path("mesh"), "no partitioned mesh", [this] { this->make(); });
  EXPECT_EQ("years of work", contentOf(this->Folder.path("mesh/thesis.tex")));
}

TEST_F(Publication, RefusesAFile)
{
  this->Folder.file("mesh", "text");
  expectIOError(this->Folder.path("mesh"), "no partitioned mesh", [this] { this->make(); });
}

TEST_F(Publication, NamesAMissingFolder)
{
  const std::string path = this->Folder.path("none/mesh");
  expectIOError(
    path, "does not exist", [&] { partitionMesh(openFlatMesh(this->Folder.path("flat")), path); });
}

TEST_F(Publication, ClearsAwayWhatAKilledRunHasLeft)
{
  fs::create_directories(this->Folder.path(".mesh.tmp.Ab3dEf/pieces"));
  fs::create_directories(this->Folder.path(".other.tmp.Ab3dEf"));
  this->make();
  EXPECT_FALSE(fs::exists(this->Folder.path(".mesh.tmp.Ab3dEf")));
  EXPECT_TRUE(fs::exists(this->Folder.path(".other.tmp.Ab3dEf")));
}

TEST_F(Publication, NamesAVertexIdThatIsNoPoints)
{
  SourceMesh bad = this->Source;
  bad.Cells[10] = 1000000;
  writeFlat(bad, this->Folder.path("flat"));
  EXPECT_THROW(this->make(), IOError);
  EXPECT_EQ(1U, this->Folder.fileCount());
}

} // namespace
