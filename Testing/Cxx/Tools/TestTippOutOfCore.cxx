// SPDX-License-Identifier: BSD-3-Clause
// The command 'tipp delaunay' with a partitioned mesh as output.
#include "TippOutOfCore.h"

#include "vtkTIPPOutOfCoreDelaunay2D.h"

#include "vtkNew.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <fstream>
#include <random>
#include <utility>

#include <sys/resource.h>

namespace
{

using namespace tipp::test;

TEST_F(TippOutOfCore, MakesAMeshThatTheCheckAccepts)
{
  this->makePoints("clustered", "30000");
  const Outcome made = this->run({ "--stats", this->Folder.path("run.json") });
  ASSERT_EQ(0, made.ExitCode) << made.Err;
  const auto json = nlohmann::json::parse(contentOf(this->Folder.path("run.json")));
  EXPECT_EQ(30000, json["points"]);
  EXPECT_GT(json["pieces"], 4);
  const Outcome checked =
    runTipp(this->Folder, { "check", this->Points, this->Mesh, "--tie-rule" });
  EXPECT_EQ(0, checked.ExitCode) << checked.Out << checked.Err;
  EXPECT_NE(std::string::npos, checked.Out.find("correct"));
}

TEST_F(TippOutOfCore, ChecksTheNeighborsThatAMeshNames)
{
  this->makePoints("clustered", "30000");
  ASSERT_EQ(0, this->run({ "--neighbors" }).ExitCode);
  const Outcome checked = runTipp(this->Folder, { "check", this->Points, this->Mesh });
  EXPECT_EQ(0, checked.ExitCode) << checked.Out << checked.Err;
  const std::string flat = this->Folder.path("mesh.vtu");
  ASSERT_EQ(
    0, runTipp(this->Folder, { "delaunay", this->Points, "-o", flat, "--neighbors" }).ExitCode);
  EXPECT_NE(std::string::npos, contentOf(flat).find("NeighborIds"));
  EXPECT_EQ(0, runTipp(this->Folder, { "check", this->Points, flat }).ExitCode);
  const std::string ids = this->Folder.path("triangles.npy");
  const Outcome refused =
    runTipp(this->Folder, { "delaunay", this->Points, "-o", ids, "--neighbors" });
  EXPECT_EQ(2, refused.ExitCode);
  EXPECT_NE(std::string::npos, refused.Err.find("--neighbors: needs an output named"))
    << refused.Err;
}

TEST_F(TippOutOfCore, MakesTheFilesOfTheVtkClass)
{
  this->makePoints("clustered", "30000");
  ASSERT_EQ(0, this->run({ "--neighbors" }).ExitCode);
  const std::string other = this->Folder.path("other.tipp");
  vtkNew<vtkTIPPOutOfCoreDelaunay2D> filter;
  filter->AddInputFileName(this->Points.c_str());
  filter->SetFileName(other.c_str());
  filter->SetMemoryLimit(2 << 20);
  filter->GenerateNeighborIdsOn();
  filter->Update();
  EXPECT_TRUE(filesOf(this->Mesh) == filesOf(other));
}

TEST_F(TippOutOfCore, AColumnNamedAsAnArrayOfTheMeshIsRefusedAndLeavesNothing)
{
  const auto run = [this](const std::string& column, const std::vector<std::string>& more)
  {
    this->Folder.file("named.csv", "x,y," + column + "\n0,0,1\n1,0,2\n0,1,3\n");
    std::vector<std::string> words{ "delaunay", "named.csv", "-o", "named.tipp" };
    words.insert(words.end(), more.begin(), more.end());
    return runTipp(this->Folder, words);
  };
  for (const std::string column : { "RepresentativePointId", "GlobalPointIds", "vtkGhostType" })
  {
    const Outcome outcome = run(column, { "--map-duplicates" });
    EXPECT_EQ(1, outcome.ExitCode);
    EXPECT_NE(std::string::npos, outcome.Err.find("two columns named " + column)) << outcome.Err;
    EXPECT_FALSE(std::filesystem::exists(this->Folder.path(".named.tipp.part")));
  }
  EXPECT_EQ(0, run("RepresentativePointId", {}).ExitCode);
}

TEST_F(TippOutOfCore, ChecksAgainstTheRightPointsOnly)
{
  this->makePoints("clustered", "3000");
  ASSERT_EQ(0, this->run({}).ExitCode);
  this->makePoints("uniform", "3000");
  const Outcome checked = runTipp(this->Folder, { "check", this->Points, this->Mesh });
  EXPECT_EQ(1, checked.ExitCode);
  EXPECT_NE(std::string::npos, checked.Err.find("are not the 3000 points"));
}

TEST_F(TippOutOfCore, ResumesAfterInterrupt)
{
  this->makePoints("uniform", "200000");
  const TippProcess process(this->Folder, this->command());
  const std::string plan = this->Folder.path(".mesh.tipp.part/.plan");
  process.waitUntil([&] { return std::filesystem::exists(plan); });
  process.interrupt();
  const Outcome interrupted = process.wait();
  EXPECT_TRUE(interrupted.ExitCode == 130 || interrupted.ExitCode == 0) << interrupted.ExitCode;
  const Outcome resumed = this->run({ "--resume" });
  EXPECT_EQ(0, resumed.ExitCode) << resumed.Err;
  EXPECT_EQ(0, runTipp(this->Folder, { "check", this->Points, this->Mesh }).ExitCode);
}

TEST_F(TippOutOfCore, RemakesPiecesThatAreDamagedBeforeItIsResumed)
{
  this->makePoints("uniform", "100000");
  ASSERT_EQ(0, this->run({}).ExitCode);
  const auto expected = filesOf(this->Mesh);
  std::filesystem::remove_all(this->Mesh);
  const TippProcess process(this->Folder, this->command());
  const std::string first = this->Folder.path(".mesh.tipp.part/.piece.0");
  process.waitUntil([&] { return std::filesystem::exists(first); });
  process.kill();
  ASSERT_EQ(-SIGKILL, process.wait().ExitCode);
  for (const auto& piece :
    std::filesystem::directory_iterator(this->Folder.path(".mesh.tipp.part/mesh.tipp/pieces")))
  {
    std::filesystem::resize_file(piece, std::filesystem::file_size(piece) / 2);
  }
  const Outcome resumed = this->run({ "--resume" });
  EXPECT_EQ(0, resumed.ExitCode) << resumed.Err;
  EXPECT_NE(std::string::npos, resumed.Err.find("is damaged or missing")) << resumed.Err;
  EXPECT_TRUE(expected == filesOf(this->Mesh));
}

TEST_F(TippOutOfCore, CheckReportsTheDamagedFile)
{
  this->makePoints("clustered", "10000");
  ASSERT_EQ(0, this->run({ "--neighbors" }).ExitCode);
  for (const auto& [name, content] : filesOf(this->Mesh))
  {
    std::string damaged = content;
    damaged[damaged.size() * 3 / 4] ^= 1;
    const std::string path = this->Folder.file("mesh.tipp/" + name, damaged);
    const Outcome checked = runTipp(this->Folder, { "check", this->Points, this->Mesh });
    EXPECT_EQ(1, checked.ExitCode) << name << checked.Out;
    EXPECT_NE(std::string::npos, checked.Err.find(path)) << checked.Err;
    this->Folder.file("mesh.tipp/" + name, content);
  }
}

TEST_F(TippOutOfCore, ResumesAfterAFullDisk)
{
  this->makePoints("uniform", "50000");
  // A limit on the size of files simulates a full disk: first while points are spilled, then while
  // pieces are written.
  for (const rlim_t most : { 100000, 1300000 })
  {
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit small{ most, before.rlim_max };
    setrlimit(RLIMIT_FSIZE, &small);
    std::signal(SIGXFSZ, SIG_IGN);
    const Outcome full = this->run({ "--partitions", "1x1" });
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_EQ(1, full.ExitCode);
    EXPECT_NE(std::string::npos, full.Err.find("cannot be written")) << full.Err;
    EXPECT_FALSE(std::filesystem::exists(this->Mesh));
    const Outcome resumed = this->run({ "--partitions", "1x1", "--resume" });
    EXPECT_EQ(0, resumed.ExitCode) << resumed.Err;
    EXPECT_EQ(0, runTipp(this->Folder, { "check", this->Points, this->Mesh }).ExitCode);
    std::filesystem::remove_all(this->Mesh);
  }
}

/// Points for which partitions do not pay: nearly all points are sent between pieces, mostly
/// through a file.
class TippLargeRim : public TippOutOfCore
{
protected:
  /// Makes points (x, curve(x)) with x from -1 to 1.
  template <typename Curve>
  void makeCurve(int count, const Curve& curve)
  {
    this->Points = this->Folder.path("points.csv");
    std::ofstream file(this->Points);
    file.precision(17);
    file << "x,y\n";
    std::mt19937 random(1);
    for (int i = 0; i < count; ++i)
    {
      const double x = double(random()) * 0x1p-31 - 1;
      file << x << "," << curve(x) << "\n";
    }
  }

