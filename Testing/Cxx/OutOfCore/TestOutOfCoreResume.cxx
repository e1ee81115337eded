// SPDX-License-Identifier: BSD-3-Clause
// An interrupted run can be resumed, and makes the same files: triangles and tetrahedra.
#include "ResumeTesting.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <set>
#include <utility>

#include <sys/stat.h>

namespace
{

namespace fs = std::filesystem;
using namespace tipp;
using namespace tipp::test;

TYPED_TEST_SUITE(OutOfCoreResume, Engines, );

TYPED_TEST(OutOfCoreResume, MakesTheSameFilesAfterAnyInterruption)
{
  for (const std::string& kind : TypeParam::kinds())
  {
    this->Options = TypeParam::options();
    this->makePoints(kind);
    this->run();
    const auto expected = this->files();
    std::mt19937 random(1);
    this->Options.Resume = true;
    int resumed = 0;
    for (int round = 0; round < 8; ++round)
    {
      fs::remove_all(this->Folder.path("mesh.tipp"));
      bool isAborted = true;
      for (int ended = 0; isAborted; ++ended)
      {
        this->Options.Threads = 1 + (round + ended) % 3;
        this->Options.MemoryLimit = (round + ended) % 2 == 0 ? 1 : 1 << 20;
        // Later runs need more calls, since they verify what earlier ones have written.
        int calls = int(random() % 60) + 2 * ended;
        this->Options.Progress = [&calls](double) { return calls-- > 0; };
        const auto statistics = this->run();
        resumed += statistics.Resumed ? 1 : 0;
        isAborted = statistics.Aborted;
      }
      ASSERT_TRUE(expected == this->files()) << kind << " " << round;
      ASSERT_EQ(2U, this->Folder.fileCount());
    }
    EXPECT_GT(resumed, 8) << kind;
  }
}

template <typename Engine>
class OutOfCoreBegun : public OutOfCoreResume<Engine>
{
protected:
  void SetUp() override
  {
    this->makePoints("uniform");
    this->Options.Progress = [](double fraction) { return fraction < 0.4; };
    // One thread, so that some pieces are done and others not begun.
    this->Options.Threads = 1;
    ASSERT_TRUE(this->run().Kept);
    this->Options.Threads = 2;
    this->Options.Progress = {};
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

  const std::string Pieces = this->Folder.path(".mesh.tipp.part/mesh.tipp/pieces");
  const std::string Results = this->Folder.path(".mesh.tipp.part/.piece.");
};
TYPED_TEST_SUITE(OutOfCoreBegun, Engines, );

TYPED_TEST(OutOfCoreBegun, IsResumedOnlyOnRequest)
{
  expectIOError(this->Folder.path("mesh.tipp"), "resume that run", [this] { this->run(); });
  this->Options.Resume = true;
  EXPECT_TRUE(this->run().Resumed);
}

TYPED_TEST(OutOfCoreBegun, RefusesAnInputThatHasChanged)
{
  this->makePoints("uniform", 2500, 2);
  this->Options.Resume = true;
  expectIOError(this->Folder.path("mesh.tipp"), "since changed input", [this] { this->run(); });
}

TYPED_TEST(OutOfCoreBegun, RefusesOtherOptions)
{
  this->Options.Resume = true;
  this->Options.PiecePoints = 200;
  expectIOError(this->Folder.path("mesh.tipp"), "other options", [this] { this->run(); });
}

TYPED_TEST(OutOfCoreBegun, RefusesTheOtherKindOfMesh)
{
  using Other = std::conditional_t<std::is_same_v<TypeParam, Plane>, Space, Plane>;
  auto options = Other::options();
  const auto run = [&]
  { Other::run(this->Folder.path("points.npy"), this->Folder.path("mesh.tipp"), options); };
  expectIOError(this->Folder.path("mesh.tipp"), "another run", run);
  options.Resume = true;
  expectIOError(this->Folder.path("mesh.tipp"), "other options", run);
  EXPECT_GT(this->results().size(), 1U);
}

TYPED_TEST(OutOfCoreBegun, RefusesTheWorkOfAnotherVersion)
{
  writeCheckedFile(this->Folder.path(".mesh.tipp.part/.plan"),
    [](SaveArchive& archive)
    { archive(std::string("TIPP out of core 0\n"), std::uint8_t(0), std::uint64_t(0)); });
  this->Options.Resume = true;
  expectIOError(this->Folder.path("mesh.tipp"), "another version of TIPP", [this] { this->run(); });
  EXPECT_GT(this->results().size(), 1U);
}

TYPED_TEST(OutOfCoreBegun, MakesNoPieceAgainThatIsDone)
{
  const auto identities = [this]
  {
    std::set<std::pair<std::string, ino_t>> found;
    for (const std::string& path : this->results())
    {
      struct stat status = {};
      EXPECT_EQ(0, stat(path.c_str(), &status));
      found.emplace(path, status.st_ino);
    }
    return found;
  };
  const auto before = identities();
  this->Options.Resume = true;
  this->Options.Progress = [](double fraction) { return fraction < 0.85; }; // all are triangulated
  EXPECT_TRUE(this->run().Aborted);
  const auto after = identities();
  EXPECT_TRUE(std::includes(after.begin(), after.end(), before.begin(), before.end()));
  EXPECT_GT(after.size(), before.size());
}

TYPED_TEST(OutOfCoreBegun, ReportsADamagedPlan)
{
  const std::string plan = this->Folder.path(".mesh.tipp.part/.plan");
  std::string content = contentOf(plan);
  content[content.size() / 2] ^= 1;
  this->Folder.file(".mesh.tipp.part/.plan", content);
  this->Options.Resume = true;
  expectIOError(plan, "is damaged", [this] { this->run(); });
}

TYPED_TEST(OutOfCoreBegun, ReportsAMissingPlan)
{
  const std::string plan = this->Folder.path(".mesh.tipp.part/.plan");
  fs::remove(plan);
  this->Options.Resume = true;
  expectIOError(plan, "is missing", [this] { this->run(); });
  EXPECT_FALSE(fs::is_empty(this->Folder.path(".mesh.tipp.part/mesh.tipp/pieces")));
}

template <typename Engine>
class OutOfCoreDamaged : public OutOfCoreBegun<Engine>
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

