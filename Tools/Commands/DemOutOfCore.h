// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDemOutOfCore_h
#define tippDemOutOfCore_h

#include "Commands/DemArguments.h"

namespace tipp
{

/// `tipp dem` with a limit of memory. Returns the exit code.
int runDemOutOfCore(const DemArguments& arguments, DemReport& report);

} // namespace tipp

#endif
