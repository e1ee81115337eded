// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippProcess_h
#define tippProcess_h

#include <string>

class vtkMultiProcessController;

namespace tipp
{

/// The rank that mpirun or a batch system started this process as; -1: none. Does not need MPI to
/// be initialised.
int startedRank();

/// Whether this process is a rank other than the first, which has no work in a command that runs on
/// the first rank only.
inline bool isIdleRank()
{
  return startedRank() > 0;
}

/// Initialises MPI for the object's lifetime if mpirun or a batch system started the process.
/// Throws std::runtime_error if that is so in a build without MPI.
class MpiSession
{
public:
  MpiSession();
  ~MpiSession();
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;

  /// Null for a process without MPI. Not owned by the caller.
  vtkMultiProcessController* controller() const;
  /// Whether this is the first rank, the one that prints messages.
  bool isFirst() const;

private:
  vtkMultiProcessController* Controller = nullptr;
};

/// The shell's exit code of a program that Ctrl-C ended.
constexpr int interruptedExitCode = 130;

/// Makes Ctrl-C (SIGINT) set a flag for isInterrupted(). If the process still runs a moment later,
/// or at a second signal or SIGTERM, a separate thread removes the temporary files, prints one
/// sentence and ends the process. So commands need not poll the flag often, or at all. `rank` is
/// the process's rank, or -1; only the first rank prints.
void watchForInterrupt(int rank);
bool isInterrupted();
/// Prints a message, once and only on the first rank, and returns the exit code.
int reportInterrupt(const std::string& consequence = "nothing was written");
/// Prints the message of the exception being handled, only on the first rank, and returns the exit
/// code. With several ranks, call it before MPI_Finalize(): mpirun ends the first rank once another
/// one has failed.
int reportFailure();
/// Call it before the process reports its outcome: blocks for ever if the thread is ending the
/// process, and otherwise keeps it from doing so.
void endWatch();

/// Installs signal handlers: a crash of VTK's readers then ends the program with a message that
/// names the file, and exit code 1. Other crashes are not affected.
void reportReaderCrashes();

} // namespace tipp

#endif