  void change(const std::string& path) const
  {
    std::string content = contentOf(path);
    for (std::size_t at = 0; at < content.size(); at += 100)
    {
      content[at] ^= 1;
    }
    std::ofstream(path, std::ios::binary) << content;
  }
};
TYPED_TEST_SUITE(OutOfCoreDamaged, Engines, );

TYPED_TEST(OutOfCoreDamaged, RemakesChangedPieces)
{
  for (const auto& piece : fs::directory_iterator(this->Pieces))
  {
    this->change(piece.path().string());
  }
  this->expectMadeAgain(this->Pieces);
}

TYPED_TEST(OutOfCoreDamaged, RemakesTruncatedPieces)
{
  for (const auto& piece : fs::directory_iterator(this->Pieces))
  {
    fs::resize_file(piece, fs::file_size(piece) / 2);
  }
  this->expectMadeAgain(this->Pieces);
}

TYPED_TEST(OutOfCoreDamaged, RemakesMissingPieces)
{
  fs::remove_all(this->Pieces);
  this->expectMadeAgain(this->Pieces);
}

TYPED_TEST(OutOfCoreDamaged, RemakesPiecesWithChangedResults)
{
  for (const std::string& result : this->results())
  {
    this->change(result);
  }
  this->expectMadeAgain(this->Results);
}

TYPED_TEST(OutOfCoreDamaged, RemakesOnlyTheDamagedPiece)
{
  const std::string result = this->results().front();
  this->change(result);
  this->expectMadeAgain(result + ": is damaged or missing; its piece is made again");
}

TYPED_TEST(OutOfCoreDamaged, RemovesBytesAppendedToPieces)
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

TYPED_TEST(OutOfCoreBegun, ReportsTruncatedSpilledPoints)
{
  const std::string points = this->Folder.path(".mesh.tipp.part/.points.0");
  fs::resize_file(points, fs::file_size(points) - 100);
  this->Options.Resume = true;
  expectIOError(points, "shorter", [this] { this->run(); });
}

TYPED_TEST(OutOfCoreBegun, ReportsDamagedSpilledPoints)
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

TYPED_TEST(OutOfCoreBegun, KeepsAnOlderMeshUntilItIsComplete)
{
  fs::create_directory(this->Folder.path("mesh.tipp"));
  this->Options.Resume = true;
  this->run();
  EXPECT_EQ(2500, openPartitionedMesh(this->Folder.path("mesh.tipp")).Points);
}

} // namespace
