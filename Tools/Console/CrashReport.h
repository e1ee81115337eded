// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCrashReport_h
#define tippCrashReport_h

namespace tipp
{

/// From now on a crash of VTK's readers ends the program with a message that names the file, and
/// exit code 1. Other crashes end it as they would without this.
void reportReaderCrashes();

} // namespace tipp

#endif
