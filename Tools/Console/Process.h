// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippProcess_h
#define tippProcess_h

#include <string>

class vtkMultiProcessController;

namespace tipp
{

/// Exit codes of all commands. Usage errors are found while the command line is parsed.
enum ExitCode
{
  Success = 0,
  Failure = 1,
  Usage = 2,
  Undecided = 3 ///< of 'tipp check'
};

/// Returns the rank with which mpirun or a batch system started this process; -1 if it is not a
/// rank. Works before MPI is initialised.
int startedRank();

/// Returns whether this process is a rank other than the first. Such a rank has no work in commands
/// that run on the first rank only.
inline bool isIdleRank()
{
  return startedRank() > 0;
}

/// Initialises MPI for the object's lifetime if mpirun or a batch system started the process. In a
/// build without MPI, it throws std::runtime_error in this case.
class MpiSession
{
public:
  MpiSession();
  ~MpiSession();
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;

  /// Returns null for a process without MPI. Not owned by the caller.
  vtkMultiProcessController* controller() const;
  /// Returns whether this is the first rank, which prints messages.
  bool isFirst() const;
  /// Returns the number of ranks; 1 for a process without MPI.
  int ranks() const;

private:
  vtkMultiProcessController* Controller = nullptr;
};

/// The exit code that shells use for a program ended by Ctrl-C.
constexpr int interruptedExitCode = 130;

/// Makes Ctrl-C (SIGINT) set the flag that isInterrupted() returns. If the process still runs a
/// moment later, or after a second signal or SIGTERM, a separate thread removes the temporary
/// files, prints one sentence and ends the process. So commands need not check the flag often, or
/// at all. `rank` is the process's rank, or -1; only the first rank prints.
void watchForInterrupt(int rank);
/// Returns whether Ctrl-C has been pressed.
bool isInterrupted();
/// Prints that the command was interrupted, once and only on the first rank. Returns the exit code.
int reportInterrupt(const std::string& consequence = "nothing was written");
/// Prints the message of the exception being handled, only on the first rank. Returns the exit
/// code. With several ranks, call it before MPI_Finalize(): mpirun ends the first rank once another
/// rank has failed.
int reportFailure();
/// Call this before the process reports its outcome. From then on the thread does not end the
/// process; if it is already doing so, this function never returns.
void endWatch();

/// Prepares the process for VTK: its own messages are turned off, and a crash of its readers ends
/// the program with exit code 1 and a message that names the file. Does nothing without VTK.
void prepareVtk();

} // namespace tipp

#endif