  /// Expects the memory bound that Documentation/OutOfCore.md gives for two threads.
  void expectSmall(double count) const
  {
    const Outcome made = this->run({ "--stats", this->Folder.path("run.json") });
    ASSERT_EQ(0, made.ExitCode) << made.Err;
    const auto json = nlohmann::json::parse(contentOf(this->Folder.path("run.json")));
    EXPECT_EQ(count, json["points"].get<double>());
    EXPECT_GT(json["boundary_bytes"], 0);
    const double onTop = this->peakOfSmallRun() + 30e6; // memory that two threads' kernels keep
    constexpr double perPoint = 300;
    EXPECT_LT(json["peak_memory_bytes"].get<double>(), 2 * 0x1p20 + onTop + perPoint * count);
    EXPECT_EQ(0, runTipp(this->Folder, { "check", this->Points, this->Mesh }).ExitCode);
  }
};

TEST_F(TippLargeRim, OfACircleTakesLittleMemory)
{
  this->makePoints("circle", "120000");
  this->expectSmall(120000);
}

TEST_F(TippLargeRim, OfAParabolaTakesLittleMemory)
{
  this->makeCurve(120000, [](double x) { return x * x; });
  this->expectSmall(120000);
}

TEST_F(TippLargeRim, OfALineAndAPointTakesLittleMemory)
{
  bool isFirst = true;
  this->makeCurve(60000, [&](double) { return std::exchange(isFirst, false) ? 1 : 0; });
  this->expectSmall(60000);
}

TEST_F(TippLargeRim, IsRemadeAfterKills)
{
  this->makePoints("circle", "30000");
  ASSERT_EQ(0, this->run({}).ExitCode);
  const auto expected = filesOf(this->Mesh);
  std::filesystem::remove_all(this->Mesh);
  std::mt19937 random(5);
  const int kills = this->killUntilDone({}, random);
  EXPECT_GT(kills, 0);
  EXPECT_TRUE(expected == filesOf(this->Mesh));
  EXPECT_FALSE(std::filesystem::exists(this->Folder.path(".mesh.tipp.part")));
}

TEST_F(TippLargeRim, ResumesAfterAFullDisk)
{
  this->makePoints("circle", "30000");
  const std::string scratch = this->Folder.path("scratch");
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{ 730000, before.rlim_max };
  setrlimit(RLIMIT_FSIZE, &small);
  std::signal(SIGXFSZ, SIG_IGN);
  const Outcome full = this->run({ "--sink", "count", "--scratch", scratch });
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(1, full.ExitCode);
  EXPECT_NE(std::string::npos, full.Err.find("cannot be written")) << full.Err;
  EXPECT_NE(std::string::npos, full.Err.find(scratch)) << full.Err;
  const Outcome resumed = this->run({ "--sink", "count", "--scratch", scratch, "--resume" });
  EXPECT_EQ(0, resumed.ExitCode) << resumed.Err;
  EXPECT_NE(std::string::npos, resumed.Out.find("30000 points")) << resumed.Out;
}

/// Expects the memory bound that Documentation/OutOfCore.md gives for two threads.
class TippMemory : public TippOutOfCore
{
protected:
  void expectKept(const std::string& points, const std::string& sink, int limit) const
  {
    const double onTop = this->peakOfSmallRun() + 30e6; // memory that two threads' kernels keep
    const std::string report = this->Folder.path("run.json");
    const Outcome made = runTipp(this->Folder,
      { "delaunay", "uniform:" + points, "-o", this->Mesh, "--sink", sink, "--threads", "2",
        "--memory", std::to_string(limit) + "M", "--stats", report });
    ASSERT_EQ(0, made.ExitCode) << made.Err;
    const auto json = nlohmann::json::parse(contentOf(report));
    EXPECT_EQ(std::stoll(points), json["points"]);
    EXPECT_LT(json["peak_memory_bytes"].get<double>(), limit * 0x1p20 + onTop);
  }
};

TEST_F(TippMemory, IsWithinTheLimitForThreeMillionPoints)
{
  this->expectKept("3000000", "mesh", 32);
}

TEST_F(TippMemory, IsWithinTheLimitForTwentyMillionPoints)
{
  this->expectKept("20000000", "count", 64);
}

TEST_F(TippOutOfCore, ShowsTheTimeLeftOnATerminal)
{
  const Outcome outcome = runTippOnTerminal(this->Folder,
    { "delaunay", "uniform:5000000", "-o", this->Mesh, "--sink", "count", "--threads", "1",
      "--memory", "8M" });
  EXPECT_EQ(0, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find(" s left")) << outcome.Err;
}

TEST_F(TippOutOfCore, ReportsOptionsThatNeedAPartitionedOutput)
{
  this->makePoints("uniform", "100");
  for (const std::vector<std::string>& more :
    { std::vector<std::string>{ "--resume" }, { "--memory", "2M" }, { "--scratch", "x" } })
  {
    std::vector<std::string> arguments{ "delaunay", this->Points, "-o",
      this->Folder.path("mesh.vtu") };
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = runTipp(this->Folder, arguments);
    EXPECT_EQ(2, outcome.ExitCode);
    EXPECT_NE(std::string::npos, outcome.Err.find("needs an output named .tipp")) << outcome.Err;
  }
}

} // namespace
