// SPDX-License-Identifier: BSD-3-Clause
#include "Console/Process.h"

#include "Vtk/DataSets.h"

#include "vtkLogger.h"
#include "vtkMultiProcessController.h"
#ifdef TIPP_USE_MPI
#include "vtkMPIController.h"

#include <mpi.h>
#endif

#include <dlfcn.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <stdexcept>

namespace tipp
{

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

int MpiSession::ranks() const
{
  return this->Controller ? this->Controller->GetNumberOfProcesses() : 1;
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

/// Installs signal handlers. A crash of VTK's readers then ends the program with exit code 1 and a
/// message that names the file. Other crashes are not affected.
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

} // namespace

void prepareVtk()
{
  // VTK's errors are printed as our own messages, so turn off VTK's.
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  reportReaderCrashes();
}

} // namespace tipp
