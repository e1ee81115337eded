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
  int ExitCode; ///< or minus the signal that ended it
  std::string Out;
  std::string Err;
};

/// The command-line tool as a process of its own, in a folder of its own.
class TippProcess
{
public:
  /// `terminal` is a file descriptor for stderr, or -1 for a file.
  TippProcess(
    const TemporaryFolder& folder, const std::vector<std::string>& arguments, int terminal = -1);

  void interrupt() const { this->signal(SIGINT); }
  void kill() const { this->signal(SIGKILL); }
  void signal(int number) const;
  bool hasEnded() const;
  Outcome wait() const;
  /// Returns when the condition holds, or the process has ended.
  void waitUntil(const std::function<bool()>& condition) const;
  /// As wait(), but kills the process if it is still there after a time far longer than it should
  /// be.
  Outcome waitOrKill() const;
  /// The same without what it printed.
  int exitCode() const;

private:
  const TemporaryFolder& Folder;
  pid_t Process;
};

Outcome runTipp(const TemporaryFolder& folder, const std::vector<std::string>& arguments);

/// The same with a terminal for stderr.
Outcome runTippOnTerminal(const TemporaryFolder& folder, const std::vector<std::string>& arguments);

} // namespace test
} // namespace tipp

#endif
