// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInterrupt_h
#define tippInterrupt_h

#include <string>

namespace tipp
{

/// The shell's exit code of a program that Ctrl-C ended.
constexpr int interruptedExitCode = 130;

/// From now on Ctrl-C (SIGINT) sets a flag, for work that asks isInterrupted() now and then. If the
/// process is still there a moment later, or at a second signal or SIGTERM, a thread of its
/// own removes the temporary files, says so in one sentence and ends the process. So no phase of a
/// command need ask often, nor at all. `rank`: of the process, or -1; only the first rank speaks.
void watchForInterrupt(int rank);
bool isInterrupted();
/// Tells the user, once and on the first rank alone, and returns the exit code.
int reportInterrupt(const std::string& consequence = "nothing was written");
/// Says what the exception that is being handled tells, on the first rank alone, and returns the
/// exit code. On ranks to be called before MPI ends: mpirun ends the first rank when another one
/// has ended with a failure.
int reportFailure();
/// To be called before the process reports its end: waits for ever if the thread is ending it, and
/// keeps the thread from doing so otherwise.
void endWatch();

} // namespace tipp

#endif
