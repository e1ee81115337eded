// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCrashReport_h
#define tippCrashReport_h

namespace tipp
{

/// Installs signal handlers: a crash of VTK's readers then ends the program with a message that
/// names the file, and exit code 1. Other crashes are not affected.
void reportReaderCrashes();

} // namespace tipp

#endif
