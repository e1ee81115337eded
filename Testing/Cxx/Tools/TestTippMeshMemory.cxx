// SPDX-License-Identifier: BSD-3-Clause
// The command 'tipp mesh' with --memory.
#include "RunTipp.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <sys/resource.h>

namespace
{

using namespace tipp::test;
using Words = std::vector<std::string>;

class TippMeshMemory : public testing::Test
{
protected:
  TippMeshMemory()
  {
    // A lake with an island and a point in it that no triangle uses.
    this->Folder.file("lake.poly",
      "13 2 0 0\n1 20 15\n2 5 0\n3 35 0\n4 40 5\n5 40 25\n6 35 30\n7 5 30\n8 0 25\n9 0 5\n"
      "10 16 15\n11 20 19\n12 24 15\n13 20 11\n12 0\n1 2 3\n2 3 4\n3 4 5\n4 5 6\n5 6 7\n6 7 8\n"
      "7 8 9\n8 9 2\n9 10 11\n10 11 12\n11 12 13\n12 13 10\n1\n1 20.5 15\n");
    // Lines that cross.
    this->Folder.file(
      "crossing.csv", "0,0,40,0\n40,0,40,30\n40,30,0,30\n0,30,0,0\n0,0,40,30\n5,30,35,0\n");
  }

  Outcome run(const Words& words) const
  {
    Words all{ "mesh" };
    all.insert(all.end(), words.begin(), words.end());
    return runTipp(this->Folder, all);
  }

  void make(const std::string& input, const std::string& output, const Words& more,
    const std::string& area = "0.02") const
  {
    Words words{ input, "-o", output, "--max-area", area, "--keep-order" };
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = this->run(words);
    EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
  }

  std::string content(const std::string& name) const { return contentOf(this->Folder.path(name)); }

  /// Expects the same file with and without a limit of memory.
  void expectSame(const std::string& input, const std::string& ending, const Words& more) const
  {
    const std::string area = "0.06"; // more triangles than a strip has at least
    this->make(input, "all." + ending, more, area);
    Words words = more;
    words.insert(words.end(), { "--memory", "1M", "--threads", "3" });
    this->make(input, "part." + ending, words, area);
    EXPECT_TRUE(this->content("all." + ending) == this->content("part." + ending))
      << input << " " << ending << " " << testing::PrintToString(more);
  }

  /// Writes soundings in and around the lake, in some places only, with a column depth and level.
  void writeSoundings() const
  {
    std::string text = "x,y,level,depth\n";
    for (int i = 0; i < 4000; ++i)
    {
      const double x = i * 7919 % 4001 / 4001.0 * 42 - 1;
      const double y = i * 104729 % 4003 / 4003.0 * 25 - 1;
      text += std::to_string(x) + "," + std::to_string(y) + "," + std::to_string(i % 37) + "," +
        std::to_string(5 + x / 5 + i % 11) + "\n";
    }
    this->Folder.file("soundings.csv", text);
  }

