// SPDX-License-Identifier: BSD-3-Clause
#include "Files/HelperProcess.h"

#include "Files/IOError.h"
#include "Parallel/Poll.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <exception>
#include <fstream>

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tipp
{
namespace
{

constexpr char success = '+';
constexpr char failure = '-';
/// Requests and answers are short: large results are in the shared memory.
constexpr std::uint64_t mostBytes = std::uint64_t(1) << 28;

#ifdef MSG_NOSIGNAL
constexpr int sendFlags = MSG_NOSIGNAL; // an ended helper must not end this process
#else
constexpr int sendFlags = 0;
#endif

bool sendAll(int socket, const char* data, std::size_t bytes)
{
  while (bytes > 0)
  {
    const ssize_t sent = send(socket, data, bytes, sendFlags);
    if (sent < 0 && errno != EINTR)
    {
      return false;
    }
    data += std::max<ssize_t>(sent, 0);
    bytes -= std::size_t(std::max<ssize_t>(sent, 0));
  }
  return true;
}

bool receiveAll(int socket, char* data, std::size_t bytes)
{
  while (bytes > 0)
  {
    const ssize_t got = recv(socket, data, bytes, 0);
    if (got == 0 || (got < 0 && errno != EINTR))
    {
      return false;
    }
    data += std::max<ssize_t>(got, 0);
    bytes -= std::size_t(std::max<ssize_t>(got, 0));
  }
  return true;
}

bool sendText(int socket, const std::string& text)
{
  const std::uint64_t size = text.size();
  return sendAll(socket, reinterpret_cast<const char*>(&size), sizeof size) &&
    sendAll(socket, text.data(), text.size());
}

bool receiveText(int socket, std::string& text)
{
  std::uint64_t size = 0;
  if (!receiveAll(socket, reinterpret_cast<char*>(&size), sizeof size) || size > mostBytes)
  {
    return false;
  }
  text.resize(std::size_t(size));
  return receiveAll(socket, text.data(), text.size());
}

/// Removes what this process does at signals: the helper has none of the threads that wait for
/// them. Ctrl-C reaches all processes of a terminal; the helper leaves the decision to its parent.
void resetSignals()
{
  for (const int signal : { SIGTERM, SIGHUP, SIGPROF, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT })
  {
    std::signal(signal, SIG_DFL);
  }
  std::signal(SIGINT, SIG_IGN);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
}

/// What libraries print about damage is for their developers.
void silenceOutputs()
{
  const int nothing = open("/dev/null", O_WRONLY);
  if (nothing >= 0)
  {
    dup2(nothing, STDOUT_FILENO);
    dup2(nothing, STDERR_FILENO);
  }
}

/// Limits the memory: a damaged file may ask for any amount.
void limitMemory()
{
  const rlimit noCores{ 0, 0 };
  setrlimit(RLIMIT_CORE, &noCores);
  std::uint64_t pages = 0;
  if (std::ifstream("/proc/self/statm") >> pages)
  {
    const auto page = std::uint64_t(sysconf(_SC_PAGESIZE));
    const std::uint64_t machine = std::uint64_t(sysconf(_SC_PHYS_PAGES)) * page;
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) == 0)
    {
      limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, pages * page + machine);
      setrlimit(RLIMIT_AS, &limit);
    }
  }
}

std::string answerOf(
  const HelperProcess::Answer& answer, const std::string& request, SharedMemory& memory)
{
  try
  {
    return success + answer(request, memory);
  }
  catch (const std::exception& error)
  {
    return failure + std::string(error.what());
  }
}

} // namespace

HelperEnded::~HelperEnded() = default;

HelperProcess::HelperProcess(Answer answer, int cpuSeconds)
{
  int ends[2] = { -1, -1 };
  if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0)
  {
    throw IOError(
      std::string("No process can be started (") + std::strerror(errno) + "); end others.");
  }
  for (const int end : ends)
  {
    fcntl(end, F_SETFD, FD_CLOEXEC);
  }
  this->Child = fork();
  if (this->Child == 0)
  {
    this->Socket = ends[1];
    this->run(answer, cpuSeconds, ends[0]);
  }
  const int error = errno;
  close(ends[1]);
  this->Socket = ends[0];
  if (this->Child < 0)
  {
    close(ends[0]);
    throw IOError(
      std::string("No process can be started (") + std::strerror(error) + "); end others.");
  }
}

HelperProcess::~HelperProcess()
{
  this->end();
}

void HelperProcess::end()
{
  if (this->Child <= 0)
  {
    return;
  }
  close(this->Socket);
  kill(this->Child, SIGKILL);
  while (waitpid(this->Child, nullptr, 0) < 0 && errno == EINTR)
  {
  }
  this->Child = -1;
}

void HelperProcess::run(const Answer& answer, int cpuSeconds, int parentSocket)
{
  try
  {
    // The socket ends with the parent, or with its last child that has inherited it; so no helper
    // outlives it. PR_SET_PDEATHSIG would end the helper with the thread that has started it.
    close(parentSocket);
    resetSignals();
    silenceOutputs();
    limitMemory();
    std::string request;
    while (receiveText(this->Socket, request))
    {
      limitWork(cpuSeconds);
      const std::string text = answerOf(answer, request, this->Memory);
      limitWork(0);
      if (!sendText(this->Socket, text))
      {
        break;
      }
    }
  }
  catch (...)
  {
    _exit(1);
  }
  _exit(0); // skips this process' own clean-up
}

/// The system ends this process after so much work, or never for 0. Waiting for a slow disk does
/// not count.
void HelperProcess::limitWork(int cpuSeconds)
{
  itimerval timer{};
  timer.it_value.tv_sec = cpuSeconds;
  setitimer(ITIMER_PROF, &timer, nullptr);
}

void HelperProcess::send(const std::string& request)
{
  if (this->Child <= 0 || !sendText(this->Socket, request))
  {
    this->reportEnd();
  }
}

void HelperProcess::waitForAnswer()
{
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::seconds most(900);
  constexpr int milliseconds = 100;
  const Clock::time_point begin = Clock::now();
  while (Clock::now() - begin < most)
  {
    pollfd waiting{ this->Socket, POLLIN, 0 };
    if (::poll(&waiting, 1, milliseconds) > 0)
    {
      return;
    }
    try
    {
      tipp::poll();
    }
    catch (...)
    {
      this->end(); // its late answer would be taken for another request's
      throw;
    }
  }
  this->end();
  throw HelperEnded("has not answered for " + std::to_string(most.count()) + " seconds");
}

std::string HelperProcess::receive()
{
  if (this->Child <= 0)
  {
    this->reportEnd();
  }
  this->waitForAnswer();
  std::string text;
  if (!receiveText(this->Socket, text) || text.empty())
  {
    this->reportEnd();
  }
  const bool isGood = text.front() == success;
  text.erase(0, 1);
  return isGood ? text : throw IOError(text);
}

void HelperProcess::reportEnd()
{
  this->end();
  throw HelperEnded("has ended early");
}

} // namespace tipp
