// SPDX-License-Identifier: BSD-3-Clause
// Runs out of core that are killed and resumed: the same files, and nothing else.
#include "TippOutOfCore.h"

#include <cstdlib>

namespace
{

using namespace tipp::test;

class TippKilledTwentyTimes : public TippOutOfCore
{
protected:
  void expectTheSameBytes() const
  {
    ASSERT_EQ(0, this->run({ "--neighbors" }).ExitCode);
    const auto expected = filesOf(this->Mesh);
    std::mt19937 random(3);
    int kills = 0;
    for (int round = 0; kills < 20; ++round)
    {
      ASSERT_LT(round, 60) << "runs end before they are killed";
      std::filesystem::remove_all(this->Mesh);
      kills += this->killUntilDone({ "--neighbors" }, random);
      ASSERT_TRUE(expected == filesOf(this->Mesh)) << round;
    }
  }
};

TEST_F(TippKilledTwentyTimes, MakesTheSameTriangles)
{
  this->makePoints("coast", "60000");
  this->expectTheSameBytes();
}

TEST_F(TippKilledTwentyTimes, MakesTheSameTetrahedra)
{
  this->Command = "delaunay3d";
  this->Points = "uniform:30000";
  this->expectTheSameBytes();
}

/// Kills runs before the first call that renames or removes something, then before the second, and
/// so on, and resumes each.
class TippKilledAtACall : public TippOutOfCore
{
protected:
  /// Calls prepare() before each killed run, and check() after each resumed one.
  template <typename Prepare, typename Check>
  void killAtEachCall(
    const std::vector<std::string>& more, const Prepare& prepare, const Check& check) const
  {
    int at = 1;
    for (;; ++at)
    {
      ASSERT_LT(at, 200) << "no run has come to its end";
      prepare();
      setenv("LD_PRELOAD", TIPP_KILL_AT_CALL, 1);
      setenv("TIPP_KILL_AT", std::to_string(at).c_str(), 1);
      const Outcome killed = this->run(more);
      unsetenv("TIPP_KILL_AT");
      unsetenv("LD_PRELOAD");
      if (killed.ExitCode == 0)
      {
        break;
      }
      ASSERT_EQ(-SIGKILL, killed.ExitCode) << killed.Err;
      std::vector<std::string> resume = more;
      resume.emplace_back("--resume");
      const Outcome resumed = this->run(resume);
      ASSERT_EQ(0, resumed.ExitCode) << at << ": " << resumed.Err;
      ASSERT_NO_FATAL_FAILURE(check(at, resumed));
    }
    EXPECT_GT(at, 5);
  }

  /// In the mesh, in its folder or in that of temporary files.
  void expectNothingLeft() const
  {
    const std::vector<std::string> more{ "--scratch", this->Folder.path("scratch") };
    ASSERT_EQ(0, this->run(more).ExitCode);
    const auto expected = filesOf(this->Mesh);
    const std::size_t files = this->Folder.fileCount();
    this->killAtEachCall(
      more, [&] { std::filesystem::remove_all(this->Mesh); },
      [&](int at, const Outcome&)
      {
        ASSERT_TRUE(expected == filesOf(this->Mesh)) << at;
        ASSERT_EQ(files, this->Folder.fileCount()) << at;
        ASSERT_TRUE(std::filesystem::is_empty(this->Folder.path("scratch"))) << at;
      });
  }
};

TEST_F(TippKilledAtACall, LeavesNoOtherFiles)
{
  this->makePoints("coast", "20000");
  this->expectNothingLeft();
}

TEST_F(TippKilledAtACall, LeavesNothingOfTetrahedra)
{
  this->Command = "delaunay3d";
  this->Points = "uniform:12000";
  this->expectNothingLeft();
}

TEST_F(TippKilledAtACall, ReplacesAnOlderMeshOrKeepsIt)
{
  this->makePoints("uniform", "100");
  ASSERT_EQ(0, this->run({}).ExitCode);
  const std::string older = this->Folder.path("older.tipp");
  std::filesystem::rename(this->Mesh, older);
  this->makePoints("coast", "20000");
  ASSERT_EQ(0, this->run({}).ExitCode);
  const auto expected = filesOf(this->Mesh);
  const std::size_t files = this->Folder.fileCount();
  this->killAtEachCall(
    {},
    [&]
    {
      std::filesystem::remove_all(this->Mesh);
      std::filesystem::copy(older, this->Mesh, std::filesystem::copy_options::recursive);
    },
    [&](int at, const Outcome&)
    {
      ASSERT_TRUE(expected == filesOf(this->Mesh)) << at;
      ASSERT_EQ(files, this->Folder.fileCount()) << at;
    });
}

TEST_F(TippKilledAtACall, CountsTheSameTriangles)
{
  this->makePoints("coast", "20000");
  const auto checksum = [](const Outcome& outcome)
  { return outcome.Out.substr(outcome.Out.find("checksum")); };
  const std::vector<std::string> more{ "--sink", "count", "--scratch",
    this->Folder.path("scratch") };
  const std::string expected = checksum(this->run(more));
  const std::size_t files = this->Folder.fileCount();
  this->killAtEachCall(
    more, [] {},
    [&](int at, const Outcome& outcome)
    {
      ASSERT_EQ(expected, checksum(outcome)) << at;
      ASSERT_EQ(files, this->Folder.fileCount()) << at;
      ASSERT_TRUE(std::filesystem::is_empty(this->Folder.path("scratch"))) << at;
    });
}

} // namespace
