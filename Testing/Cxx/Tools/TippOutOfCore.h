// SPDX-License-Identifier: BSD-3-Clause
#ifndef TippOutOfCore_h
#define TippOutOfCore_h

#include "MeshChecks.h"
#include "RunTipp.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <system_error>
#include <vector>

namespace tipp
{
namespace test
{

/// Runs `tipp delaunay` or `tipp delaunay3d` with a partitioned mesh for output.
class TippOutOfCore : public testing::Test
{
protected:
  void makePoints(const std::string& distribution, const std::string& count) const
  {
    ASSERT_EQ(0,
      runTipp(this->Folder,
        { "points", "--distribution", distribution, "--count", count, "-o", this->Points })
        .ExitCode);
  }

  Outcome run(const std::vector<std::string>& more) const
  {
    std::vector<std::string> arguments = this->command();
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runTipp(this->Folder, arguments);
  }

  std::vector<std::string> command() const
  {
    return { this->Command, this->Points, "-o", this->Mesh, "--memory", "2M", "--threads", "2" };
  }

  /// The number of files in the work folder, which is hidden beside the mesh.
  std::size_t workFiles() const
  {
    const std::string work = this->Folder.path(".mesh.tipp.part");
    std::error_code ignored; // files may disappear meanwhile
    std::size_t count = 0;
    for (std::filesystem::recursive_directory_iterator at(work, ignored), end; at != end;
         at.increment(ignored))
    {
      ++count;
    }
    return count;
  }

  /// The peak memory of a run with four points. It depends on VTK's libraries.
  double peakOfSmallRun() const
  {
    const std::string points = this->Folder.path("few.csv");
    const std::string stats = this->Folder.path("few.json");
    std::ofstream(points) << "x,y\n0,0\n1,0\n0,1\n1,2\n";
    const Outcome made = runTipp(
      this->Folder, { "delaunay", points, "-o", this->Folder.path("few.tipp"), "--stats", stats });
    EXPECT_EQ(0, made.ExitCode) << made.Err;
    return nlohmann::json::parse(contentOf(stats))["peak_memory_bytes"].get<double>();
  }

  /// Starts and resumes runs, and kills each after it has made a few more files, until a run
  /// finishes. Returns the number of killed runs.
  int killUntilDone(std::vector<std::string> more, std::mt19937& random) const
  {
    std::vector<std::string> arguments = this->command();
    more.emplace_back("--resume");
    arguments.insert(arguments.end(), more.begin(), more.end());
    for (int kills = 0;; ++kills)
    {
      const std::size_t enough = this->workFiles() + 1 + random() % 4;
      const TippProcess process(this->Folder, arguments);
      process.waitUntil([&] { return this->workFiles() >= enough; });
      process.kill();
      const Outcome outcome = process.wait();
      if (outcome.ExitCode != -SIGKILL)
      {
        EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
        return kills;
      }
    }
  }

  TemporaryFolder Folder;
  std::string Command = "delaunay";
  std::string Points = this->Folder.path("points.npy");
  std::string Mesh = this->Folder.path("mesh.tipp");
};

} // namespace test
} // namespace tipp

#endif
