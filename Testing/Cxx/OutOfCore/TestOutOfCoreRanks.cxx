// SPDX-License-Identifier: BSD-3-Clause
// Several ranks make the same files as one process, and end together.
#include "Constraints/TableConstraints.h"
#include "OutOfCore/OutOfCoreOptions.h"
#include "OutOfCoreTesting.h"

#include "Constraints/OnDisk/ConstrainedStream.h"
#include "Files/IOError.h"
#include "Npy/NpyFile.h"
#include "OutOfCore/OutOfCoreTriangulation.h"
#include "OutOfCore/RunOnRanks.h"

#include "vtkErrorCode.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkTIPPOutOfCoreDelaunay2D.h"
#include "vtkTable.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

namespace
{

namespace fs = std::filesystem;
using namespace tipp;
using namespace tipp::test;

using Files = std::map<std::string, std::string>;

class OutOfCoreRanks : public testing::TestWithParam<std::string>
{
protected:
  OutOfCoreRanks()
    : Ranks(this->Controller)
  {
    this->Options.PiecePoints = 150;
    this->Options.PartitionPoints = 40;
    this->Options.Threads = 2;
    this->Options.Neighbors = true;
    if (this->isFirst())
    {
      this->Folder = std::make_unique<TemporaryFolder>();
    }
    this->Points =
      this->Ranks.broadcast(this->isFirst() ? this->Folder->path("points.npy") : std::string());
  }

  void makePoints(const std::string& set, std::size_t count = 2500) const
  {
    if (this->isFirst())
    {
      writePoints(this->Folder->path("points.npy"), makePointSet(set, count));
    }
  }

  bool isFirst() const { return this->Ranks.rank() == 0; }
  std::string mesh() const { return this->isFirst() ? this->Folder->path("mesh.tipp") : ""; }

  std::unique_ptr<PointStream> open() const
  {
    auto points =
      std::make_unique<BrokenStream>(openPointStream({ this->Points }), this->GoodPasses);
    if (this->Constraints.Lines.Edges.empty())
    {
      return points;
    }
    return std::make_unique<ConstrainedStream>(
      std::move(points), this->Constraints, "constraints", 1);
  }

  OutOfCoreStatistics runTogether()
  {
    Communicator ranks(this->Controller); // a new one, since it cannot be used after a failure
    return triangulateOutOfCoreOnRanks(
      ranks, [this] { return this->open(); }, this->mesh(), this->Options);
  }

  /// Runs on the first rank alone, while the other ranks wait.
  OutOfCoreStatistics runAlone()
  {
    OutOfCoreStatistics statistics;
    if (this->isFirst())
    {
      OutOfCoreOptions options = this->Options;
      options.Threads = 1;
      statistics = triangulateOutOfCore(*this->open(), this->mesh(), options);
    }
    this->Ranks.barrier();
    return statistics;
  }

  /// Returns the files of the mesh, and removes the mesh.
  Files takeFiles() const
  {
    Files files;
    if (this->isFirst())
    {
      files = filesOf(this->mesh());
      fs::remove_all(this->mesh());
      EXPECT_EQ(this->InputFiles, this->Folder->fileCount()) << "something is left";
    }
    return files;
  }

  /// The message of the error that all ranks throw if one fails.
  std::string failure()
  {
    try
    {
      this->runTogether();
    }
    catch (const RankFailure& error)
    {
      return error.what();
    }
    return "";
  }

  vtkMultiProcessController* const Controller = vtkMultiProcessController::GetGlobalController();
  Communicator Ranks;
  /// Whether the last rank had a file of spilled points during the run.
  bool lastRankSpills()
  {
    bool isThere = false;
    this->Options.Progress = [&](double)
    {
      isThere = isThere || !this->isFirst() ||
        fs::exists(
          this->Folder->path(".mesh.tipp.part/.points." + std::to_string(this->Ranks.size() - 1)));
      return true;
    };
    this->runTogether();
    this->Options.Progress = {};
    return isThere;
  }

