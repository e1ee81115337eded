// SPDX-License-Identifier: BSD-3-Clause
// tetrahedralizeOutOfCoreOnRanks() on the ranks of the global controller makes the files of one
// process.
#include "PointsInSpace.h"
#include "TemporaryFolder.h"

#include "Files/IOError.h"
#include "Npy/NpyFile.h"
#include "OutOfCore/OutOfCoreTetrahedralization.h"
#include "Points/ReadPoints.h"

#include "vtkMultiProcessController.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace
{

namespace fs = std::filesystem;
using namespace tipp;
using namespace tipp::test;

/// The contents of all files in a folder, by relative path.
std::map<std::string, std::string> contentsOf(const std::string& folder)
{
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
  {
    if (entry.is_regular_file())
    {
      std::ifstream file(entry.path(), std::ios::binary);
      files[entry.path().string().substr(folder.size())] =
        std::string(std::istreambuf_iterator<char>(file), {});
    }
  }
  return files;
}

class OutOfCore3DRanks : public testing::Test
{
protected:
  OutOfCore3DRanks()
    : Ranks(vtkMultiProcessController::GetGlobalController())
  {
    this->Options.PiecePoints = 150;
    this->Options.MemoryLimit = 1 << 20; // too little for one piece
    this->Options.Threads = 2;
    this->Options.Neighbors = true;
    this->Options.MapDuplicates = true;
    if (this->Ranks.isFirst())
    {
      this->Folder = std::make_unique<TemporaryFolder>();
    }
    this->Points = this->Ranks.broadcast(this->path("points.npy"));
  }

  std::string path(const std::string& name) const
  {
    return this->Ranks.isFirst() ? this->Folder->path(name) : std::string();
  }

  void write(const std::vector<Point3>& points) const
  {
    if (this->Ranks.isFirst())
    {
      NpyWriter writer(this->Points, "<f8", { std::int64_t(points.size()), 3 });
      writer.write(points.data(), points.size() * sizeof(Point3));
      writer.close();
    }
    this->Ranks.barrier();
  }

  std::unique_ptr<PointStream> open() const
  {
    PointOptions inSpace;
    inSpace.InSpace = true;
    return openPointStream({ this->Points }, inSpace);
  }

  OutOfCoreStatistics3 runTogether() const
  {
    // A new one, since it cannot be used after a failure.
    Communicator ranks(vtkMultiProcessController::GetGlobalController());
    return tetrahedralizeOutOfCoreOnRanks(
      ranks, [this] { return this->open(); }, this->path("ranks.tipp"), this->Options);
  }

  /// Expects the files of one process, and removes those of the ranks.
  void expectFilesOfOne(const std::string& what) const
  {
    if (this->Ranks.isFirst())
    {
      OutOfCoreOptions3 options = this->Options;
      options.Threads = 1;
      options.Progress = {};
      options.Resume = false;
      tetrahedralizeOutOfCore(*this->open(), this->path("one.tipp"), options);
      const auto expected = contentsOf(this->path("one.tipp"));
      EXPECT_GT(expected.size(), 2U) << what; // an index and at least two pieces
      EXPECT_TRUE(expected == contentsOf(this->path("ranks.tipp"))) << what;
      fs::remove_all(this->path("one.tipp"));
      fs::remove_all(this->path("ranks.tipp"));
    }
    this->Ranks.barrier();
  }

  mutable Communicator Ranks;
  OutOfCoreOptions3 Options;
  std::string Points;
  std::unique_ptr<TemporaryFolder> Folder; ///< on the first rank
};

} // namespace

TEST_F(OutOfCore3DRanks, FilesAreThoseOfOneProcess)
{
  for (const char* const kind : { "uniform", "clustered", "lattice", "coarse" })
  {
    const auto points = pointsInSpace(kind, 3000, 7);
    this->write(points);
    const OutOfCoreStatistics3 made = this->runTogether();
    EXPECT_EQ(this->Ranks.isFirst() ? std::int64_t(points.size()) : 0, made.Points) << kind;
    this->expectFilesOfOne(kind);
  }
}

TEST_F(OutOfCore3DRanks, PointsFarFromOneAreScaledOnAllRanks)
{
  auto points = pointsInSpace("clustered", 1500);
  for (Point3& p : points)
  {
    p = { p.x * 0x1p90, p.y * 0x1p90, p.z * 0x1p90 };
  }
  points[3].z = std::numeric_limits<double>::quiet_NaN();
  this->write(points);
  this->runTogether();
  this->expectFilesOfOne("scaled");
}

TEST_F(OutOfCore3DRanks, FewPiecesLeaveRanksWithoutWork)
{
  this->Options.PiecePoints = 700;
  this->write(pointsInSpace("uniform", 1400));
  this->runTogether();
  this->expectFilesOfOne("two pieces");
}

TEST_F(OutOfCore3DRanks, AnAbortedRunIsResumed)
{
  this->write(pointsInSpace("uniform", 4000));
  for (const double end : { 0.2, 0.5, 0.95 })
  {
    this->Options.Progress = [end](double done) { return done <= end; };
    EXPECT_TRUE(this->runTogether().Aborted) << end;
    this->Options.Progress = {};
    this->Options.Resume = true;
    const OutOfCoreStatistics3 made = this->runTogether();
    EXPECT_FALSE(made.Aborted) << end;
    EXPECT_EQ(this->Ranks.isFirst(), made.Resumed) << end;
    this->expectFilesOfOne("resumed");
  }
}

TEST_F(OutOfCore3DRanks, PointsInOnePlaneAreAnErrorOnAllRanks)
{
  auto points = pointsInSpace("uniform", 500);
  for (Point3& p : points)
  {
    p.z = 1;
  }
  this->write(points);
  try
  {
    this->runTogether();
    ADD_FAILURE() << "there is no error";
  }
  catch (const RankFailure& failure)
  {
    EXPECT_NE(std::string::npos, std::string(failure.what()).find("in one plane"));
  }
}