  /// The names in the folder.
  std::vector<std::string> names() const
  {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(this->Folder.path(".")))
    {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  TemporaryFolder Folder;
};

TEST_F(TippMeshMemory, FilesAreTheSameAsInMemory)
{
  for (const std::string input : { "lake.poly", "crossing.csv" })
  {
    for (const std::string ending : { "vtu", "vtp", "2dm", "msh", "node" })
    {
      this->make(input, "all." + ending, {});
      for (const char* const threads : { "1", "3" })
      {
        this->make(input, "part." + ending, { "--memory", "1M", "--threads", threads });
        EXPECT_TRUE(this->content("all." + ending) == this->content("part." + ending))
          << input << " " << ending << " " << threads;
      }
    }
    EXPECT_TRUE(this->content("all.ele") == this->content("part.ele")) << input;
    EXPECT_TRUE(this->content("all.poly") == this->content("part.poly")) << input;
  }
}

TEST_F(TippMeshMemory, TrianglesThatAreNotAsRequestedAreListed)
{
  this->make("crossing.csv", "all.vtu", { "--min-angle", "33", "--stats", "all.json" });
  this->make(
    "crossing.csv", "part.vtu", { "--min-angle", "33", "--stats", "part.json", "--memory", "1M" });
  const auto all = nlohmann::json::parse(this->content("all.json"));
  const auto part = nlohmann::json::parse(this->content("part.json"));
  for (const char* const key : { "points", "triangles", "bandwidth", "below_bound", "above_area" })
  {
    EXPECT_EQ(all[key], part[key]) << key;
  }
}

TEST_F(TippMeshMemory, MemoryStaysBounded)
{
  const auto peakWith = [this](const std::string& area, const Words& more)
  {
    Words words{ "lake.poly", "-o", "out.vtu", "--max-area", area, "--keep-order", "--stats",
      "stats.json" };
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = this->run(words);
    EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
    return nlohmann::json::parse(this->content("stats.json"))["peak_memory_bytes"].get<double>();
  };
  // The program and its libraries take a part of the limit; 1.8 million triangles 130 MB.
  const double least = peakWith("10", {});
  const auto limit = std::int64_t(least / 1e6) + 40;
  EXPECT_LT(peakWith("0.001", { "--memory", std::to_string(limit) + "M" }), least + 80e6);
  EXPECT_GT(peakWith("0.001", {}), least + 110e6);
}

TEST_F(TippMeshMemory, ScratchFolderHasTheTemporaryFiles)
{
  std::filesystem::create_directory(this->Folder.path("scratch"));
  this->make("lake.poly", "out.vtu", { "--memory", "64M", "--scratch", "scratch" });
  EXPECT_TRUE(std::filesystem::is_empty(this->Folder.path("scratch")));
  const Outcome outcome = this->run(
    { "lake.poly", "-o", "out.vtu", "--keep-order", "--memory", "64M", "--scratch", "lost" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_EQ(0U, outcome.Err.find("tipp: lost: cannot be written")) << outcome.Err;
}

TEST_F(TippMeshMemory, FullDiskIsOneSentence)
{
  this->run({ "--help" });
  const std::vector<std::string> before = this->names();
  // A limit on the size of files simulates a full disk.
  rlimit usual{};
  getrlimit(RLIMIT_FSIZE, &usual);
  const rlimit small{ 20000000, usual.rlim_max };
  setrlimit(RLIMIT_FSIZE, &small);
  const Outcome outcome = this->run(
    { "lake.poly", "-o", "out.vtu", "--keep-order", "--memory", "64M", "--max-area", "0.001" });
  setrlimit(RLIMIT_FSIZE, &usual);
  EXPECT_EQ(1, outcome.ExitCode) << outcome.Err;
  EXPECT_EQ(0U, outcome.Err.find("tipp: .: cannot hold the temporary files (")) << outcome.Err;
  EXPECT_NE(std::string::npos, outcome.Err.find("--scratch")) << outcome.Err;
  EXPECT_EQ(1, std::count(outcome.Err.begin(), outcome.Err.end(), '\n')) << outcome.Err;
  EXPECT_EQ(before, this->names());
}

TEST_F(TippMeshMemory, InterruptLeavesNoFile)
{
  this->run({ "--help" });
  const std::vector<std::string> before = this->names();
  const TippProcess process(this->Folder,
    { "mesh", "lake.poly", "-o", "out.vtu", "--keep-order", "--memory", "64M", "--max-area",
      "0.00001" });
  std::this_thread::sleep_for(std::chrono::seconds(1)); // of more than a minute
  process.interrupt();
  const int exitCode = process.wait().ExitCode;
  EXPECT_TRUE(exitCode == 130 || exitCode == -SIGINT) << exitCode; // before it watches for signals
  EXPECT_EQ(before, this->names());
}

TEST_F(TippMeshMemory, RenumberingIsRefused)
{
  const Outcome outcome = this->run({ "lake.poly", "-o", "out.vtu", "--memory", "64M" });
  EXPECT_EQ(2, outcome.ExitCode) << outcome.Err;
  EXPECT_NE(std::string::npos, outcome.Err.find("needs --keep-order")) << outcome.Err;
  EXPECT_FALSE(std::filesystem::exists(this->Folder.path("out.vtu")));
}

TEST_F(TippMeshMemory, GridsOfModelsAreTheSameAsInMemory)
{
  this->writeSoundings();
  this->Folder.file("sea.csv", "30,-5,45,-5\n45,-5,45,40\n45,40,30,40\n30,40,30,-5\n");
  this->expectSame("lake.poly", "14", { "--depth", "soundings.csv", "--open", "sea.csv" });
  this->expectSame("lake.poly", "gr3", { "--depth", "soundings.csv", "--open-deeper", "9" });
}

TEST_F(TippMeshMemory, DepthsOfARasterAreTheSameAsInMemory)
{
  std::string grid = "ncols 97\nnrows 61\nxllcorner -1\nyllcorner -3\ncellsize 0.4\n";
  for (int i = 0; i < 97 * 61; ++i)
  {
    grid += std::to_string(i * 7919 % 211) + (i % 97 == 96 ? "\n" : " ");
  }
  this->Folder.file("bottom.asc", grid); // does not reach the northern shore
  for (const Words& more : { Words{}, Words{ "--depth-at-nodes" } })
  {
    Words words{ "--depth", "bottom.asc", "--positive-up" };
    words.insert(words.end(), more.begin(), more.end());
    this->expectSame("lake.poly", "14", words);
  }
}

TEST_F(TippMeshMemory, RegionsAreTheSameAsInMemory)
{
  for (const std::string ending : { "vtu", "2dm", "node", "nc" })
  {
    this->expectSame(
      "crossing.csv", ending, { "--region", "20", "1", "0.01", "--region", "1", "20", "0.03" });
  }
  EXPECT_TRUE(this->content("all.ele") == this->content("part.ele"));
}

TEST_F(TippMeshMemory, ColumnsAreTheSameAsInMemory)
{
  this->writeSoundings();
  for (const std::string input : { "lake.poly", "crossing.csv" })
  {
    for (const std::string ending : { "vtu", "14", "nc" })
    {
      this->expectSame(input, ending, { "--points", "soundings.csv" });
    }
  }
}

TEST_F(TippMeshMemory, SmoothedMeshesAreTheSameAsInMemory)
{
  this->expectSame("lake.poly", "vtu", { "--smooth", "2" });
}

TEST_F(TippMeshMemory, WrongSizesAreRefused)
{
  for (const char* const size : { "1K", "0", "-1M", "much" })
  {
    const Outcome outcome =
      this->run({ "lake.poly", "-o", "out.vtu", "--keep-order", "--memory", size });
    EXPECT_EQ(2, outcome.ExitCode) << outcome.Err;
    EXPECT_NE(std::string::npos, outcome.Err.find("--memory")) << outcome.Err;
  }
}

TEST_F(TippMeshMemory, ScratchNeedsAMemoryLimit)
{
  const Outcome outcome = this->run({ "lake.poly", "-o", "out.vtu", "--scratch", "." });
  EXPECT_EQ(2, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("--scratch")) << outcome.Err;
}

} // namespace
