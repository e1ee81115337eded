// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDemOutOfCore_h
#define tippDemOutOfCore_h

#include "Commands/DemArguments.h"

class vtkMultiProcessController;

namespace tipp
{

/// `tipp dem` with a limit of memory, on the ranks of a controller or on this process alone (null).
/// Returns the exit code, the same on all ranks.
int runDemOutOfCore(
  const DemArguments& arguments, vtkMultiProcessController* controller, DemReport& report);

} // namespace tipp

#endif
