// SPDX-License-Identifier: BSD-3-Clause
#include "RunTipp.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

using namespace tipp;
using namespace tipp::test;

namespace
{

using Words = std::vector<std::string>;

/// Two meshes of random points, of which fine.vtu has heights.
class TippRemap : public testing::Test
{
protected:
  TippRemap()
  {
    this->makeMesh("fine", 40, 1);
    this->makeMesh("coarse", 11, 0.9);
  }

  Outcome run(const Words& words) const { return runTipp(this->Folder, words); }

  std::string bytesOf(const std::string& name) const
  {
    std::ifstream file(this->Folder.path(name), std::ios::binary);
    return { std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
  }

  TemporaryFolder Folder;

private:
  void makeMesh(const std::string& name, int side, double width) const
  {
    std::ofstream csv(this->Folder.path(name + ".csv"));
    csv << "x,y,height\n";
    for (int i = 0; i < side * side; ++i)
    {
      const double x = width * (i % side) / (side - 1);
      const double y = width * double(i / side) / (side - 1);
      csv << x << "," << y << "," << x * x - y << "\n";
    }
    csv.close();
    EXPECT_EQ(0, this->run({ "delaunay", name + ".csv", "-o", name + ".vtu" }).ExitCode);
  }
};

} // namespace

TEST_F(TippRemap, DoesNotDependOnThreads)
{
  const Outcome outcome =
    this->run({ "remap", "fine.vtu", "--to", "coarse.vtu", "-o", "a.vtu", "--threads", "1" });
  EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
  EXPECT_EQ(0,
    this->run({ "remap", "fine.vtu", "--to", "coarse.vtu", "-o", "b.vtu", "--threads", "3" })
      .ExitCode);
  EXPECT_EQ(this->bytesOf("a.vtu"), this->bytesOf("b.vtu"));
  EXPECT_NE(this->bytesOf("a.vtu").find("CoveredShare"), std::string::npos);
}

TEST_F(TippRemap, ReadsAStoredMesh)
{
  ASSERT_EQ(0, this->run({ "partition", "fine.vtu", "-o", "fine.tipp" }).ExitCode);
  const Outcome outcome =
    this->run({ "remap", "fine.tipp", "--to", "coarse.vtu", "-o", "a.vtu", "--arrays", "height" });
  EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
  EXPECT_NE(outcome.Out.find("200 cells, 200 of them covered"), std::string::npos) << outcome.Out;
}

TEST_F(TippRemap, RefusesAnExtensionOfOtherCells)
{
  const Outcome outcome = this->run({ "remap", "fine.vtu", "--to", "coarse.vtu", "-o", "a.vtp" });
  EXPECT_NE(0, outcome.ExitCode);
  EXPECT_NE(outcome.Err.find("name it .vtu"), std::string::npos) << outcome.Err;
}

TEST_F(TippRemap, NamesAnArrayThatTheSourceLacks)
{
  const Outcome outcome =
    this->run({ "remap", "fine.vtu", "--to", "coarse.vtu", "-o", "a.vtu", "--arrays", "depth" });
  EXPECT_NE(0, outcome.ExitCode);
  EXPECT_NE(outcome.Err.find("'depth'"), std::string::npos) << outcome.Err;
  EXPECT_FALSE(std::filesystem::exists(this->Folder.path("a.vtu")));
}

TEST_F(TippRemap, ConservativePixelsAreTheSameForStoredMeshes)
{
  ASSERT_EQ(0, this->run({ "partition", "fine.vtu", "-o", "fine.tipp" }).ExitCode);
  const auto imageOf = [this](const std::string& mesh)
  {
    const Outcome outcome = this->run({ "resample", mesh, "-o", "a.npy", "--arrays", "height",
      "--bounds", "0", "1", "0", "1", "--dims", "30", "20", "1", "--method", "conservative" });
    EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
    return this->bytesOf("a.npy");
  };
  constexpr std::size_t pixels = 30 * 20;
  const auto valuesOf = [](const std::string& npy)
  {
    std::vector<double> values(pixels);
    std::memcpy(
      values.data(), npy.data() + npy.size() - pixels * sizeof(double), pixels * sizeof(double));
    return values;
  };
  const std::string whole = imageOf("fine.vtu");
  const std::string stored = imageOf("fine.tipp");
  ASSERT_EQ(whole.size(), stored.size());
  ASSERT_GT(whole.size(), pixels * sizeof(double));
  for (std::size_t i = 0; i < pixels; ++i)
  {
    ASSERT_NEAR(valuesOf(whole)[i], valuesOf(stored)[i], 1e-14) << i;
  }
}

TEST_F(TippRemap, ConservativePixelsNeedAWidth)
{
  const Outcome outcome = this->run({ "resample", "fine.vtu", "-o", "a.npy", "--arrays", "height",
    "--dims", "1", "20", "1", "--method", "conservative" });
  EXPECT_NE(0, outcome.ExitCode);
  EXPECT_NE(outcome.Err.find("give --delta"), std::string::npos) << outcome.Err;
}
