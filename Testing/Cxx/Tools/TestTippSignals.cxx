// SPDX-License-Identifier: BSD-3-Clause
// Signals at any moment, independent of the machine's speed: the tool is made to hang in one call
// that reads or writes a file after the other, so that only the signal can end it.
#include "RunTipp.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <thread>

namespace fs = std::filesystem;
using namespace tipp::test;

namespace
{

class TippSignals : public testing::Test
{
protected:
  void make(const std::vector<std::string>& arguments)
  {
    const Outcome outcome = runTipp(this->Folder, arguments);
    ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  }

  void makePoints()
  {
    this->make({ "points", "--distribution", "uniform", "--count", "20000", "-o", "points.npy" });
  }

  void makeMesh(const std::string& name)
  {
    this->makePoints();
    this->make({ "delaunay", "points.npy", "-o", name });
  }

  bool isHidden(const fs::path& path) const
  {
    const std::string name = path.filename().string();
    return name[0] == '.' && name != ".out" && name != ".err";
  }

  std::vector<std::string> hidden() const
  {
    std::vector<std::string> names;
    for (const fs::directory_entry& entry : fs::directory_iterator(this->Folder.path("")))
    {
      if (this->isHidden(entry.path()))
      {
        names.push_back(entry.path().filename().string());
      }
    }
    return names;
  }

  /// Runs the command until it hangs in this call, and sends the signal. Returns false if the
  /// command ended before.
  bool hangAndSignal(
    const std::vector<std::string>& arguments, int call, int number, Outcome& outcome)
  {
    const std::string mark = this->Folder.path("mark");
    fs::remove(mark);
    setenv("LD_PRELOAD", TIPP_HANG_AT_CALL, 1);
    setenv("TIPP_HANG_AT", std::to_string(call).c_str(), 1);
    setenv("TIPP_HANG_MARK", mark.c_str(), 1);
    const TippProcess process(this->Folder, arguments);
    unsetenv("LD_PRELOAD");
    while (!fs::exists(mark) && !process.hasEnded())
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    const bool hangs = fs::exists(mark);
    if (hangs)
    {
      process.signal(number);
    }
    outcome = process.waitOrKill();
    return hangs;
  }

  /// Signals every call that reads or writes a file or, if there are many, some of them.
  void expectClearEndsOf(const std::vector<std::string>& arguments, const std::string& output,
    const std::vector<std::string>& mayStay = {})
  {
    int hung = 0;
    for (int call = 1;; call += 1 + call / 3)
    {
      Outcome outcome;
      if (!this->hangAndSignal(arguments, call, SIGINT, outcome))
      {
        ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
        break;
      }
      ++hung;
      ASSERT_EQ(130, outcome.ExitCode) << "call " << call << ": " << outcome.Err;
      ASSERT_EQ(0U, outcome.Err.find("tipp: interrupted; ")) << outcome.Err;
      ASSERT_EQ(outcome.Err.size() - 1, outcome.Err.find('\n')) << outcome.Err;
      const bool isWritten = outcome.Err.find("already written") != std::string::npos;
      ASSERT_EQ(isWritten, !output.empty() && fs::exists(this->Folder.path(output)))
        << "call " << call << ": " << outcome.Err;
      const std::vector<std::string> left = this->hidden();
      const bool goesOn = outcome.Err.find("--resume") != std::string::npos;
      ASSERT_EQ(goesOn ? mayStay : std::vector<std::string>(), left) << "call " << call;
      for (const std::string& name : left)
      {
        fs::remove_all(this->Folder.path(name));
      }
      if (!output.empty())
      {
        fs::remove_all(this->Folder.path(output));
      }
    }
    EXPECT_GT(hung, 0);
  }

  TemporaryFolder Folder;
};

TEST_F(TippSignals, InterruptEndsPointsAnywhere)
{
  this->makePoints();
  this->expectClearEndsOf(
    { "points", "--like", "points.npy", "--count", "20000", "-o", "out.npy" }, "out.npy");
}

TEST_F(TippSignals, InterruptEndsDelaunayAnywhere)
{
  this->makePoints();
  this->expectClearEndsOf({ "delaunay", "points.npy", "-o", "out.npy" }, "out.npy");
  this->expectClearEndsOf({ "delaunay", "points.npy", "-o", "out.vtu" }, "out.vtu");
}

TEST_F(TippSignals, InterruptEndsDelaunayOutOfCoreAnywhere)
{
  this->makePoints();
  this->expectClearEndsOf({ "delaunay", "points.npy", "-o", "out.tipp", "--partitions", "2x2" },
    "out.tipp", { ".out.tipp.part" });
}

TEST_F(TippSignals, InterruptEndsMeshAnywhere)
{
  this->Folder.file(
    "square.poly", "4 2 0 0\n1 0 0\n2 9 0\n3 9 9\n4 0 9\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n");
  for (const std::string name : { "out.vtu", "out.14" })
  {
    this->expectClearEndsOf({ "mesh", "square.poly", "-o", name, "--size", "0.1" }, name);
  }
}

TEST_F(TippSignals, InterruptEndsFlattenAnywhere)
{
  this->makeMesh("mesh.vtu");
  this->expectClearEndsOf({ "flatten", "mesh.vtu", "-o", "out" }, "out");
}

TEST_F(TippSignals, InterruptEndsPartitionAnywhere)
{
  this->makeMesh("mesh.vtu");
  this->expectClearEndsOf({ "partition", "mesh.vtu", "-o", "out.tipp" }, "out.tipp");
}

TEST_F(TippSignals, InterruptEndsResampleAnywhere)
{
  this->makeMesh("mesh.vtu");
  this->expectClearEndsOf(
    { "resample", "mesh.vtu", "-o", "out.vti", "--dims", "30", "30", "1" }, "out.vti");
}

TEST_F(TippSignals, InterruptEndsCheckAnywhere)
{
  this->makeMesh("mesh.tipp");
  this->expectClearEndsOf({ "check", "points.npy", "mesh.tipp" }, "");
}

TEST_F(TippSignals, TerminationRemovesTemporaryFiles)
{
  this->makeMesh("mesh.vtu");
  for (const int call : { 1, 5, 20 })
  {
    Outcome outcome;
    ASSERT_TRUE(
      this->hangAndSignal({ "partition", "mesh.vtu", "-o", "out.tipp" }, call, SIGTERM, outcome));
    EXPECT_EQ(143, outcome.ExitCode);
    EXPECT_EQ("tipp: ended by SIGTERM; nothing was written.\n", outcome.Err);
    EXPECT_TRUE(this->hidden().empty());
  }
}

TEST_F(TippSignals, AnInterruptKeepsTheStateOfAnEarlierRun)
{
  this->makePoints();
  const std::vector<std::string> arguments{ "delaunay", "points.npy", "-o", "out.tipp",
    "--partitions", "2x2", "--resume" };
  const fs::path plan = this->Folder.path(".out.tipp.part/.plan");
  Outcome outcome;
  for (int call = 1; !fs::exists(plan); ++call)
  {
    ASSERT_TRUE(this->hangAndSignal(arguments, call, SIGINT, outcome));
  }
  for (int call = 1; call < 5; ++call)
  {
    ASSERT_TRUE(this->hangAndSignal(arguments, call, SIGINT, outcome));
    EXPECT_TRUE(fs::exists(plan)) << "call " << call;
  }
}

} // namespace
