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

/// Adds the options that select the points and columns to read.
void addPointOptions(CLI::App& command, PointOptions& options);

/// Adds the option --duplicates, which selects the values of points with equal coordinates.
void addDuplicatesOption(CLI::App& command, DuplicateRule& rule);

/// Adds the option --threads.
void addThreadsOption(CLI::App& command, int& threads);

/// Adds the options --resume and --scratch. `condition` begins their help text: it says to which
/// runs they apply.
void addResumeOptions(
  CLI::App& command, const std::string& condition, bool& resume, std::string& scratch);

/// Sets a temporary file for thinning, for runs with a memory limit: in the folder `scratch`, or
/// beside the output if that is empty.
void setThinningFile(PointOptions& options, const std::string& scratch, const std::string& output);

/// Prints to stderr how many points of LAS files were not selected, and how many were removed by
/// thinning.
void reportLeftOut(std::int64_t points, std::int64_t thinnedOut);

/// Returns text about duplicates for a summary, such as "3 duplicates, 1 location with different
/// elevations".
std::string describeDuplicates(std::int64_t duplicates, std::int64_t disagreeing);

/// Parses a number of bytes, which may have the suffix K, M or G for 2^10, 2^20 or 2^30 bytes, such
/// as "512M". Returns nullopt for other text and for 0.
std::optional<std::uint64_t> parseMemorySize(const std::string& text);

/// Validates a memory size on the command line: returns an error message, or an empty text.
std::string checkMemorySize(const std::string& text);

/// Validates a finite number above 0, likewise.
std::string checkPositive(const std::string& text);

/// Throws CLI::ValidationError if an option does not suit the others; `problem` follows its name.
void refuseIf(bool isMisplaced, const std::string& option, const std::string& problem);

} // namespace tipp

#endif
