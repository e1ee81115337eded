// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRunTool_h
#define tippRunTool_h

namespace tipp
{

/// Runs the command line tool with the arguments of main(), and returns the exit code. It prints
/// its messages, and changes the handlers of signals. Call it once in a process, on the main
/// thread.
int runTool(int argc, char** argv);

} // namespace tipp

#endif
