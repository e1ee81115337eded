// SPDX-License-Identifier: BSD-3-Clause
#include "Parallel/UsableProcessors.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace
{

using namespace tipp;

/// Control groups as the system shows them: a folder for each, which is removed in the end.
class ControlGroups : public testing::Test
{
protected:
  ~ControlGroups() override { std::filesystem::remove_all(this->Top); }

  void write(const std::string& group, const std::string& file, const std::string& text) const
  {
    std::filesystem::create_directories(this->Top / group);
    std::ofstream(this->Top / group / file) << text << '\n';
  }

  double limit(const std::string& groups) const
  {
    return controlGroupLimit(groups, this->Top.string());
  }

private:
  const std::filesystem::path Top = std::filesystem::path(testing::TempDir()) /
    testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(ControlGroups, Version2LimitIsThatOfTheGroupsFile)
{
  this->write("jobs/one", "cpu.max", "150000 100000");
  EXPECT_EQ(1.5, this->limit("0::/jobs/one\n"));
}

TEST_F(ControlGroups, TheSmallestLimitOfTheGroupsAboveCounts)
{
  this->write("jobs/one", "cpu.max", "max 100000");
  this->write("jobs", "cpu.max", "400000 100000");
  this->write("", "cpu.max", "800000 100000");
  EXPECT_EQ(4, this->limit("0::/jobs/one\n"));
}

TEST_F(ControlGroups, AContainerSeesItsGroupAsTheTopOne)
{
  this->write("", "cpu.max", "200000 100000");
  EXPECT_EQ(2, this->limit("0::/\n"));
  EXPECT_EQ(2, this->limit("0::/../../named/as/by/the/host\n"));
}

TEST_F(ControlGroups, Version1LimitIsThatOfTheControllerOfTime)
{
  this->write("cpu,cpuacct/jobs", "cpu.cfs_quota_us", "50000");
  this->write("cpu,cpuacct/jobs", "cpu.cfs_period_us", "100000");
  this->write("memory/jobs", "cpu.cfs_quota_us", "1000");
  this->write("memory/jobs", "cpu.cfs_period_us", "100000");
  EXPECT_EQ(0.5, this->limit("3:memory:/jobs\n2:cpu,cpuacct:/jobs\n1:name=systemd:/jobs\n"));
}

TEST_F(ControlGroups, WhatIsNotALimitIsNone)
{
  EXPECT_EQ(0, this->limit(""));
  EXPECT_EQ(0, this->limit("0::/absent\n"));
  EXPECT_EQ(0, this->limit("no colons\n::\n:\n"));
  this->write("max", "cpu.max", "max 100000");
  EXPECT_EQ(0, this->limit("0::/max\n"));
  for (const std::string text : { "-1 100000", "100000 0", "100000", "x y", "nan 1", "" })
  {
    this->write("odd", "cpu.max", text);
    EXPECT_EQ(0, this->limit("0::/odd\n")) << text;
  }
}

void expectProcessors(int count, const std::string& from, const ProcessorCount& found)
{
  EXPECT_EQ(count, found.Count);
  EXPECT_EQ(from, found.From);
}

TEST(UsableProcessors, AreTheFewestOfAllLimits)
{
  expectProcessors(16, "processors", fewestProcessors(16, 16, 0, 0));
  expectProcessors(3, "affinity", fewestProcessors(3, 16, 0, 0));
  expectProcessors(2, "control group", fewestProcessors(16, 16, 1.5, 0));
  expectProcessors(1, "control group", fewestProcessors(16, 16, 0.01, 0));
  expectProcessors(16, "processors", fewestProcessors(16, 16, 1e300, 0));
  expectProcessors(4, "ranks on this node", fewestProcessors(16, 16, 0, 4));
  expectProcessors(1, "ranks on this node", fewestProcessors(2, 2, 0, 5));
}

TEST(UsableProcessors, RanksThatHaveOwnProcessorsKeepThem)
{
  expectProcessors(4, "affinity", fewestProcessors(4, 16, 0, 4));
}

TEST(UsableProcessors, AreAtLeastOneHere)
{
  EXPECT_GE(usableProcessors().Count, 1);
  EXPECT_LE(usableProcessors().Count, processorCount());
}

} // namespace
