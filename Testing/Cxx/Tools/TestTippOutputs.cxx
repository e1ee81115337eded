// SPDX-License-Identifier: BSD-3-Clause
// Outputs that cannot be written, are also inputs, or have unusual names.
#include "MeshChecks.h"
#include "RunTipp.h"

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include <sys/resource.h>
#include <sys/stat.h>

namespace
{

namespace fs = std::filesystem;
using namespace tipp::test;
using Words = std::vector<std::string>;

class TippOutputs : public testing::Test
{
protected:
  TippOutputs()
  {
    this->Folder.file("tiny.csv", "0,0\n1,0\n0,1\n");
    this->require({ "points", "--distribution", "uniform", "--count", "3000", "-o", "points.npy" });
    this->require({ "delaunay", "points.npy", "-o", "mesh.vtu" });
    this->require({ "flatten", "mesh.vtu", "-o", "flat" });
    this->require({ "partition", "flat", "-o", "mesh.tipp", "--tiling", "grid:2x2" });
  }

  Outcome run(const Words& arguments) const { return runTipp(this->Folder, arguments); }

  void require(const Words& arguments) const
  {
    const Outcome outcome = this->run(arguments);
    ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  }

  /// Runs the tool with a limit on the size of files, as if the disk were full.
  Outcome runOnFullDisk(const Words& arguments, rlim_t bytes) const
  {
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit small{ bytes, before.rlim_max };
    setrlimit(RLIMIT_FSIZE, &small);
    std::signal(SIGXFSZ, SIG_IGN);
    const Outcome outcome = this->run(arguments);
    setrlimit(RLIMIT_FSIZE, &before);
    return outcome;
  }

  /// Expects one sentence, exit code 1, and unchanged files.
  void expectRefused(const Words& arguments, const std::string& words) const
  {
    const auto before = this->files();
    const Outcome outcome = this->run(arguments);
    this->expectFailed(outcome, words);
    EXPECT_TRUE(before == this->files()) << outcome.Err;
  }

  void expectFailed(const Outcome& outcome, const std::string& words) const
  {
    EXPECT_EQ(1, outcome.ExitCode) << outcome.Err;
    EXPECT_EQ("", outcome.Out);
    EXPECT_NE(std::string::npos, outcome.Err.find(words)) << outcome.Err;
    EXPECT_EQ(outcome.Err.size() - 1, outcome.Err.find('\n')) << outcome.Err;
  }

  std::map<std::string, std::string> files() const
  {
    std::map<std::string, std::string> files = filesOf(this->Folder.path(""));
    files.erase(".out");
    files.erase(".err");
    return files;
  }

  std::string path(const std::string& name) const { return this->Folder.path(name); }

