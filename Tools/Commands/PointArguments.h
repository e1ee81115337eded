// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointArguments_h
#define tippPointArguments_h

#include "Duplicates/ResolveDuplicates.h"
#include "Points/ReadPoints.h"

#include <cstdint>
#include <string>

namespace CLI
{
class App;
}

namespace tipp
{

/// Adds the options that tell which points and columns of files are read.
void addPointOptions(CLI::App& command, PointOptions& options);

/// Adds the option that tells which values a place of several points has.
void addDuplicatesOption(CLI::App& command, DuplicateRule& rule);

/// For a run in bounded memory: thinning keeps its squares in a temporary file, in the folder
/// `scratch` or, if that is empty, beside the output.
void setThinningFile(PointOptions& options, const std::string& scratch, const std::string& output);

/// Tells on the standard error stream how many points of LAS files were not selected, and how many
/// thinning has left out.
void reportLeftOut(std::int64_t points, std::int64_t thinnedOut);

/// What a summary says of duplicates, as "3 duplicates, 1 place with different elevations".
std::string describeDuplicates(std::int64_t duplicates, std::int64_t disagreeing);

} // namespace tipp

#endif
