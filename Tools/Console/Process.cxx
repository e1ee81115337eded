// SPDX-License-Identifier: BSD-3-Clause
#include "Console/Process.h"

#include "Files/TemporaryPaths.h"
#include "Vtk/DataSets.h"

#include "vtkMultiProcessController.h"
#ifdef TIPP_USE_MPI
#include "vtkMPIController.h"

#include <mpi.h>
#endif

#include <dlfcn.h>
#include <fmt/format.h>
#include <semaphore.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <exception>
#include <mutex>
#include <new>
#include <stdexcept>
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

MpiSession::MpiSession()
{
  // MPI_Init() takes time in a process that was not started as a rank, and may fail without a
  // network.
  if (startedRank() < 0)
  {
    return;
  }
#ifdef TIPP_USE_MPI
  // FUNNELED: only the main thread calls MPI.
  int provided = MPI_THREAD_SINGLE;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  this->Controller = vtkMPIController::New();
  this->Controller->Initialize(nullptr, nullptr, 1);
  vtkMultiProcessController::SetGlobalController(this->Controller);
#else
  throw std::runtime_error(
    "this tipp was built without MPI and cannot run on several ranks; start it "
    "without mpirun, or build it with -DTIPP_USE_MPI=ON.");
#endif
}

MpiSession::~MpiSession()
{
#ifdef TIPP_USE_MPI
  if (this->Controller)
  {
    vtkMultiProcessController::SetGlobalController(nullptr);
    this->Controller->Finalize(1);
    this->Controller->Delete();
    MPI_Finalize();
  }
#endif
}

vtkMultiProcessController* MpiSession::controller() const
{
  return this->Controller;
}

bool MpiSession::isFirst() const
{
  return !this->Controller || this->Controller->GetLocalProcessId() == 0;
}

namespace
{

// Prints with write(): a signal handler may call few other functions.
void print(const char* text)
{
  [[maybe_unused]] const auto written = write(STDERR_FILENO, text, std::strlen(text));
}

extern "C" void onCrash(int signal)
{
  const char* const path = fileBeingRead();
  if (!path)
  {
    // When this returns, the default action, which has been restored, ends the program.
    raise(signal);
    return;
  }
  print("tipp: ");
  print(path);
  print(": cannot be read as a VTK file (VTK's reader crashed); check that it is complete and that "
        "its extension is right.\n");
  _exit(Failure);
}

} // namespace

void reportReaderCrashes()
{
  if (dlsym(RTLD_DEFAULT, "__sanitizer_set_death_callback"))
  {
    return; // the sanitizer's report is more useful
  }
  // Handlers get a stack of their own, because a reader may have exhausted the normal one.
  static char stack[1 << 16];
  stack_t alternative = {};
  alternative.ss_sp = stack;
  alternative.ss_size = sizeof stack;
  sigaltstack(&alternative, nullptr);
  for (const int signal : { SIGSEGV, SIGBUS, SIGFPE, SIGABRT })
  {
    // This replaces a handler of UCX, which Open MPI may load.
    struct sigaction action = {};
    action.sa_handler = onCrash;
    action.sa_flags = SA_ONSTACK | SA_RESETHAND;
    sigaction(signal, &action, nullptr);
  }
}

namespace
{

constexpr long grace = 300'000'000; // nanoseconds
constexpr long second = 1'000'000'000;

std::atomic<bool> interrupted{ false };
std::atomic<bool> terminated{ false };
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets it");
std::atomic<bool> isSaid{ false };
bool isRank = false;
pid_t parent = 0;
std::atomic<bool> isOrphan{ false };
sem_t signals;

/// Returns the mutex of the right to end the process: the thread that holds it decides how the
/// process ends. Never destroyed, because threads may still run while static objects are destroyed.
std::mutex& ending()
{
  static auto* const mutex = new std::mutex;
  return *mutex;
}

extern "C" void onSignal(int number)
{
  (number == SIGTERM ? terminated : interrupted) = true;
  sem_post(&signals);
}

/// Waits for a signal. Returns false if none arrived in time.
bool waitForSignal(long nanoseconds)
{
  timespec until = {};
  clock_gettime(CLOCK_REALTIME, &until);
  until.tv_nsec += nanoseconds;
  until.tv_sec += until.tv_nsec / second;
  until.tv_nsec %= second;
  int failed = 0;
  while ((failed = sem_timedwait(&signals, &until)) != 0 && errno == EINTR)
  {
  }
  return failed == 0;
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
  sem_init(&signals, 0, 0);
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