  TemporaryFolder Folder;
};

struct FullDisk
{
  const char* Name;
  Words Arguments;
  rlim_t Bytes; ///< less than the size of the output
  bool IsFile;
};

// CTest shows this name for the test.
std::ostream& operator<<(std::ostream& stream, const FullDisk& disk)
{
  return stream << disk.Name;
}

class TippFullDisk
  : public TippOutputs
  , public testing::WithParamInterface<FullDisk>
{
};

TEST_P(TippFullDisk, FailsAndKeepsTheOldFile)
{
  const std::string output = GetParam().Arguments.back();
  if (GetParam().IsFile)
  {
    this->Folder.file(output, "old");
  }
  const auto before = this->files();
  const Outcome outcome = this->runOnFullDisk(GetParam().Arguments, GetParam().Bytes);
  EXPECT_EQ(1, outcome.ExitCode) << outcome.Err;
  EXPECT_NE(std::string::npos, outcome.Err.find("cannot be written (")) << outcome.Err;
  EXPECT_NE(std::string::npos, outcome.Err.find(output)) << outcome.Err;
  auto after = this->files();
  after.erase("out.npy"); // this mesh was written, but not its statistics
  EXPECT_TRUE(before == after) << outcome.Err;
}

// out.vtu has 174,816 bytes. The last ones are written when the file is closed.
INSTANTIATE_TEST_SUITE_P(Outputs, TippFullDisk,
  testing::Values(FullDisk{ "vtu", { "delaunay", "points.npy", "-o", "out.vtu" }, 100000, true },
    FullDisk{ "vtuAtItsEnd", { "delaunay", "points.npy", "-o", "out.vtu" }, 174000, true },
    FullDisk{ "vtp", { "delaunay", "points.npy", "-o", "out.vtp" }, 100000, true },
    FullDisk{ "vtpAtItsStart", { "delaunay", "points.npy", "-o", "out.vtp" }, 300, true },
    FullDisk{ "npy", { "delaunay", "points.npy", "-o", "triangles.npy" }, 100000, true },
    FullDisk{
      "vti", { "resample", "mesh.vtu", "--dims", "90", "90", "1", "-o", "out.vti" }, 5000, true },
    FullDisk{ "points",
      { "points", "--distribution", "uniform", "--count", "3000", "-o", "new.npy" }, 30000, true },
    FullDisk{
      "stats", { "delaunay", "tiny.csv", "-o", "out.npy", "--stats", "run.json" }, 300, true },
    FullDisk{ "flat", { "flatten", "mesh.vtu", "-o", "out" }, 50000, false },
    FullDisk{
      "mesh", { "partition", "flat", "--tiling", "grid:2x2", "-o", "out.tipp" }, 30000, false },
    FullDisk{ "dataSet", { "partition", "mesh.vtu", "--tiling", "grid:2x2", "-o", "out.tipp" },
      50000, false }),
  [](const auto& info) { return std::string(info.param.Name); });

TEST_F(TippOutputs, PrintingToAFullDiskFails)
{
  for (const Words& words : { Words{ "--help" }, Words{ "check", "points.npy", "mesh.vtu" },
         Words{ "points", "--distribution", "uniform", "--count", "3", "-o", "three.npy" } })
  {
    fs::remove(this->path(".out"));
    fs::create_symlink("/dev/full", this->path(".out"));
    const TippProcess process(this->Folder, words);
    fs::path out = this->path(".out");
    const int code = process.exitCode();
    fs::remove(out);
    EXPECT_EQ(1, code) << words.front();
    const std::string error = contentOf(this->path(".err"));
    EXPECT_NE(std::string::npos, error.find("standard output cannot be written (No space left"))
      << error;
  }
}

TEST_F(TippOutputs, ADeviceIsRefused)
{
  fs::create_symlink("/dev/full", this->path("full.vtu"));
  this->expectRefused({ "delaunay", "points.npy", "-o", "full.vtu" }, "is not an ordinary file");
  this->expectRefused(
    { "delaunay", "points.npy", "-o", "a.npy", "--stats", "/dev/full" }, "is not an ordinary file");
}

TEST_F(TippOutputs, AnInputIsRefused)
{
  this->Folder.file("run.json", "old");
  fs::create_symlink("points.npy", this->path("link.npy"));
  fs::create_hard_link(this->path("points.npy"), this->path("hard.npy"));
  fs::create_directory(this->path("sub"));
  fs::create_symlink("flat", this->path("flatlink"));
  const std::string also = "is also an input";
  for (const char* const name :
    { "points.npy", "link.npy", "hard.npy", "sub/../points.npy", "./points.npy" })
  {
    this->expectRefused({ "delaunay", "points.npy", "-o", name }, also);
    this->expectRefused({ "points", "--like", "points.npy", "--count", "9", "-o", name }, also);
    this->expectRefused({ "delaunay", "points.npy", "-o", "x.vtu", "--stats", name }, also);
    this->expectRefused({ "delaunay", "points.npy", "-o", "x.tipp", "--stats", name }, also);
  }
  this->expectRefused({ "delaunay", "mesh.vtu", "-o", "mesh.vtu" }, also);
  this->expectRefused(
    { "delaunay", "mesh.tipp/mesh.pvtu", "-o", "mesh.tipp/pieces/000001.vtu" }, also);
  this->expectRefused(
    { "resample", "flat", "--dims", "9", "9", "1", "--arrays", "z", "-o", "flatlink/points.npy" },
    also);
  this->expectRefused({ "partition", "flat", "-o", "x.tipp", "--stats", "flat/points.npy" }, also);
}

TEST_F(TippOutputs, TheFolderOfAnInputIsRefused)
{
  const std::string holds = "holds an input";
  for (const char* const name : { "mesh.tipp", "mesh.tipp/", "./sub/../mesh.tipp" })
  {
    fs::create_directory(this->path("sub"));
    this->expectRefused({ "partition", "mesh.tipp/pieces/000000.vtu", "-o", name }, holds);
    this->expectRefused({ "delaunay", "mesh.tipp/pieces/000000.vtu", "-o", name }, holds);
  }
}

TEST_F(TippOutputs, OutputsMustDiffer)
{
  this->expectRefused(
    { "delaunay", "points.npy", "-o", "a.npy", "--stats", "./a.npy" }, "is the same as");
  this->expectRefused(
    { "partition", "flat", "-o", "mesh.tipp", "--stats", "mesh.tipp/run.json" }, "lies in it");
  this->expectRefused(
    { "delaunay", "points.npy", "-o", "mesh.tipp", "--stats", "mesh.tipp/run.json" }, "lies in it");
  this->expectRefused(
    { "delaunay", "points.npy", "-o", "x.tipp", "--scratch", "x.tipp" }, "lies in it");
}

TEST_F(TippOutputs, ScratchFolderWithoutItsParentIsRefused)
{
  this->expectRefused(
    { "delaunay", "points.npy", "-o", "x.tipp", "--scratch", "no/such" }, "cannot be made");
  EXPECT_FALSE(fs::exists(this->path("no")));
}

TEST_F(TippOutputs, ScratchFolderOfTwoRunsIsRefused)
{
  fs::create_directories(this->path("scratch/.x.tipp.part"));
  this->Folder.file("scratch/.x.tipp.part/mine.txt", "mine");
  this->expectRefused({ "delaunay", "points.npy", "-o", "x.tipp", "--scratch", "scratch" },
    "is there already with other files");
  fs::remove(this->path("scratch/.x.tipp.part/mine.txt"));
  this->Folder.file("scratch/.x.tipp.part/.tipp-work", "of another mesh");
  this->expectRefused(
    { "delaunay", "points.npy", "-o", "x.tipp", "--scratch", "scratch" }, "of another run");
}

TEST_F(TippOutputs, LinkToNothingIsWrittenThrough)
{
  fs::create_directory(this->path("sub"));
  fs::create_symlink("sub/new.npy", this->path("out.npy"));
  fs::create_symlink("sub/new.tipp", this->path("out.tipp"));
  this->require({ "delaunay", "points.npy", "-o", "out.npy" });
  this->require({ "delaunay", "points.npy", "-o", "out.tipp" });
  EXPECT_TRUE(fs::is_regular_file(this->path("sub/new.npy")));
  EXPECT_TRUE(fs::is_directory(this->path("sub/new.tipp")));
  EXPECT_TRUE(fs::is_symlink(this->path("out.npy")));
  EXPECT_TRUE(fs::is_symlink(this->path("out.tipp")));
  fs::create_symlink("gone/new.npy", this->path("bad.npy"));
  this->expectRefused({ "delaunay", "points.npy", "-o", "bad.npy" }, "its folder does not exist");
}

TEST_F(TippOutputs, LongestNamesAreWritten)
{
  const std::string name(250, 'n');
  this->require({ "delaunay", "points.npy", "-o", name + ".npy", "--stats", name + ".json" });
  this->require({ "delaunay", "points.npy", "-o", name + ".tipp" });
  this->require({ "partition", "flat", "-o", name + ".tipp" });
  this->require({ "flatten", "mesh.vtu", "-o", name + "flat" });
  this->expectRefused({ "delaunay", "points.npy", "-o", name + "nn.npy" }, "File name too long");
  this->expectRefused({ "delaunay", "points.npy", "-o", name + "n.tipp" }, "File name too long");
}

TEST_F(TippOutputs, SlashAtTheEndNamesAFolder)
{
  this->require({ "delaunay", "points.npy", "-o", "x.tipp/" });
  this->require({ "check", "points.npy", "x.tipp/" });
  this->require({ "partition", "flat/", "-o", "y.tipp/" });
  this->require({ "flatten", "mesh.vtu", "-o", "out/" });
  this->expectRefused({ "delaunay", "points.npy", "-o", "x.npy/" }, "is the name of a folder");
}

TEST_F(TippOutputs, MessagesNameTheOutputAndNotItsTemporaryFiles)
{
  const Outcome flatten = this->runOnFullDisk({ "flatten", "mesh.vtu", "-o", "out" }, 4096);
  this->expectFailed(flatten, "out/");
  EXPECT_EQ(std::string::npos, flatten.Err.find(".tmp")) << flatten.Err;
}

TEST_F(TippOutputs, AFileWithTheWorkFoldersNameIsReported)
{
  this->Folder.file(".x.tipp.part", "mine");
  this->expectRefused(
    { "delaunay", "points.npy", "-o", "x.tipp" }, ".x.tipp.part: is a file where the work folder");
}

TEST_F(TippOutputs, UsersFoldersNamedLikeWorkFoldersAreKept)
{
  fs::create_directory(this->path(".x.tipp.part"));
  this->Folder.file(".x.tipp.part/notes.txt", "mine");
  this->expectRefused(
    { "delaunay", "points.npy", "-o", "x.tipp" }, "is there already with other files");
  fs::create_directory(this->path(".y.tipp.tmp.Ab3dEf"));
  this->Folder.file(".y.tipp.tmp.Ab3dEf/notes.txt", "mine");
  this->require({ "partition", "flat", "-o", "y.tipp" });
  EXPECT_EQ("mine", contentOf(this->path(".y.tipp.tmp.Ab3dEf/notes.txt")));
}

TEST_F(TippOutputs, UsersFilesInAMeshAreKept)
{
  this->Folder.file("mesh.tipp/notes.txt", "mine");
  this->expectRefused({ "partition", "flat", "-o", "mesh.tipp" }, "holds 'notes.txt'");
  this->expectRefused({ "delaunay", "points.npy", "-o", "mesh.tipp" }, "holds 'notes.txt'");
}

/// The file appears while the run waits for its input from a pipe.
TEST_F(TippOutputs, FileThatAppearsDuringTheRunIsKept)
{
  for (const char* output : { "out.npy", "out.vtu", "out.vtp" })
  {
    const std::string pipe = this->path("pipe.csv");
    ASSERT_EQ(0, mkfifo(pipe.c_str(), 0600));
    const TippProcess process(this->Folder, { "delaunay", "pipe.csv", "-o", output });
    std::ofstream input(pipe); // returns once the tool reads, after it has checked its output
    this->Folder.file(output, "the user's");
    input << "0,0\n1,0\n0,1\n" << std::flush;
    input.close();
    const Outcome outcome = process.waitOrKill();
    EXPECT_EQ(1, outcome.ExitCode) << output;
    EXPECT_NE(std::string::npos, outcome.Err.find(output)) << outcome.Err;
    EXPECT_EQ("the user's", contentOf(this->path(output)));
    fs::remove(pipe);
  }
}

} // namespace
