// SPDX-License-Identifier: BSD-3-Clause
// A run that was ended can go on, and makes the same files.
#include "OutOfCoreTesting.h"

#include "ExpectIOError.h"
#include "Points/WritePoints.h"

#include <filesystem>
#include <random>

namespace
{

namespace fs = std::filesystem;
using namespace tipp;
using namespace tipp::test;

class OutOfCoreResume : public testing::TestWithParam<std::string>
{
protected:
  OutOfCoreResume()
  {
    this->Options.PiecePoints = 150;
    this->Options.PartitionPoints = 40;
    this->Options.Threads = 2;
  }

  OutOfCoreStatistics run() const
  {
    const auto points = openPointStream({ this->Folder.path("points.npy") });
    return triangulateOutOfCore(*points, this->Folder.path("mesh.tipp"), this->Options);
  }

  std::map<std::string, std::string> files() const
  {
    return filesOf(this->Folder.path("mesh.tipp"));
  }

  OutOfCoreOptions Options;
  TemporaryFolder Folder;
};

TEST_P(OutOfCoreResume, MakesTheSameFilesWhereverItWasEnded)
{
  writePoints(this->Folder.path("points.npy"), makePointSet(GetParam(), 2500));
  this->run();
  const auto expected = this->files();
  std::mt19937 random(1);
  this->Options.Resume = true;
  int resumed = 0;
  for (int round = 0; round < 8; ++round)
  {
    fs::remove_all(this->Folder.path("mesh.tipp"));
    OutOfCoreStatistics statistics;
    do
    {
      int calls = int(random() % 60);
      this->Options.Progress = [&calls](double) { return calls-- > 0; };
      statistics = this->run();
      resumed += statistics.Resumed ? 1 : 0;
    } while (statistics.Aborted);
    ASSERT_TRUE(expected == this->files()) << round;
    ASSERT_EQ(2U, this->Folder.fileCount());
  }
  EXPECT_GT(resumed, 8);
}

INSTANTIATE_TEST_SUITE_P(PointSets, OutOfCoreResume,
  testing::Values("uniform", "clustered", "duplicates", "lattice", "two-clusters"),
  [](const auto& info)
  {
    std::string name = info.param;
    name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
    return name;
  });

class OutOfCoreBegun : public OutOfCoreResume
{
protected:
  void SetUp() override
  {
    writePoints(this->Folder.path("points.npy"), makePointSet("uniform", 2500));
    this->Options.Progress = [](double fraction) { return fraction < 0.4; };
    ASSERT_TRUE(this->run().Kept);
    this->Options.Progress = {};
  }
};

TEST_F(OutOfCoreBegun, RefusesToStartAgainWithoutBeingTold)
{
  expectIOError(this->Folder.path("mesh.tipp"), "resume it", [this] { this->run(); });
  this->Options.Resume = true;
  EXPECT_TRUE(this->run().Resumed);
}

TEST_F(OutOfCoreBegun, RefusesAnInputThatHasChanged)
{
  writePoints(this->Folder.path("points.npy"), makePointSet("uniform", 2500, 2));
  this->Options.Resume = true;
  expectIOError(this->Folder.path("mesh.tipp"), "changed since", [this] { this->run(); });
}

TEST_F(OutOfCoreBegun, RefusesOtherOptions)
{
  this->Options.Resume = true;
  this->Options.PiecePoints = 200;
  expectIOError(this->Folder.path("mesh.tipp"), "other options", [this] { this->run(); });
}

TEST_F(OutOfCoreBegun, NamesADamagedPlan)
{
  const std::string plan = this->Folder.path(".mesh.tipp.part/.plan");
  std::string content = contentOf(plan);
  content[content.size() / 2] ^= 1;
  this->Folder.file(".mesh.tipp.part/.plan", content);
  this->Options.Resume = true;
  expectIOError(plan, "is damaged", [this] { this->run(); });
}

TEST_F(OutOfCoreBegun, NamesSpilledPointsThatAreCutShort)
{
  const std::string points = this->Folder.path(".mesh.tipp.part/.points.0");
  fs::resize_file(points, fs::file_size(points) - 100);
  this->Options.Resume = true;
  expectIOError(points, "shorter", [this] { this->run(); });
}

TEST_F(OutOfCoreBegun, LeavesAnOlderMeshUntilItIsWhole)
{
  fs::create_directory(this->Folder.path("mesh.tipp"));
  this->Options.Resume = true;
  this->run();
  EXPECT_EQ(2500, openPartitionedMesh(this->Folder.path("mesh.tipp")).Points);
}

} // namespace
