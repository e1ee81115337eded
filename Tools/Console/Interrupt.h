// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInterrupt_h
#define tippInterrupt_h

namespace tipp
{

/// The shell's exit code of a program that Ctrl-C ended.
constexpr int interruptedExitCode = 130;

/// From now on the first Ctrl-C (SIGINT) only sets a flag; a second one ends the process.
void watchForInterrupt();
bool isInterrupted();
/// Tells the user that nothing was written, and returns the exit code.
int reportInterrupt();

} // namespace tipp

#endif
