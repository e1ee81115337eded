// SPDX-License-Identifier: BSD-3-Clause
#include "ExpectIOError.h"
#include "MeshChecks.h"
#include "TemporaryFolder.h"

#include "Files/PendingOutput.h"
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

  /// The path of a finished mesh that could not be renamed, or an empty string.
  std::string finished() const
  {
    for (const fs::directory_entry& entry : fs::directory_iterator(this->Folder.path("")))
    {
      if (entry.path().filename().string().rfind(".mesh.tmp.", 0) == 0)
      {
        return entry.path().string() + "/mesh";
      }
    }
    return "";
  }

  SourceMesh Source;
  TemporaryFolder Folder;
};

TEST_F(Publication, LeavesNoOtherFiles)
{
  this->make();
  EXPECT_EQ(2U, this->Folder.fileCount());
  for (const auto& [name, content] : filesOf(this->Folder.path("mesh")))
  {
    EXPECT_NE('.', name[0]) << name;
  }
}

TEST_F(Publication, LeavesNoFilesOfAStoppedRun)
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

TEST_F(Publication, StopsAtTheFirstRequestInAnyPhase)
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

TEST_F(Publication, CallsProgressOftenInEveryPhaseForLargeChunks)
{
  writeFlat(makeSource(latticeTriangles(300, 0.3)), this->Folder.path("flat")); // 180,000 cells
  std::map<double, int> calls; // number of calls by the fraction that was done
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

TEST_F(Publication, KeepsAFinishedMeshIfStoppedAtTheEnd)
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

TEST_F(Publication, DoesNotChangeTheSource)
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

TEST_F(Publication, AcceptsAnEmptyFolder)
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

TEST_F(Publication, KeepsAFolderThatAppearsMeanwhile)
{
  PartitionOptions options;
  const std::string notes = this->Folder.path("mesh/thesis.tex");
  options.Progress = [&](double)
  {
    fs::create_directory(this->Folder.path("mesh"));
    this->Folder.file("mesh/thesis.tex", "years of work");
    return true;
  };
  expectIOError(this->Folder.path("mesh"), "has appeared since", [&] { this->make(options); });
  EXPECT_EQ("years of work", contentOf(notes));
  expectHolds(this->finished(), this->Source);
  fs::rename(this->Folder.path("mesh"), this->Folder.path("other"));
  this->make(); // must not remove the finished mesh
  expectHolds(this->finished(), this->Source);
}

TEST_F(Publication, KeepsAFileAddedToTheOldMeshMeanwhile)
{
  this->make();
  PartitionOptions options;
  options.Progress = [&](double)
  {
    this->Folder.file("mesh/pieces/thesis.tex", "years of work");
    return true;
  };
  expectIOError(
    this->Folder.path("mesh"), "holds 'pieces/thesis.tex'", [&] { this->make(options); });
  EXPECT_EQ("years of work", contentOf(this->Folder.path("mesh/pieces/thesis.tex")));
  expectHolds(this->Folder.path("mesh"), this->Source);
  expectHolds(this->finished(), this->Source);
}

TEST_F(Publication, KeepsAMeshThatReplacedTheOldOneMeanwhile)
{
  this->make();
  fs::copy(this->Folder.path("mesh"), this->Folder.path("copy"), fs::copy_options::recursive);
  PartitionOptions options;
  options.Progress = [&](double)
  {
    if (fs::exists(this->Folder.path("copy")))
    {
      fs::remove_all(this->Folder.path("mesh"));
      fs::rename(this->Folder.path("copy"), this->Folder.path("mesh"));
    }
    return true;
  };
  expectIOError(this->Folder.path("mesh"), "has been changed since", [&] { this->make(options); });
  expectHolds(this->Folder.path("mesh"), this->Source);
  expectHolds(this->finished(), this->Source);
}

TEST_F(Publication, RefusesAnOldMeshThatHoldsOtherFiles)
{
  this->make();
  this->Folder.file("mesh/notes.txt", "years of work");
  expectIOError(this->Folder.path("mesh"), "holds 'notes.txt'", [this] { this->make(); });
  EXPECT_EQ("years of work", contentOf(this->Folder.path("mesh/notes.txt")));
  EXPECT_EQ(2U, this->Folder.fileCount());
}

TEST_F(Publication, ReplacesAnOldMeshWhosePiecesAreMissing)
{
  this->make();
  fs::remove(this->Folder.path("mesh/pieces/000003.vtu"));
  this->make();
  expectHolds(this->Folder.path("mesh"), this->Source);
}

TEST_F(Publication, KeepsAUsersFolderNamedLikeAWorkFolder)
{
  fs::create_directories(this->Folder.path(".mesh.tmp.Ab3dEf"));
  this->Folder.file(".mesh.tmp.Ab3dEf/thesis.tex", "years of work");
  this->make();
  EXPECT_EQ("years of work", contentOf(this->Folder.path(".mesh.tmp.Ab3dEf/thesis.tex")));
}

TEST_F(Publication, KeepsAUsersFileInALeftoverWorkFolder)
{
  fs::create_directories(this->Folder.path(".mesh.tmp.Ab3dEf/mesh/pieces"));
  this->Folder.file(".mesh.tmp.Ab3dEf/.tipp-work", "");
  this->Folder.file(".mesh.tmp.Ab3dEf/mesh/pieces/000000.vtu", "piece");
  this->Folder.file(".mesh.tmp.Ab3dEf/mesh/thesis.tex", "years of work");
  this->make();
  EXPECT_FALSE(fs::exists(this->Folder.path(".mesh.tmp.Ab3dEf/mesh/pieces")));
  EXPECT_EQ("years of work", contentOf(this->Folder.path(".mesh.tmp.Ab3dEf/mesh/thesis.tex")));
}

TEST_F(Publication, RemovesALeftoverWorkFolderWithAnUnfinishedPiece)
{
  fs::create_directories(this->Folder.path(".mesh.tmp.Ab3dEf/mesh/pieces"));
  this->Folder.file(".mesh.tmp.Ab3dEf/.tipp-work", "");
  this->Folder.file(".mesh.tmp.Ab3dEf/mesh/pieces/000000.vtu.next", "piece");
  this->make();
  EXPECT_FALSE(fs::exists(this->Folder.path(".mesh.tmp.Ab3dEf")));
}

TEST_F(Publication, ReportsAUsersFolderEachTime)
{
  this->Folder.file(".mesh.part", "a file");
  for (int time = 0; time < 2; ++time)
  {
    expectIOError(this->Folder.path(".mesh.part"), "is a file",
      [&] { PendingFolder::lasting(this->Folder.path("mesh"), nullptr); });
  }
  fs::remove(this->Folder.path(".mesh.part"));
  fs::create_directory(this->Folder.path(".mesh.part"));
  this->Folder.file(".mesh.part/notes.txt", "years of work");
  for (int time = 0; time < 2; ++time) // the second time shows that the lock was released
  {
    expectIOError(this->Folder.path(".mesh.part"), "is there already with other files",
      [&] { PendingFolder::lasting(this->Folder.path("mesh"), nullptr); });
  }
  EXPECT_EQ("years of work", contentOf(this->Folder.path(".mesh.part/notes.txt")));
}

TEST_F(Publication, RefusesAFile)
{
  this->Folder.file("mesh", "text");
  expectIOError(this->Folder.path("mesh"), "no partitioned mesh", [this] { this->make(); });
}

TEST_F(Publication, RefusesAFolderNamedLikeAFileOfAnyFormat)
{
  for (const char* const path :
    { "mesh.vtu", "mesh.las", "mesh.tif", "mesh.geojson", "mesh.vtkhdf" })
  {
    expectIOError(path, "would be a folder", [path] { requireFolderName(path); });
  }
  EXPECT_NO_THROW(requireFolderName("mesh.tipp"));
  EXPECT_NO_THROW(requireFolderName("mesh"));
}

TEST_F(Publication, NamesAMissingFolder)
{
  const std::string path = this->Folder.path("none/mesh");
  expectIOError(
    path, "does not exist", [&] { partitionMesh(openFlatMesh(this->Folder.path("flat")), path); });
}

TEST_F(Publication, RemovesFilesOfAKilledRun)
{
  fs::create_directories(this->Folder.path(".mesh.tmp.Ab3dEf/pieces"));
  fs::create_directories(this->Folder.path(".other.tmp.Ab3dEf"));
  this->make();
  EXPECT_FALSE(fs::exists(this->Folder.path(".mesh.tmp.Ab3dEf")));
  EXPECT_TRUE(fs::exists(this->Folder.path(".other.tmp.Ab3dEf")));
}

TEST_F(Publication, ReportsAnInvalidVertexId)
{
  SourceMesh bad = this->Source;
  bad.Cells[10] = 1000000;
  writeFlat(bad, this->Folder.path("flat"));
  EXPECT_THROW(this->make(), IOError);
  EXPECT_EQ(1U, this->Folder.fileCount());
}

} // namespace
