// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointArguments_h
#define tippPointArguments_h

#include "Points/ReadPoints.h"

#include <cstdint>

namespace CLI
{
class App;
}

namespace tipp
{

/// Adds the options that tell which points and columns of files are read.
void addPointOptions(CLI::App& command, PointOptions& options);

/// Tells on the standard error stream how many points of LAS files were not selected.
void reportLeftOut(std::int64_t points);

} // namespace tipp

#endif
