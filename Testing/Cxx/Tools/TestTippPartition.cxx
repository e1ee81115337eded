// SPDX-License-Identifier: BSD-3-Clause
#include "MeshChecks.h"
#include "RunTipp.h"

#include "Partitioned/PartitionedMesh.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <random>
#include <thread>

#include <sched.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

namespace fs = std::filesystem;
using namespace tipp;
using namespace tipp::test;

namespace
{

class TippPartition : public testing::Test
{
protected:
  TippPartition()
    : Source(makeSource(latticeTriangles(60, 0.3)))
  {
    writeFlat(this->Source, this->Folder.path("flat"));
  }

  Outcome run(const std::vector<std::string>& more) const
  {
    std::vector<std::string> words{ "partition", "flat", "-o", "mesh" };
    words.insert(words.end(), more.begin(), more.end());
    return runTipp(this->Folder, words);
  }

  /// The number of hidden folders that runs have left.
  int leftovers() const
  {
    int count = 0;
    for (const auto& entry : fs::directory_iterator(this->Folder.path("")))
    {
      count += entry.path().filename().string().rfind(".mesh.tmp.", 0) == 0 ? 1 : 0;
    }
    return count;
  }

  SourceMesh Source;
  TemporaryFolder Folder;
};

TEST_F(TippPartition, ReportsTheGivenFile)
{
  // Big-endian doubles: a square with two coordinates of 1 and one of NaN.
  std::string doubles(12 * 8, '\0');
  for (const std::size_t value : { 3, 9, 10 })
  {
    doubles.replace(8 * value, 2, "\x3f\xf0");
  }
  doubles.replace(8 * 7, 2, "\x7f\xf8");
  const auto number = [](char value) { return std::string(3, '\0') + value; };
  this->Folder.file("bad.vtk",
    "# vtk DataFile Version 4.2\nmesh\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n" +
      doubles + "\nCELLS 1 5\n" + number(4) + number(0) + number(1) + number(3) + number(2) +
      "\nCELL_TYPES 1\n" + number(9) + "\n");
  const Outcome outcome = runTipp(this->Folder, { "partition", "bad.vtk", "-o", "mesh" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_EQ("tipp: bad.vtk: point 2 has a coordinate that is not finite; leave such points out.\n",
    outcome.Err);
}

TEST_F(TippPartition, ReportsTheMesh)
{
  const Outcome outcome = this->run({ "--stats", "run.json", "--threads", "2" });
  EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
  EXPECT_EQ("", outcome.Err);
  EXPECT_EQ(0U, outcome.Out.find("7200 cells, 3722 points, 16 pieces, ")) << outcome.Out;
  const auto json = nlohmann::json::parse(contentOf(this->Folder.path("run.json")));
  EXPECT_EQ(7200, json["cells"]);
  EXPECT_EQ(16, json["pieces"]);
  EXPECT_EQ(1, json["ranks"]);
  EXPECT_EQ(2, json["threads"]);
  EXPECT_GT(json["border_cells"], 0);
  EXPECT_GT(json["mesh_bytes"], 100000);
  EXPECT_EQ(5U, json["phases"].size());
}

TEST_F(TippPartition, AcceptsAVtkFile)
{
  this->run({});
  const Outcome outcome = runTipp(
    this->Folder, { "partition", "mesh/mesh.pvtu", "-o", "again", "--tiling", "quadtree:1000" });
  EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
  const PartitionedMesh again = openPartitionedMesh(this->Folder.path("again"));
  EXPECT_EQ(7200, again.Cells);
  EXPECT_GT(again.Pieces.size(), 4U);
}

TEST_F(TippPartition, RefusesAFlatMeshWithReservedArrayNames)
{
  this->run({});
  const Outcome outcome =
    runTipp(this->Folder, { "partition", "mesh/pieces/000000.vtu", "-o", "again" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("rename it")) << outcome.Err;
}

TEST_F(TippPartition, MemoryMayHaveAnyUnitAndABlank)
{
  for (const char* memory : { "1 GB", "64 MiB", "64mb", "65536kB", "67108864 B" })
  {
    EXPECT_EQ(0, this->run({ "--memory", memory }).ExitCode) << memory;
  }
  for (const char* memory : { "1 Gib GB", "1 G B", "GB", "1.5G", "-1G", "1e9", "5iB", "0 GB" })
  {
    EXPECT_EQ(2, this->run({ "--memory", memory }).ExitCode) << memory;
  }
}

TEST_F(TippPartition, RefusesAnOutputThatIsNamedLikeAFile)
{
  const Outcome outcome = runTipp(this->Folder, { "partition", "flat", "-o", "again.vtu" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("again.vtu: would be a folder")) << outcome.Err;
  EXPECT_FALSE(fs::exists(this->Folder.path("again.vtu")));
}

TEST_F(TippPartition, RefusesWrongUsage)
{
  EXPECT_EQ(2, this->run({ "--tiling", "hexagons:4" }).ExitCode);
  EXPECT_EQ(2, this->run({ "--memory", "many" }).ExitCode);
  EXPECT_EQ(2, this->run({ "--memory", "99999999999G" }).ExitCode);
  EXPECT_EQ(2, this->run({ "--loader", "magic" }).ExitCode);
  EXPECT_EQ(2, this->run({ "--borrowers", "steal" }).ExitCode);
  EXPECT_EQ(1, this->run({ "--device", "abacus" }).ExitCode);
  EXPECT_EQ(1, runTipp(this->Folder, { "partition", "none", "-o", "mesh" }).ExitCode);
  EXPECT_FALSE(fs::exists(this->Folder.path("mesh")));
  EXPECT_EQ(0, this->leftovers());
}

// Wherever the run is killed, there is either no mesh or a complete one, and the source is
// unchanged. The next run removes what is left of it.
TEST_F(TippPartition, SurvivesBeingKilled)
{
  const auto source = filesOf(this->Folder.path("flat"));
  std::mt19937 random(1);
  std::map<std::string, std::string> whole;
  int killed = 0;
  for (int i = 0; i < 40; ++i)
  {
    const TippProcess process(this->Folder, { "partition", "flat", "-o", "mesh" });
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 120000));
    process.kill();
    killed += process.wait().ExitCode == -SIGKILL ? 1 : 0;
    if (fs::exists(this->Folder.path("mesh")))
    {
      const auto files = filesOf(this->Folder.path("mesh"));
      whole = whole.empty() ? files : whole;
      ASSERT_TRUE(whole == files);
    }
    ASSERT_LE(this->leftovers(), 1);
  }
  EXPECT_GT(killed, 0);
  EXPECT_EQ(0, this->run({}).ExitCode);
  expectHolds(this->Folder.path("mesh"), this->Source);
  EXPECT_EQ(0, this->leftovers());
  EXPECT_TRUE(source == filesOf(this->Folder.path("flat")));
}

/// Runs an action in a process that has a small disk mounted at `where`. Returns 77 if mounting is
/// not permitted.
template <typename Action>
int onSmallDisk(const std::string& where, const char* size, const Action& action)
{
  fs::create_directory(where);
  const pid_t child = fork();
  if (child == 0)
  {
    if (unshare(CLONE_NEWNS) != 0 || mount("", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
      mount("tmpfs", where.c_str(), "tmpfs", 0, size) != 0)
    {
      _exit(77);
    }
    _exit(action());
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST_F(TippPartition, ReportsATooSmallDiskBeforeItStarts)
{
  const int result = onSmallDisk(this->Folder.path("disk"), "size=100k",
    [this]
    {
      const Outcome outcome = runTipp(this->Folder, { "partition", "flat", "-o", "disk/mesh" });
      const bool said = outcome.Err.find("free space or name another disk") != std::string::npos;
      return outcome.ExitCode == 1 && said && fs::is_empty(this->Folder.path("disk")) ? 0 : 1;
    });
  if (result == 77)
  {
    GTEST_SKIP() << "this process may not mount a small disk";
  }
  EXPECT_EQ(0, result);
}

TEST_F(TippPartition, ReportsAFullDiskAndLeavesNoFiles)
{
  // These cells cross all borders, so the mesh needs more space than the tool checks for in
  // advance.
  const SourceMesh soup = makeSource(cellSoup(2, 3, 3000, 3));
  writeFlat(soup, this->Folder.path("flat"));
  const int result = onSmallDisk(this->Folder.path("disk"), "size=1200k",
    [this]
    {
      const Outcome outcome = runTipp(this->Folder,
        { "partition", "flat", "-o", "disk/mesh", "--tiling", "grid:9x9", "--borrowers",
          "duplicate" });
      const bool said = outcome.Err.find("No space left on device") != std::string::npos;
      return outcome.ExitCode == 1 && said && fs::is_empty(this->Folder.path("disk")) ? 0 : 1;
    });
  if (result == 77)
  {
    GTEST_SKIP() << "this process may not mount a small disk";
  }
  EXPECT_EQ(0, result);
}

TEST_F(TippPartition, UnusedPointsNeedNotBeFinite)
{
  this->Folder.file("points.csv", "x,y,z\n0,0,1\n8,0,1\nnan,3,1\n8,8,1\n0,8,1\n3,inf,2\n");
  ASSERT_EQ(0, runTipp(this->Folder, { "delaunay", "points.csv", "-o", "few.vtu" }).ExitCode);
  for (const char* const tiling : { "grid:2x2", "quadtree:1" })
  {
    const Outcome outcome =
      runTipp(this->Folder, { "partition", "few.vtu", "-o", "few", "--tiling", tiling });
    EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
    EXPECT_EQ(0U, outcome.Out.find("2 cells, 6 points")) << outcome.Out;
    const Outcome image =
      runTipp(this->Folder, { "resample", "few", "-o", "image.npy", "--dims", "4", "4", "1" });
    EXPECT_EQ(0, image.ExitCode) << image.Err;
  }
}

TEST_F(TippPartition, ReportsTheGhostCellsLeftOut)
{
  this->Folder.file("ghosts.vtk",
    "# vtk DataFile Version 3.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0 4 0 0 "
    "4 "
    "4 0 0 4 0\nCELLS 3 11\n3 0 1 2\n3 0 2 3\n2 0 1\nCELL_TYPES 3\n5\n5\n3\nCELL_DATA 3\nSCALARS "
    "vtkGhostType unsigned_char 1\nLOOKUP_TABLE default\n0\n1\n0\n");
  for (const char* const command : { "partition", "flatten" })
  {
    const Outcome outcome = runTipp(this->Folder, { command, "ghosts.vtk", "-o", command });
    EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
    EXPECT_EQ("tipp: warning: ghosts.vtk: 1 of vtkLine left out.\n"
              "tipp: warning: ghosts.vtk: 1 ghost cells left out.\n",
      outcome.Err);
  }
}

} // namespace
