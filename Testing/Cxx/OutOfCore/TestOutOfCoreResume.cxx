// SPDX-License-Identifier: BSD-3-Clause
// An interrupted run can be resumed, and makes the same files.
#include "OutOfCoreTesting.h"

#include "ExpectIOError.h"
#include "Npy/NpyFile.h"

#include <filesystem>
#include <fstream>
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

TEST_P(OutOfCoreResume, MakesTheSameFilesAfterAnyInterruption)
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
    this->Options.MemoryLimit = round % 2 == 0 ? 1 : OutOfCoreOptions().MemoryLimit;
    OutOfCoreStatistics statistics;
    int ended = 0;
    do
    {
      // Later runs need more calls, since they verify what earlier ones have written.
      int calls = int(random() % 60) + 2 * ended++;
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
    this->Options.Progress = [](double fraction) { return fraction < 0.6; };
    // With one thread, the run always ends at the same step.
    this->Options.Threads = 1;
    ASSERT_TRUE(this->run().Kept);
    this->Options.Threads = 2;
    this->Options.Progress = {};
  }
};

TEST_F(OutOfCoreBegun, IsResumedOnlyOnRequest)
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

TEST_F(OutOfCoreBegun, ReportsADamagedPlan)
{
  const std::string plan = this->Folder.path(".mesh.tipp.part/.plan");
  std::string content = contentOf(plan);
  content[content.size() / 2] ^= 1;
  this->Folder.file(".mesh.tipp.part/.plan", content);
  this->Options.Resume = true;
  expectIOError(plan, "is damaged", [this] { this->run(); });
}

TEST_F(OutOfCoreBegun, ReportsAMissingPlan)
{
  const std::string plan = this->Folder.path(".mesh.tipp.part/.plan");
  fs::remove(plan);
  this->Options.Resume = true;
  expectIOError(plan, "is missing", [this] { this->run(); });
  EXPECT_FALSE(fs::is_empty(this->Folder.path(".mesh.tipp.part/mesh.tipp/pieces")));
}

class OutOfCoreDamaged : public OutOfCoreBegun
{
protected:
  /// Resumes the run. Expects a warning that names the damaged file, and the files of an
  /// uninterrupted run.
  void expectMadeAgain(const std::string& damaged)
  {
    std::vector<std::string> warnings;
    this->Options.Warn = [&](const std::string& sentence) { warnings.push_back(sentence); };
    this->Options.Resume = true;
    EXPECT_TRUE(this->run().Resumed);
    ASSERT_EQ(1U, warnings.size());
    EXPECT_EQ(0U, warnings[0].find(damaged)) << warnings[0];
    const auto resumed = this->files();
    fs::remove_all(this->Folder.path("mesh.tipp"));
    this->run();
    EXPECT_TRUE(resumed == this->files());
    EXPECT_EQ(1U, warnings.size());
  }

  /// The paths of the finished pieces' results.
  std::vector<std::string> results() const
  {
    std::vector<std::string> paths;
    for (const auto& entry : fs::directory_iterator(this->Folder.path(".mesh.tipp.part")))
    {
      if (entry.path().string().compare(0, this->Results.size(), this->Results) == 0)
      {
        paths.push_back(entry.path().string());
      }
    }
    EXPECT_GT(paths.size(), 1U);
    return paths;
  }

  void change(const std::string& path) const
  {
    std::string content = contentOf(path);
    for (std::size_t at = 0; at < content.size(); at += 100)
    {
      content[at] ^= 1;
    }
    std::ofstream(path, std::ios::binary) << content;
  }

  const std::string Pieces = Folder.path(".mesh.tipp.part/mesh.tipp/pieces");
  const std::string Results = Folder.path(".mesh.tipp.part/.piece.");
};

TEST_F(OutOfCoreDamaged, RemakesChangedPieces)
{
  for (const auto& piece : fs::directory_iterator(this->Pieces))
  {
    this->change(piece.path().string());
  }
  this->expectMadeAgain(this->Pieces);
}

