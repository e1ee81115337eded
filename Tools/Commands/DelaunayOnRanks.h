// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDelaunayOnRanks_h
#define tippDelaunayOnRanks_h

#include "Commands/DelaunayArguments.h"

class vtkMultiProcessController;

namespace tipp
{

/// Runs `tipp delaunay` on the ranks of a controller, or on this process alone (null). Every rank
/// reads its share of the points; the first one writes the output and prints messages. Returns the
/// exit code, the same on all ranks.
int runDelaunayOnRanks(const DelaunayArguments& arguments, vtkMultiProcessController* controller);

} // namespace tipp

#endif
