// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDelaunayOutOfCore_h
#define tippDelaunayOutOfCore_h

#include "Commands/DelaunayArguments.h"

#include <string>

class vtkMultiProcessController;

namespace tipp
{

/// Whether the output is a partitioned mesh, which is made out of core.
bool isOutOfCore(const DelaunayArguments& arguments);

/// `tipp delaunay` with such an output on the ranks of a controller, or on this process alone
/// (null); the exit code, the same on all ranks.
int runDelaunayOutOfCore(const DelaunayArguments& arguments, vtkMultiProcessController* controller);

/// The options that only such an output has, but that were given with another; empty if none.
std::string misplacedOutOfCoreOption(const DelaunayArguments& arguments);

} // namespace tipp

#endif