TEST_F(OutOfCoreDamaged, RemakesTruncatedPieces)
{
  for (const auto& piece : fs::directory_iterator(this->Pieces))
  {
    fs::resize_file(piece, fs::file_size(piece) / 2);
  }
  this->expectMadeAgain(this->Pieces);
}

TEST_F(OutOfCoreDamaged, RemakesMissingPieces)
{
  fs::remove_all(this->Pieces);
  this->expectMadeAgain(this->Pieces);
}

TEST_F(OutOfCoreDamaged, RemakesPiecesWithChangedResults)
{
  for (const std::string& result : this->results())
  {
    this->change(result);
  }
  this->expectMadeAgain(this->Results);
}

TEST_F(OutOfCoreDamaged, RemakesOnlyTheDamagedPiece)
{
  const std::string result = this->results().front();
  this->change(result);
  this->expectMadeAgain(result + ": is damaged or missing; its piece is made again");
}

TEST_F(OutOfCoreDamaged, RemovesBytesAppendedToPieces)
{
  for (const auto& piece : fs::directory_iterator(this->Pieces))
  {
    std::ofstream(piece.path(), std::ios::app) << std::string(100000, 'x');
  }
  this->Options.Resume = true;
  this->run();
  const auto resumed = this->files();
  fs::remove_all(this->Folder.path("mesh.tipp"));
  this->run();
  EXPECT_TRUE(resumed == this->files());
}

TEST_F(OutOfCoreBegun, ReportsTruncatedSpilledPoints)
{
  const std::string points = this->Folder.path(".mesh.tipp.part/.points.0");
  fs::resize_file(points, fs::file_size(points) - 100);
  this->Options.Resume = true;
  expectIOError(points, "shorter", [this] { this->run(); });
}

TEST_F(OutOfCoreBegun, ReportsDamagedSpilledPoints)
{
  const std::string points = this->Folder.path(".mesh.tipp.part/.points.0");
  std::string content = contentOf(points);
  for (std::size_t at = 0; at < content.size(); at += 500)
  {
    content[at] ^= 1;
  }
  this->Folder.file(".mesh.tipp.part/.points.0", content);
  this->Options.Resume = true;
  expectIOError(points, "is damaged", [this] { this->run(); });
  EXPECT_FALSE(fs::exists(this->Folder.path("mesh.tipp")));
}

TEST_F(OutOfCoreBegun, KeepsAnOlderMeshUntilItIsComplete)
{
  fs::create_directory(this->Folder.path("mesh.tipp"));
  this->Options.Resume = true;
  this->run();
  EXPECT_EQ(2500, openPartitionedMesh(this->Folder.path("mesh.tipp")).Points);
}

/// A run that was killed after it finished its mesh, but before it renamed it to its final path.
class OutOfCoreWhole : public OutOfCoreResume
{
protected:
  void SetUp() override { this->makeWhole(); }

  void makeWhole()
  {
    writePoints(this->Folder.path("points.npy"), makePointSet("duplicates", 2500));
    this->Options.Progress = [this](double fraction)
    {
      if (fraction == 1)
      {
        fs::copy(this->Part, this->Folder.path("copy"), fs::copy_options::recursive);
      }
      return true;
    };
    this->Whole = this->run();
    this->Options.Progress = {};
    if (!this->Options.CountOnly)
    {
      this->Expected = this->files();
      fs::rename(this->Folder.path("mesh.tipp"), this->Folder.path("published"));
    }
    fs::rename(this->Folder.path("copy"), this->Part);
  }

  void publish() const
  {
    fs::rename(this->Folder.path("published"), this->Folder.path("mesh.tipp"));
  }

  void expectTheSame(const OutOfCoreStatistics& statistics) const
  {
    EXPECT_TRUE(statistics.Resumed);
    EXPECT_EQ(2500, statistics.Points);
    EXPECT_EQ(this->Whole.Triangles, statistics.Triangles);
    EXPECT_EQ(this->Whole.TriangleSum, statistics.TriangleSum);
    EXPECT_EQ(this->Whole.Duplicates, statistics.Duplicates);
    EXPECT_EQ(this->Whole.Pieces, statistics.Pieces);
    EXPECT_EQ(this->Whole.MeshBytes, statistics.MeshBytes);
    EXPECT_FALSE(fs::exists(this->Part));
  }

