// SPDX-License-Identifier: BSD-3-Clause
#include "Files/ChildProcess.h"

#include "Files/IOError.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <exception>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tipp
{
namespace
{

constexpr char success = '+';
constexpr char failure = '-';

bool writeAll(int descriptor, const std::string& bytes)
{
  std::size_t done = 0;
  while (done < bytes.size())
  {
    const ssize_t put = write(descriptor, bytes.data() + done, bytes.size() - done);
    if (put < 0 && errno != EINTR)
    {
      return false;
    }
    done += put > 0 ? std::size_t(put) : 0;
  }
  return true;
}

std::string readAll(int descriptor)
{
  std::string bytes;
  std::array<char, 4096> block{};
  for (;;)
  {
    const ssize_t got = read(descriptor, block.data(), block.size());
    if (got > 0)
    {
      bytes.append(block.data(), std::size_t(got));
    }
    else if (got == 0 || errno != EINTR)
    {
      return bytes;
    }
  }
}

} // namespace

std::string runInChild(const std::function<std::string()>& work)
{
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
  {
    return work();
  }
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child == 0)
  {
    // This process' signal handlers wake a thread that the child does not have.
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    close(ends[0]);
    if (getppid() != parent)
    {
      _exit(1);
    }
    std::string result;
    try
    {
      result = success + work();
    }
    catch (const std::exception& error)
    {
      result = failure + std::string(error.what());
    }
    catch (...)
    {
      _exit(1);
    }
    // The last byte shows that the result is complete. _exit() skips this process' own clean-up.
    _exit(writeAll(ends[1], result + success) ? 0 : 1);
  }
  close(ends[1]);
  if (child < 0)
  {
    close(ends[0]);
    return work(); // no process can be made
  }
  std::string result = readAll(ends[0]);
  close(ends[0]);
  int status = 0; // stays 0 where SIGCHLD is ignored
  while (waitpid(child, &status, 0) < 0 && errno == EINTR)
  {
  }
  if (status != 0 || result.size() < 2 || result.back() != success)
  {
    throw IOError("A process that was to do a part of the work has ended early; try again.");
  }
  const bool isGood = result.front() == success;
  result = result.substr(1, result.size() - 2);
  if (!isGood)
  {
    throw IOError(result);
  }
  return result;
}

} // namespace tipp
