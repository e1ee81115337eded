// SPDX-License-Identifier: BSD-3-Clause
#include "Console/Process.h"

#include "Files/TemporaryPaths.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <new>
#include <thread>

namespace tipp
{

int startedRank()
{
  for (const char* const name : { "OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK" })
  {
    if (const char* const rank = std::getenv(name))
    {
      return std::atoi(rank);
    }
  }
  return -1;
}

namespace
{

constexpr std::chrono::milliseconds grace(300);
constexpr std::chrono::milliseconds second(1000);

std::atomic<bool> interrupted{ false };
std::atomic<bool> terminated{ false };
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets it");
std::atomic<bool> isSaid{ false };
bool isRank = false;
pid_t parent = 0;
pid_t owner = 0; ///< the process that waits for signals
std::atomic<bool> isOrphan{ false };
std::array<int, 2> signals = { -1, -1 }; ///< a pipe, which gets a byte for each signal

/// Returns the mutex of the right to end the process: the thread that holds it decides how the
/// process ends. Never destroyed, because threads may still run while static objects are destroyed.
std::mutex& ending()
{
  static auto* const mutex = new std::mutex;
  return *mutex;
}

extern "C" void onSignal(int number)
{
  const int before = errno;
  (number == SIGTERM ? terminated : interrupted) = true;
  if (getpid() == owner) // not in a forked child, which has the same pipe
  {
    [[maybe_unused]] const auto written = write(signals[1], "", 1);
  }
  errno = before;
}

/// Waits for a signal. Returns false if none arrived in time.
bool waitForSignal(std::chrono::milliseconds time)
{
  pollfd waiting = { signals[0], POLLIN, 0 };
  char byte = 0;
  return poll(&waiting, 1, int(time.count())) > 0 && read(signals[0], &byte, 1) == 1;
}

void say(const char* what, const std::string& consequence)
{
  if (!isSaid.exchange(true))
  {
    const char* const clear = isatty(STDERR_FILENO) == 1 ? "\r\033[K" : ""; // clears a progress bar
    // Unlike fmt::print(), this does not throw if stderr cannot be written.
    std::fputs(fmt::format("{}tipp: {}; {}.\n", clear, what, consequence).c_str(), stderr);
  }
}

[[noreturn]] void endProcess()
{
  ending().lock(); // never released
  const EndedPaths paths = endTemporaryPaths();
  say(interrupted ? "interrupted"
      : isOrphan  ? "ended because mpirun has ended"
      : isRank    ? "ended by SIGTERM, which mpirun sends to all ranks when one of them ends"
                  : "ended by SIGTERM",
    paths.HasOutput   ? "the output was already written"
      : paths.HasKept ? "to continue, run the same command with --resume"
                      : "nothing was written");
  std::fflush(stderr);
  _exit(interrupted ? interruptedExitCode : 128 + SIGTERM);
}

/// Watches for signals, and for the end of mpirun: if mpirun was killed, a rank could wait for
/// others forever.
void watch()
{
  while (!waitForSignal(second) && !isOrphan)
  {
    isOrphan = isRank && getppid() != parent;
  }
  if (!terminated && !isOrphan)
  {
    waitForSignal(grace); // time for the work to stop by itself
  }
  endProcess();
}

} // namespace

void watchForInterrupt(int rank)
{
  isSaid = rank > 0;
  isRank = rank >= 0;
  parent = getppid();
  owner = getpid();
  if (pipe(signals.data()) != 0)
  {
    return; // no file can be opened, either; signals then end the process as usual
  }
  for (const int end : signals)
  {
    fcntl(end, F_SETFD, FD_CLOEXEC);
  }
  fcntl(signals[1], F_SETFL, O_NONBLOCK); // the handler must not wait
  struct sigaction action = {};
  action.sa_handler = onSignal;
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  std::signal(SIGXFSZ, SIG_IGN); // so that writing a file that is too large is an error like others
  std::thread(watch).detach();
}

bool isInterrupted()
{
  return interrupted;
}

int reportInterrupt(const std::string& consequence)
{
  say("interrupted", consequence);
  return interruptedExitCode;
}

int reportFailure()
{
  endWatch();
  std::string reason;
  try
  {
    throw;
  }
  catch (const std::bad_alloc&)
  {
    reason = "there is not enough memory for this input.";
  }
  catch (const std::exception& error)
  {
    reason = error.what();
  }
  if (!isSaid.exchange(true))
  {
    std::fputs(("tipp: " + reason + "\n").c_str(), stderr);
  }
  return EXIT_FAILURE;
}

void endWatch()
{
  static bool hasEnded = false; // used by the main thread only
  if (!hasEnded)
  {
    ending().lock(); // never released
    hasEnded = true;
  }
}

} // namespace tipp
