// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointArguments_h
#define tippPointArguments_h

#include "Duplicates/ResolveDuplicates.h"
#include "Points/ReadPoints.h"

#include <cstdint>
#include <optional>
#include <string>

namespace CLI
{
class App;
}

namespace tipp
{

/// Adds the options that tell which points and columns of files are read.
void addPointOptions(CLI::App& command, PointOptions& options);

/// Adds the option that tells whose values coincident points get.
void addDuplicatesOption(CLI::App& command, DuplicateRule& rule);

/// Adds the option --threads.
void addThreadsOption(CLI::App& command, int& threads);

/// For a run in bounded memory: thinning keeps its squares in a temporary file, in the folder
/// `scratch` or, if that is empty, beside the output.
void setThinningFile(PointOptions& options, const std::string& scratch, const std::string& output);

/// Tells on the standard error stream how many points of LAS files were not selected, and how many
/// thinning has left out.
void reportLeftOut(std::int64_t points, std::int64_t thinnedOut);

/// What a summary says of duplicates, as "3 duplicates, 1 location with different elevations".
std::string describeDuplicates(std::int64_t duplicates, std::int64_t disagreeing);

/// Parses a number of bytes, or with the suffix K, M, G of 2^10, 2^20, 2^30 bytes, such as "512M";
/// nullopt for any other text and for 0.
std::optional<std::uint64_t> parseMemorySize(const std::string& text);

/// A validator for the command line: returns an error message, or an empty string.
std::string checkMemorySize(const std::string& text);

} // namespace tipp

#endif
