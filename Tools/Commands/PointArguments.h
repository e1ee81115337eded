// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointArguments_h
#define tippPointArguments_h

#include "Files/Formats.h"
#include "OutOfCore/OutOfCoreOptions.h"
#include "Points/Longitudes.h"
#include "Points/ReadPoints.h"
#include "Triangulation/ResolveDuplicates.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// Adds a subcommand to `app`. `addOptions` adds its options, which fill the arguments; `run`
/// carries it out and returns the exit code. See Commands.h.
template <typename Arguments>
void addCommand(CLI::App& app, int& exitCode, const std::string& name,
  const std::string& description, const std::string& footer,
  void (*addOptions)(CLI::App&, Arguments&), int (*run)(Arguments&))
{
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* const command = app.add_subcommand(name, description);
  addOptions(*command, *arguments);
  command->footer(footer);
  command->callback([arguments, run, &exitCode]() { exitCode = run(*arguments); });
}

/// The options of commands that triangulate points.
struct RunArguments
{
  std::vector<std::string> Inputs;
  std::string Output;
  PointOptions Columns;
  std::string Statistics; ///< path of a file; empty: none
  // For a run out of core:
  std::string Memory; ///< empty: not given
  bool Resume = false;
  std::string Scratch;

  Opener OutputIs = Opener::None; ///< the format of Output, set before the options are checked

  /// Returns whether the output is a partitioned mesh, which is computed out of core.
  bool makesPieces() const { return this->OutputIs == Opener::Pieces; }
  /// Sets the memory limit, if it is given, and the options Resume and Scratch.
  void setOptions(OutOfCoreRunOptions& options) const;
  /// Throws CLI::ValidationError if an option is given that needs makesPieces().
  void refuseMisplaced() const;
};

/// Adds the arguments for the files of points and the output, and the options of RunArguments.
/// `uses`: what the output is (Files/Formats.h). `condition` begins the help of options for runs
/// out of core.
void addRunOptions(CLI::App& command, RunArguments& arguments, const std::string& outputHelp,
  unsigned uses, const std::string& memoryHelp, const std::string& condition);

/// Adds the flags for the arrays that a mesh has on request. `duplicatesIn` and `neighborsIn` say
/// which outputs can hold them, such as " to .vtp or .vtu"; `cell` is what the mesh consists of.
void addArrayFlags(CLI::App& command, bool& mapDuplicates, bool& neighbors,
  const std::string& duplicatesIn, const std::string& neighborsIn, const std::string& cell);

/// Adds the option --output, whose format must have one of the `uses` (Files/Formats.h).
void addOutput(CLI::App& command, std::string& output, const std::string& help, unsigned uses);

/// Returns a paragraph of a footer in lines of at most 88 characters: after `title`, which begins
/// the first one, all are indented by eight blanks.
std::string paragraph(const std::string& title, const std::string& text);

/// Adds the options that select the points and columns to read.
void addPointOptions(CLI::App& command, PointOptions& options);

/// Adds an option of four numbers, xmin xmax ymin ymax. A box without area is refused.
CLI::Option* addBoxOption(CLI::App& command, const std::string& name, std::optional<Box2>& box,
  const std::string& description);

/// Adds --bounds, which limits the points that are read.
void addBoundsOption(CLI::App& command, PointOptions& options);

/// Throws IOError if none of the files' points is within --bounds, `points` being the number of
/// those that are, or if requireSensible() refuses them. `figures` are those after reading.
void requireInBounds(const std::vector<std::string>& files, const PointOptions& options,
  std::int64_t points, const ReadFigures& figures);

/// The same before points are read, as far as the headers of LAS files tell.
void requireInBounds(
  const std::vector<std::string>& files, const PointOptions& options, const ReadFigures& figures);

/// Adds the option --duplicates, which selects the values of points with equal coordinates.
void addDuplicatesOption(CLI::App& command, DuplicateRule& rule);

/// Adds an option whose value `check` validates. --help shows its default.
template <typename Value, typename Check>
void addChecked(CLI::App& command, const std::string& name, Value& value, const Check& check,
  const std::string& help)
{
  command.add_option(name, value, help)->check(check)->capture_default_str();
}

/// Adds the option --curve-tolerance, for commands that read lines or polygons of a GIS.
void addCurveOption(CLI::App& command);

/// Adds the option --threads.
void addThreadsOption(CLI::App& command, int& threads);

/// Returns Columns with a temporary file for thinning, for runs with a memory limit: in the folder
/// Scratch, or beside the output if that is empty.
PointOptions withThinningFile(const RunArguments& arguments);

/// Prints to stderr how many points of LAS files were not selected, and how many were removed by
/// thinning.
void reportLeftOut(std::int64_t points, std::int64_t thinnedOut);

/// Prints to stderr how much of LAS and LAZ files was not read, if something was not.
void reportRead(const ReadFigures& figures);

/// Prints a warning if points lie on both sides of the meridian at which longitudes jump.
void warnOfLongitudes(const LongitudeSpan& span);

/// Prints which columns of tables have been read, to stdout, unless they are called x, y and z, and
/// warnings about their values, to stderr.
void reportTables(const std::vector<TableReport>& reports);

/// Parses a number of bytes, which may have the unit K, M, G or T for 2^10, 2^20, 2^30 or 2^40
/// bytes, such as "512M", "1 GB" or "2 GiB": in any case, also with B or iB, and with blanks before
/// it. Returns nullopt for other text and for 0.
std::optional<std::uint64_t> parseMemorySize(const std::string& text);

/// Validates a memory size on the command line: returns an error message, or an empty text.
std::string checkMemorySize(const std::string& text);

/// Validates the memory limit of a run out of core: returns an error message, or an empty text.
std::string checkRunMemory(const std::string& text);

/// Validates a finite number above 0 on the command line: returns an error message, or an empty
/// text.
std::string checkPositive(const std::string& text);

/// Throws CLI::ValidationError if an option does not suit the others; `problem` follows its name.
void refuseIf(bool isMisplaced, const std::string& option, const std::string& problem);

} // namespace tipp

#endif
