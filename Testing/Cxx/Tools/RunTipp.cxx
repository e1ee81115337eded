// SPDX-License-Identifier: BSD-3-Clause
#include "RunTipp.h"

#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tipp
{
namespace test
{
namespace
{

// Runs in the child process, where only async-signal-safe functions may be called.
[[noreturn]] void execute(
  const char* tool, const char* folder, char* const* arguments, int terminal)
{
  const int mode = O_WRONLY | O_CREAT | O_TRUNC;
  if (chdir(folder) == 0 && dup2(open(".out", mode, 0600), STDOUT_FILENO) >= 0 &&
    dup2(terminal >= 0 ? terminal : open(".err", mode, 0600), STDERR_FILENO) >= 0)
  {
    execv(tool, arguments);
  }
  _exit(99);
}

} // namespace

TippProcess::TippProcess(
  const TemporaryFolder& folder, const std::vector<std::string>& arguments, int terminal)
  : Folder(folder)
{
  std::vector<std::string> words{ "tipp" };
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words)
  {
    pointers.push_back(word.data());
  }
  pointers.push_back(nullptr);
  const std::string where = folder.path("");
  // The tests also run with another build of the tool, such as the Python wheel's.
  const char* const other = std::getenv("TIPP_TOOL");
  const char* const tool = other ? other : TIPP_EXECUTABLE;
  this->Process = fork();
  if (this->Process < 0)
  {
    throw std::runtime_error("no process");
  }
  if (this->Process == 0)
  {
    execute(tool, where.c_str(), pointers.data(), terminal);
  }
}

void TippProcess::signal(int number) const
{
  ::kill(this->Process, number);
}

int TippProcess::exitCode() const
{
  int status = 0;
  waitpid(this->Process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

Outcome TippProcess::wait() const
{
  const int code = this->exitCode();
  return { code, contentOf(this->Folder.path(".out")), contentOf(this->Folder.path(".err")) };
}

void TippProcess::waitUntil(const std::function<bool()>& condition) const
{
  while (!condition() && !this->hasEnded())
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

bool TippProcess::hasEnded() const
{
  siginfo_t info = {};
  waitid(P_PID, id_t(this->Process), &info, WEXITED | WNOHANG | WNOWAIT);
  return info.si_pid == this->Process;
}

Outcome TippProcess::waitOrKill() const
{
  constexpr int mostMilliseconds = 60000;
  for (int i = 0; i < mostMilliseconds / 10; ++i)
  {
    if (this->hasEnded())
    {
      return this->wait();
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  this->kill();
  return this->wait();
}

Outcome runTipp(const TemporaryFolder& folder, const std::vector<std::string>& arguments)
{
  return TippProcess(folder, arguments).wait();
}

Outcome runTippOnTerminal(const TemporaryFolder& folder, const std::vector<std::string>& arguments)
{
  int ours = -1;
  int theirs = -1;
  if (openpty(&ours, &theirs, nullptr, nullptr, nullptr) != 0)
  {
    throw std::runtime_error("no terminal");
  }
  const TippProcess process(folder, arguments, theirs);
  close(theirs);
  std::string shown;
  char buffer[1024];
  for (ssize_t got; (got = read(ours, buffer, sizeof(buffer))) > 0;)
  {
    shown.append(buffer, std::size_t(got));
  }
  close(ours);
  Outcome outcome = process.wait();
  outcome.Err = shown;
  return outcome;
}

} // namespace test
} // namespace tipp
