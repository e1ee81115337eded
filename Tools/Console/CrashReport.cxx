// SPDX-License-Identifier: BSD-3-Clause
#include "Console/CrashReport.h"

#include "Commands/Commands.h"
#include "Vtk/ReadDataSet.h"

#include <csignal>
#include <cstring>

#include <unistd.h>

namespace tipp
{
namespace
{

// A signal handler may only call write(), _exit() and the like.
void print(const char* text)
{
  [[maybe_unused]] const auto written = write(STDERR_FILENO, text, std::strlen(text));
}

extern "C" void onCrash(int signal)
{
  const char* const path = fileBeingRead();
  if (!path)
  {
    // The default action, which has been restored, ends the program when this returns.
    raise(signal);
    return;
  }
  print("tipp: ");
  print(path);
  print(
    ": cannot be read as a VTK file (VTK's reader crashed); check that it is whole and that its "
    "extension is right.\n");
  _exit(Failure);
}

} // namespace

void reportReaderCrashes()
{
  // A separate stack, because a reader may have exhausted the normal one.
  static char stack[1 << 16];
  stack_t alternative = {};
  alternative.ss_sp = stack;
  alternative.ss_size = sizeof stack;
  sigaltstack(&alternative, nullptr);
  for (const int signal : { SIGSEGV, SIGBUS, SIGFPE, SIGABRT })
  {
    // A sanitizer's own report is more useful.
    struct sigaction present = {};
    if (sigaction(signal, nullptr, &present) != 0 || present.sa_handler != SIG_DFL)
    {
      continue;
    }
    struct sigaction action = {};
    action.sa_handler = onCrash;
    action.sa_flags = SA_ONSTACK | SA_RESETHAND;
    sigaction(signal, &action, nullptr);
  }
}

} // namespace tipp
