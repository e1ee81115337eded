// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDelaunayOutOfCore_h
#define tippDelaunayOutOfCore_h

#include "Commands/DelaunayArguments.h"

#include <string>

namespace tipp
{

/// Whether the output is a partitioned mesh, which is made out of core.
bool isOutOfCore(const DelaunayArguments& arguments);

/// `tipp delaunay` with such an output; the exit code.
int runDelaunayOutOfCore(const DelaunayArguments& arguments);

/// The options that only such an output has, but that were given with another; empty if none.
std::string misplacedOutOfCoreOption(const DelaunayArguments& arguments);

} // namespace tipp

#endif
