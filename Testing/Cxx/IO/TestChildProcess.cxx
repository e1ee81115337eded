// SPDX-License-Identifier: BSD-3-Clause
#include "Files/ChildProcess.h"
#include "Files/IOError.h"

#include <gtest/gtest.h>

#include <csignal>
#include <stdexcept>

#include <unistd.h>

namespace
{

using namespace tipp;

TEST(ChildProcess, ReturnsItsWholeResult)
{
  const std::string large(1 << 20, 'x');
  EXPECT_EQ(large, runInChild([&] { return large; }));
  EXPECT_EQ("", runInChild([] { return std::string(); }));
}

TEST(ChildProcess, RunsInAnotherProcess)
{
  EXPECT_NE(std::to_string(getpid()), runInChild([] { return std::to_string(getpid()); }));
}

TEST(ChildProcess, ForwardsErrors)
{
  try
  {
    runInChild([]() -> std::string { throw std::runtime_error("no such system"); });
    FAIL() << "no exception";
  }
  catch (const IOError& error)
  {
    EXPECT_STREQ("no such system", error.what());
  }
}

TEST(ChildProcess, ReportsThatItWasKilled)
{
  EXPECT_THROW(runInChild([]() -> std::string { _exit(0); }), IOError);
  EXPECT_THROW(runInChild(
                 []
                 {
                   raise(SIGKILL);
                   return std::string("result");
                 }),
    IOError);
}

TEST(ChildProcess, EndsBySignalsThatItsParentHandles)
{
  const auto before = std::signal(SIGTERM, [](int) {});
  EXPECT_THROW(runInChild(
                 []
                 {
                   raise(SIGTERM);
                   return std::string("result");
                 }),
    IOError);
  std::signal(SIGTERM, before);
}

} // namespace