  const std::string Part = Folder.path(".mesh.tipp.part");
  OutOfCoreStatistics Whole;
  std::map<std::string, std::string> Expected;
};

TEST_F(OutOfCoreWhole, IsRenamedEvenIfItsPointsAreMissing)
{
  for (const char* name : { ".points.0", ".piece.0", ".piece.1.finished" })
  {
    ASSERT_TRUE(fs::remove(this->Part + "/" + name)) << name;
  }
  this->Options.Resume = true;
  this->expectTheSame(this->run());
  EXPECT_TRUE(this->Expected == this->files());
}

TEST_F(OutOfCoreWhole, IsRenamedWithoutARequestToResume)
{
  this->Options.Progress = [](double) { return false; }; // no effect: only renaming is left
  this->expectTheSame(this->run());
  EXPECT_TRUE(this->Expected == this->files());
}

TEST_F(OutOfCoreWhole, IsRefusedForAnotherInput)
{
  writePoints(this->Folder.path("points.npy"), makePointSet("uniform", 2500, 2));
  expectIOError(this->Folder.path("mesh.tipp"), "another run", [this] { this->run(); });
  this->Options.Resume = true;
  expectIOError(this->Folder.path("mesh.tipp"), "changed since", [this] { this->run(); });
  EXPECT_TRUE(this->Expected == filesOf(this->Part + "/mesh.tipp"));
}

TEST_F(OutOfCoreWhole, IsRefusedIfAFileIsMissing)
{
  fs::remove(this->Part + "/mesh.tipp/pieces/000003.vtu");
  this->Options.Resume = true;
  expectIOError(this->Part + "/mesh.tipp", "is damaged", [this] { this->run(); });
}

TEST_F(OutOfCoreWhole, IsRefusedIfAFileHasChanged)
{
  this->Options.Resume = true;
  const std::string mesh = this->Part + "/mesh.tipp/";
  for (const auto& [name, content] : this->Expected)
  {
    std::string damaged = content;
    damaged[damaged.size() - 8] ^= 1;
    std::ofstream(mesh + name, std::ios::binary) << damaged;
    expectIOError(mesh + name, "is damaged", [this] { this->run(); });
    EXPECT_FALSE(fs::exists(this->Folder.path("mesh.tipp")));
    std::ofstream(mesh + name, std::ios::binary) << content;
  }
  this->expectTheSame(this->run());
  EXPECT_TRUE(this->Expected == this->files());
}

TEST_F(OutOfCoreWhole, IsKeptAfterItReplacedAnotherMesh)
{
  this->publish();
  fs::remove_all(this->Part + "/mesh.tipp");
  const TemporaryFolder other;
  triangulateFile(other, makePointSet("uniform", 500), {});
  fs::rename(other.path("mesh.tipp"), this->Part + "/mesh.tipp");
  this->Options.Resume = true;
  this->expectTheSame(this->run());
  EXPECT_TRUE(this->Expected == this->files());
}

TEST_F(OutOfCoreWhole, MayBeReplacedByAnotherInputOnceRenamed)
{
  this->publish();
  const Coordinates xy = makePointSet("uniform", 1000, 2);
  writePoints(this->Folder.path("points.npy"), xy);
  EXPECT_FALSE(this->run().Resumed);
  EXPECT_TRUE(meshMatches(this->Folder.path("mesh.tipp"), xy, reference(xy)));
  EXPECT_FALSE(fs::exists(this->Part));
}

class OutOfCoreCounted : public OutOfCoreWhole
{
protected:
  void SetUp() override
  {
    this->Options.CountOnly = true;
    this->makeWhole();
  }
};

TEST_F(OutOfCoreCounted, IsNotCountedAgain)
{
  ASSERT_TRUE(fs::remove(this->Part + "/.points.0"));
  this->Options.Resume = true;
  this->expectTheSame(this->run());
  EXPECT_EQ(1U, this->Folder.fileCount());
}

} // namespace
