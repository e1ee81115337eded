// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRunTipp_h
#define tippRunTipp_h

#include "TemporaryFolder.h"

#include <csignal>
#include <functional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace tipp
{
namespace test
{

struct Outcome
{
  int ExitCode; ///< or minus the number of the signal that ended the process
  std::string Out;
  std::string Err;
};

/// Runs the command-line tool as a process in a folder.
class TippProcess
{
public:
  /// `terminal` is a file descriptor for stderr; -1 writes stderr to a file.
  TippProcess(
    const TemporaryFolder& folder, const std::vector<std::string>& arguments, int terminal = -1);

  void interrupt() const { this->signal(SIGINT); }
  void kill() const { this->signal(SIGKILL); }
  void signal(int number) const;
  bool hasEnded() const;
  Outcome wait() const;
  /// Waits until the condition holds or the process has ended.
  void waitUntil(const std::function<bool()>& condition) const;
  /// Waits for the end, but kills the process after a time limit that is far longer than any test.
  Outcome waitOrKill() const;
  /// Waits for the end, and returns only the exit code.
  int exitCode() const;

private:
  const TemporaryFolder& Folder;
  pid_t Process;
};

Outcome runTipp(const TemporaryFolder& folder, const std::vector<std::string>& arguments);

/// As runTipp(), with a terminal for stderr.
Outcome runTippOnTerminal(const TemporaryFolder& folder, const std::vector<std::string>& arguments);

} // namespace test
} // namespace tipp

#endif
