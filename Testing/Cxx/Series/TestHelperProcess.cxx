// SPDX-License-Identifier: BSD-3-Clause
#include "Files/HelperProcess.h"
#include "Files/IOError.h"
#include "Parallel/Poll.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <string>
#include <thread>

#include <sys/wait.h>
#include <unistd.h>

namespace
{

using namespace tipp;

/// Answers "pid", "fill" with a large block, "wait", "loop", "crash" and "throw".
std::string answer(const std::string& request, SharedMemory& memory)
{
  constexpr std::size_t large = std::size_t(20) << 20;
  if (request == "fill")
  {
    std::memset(memory.resize(large), 'x', large);
  }
  else if (request == "crash")
  {
    raise(SIGSEGV);
  }
  else if (request == "throw")
  {
    throw std::runtime_error("no such value");
  }
  else if (request == "wait")
  {
    sleep(1000);
  }
  volatile bool runs = request == "loop";
  while (runs)
  {
  }
  return std::to_string(getpid());
}

/// Whether this process has a child that has ended and is not waited for, or that runs.
bool hasChild()
{
  return waitpid(-1, nullptr, WNOHANG) >= 0 || errno != ECHILD;
}

TEST(HelperProcess, AnswersInAnotherProcess)
{
  HelperProcess helper(answer);
  const std::string first = helper.ask("pid");
  EXPECT_NE(std::to_string(getpid()), first);
  EXPECT_EQ(first, helper.ask("pid"));
}

TEST(HelperProcess, SharesMemoryThatGrowsAfterTheStart)
{
  HelperProcess helper(answer);
  helper.ask("fill");
  const std::size_t last = (std::size_t(20) << 20) - 1;
  EXPECT_EQ('x', helper.memory(last + 1)[last]);
  EXPECT_THROW(helper.memory(last + 2), IOError);
}

TEST(HelperProcess, ReportsACrashAndEveryRequestAfterIt)
{
  HelperProcess helper(answer);
  EXPECT_THROW(helper.ask("crash"), HelperEnded);
  EXPECT_THROW(helper.ask("pid"), HelperEnded);
  EXPECT_FALSE(hasChild());
}

TEST(HelperProcess, EndsAnAnswerThatTakesTooMuchWork)
{
  HelperProcess helper(answer, 1);
  EXPECT_THROW(helper.ask("loop"), HelperEnded);
  EXPECT_FALSE(hasChild());
}

TEST(HelperProcess, ForwardsErrorsAndContinues)
{
  HelperProcess helper(answer);
  try
  {
    helper.ask("throw");
    FAIL() << "no exception";
  }
  catch (const IOError& error)
  {
    EXPECT_STREQ("no such value", error.what());
  }
  EXPECT_FALSE(helper.ask("pid").empty());
}

TEST(HelperProcess, LeavesNoProcess)
{
  {
    HelperProcess helper(answer);
    helper.send("wait");
  }
  EXPECT_FALSE(hasChild());
}

TEST(HelperProcess, OutlivesTheThreadThatStartedIt)
{
  std::unique_ptr<HelperProcess> helper;
  std::thread([&] { helper = std::make_unique<HelperProcess>(answer); }).join();
  EXPECT_FALSE(helper->ask("pid").empty());
}

TEST(HelperProcess, IsAbortedWhileItWorks)
{
  HelperProcess helper(answer);
  const PollScope scope([] { return false; });
  EXPECT_THROW(helper.ask("wait"), WorkAborted);
  EXPECT_FALSE(hasChild());
}

TEST(HelperProcess, EndsWithItsParent)
{
  int ends[2];
  ASSERT_EQ(0, pipe(ends));
  const pid_t parent = fork();
  if (parent == 0)
  {
    HelperProcess helper(answer);
    const auto pid = pid_t(std::stol(helper.ask("pid")));
    const bool isWritten = write(ends[1], &pid, sizeof pid) == sizeof pid;
    _exit(isWritten ? 0 : 1); // without destructors, as after SIGKILL
  }
  pid_t helper = 0;
  ASSERT_EQ(ssize_t(sizeof helper), read(ends[0], &helper, sizeof helper));
  waitpid(parent, nullptr, 0);
  close(ends[0]);
  close(ends[1]);
  for (int i = 0; i < 1000 && kill(helper, 0) == 0; ++i)
  {
    usleep(10000);
    // Without a process that takes in orphans, an ended one remains as an entry in the table.
    std::string state;
    std::FILE* const stat = std::fopen(("/proc/" + std::to_string(helper) + "/stat").c_str(), "r");
    char kind = 'Z';
    if (stat)
    {
      if (std::fscanf(stat, "%*d %*s %c", &kind) != 1)
      {
        kind = 'Z';
      }
      std::fclose(stat);
    }
    if (kind == 'Z')
    {
      return;
    }
  }
  EXPECT_NE(0, kill(helper, 0));
}

} // namespace
