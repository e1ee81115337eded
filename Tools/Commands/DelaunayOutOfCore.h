// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDelaunayOutOfCore_h
#define tippDelaunayOutOfCore_h

#include "Commands/DelaunayArguments.h"

#include <string>

class vtkMultiProcessController;

namespace tipp
{

/// Whether the output is a partitioned mesh, which is computed out of core.
bool isOutOfCore(const DelaunayArguments& arguments);

/// Runs `tipp delaunay` with such an output on the ranks of a controller, or on this process alone
/// (null). Returns the exit code, the same on all ranks.
int runDelaunayOutOfCore(const DelaunayArguments& arguments, vtkMultiProcessController* controller);

/// Returns the given options that are valid only for such an output, if the output is another one;
/// empty if there are none.
std::string misplacedOutOfCoreOption(const DelaunayArguments& arguments);

} // namespace tipp

#endif