  OutOfCoreOptions Options;
  std::unique_ptr<TemporaryFolder> Folder;
  std::size_t InputFiles = 1; ///< number of input files in the folder
  std::string Points;         ///< path of the points, the same on all ranks
  int GoodPasses = 100;       ///< passes over the input before it fails on this rank
  TableConstraints Constraints;
};

TEST_P(OutOfCoreRanks, MakeTheFilesOfOneProcess)
{
  this->makePoints(GetParam());
  const OutOfCoreStatistics alone = this->runAlone();
  const Files expected = this->takeFiles();
  for (const int threads : { 1, 3 })
  {
    this->Options.Threads = threads;
    const OutOfCoreStatistics together = this->runTogether();
    EXPECT_TRUE(expected == this->takeFiles()) << threads;
    EXPECT_EQ(alone.Triangles, together.Triangles);
    EXPECT_EQ(alone.Duplicates, together.Duplicates);
    EXPECT_EQ(alone.Points, together.Points);
  }
}

TEST_P(OutOfCoreRanks, ResumeRunsOfAnyNumberOfRanks)
{
  this->makePoints(GetParam());
  this->runAlone();
  const Files expected = this->takeFiles();
  this->Options.Resume = true;
  std::mt19937 random(1); // the same numbers on all ranks
  int aborted = 0;
  for (int round = 0; round < 4; ++round)
  {
    bool isDone = false;
    while (!isDone)
    {
      // The number of progress calls. It grows, since later runs also verify what is already
      // written.
      int calls = int(random() % 8) + aborted / 2;
      const bool isTogether = random() % 3 > 0;
      const int by = int(random() % 2) % this->Ranks.size();
      this->Options.Progress = [&](double fraction)
      {
        constexpr double triangulated = 0.9; // later steps make many progress calls
        return fraction > triangulated || calls-- > 0 || (isTogether && by != this->Ranks.rank());
      };
      const OutOfCoreStatistics statistics = isTogether ? this->runTogether() : this->runAlone();
      std::vector<std::int64_t> endings{ this->isFirst() && statistics.Aborted };
      this->Ranks.sum(endings);
      isDone = endings[0] == 0;
      aborted += isDone ? 0 : 1;
    }
    EXPECT_TRUE(expected == this->takeFiles()) << round;
  }
  EXPECT_GT(aborted, 2);
}

INSTANTIATE_TEST_SUITE_P(PointSets, OutOfCoreRanks,
  testing::Values("uniform", "clustered", "coast", "duplicates", "lattice"));

TEST_P(OutOfCoreRanks, InsertTheConstraintsOfOneProcess)
{
  this->makePoints(GetParam());
  ConstraintTable& lines = this->Constraints.Lines;
  for (std::int64_t i = 0; i < 30; ++i)
  {
    lines.Edges.push_back({ 80 * i, (1237 * i + 31) % 2500 });
  }
  lines.PolygonBegin = lines.Edges.size();
  const OutOfCoreStatistics alone = this->runAlone();
  const Files expected = this->takeFiles();
  for (const int threads : { 1, 3 })
  {
    this->Options.Threads = threads;
    const OutOfCoreStatistics together = this->runTogether();
    EXPECT_TRUE(expected == this->takeFiles()) << threads;
    EXPECT_EQ(alone.Triangles, together.Triangles);
  }
}

/// If partitions do not pay, nearly all vertices are sent from piece to piece.
class OutOfCoreRanksWithALargeRim : public OutOfCoreRanks
{
};

TEST_P(OutOfCoreRanksWithALargeRim, MakeTheFilesOfOneProcess)
{
  this->makePoints(GetParam(), 1500);
  this->Options.Columns = 4;
  this->Options.Rows = 4;
  this->runAlone();
  const Files expected = this->takeFiles();
  this->Options.MemoryLimit = 1;
  const OutOfCoreStatistics together = this->runTogether();
  EXPECT_TRUE(expected == this->takeFiles());
  if (this->isFirst())
  {
    EXPECT_GT(together.BoundaryBytes, 0U);
  }
}

INSTANTIATE_TEST_SUITE_P(PointSets, OutOfCoreRanksWithALargeRim,
  testing::Values("circle", "parabola", "collinear-and-one"));

TEST_F(OutOfCoreRanks, ReadTheirPartsOfTheInput)
{
  this->makePoints("uniform", 5000);
  this->runAlone();
  const Files expected = this->takeFiles();
  EXPECT_TRUE(this->lastRankSpills());
  EXPECT_TRUE(expected == this->takeFiles());
}

TEST_F(OutOfCoreRanks, OnlyTheFirstReadsAnInputThatOthersCannotSee)
{
  this->makePoints("uniform", 5000);
  this->runAlone();
  const Files expected = this->takeFiles();
  if (this->Ranks.rank() % 2 == 1)
  {
    this->Points = "missing.npy";
  }
  EXPECT_TRUE(this->lastRankSpills());
  EXPECT_TRUE(expected == this->takeFiles());
}

TEST_F(OutOfCoreRanks, OnlyTheFirstReadsAnInputThatCannotBeDivided)
{
  const Coordinates xy = makePointSet("uniform", 5000);
  this->Points.replace(this->Points.size() - 3, 3, "xyz");
  if (this->isFirst())
  {
    std::ofstream file(this->Points);
    file.precision(17);
    for (std::size_t i = 0; i < xy.size(); i += 2)
    {
      file << xy[i] << " " << xy[i + 1] << "\n";
    }
  }
  this->runAlone();
  const Files expected = this->takeFiles();
  EXPECT_EQ(!this->isFirst() || this->Ranks.size() == 1, this->lastRankSpills());
  EXPECT_TRUE(expected == this->takeFiles());
}

TEST_F(OutOfCoreRanks, AllEndIfOneCannotReadItsPart)
{
  this->makePoints("uniform", 5000);
  this->runAlone();
  const Files expected = this->takeFiles();
  for (const int goodPasses : { 0, 1 })
  {
    this->GoodPasses = this->Ranks.rank() == this->Ranks.size() - 1 ? goodPasses : 100;
    EXPECT_EQ("points: cannot be read.", this->failure());
    this->GoodPasses = 100;
    EXPECT_TRUE(!this->isFirst() || this->Folder->fileCount() == 1);
    this->runTogether();
    EXPECT_TRUE(expected == this->takeFiles());
  }
}

TEST_F(OutOfCoreRanks, FindACommonScaleFactor)
{
  Coordinates xy = makePointSet("uniform", 5000);
  for (double& coordinate : xy)
  {
    coordinate *= 1e-250;
  }
  if (this->isFirst())
  {
    writePoints(this->Points, xy);
  }
  this->runAlone();
  const Files expected = this->takeFiles();
  this->runTogether();
  EXPECT_TRUE(expected == this->takeFiles());
}

TEST_F(OutOfCoreRanks, OnlyTheFirstTriangulatesIfPartitionsDoNotPay)
{
  for (const char* const set : { "collinear", "parabola" })
  {
    this->makePoints(set, 500);
    this->Options.PiecePoints = 0;
    this->Options.PartitionPoints = 0;
    this->runAlone();
    const Files expected = this->takeFiles();
    this->runTogether();
    EXPECT_TRUE(expected == this->takeFiles()) << set;
  }
}

TEST_F(OutOfCoreRanks, CountTheTrianglesOfOneProcess)
{
  this->makePoints("clustered");
  this->Options.CountOnly = true;
  const OutOfCoreStatistics alone = this->runAlone();
  const OutOfCoreStatistics together = this->runTogether();
  EXPECT_EQ(alone.TriangleSum, together.TriangleSum);
  EXPECT_EQ(alone.Triangles, together.Triangles);
}

/// The first rank may finish the mesh and remove temporary files before a slow rank receives the
/// message that the last pieces are done.
TEST_F(OutOfCoreRanks, SlowRanksMayFallBehindTheEndOfTheRun)
{
  this->makePoints("uniform", 200); // two pieces, the second on the first rank
  this->runAlone();
  const Files expected = this->takeFiles();
  this->Options.Progress = [this](double)
  {
    if (!this->isFirst())
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return true;
  };
  for (int round = 0; round < 3; ++round)
  {
    EXPECT_EQ("", this->failure());
    EXPECT_TRUE(expected == this->takeFiles());
  }
}

TEST_F(OutOfCoreRanks, AllReportTheFailureOfOne)
{
  this->makePoints("uniform", 60000);
  this->Options.PiecePoints = 1000;
  this->runAlone();
  const Files expected = this->takeFiles();
  const double spilled = 0.2; // the first rank fails after spilling, others at once
  for (int failing = 0; failing < this->Ranks.size(); ++failing)
  {
    this->Options.Progress = [&](double fraction)
    {
      if (failing == this->Ranks.rank() && (failing > 0 || fraction > spilled))
      {
        throw IOError("points", "are cursed.");
      }
      return true;
    };
    EXPECT_EQ("points: are cursed.", this->failure()) << failing;
    this->Options.Progress = {};
    EXPECT_FALSE(fs::exists(this->mesh()));
    this->Options.Resume = true;
    const OutOfCoreStatistics resumed = this->runTogether();
    EXPECT_TRUE(resumed.Resumed || failing > 0 || !this->isFirst());
    EXPECT_TRUE(expected == this->takeFiles());
    this->Options.Resume = false;
  }
}

TEST_F(OutOfCoreRanks, UpdateTheFilterTogether)
{
  this->makePoints("clustered", 20000);
  std::vector<char> name(4096, 0);
  const std::string folder = this->isFirst() ? this->Folder->path("") : "";
  std::copy(folder.begin(), folder.end(), name.begin());
  this->Controller->Broadcast(name.data(), vtkIdType(name.size()), 0);
  bool isConstrained = false;
  const auto update = [&](vtkMultiProcessController* controller)
  {
    vtkNew<vtkTIPPOutOfCoreDelaunay2D> filter;
    filter->SetController(controller);
    filter->AddInputFileName((name.data() + std::string("/points.npy")).c_str());
    filter->SetFileName((name.data() + std::string("/mesh.tipp")).c_str());
    filter->SetMemoryLimit(1 << 20);
    if (isConstrained)
    {
      filter->SetConstraintsFileName((name.data() + std::string("/lines.csv")).c_str());
      filter->AddHole(0.5, 0.6);
      filter->GenerateConstraintEdgesOn();
    }
    // Each rank requests its own piece, as in ParaView.
    const bool isShared = controller != nullptr;
    EXPECT_TRUE(
      filter->UpdatePiece(isShared ? this->Ranks.rank() : 0, isShared ? this->Ranks.size() : 1, 0));
    EXPECT_EQ(this->isFirst() ? 4 : 0, filter->GetStatistics()->GetNumberOfRows());
    EXPECT_EQ(vtkErrorCode::NoError, filter->GetErrorCode());
  };
  if (this->isFirst())
  {
    this->Folder->file(
      "lines.csv", "x1,y1,x2,y2\n0.1,0.1,0.9,0.9\n0.1,0.9,0.9,0.1\n0.1,0.9,0.9,0.9\n");
    this->InputFiles = 2;
  }
  for (const bool constrained : { false, true })
  {
    isConstrained = constrained;
    if (this->isFirst())
    {
      update(nullptr);
    }
    const Files expected = this->takeFiles();
    this->Ranks.barrier();
    update(this->Controller);
    EXPECT_TRUE(expected == this->takeFiles());
    EXPECT_TRUE(!this->isFirst() || expected.size() > 5);
  }
}

TEST_F(OutOfCoreRanks, AllReportAMissingInput)
{
  EXPECT_NE(std::string::npos, this->failure().find("points.npy: cannot be opened"));
}

TEST_F(OutOfCoreRanks, ReportAFolderThatIsNotShared)
{
  if (this->isFirst())
  {
    fs::create_directory(this->Folder->path("shared"));
  }
  const std::string folder = this->isFirst() ? this->Folder->path("shared") : "";
  EXPECT_NO_THROW(this->Ranks.together([&] { requireSharedFolder(this->Ranks, folder); }));
  if (this->Ranks.size() == 1)
  {
    return;
  }
  // In another working folder, a relative path means another file.
  const fs::path here = fs::current_path();
  const TemporaryFolder elsewhere;
  fs::current_path(this->isFirst() ? this->Folder->path("") : elsewhere.path(""));
  std::string reason;
  Communicator ranks(this->Controller);
  try
  {
    ranks.together([&] { requireSharedFolder(ranks, "shared"); });
  }
  catch (const RankFailure& failure)
  {
    EXPECT_GT(failure.Rank, 0);
    reason = failure.what();
  }
  fs::current_path(here);
  EXPECT_EQ(0U, reason.find("shared: does not exist on this rank")) << reason;
  if (this->isFirst())
  {
    EXPECT_TRUE(fs::is_empty(this->Folder->path("shared")));
  }
}

} // namespace
