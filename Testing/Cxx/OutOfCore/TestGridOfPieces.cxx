// SPDX-License-Identifier: BSD-3-Clause
// Grids of pieces, with the smallest memory limit, also for points for which partitions do not pay.
#include "OutOfCoreTesting.h"

#include "Npy/NpyFile.h"

#include <filesystem>
#include <random>

namespace
{

namespace fs = std::filesystem;
using namespace tipp;
using namespace tipp::test;

/// With a grid the number of pieces is fixed, so there are several even if partitions do not pay.
class GridOfPieces : public testing::TestWithParam<std::string>
{
protected:
  GridOfPieces()
  {
    this->Options.Columns = 4;
    this->Options.Rows = 4;
    this->Options.PartitionPoints = 40;
    this->Options.Threads = 2;
    writePoints(this->Folder.path("points.npy"), this->XY);
  }

  OutOfCoreStatistics run(std::uint64_t memory)
  {
    this->Options.MemoryLimit = memory;
    const auto points = openPointStream({ this->Folder.path("points.npy") });
    return triangulateOutOfCore(*points, this->Mesh, this->Options);
  }

  static constexpr std::uint64_t Much = std::uint64_t(1) << 30;
  const Coordinates XY = makePointSet(GetParam(), 2000);
  OutOfCoreOptions Options;
  TemporaryFolder Folder;
  const std::string Mesh = Folder.path("mesh.tipp");
};

TEST_P(GridOfPieces, GivesTheSameFilesForAnyMemoryAndThreads)
{
  const std::uint64_t bytes = this->run(Much).BoundaryBytes;
  EXPECT_GT(bytes, 0U);
  EXPECT_TRUE(meshMatches(this->Mesh, this->XY, reference(this->XY)));
  const auto expected = filesOf(this->Mesh);
  for (const int threads : { 1, 3 })
  {
    this->Options.Threads = threads;
    EXPECT_EQ(bytes, this->run(1).BoundaryBytes);
    EXPECT_TRUE(expected == filesOf(this->Mesh)) << threads;
    EXPECT_EQ(2U, this->Folder.fileCount()) << "something is left";
  }
}

TEST_P(GridOfPieces, GivesTheSameFilesAfterInterruptedRuns)
{
  this->run(1);
  const auto expected = filesOf(this->Mesh);
  this->Options.Resume = true;
  std::mt19937 random(1);
  int resumed = 0;
  for (int round = 0; round < 4; ++round)
  {
    fs::remove_all(this->Mesh);
    OutOfCoreStatistics statistics;
    int ended = 0;
    do
    {
      // Later runs need more calls, since they verify what earlier ones have written.
      int calls = int(random() % 40) + 2 * ended++;
      this->Options.Progress = [&calls](double) { return calls-- > 0; };
      // A killed run may leave an unfinished file, which the next run ignores.
      if (fs::exists(this->Folder.path(".mesh.tipp.part")))
      {
        this->Folder.file(".mesh.tipp.part/.piece.0.next", "left over");
      }
      statistics = this->run(round % 2 == 0 ? 1 : Much);
      resumed += statistics.Resumed ? 1 : 0;
    } while (statistics.Aborted);
    ASSERT_TRUE(expected == filesOf(this->Mesh)) << round;
    ASSERT_EQ(2U, this->Folder.fileCount()) << "something is left";
  }
  EXPECT_GT(resumed, 4);
}

INSTANTIATE_TEST_SUITE_P(PointSets, GridOfPieces,
  testing::Values("circle", "cocircular", "parabola", "collinear-and-one", "spiral", "uniform",
    "clustered", "duplicates"),
  [](const auto& info)
  {
    std::string name = info.param;
    name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
    return name;
  });

} // namespace
