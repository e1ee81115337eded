// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/PointArguments.h"

#include "Files/IOError.h"
#include "Files/TemporaryPaths.h"
#include "Files/TextFile.h"
#include "Gis/GisFiles.h"
#include "Predicates/SensibleRange.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <sstream>
#include <stdexcept>

namespace tipp
{

std::optional<std::uint64_t> parseMemorySize(const std::string& text)
{
  static const std::map<std::string, unsigned> shifts{ { "", 0 }, { "b", 0 }, { "k", 10 },
    { "kb", 10 }, { "kib", 10 }, { "m", 20 }, { "mb", 20 }, { "mib", 20 }, { "g", 30 },
    { "gb", 30 }, { "gib", 30 }, { "t", 40 }, { "tb", 40 }, { "tib", 40 } };
  const std::size_t end = std::min(text.find_first_not_of("0123456789"), text.size());
  std::string unit = text.substr(std::min(text.find_first_not_of(' ', end), text.size()));
  std::transform(unit.begin(), unit.end(), unit.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto known = shifts.find(unit);
  const auto number = wholeNumber<std::uint64_t>(text.substr(0, end));
  return known != shifts.end() && number && *number > 0 &&
      *number <= (~std::uint64_t(0) >> known->second)
    ? std::make_optional(*number << known->second)
    : std::nullopt;
}

std::string checkPositive(const std::string& text)
{
  const auto value = wholeNumber<double>(text);
  return value && *value > 0 && std::isfinite(*value) ? ""
                                                      : "'" + text + "' is not a number above 0";
}

std::string checkMemorySize(const std::string& text)
{
  return parseMemorySize(text) ? "" : "'" + text + "' is not a number of bytes, such as 512M or 2G";
}

std::string checkRunMemory(const std::string& text)
{
  // The smallest buffers for reading points, and the smallest pieces, take about as much.
  constexpr std::uint64_t least = std::uint64_t(1) << 20;
  const std::string problem = checkMemorySize(text);
  return !problem.empty() || *parseMemorySize(text) >= least
    ? problem
    : "'" + text + "' is too little: give 1M or more";
}

namespace
{

std::string checkClass(const std::string& text)
{
  return LasSelection::parseClass(text)
    ? ""
    : "'" + text + "' is not a class; give numbers from 0 to 255, such as 2,9";
}

std::string checkNumber(const std::string& text)
{
  return wholeNumber<double>(text) ? "" : "'" + text + "' is not a number";
}

/// Parses CELL:RULE; nullopt for other text.
std::optional<Thinning> parseThinning(const std::string& text)
{
  const std::map<std::string, Thinning::Rule> rules = { { "min", Thinning::Rule::Lowest },
    { "max", Thinning::Rule::Highest }, { "nearest", Thinning::Rule::Nearest } };
  Thinning thinning;
  const char* const end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, thinning.Cell);
  if (parsed.ec != std::errc() || parsed.ptr == end || *parsed.ptr != ':' || !(thinning.Cell > 0) ||
    !std::isfinite(thinning.Cell))
  {
    return std::nullopt;
  }
  const auto rule = rules.find(std::string(parsed.ptr + 1, end));
  if (rule == rules.end())
  {
    return std::nullopt;
  }
  thinning.Keep = rule->second;
  return thinning;
}

std::string checkThinning(const std::string& text)
{
  return parseThinning(text)
    ? ""
    : "'" + text + "' is not the side of a square and min, max or nearest, such as 0.5:min";
}

} // namespace

void addPointOptions(CLI::App& command, PointOptions& options)
{
  command.add_option("--x", options.X, "Column of x: a name, or a number counted from 0");
  command.add_option("--y", options.Y, "Column of y: a name, or a number counted from 0");
  command.add_option("--z", options.Z, "Column of z: a name, or a number counted from 0");
  command.add_option("--layer", options.Layer,
    "Read only the points of this layer of a .gpkg, .kml or .dxf file (default: all layers)");
  command.add_option("--crs", options.Crs,
    "The coordinate reference system of the points, such as EPSG:25832 (default: that of the "
    "files)");
  command
    .add_option("--wrap", options.Wrap,
      "x are longitudes in degrees: 360: move those below 0 by 360, as for points on both sides of "
      "180 degrees; 180: move those from 180 on by -360. Constraints are moved too")
    ->check(CLI::IsMember({ 180, 360 }));
  command
    .add_option_function<std::string>(
      "--input-nodata",
      [&options](const std::string& text) { options.NoData = wholeNumber<double>(text); },
      "The number that stands for a missing value in the columns besides x and y, such as -9999")
    ->check(checkNumber)
    ->allow_extra_args(false);
  command
    .add_option_function<std::vector<std::string>>(
      "--class",
      [&options](const std::vector<std::string>& numbers)
      {
        for (const std::string& number : numbers)
        {
          options.Las.Classes.push_back(std::stoi(number));
        }
      },
      "Read only points of these classes from LAS files, such as 2,9 (default: all)")
    ->delimiter(',')
    ->allow_extra_args(false)
    ->check(checkClass);
  command
    .add_option_function<std::string>(
      "--returns",
      [&options](const std::string& which)
      {
        options.Las.Kind = which == "first" ? LasSelection::Returns::First
          : which == "last"                 ? LasSelection::Returns::Last
                                            : LasSelection::Returns::All;
      },
      "Read the first, the last or all returns of a pulse from LAS files (default: all)")
    ->check(CLI::IsMember({ "first", "last", "all" }));
  command
    .add_option_function<std::vector<std::string>>(
      "--keep",
      [&options](const std::vector<std::string>& flags)
      {
        for (const std::string& flag : flags)
        {
          options.Las.keep(flag);
        }
      },
      "Also read points with these flags from LAS files: withheld, synthetic, overlap. truncated: "
      "read the points of a file that ends too early; uncounted: those beyond the number in its "
      "header")
    ->delimiter(',')
    ->allow_extra_args(false)
    ->check(CLI::IsMember({ "withheld", "synthetic", "overlap", "truncated", "uncounted" }));
  command
    .add_option("--spacing", options.Spacing,
      "Of COPC files, read only the levels that are needed for points about this far apart")
    ->check(checkPositive);
  command
    .add_option_function<std::string>(
      "--thin", [&options](const std::string& text) { options.Thin = *parseThinning(text); },
      "Keep one point in each square with this side, such as 0.5:min: the lowest (min), the "
      "highest (max), or the nearest to the middle (nearest)")
    ->check(checkThinning);
}

CLI::Option* addBoxOption(CLI::App& command, const std::string& name, std::optional<Box2>& box,
  const std::string& description)
{
  return command
    .add_option_function<std::vector<double>>(
      name,
      [name, &box](const std::vector<double>& bounds)
      {
        box = boxOfVtkBounds<2>(bounds.data());
        refuseIf(box->isEmpty(), name,
          "is " + inWords(inSpace(*box)) + ", which is no range; give xmin xmax ymin ymax");
      },
      description)
    ->expected(4);
}

void addBoundsOption(CLI::App& command, PointOptions& options)
{
  addBoxOption(command, "--bounds", options.Region,
    "Read only the points in this range: xmin xmax ymin ymax. Of LAS, LAZ and COPC files the parts "
    "outside of it are not read");
}

void requireInBounds(const std::vector<std::string>& files, const PointOptions& options,
  std::int64_t points, const ReadFigures& figures)
{
  if (!options.Region)
  {
    return;
  }
  if (points == 0)
  {
    const std::string bounds =
      figures.Bounds.isEmpty() ? "" : "; the points have " + inWords(inSpace(figures.Bounds));
    throw IOError(files.front(),
      (files.size() > 1 ? "and the other files have no point with " : "has no point with ") +
        inWords(inSpace(*options.Region)) + bounds +
        "; give --bounds in the order xmin xmax ymin ymax.");
  }
  try
  {
    requireSensible(inSpace(*options.Region), inSpace(figures.Bounds));
  }
  catch (const std::runtime_error& error)
  {
    throw IOError(files.front(), std::string("is not read: ") + error.what());
  }
}

void requireInBounds(
  const std::vector<std::string>& files, const PointOptions& options, const ReadFigures& figures)
{
  if (std::size_t(figures.Files) == files.size()) // all are LAS files
  {
    requireInBounds(files, options, figures.Points - figures.SkippedPoints, figures);
  }
}

void addDuplicatesOption(CLI::App& command, DuplicateRule& rule)
{
  const std::map<std::string, DuplicateRule> rules = { { "first", DuplicateRule::First },
    { "min", DuplicateRule::Lowest }, { "max", DuplicateRule::Highest },
    { "mean", DuplicateRule::Mean } };
  command
    .add_option_function<std::string>(
      "--duplicates", [&rule, rules](const std::string& name) { rule = rules.at(name); },
      "The values of points with equal coordinates: those of the first, of the lowest (min) or "
      "highest (max), or the mean of each column (default: first)")
    ->check(CLI::IsMember({ "first", "min", "max", "mean" }));
}

void addCurveOption(CLI::App& command)
{
  command
    .add_option_function<double>("--curve-tolerance", setCurveTolerance,
      "The largest distance between curves of GIS files and the segments that replace them, in "
      "their units (default: a segment for each 4 degrees of an arc)")
    ->check(checkPositive);
}

void addThreadsOption(CLI::App& command, int& threads)
{
  addChecked(command, "--threads", threads, CLI::Range(0, 4096),
    "Number of threads; 0: OMP_NUM_THREADS, or one for each processor that this process may use");
}

void addOutput(CLI::App& command, std::string& output, const std::string& help, unsigned uses)
{
  command.add_option("-o,--output", output, help)
    ->required()
    ->check(
      [uses](const std::string& path) {
        return formatOf(path, uses) ? "" : "'" + path + "' does not end in " + listFormats(uses);
      });
}

std::string paragraph(const std::string& title, const std::string& text)
{
  constexpr std::size_t width = 88;
  constexpr std::size_t indent = 8;
  std::string lines = title + std::string(indent - std::min(indent, title.size()), ' ');
  std::size_t used = lines.size();
  std::istringstream words(text);
  for (std::string word; words >> word;)
  {
    const bool isFirst = used == indent;
    if (!isFirst && used + 1 + word.size() > width)
    {
      lines += "\n" + std::string(indent, ' ');
      used = indent;
    }
    else if (!isFirst)
    {
      lines += ' ';
      ++used;
    }
    lines += word;
    used += word.size();
  }
  return lines + '\n';
}

void addRunOptions(CLI::App& command, RunArguments& arguments, const std::string& outputHelp,
  unsigned uses, const std::string& memoryHelp, const std::string& condition)
{
  command.add_option("input", arguments.Inputs, "The points, of one or more files")->required();
  addOutput(command, arguments.Output, outputHelp, uses);
  command.add_option("--stats", arguments.Statistics, "A JSON file for figures of the run");
  command.add_option("--memory", arguments.Memory, memoryHelp)->check(checkRunMemory);
  command.add_flag("--resume", arguments.Resume,
    condition + ": resume a run that was killed, interrupted or failed");
  command.add_option("--scratch", arguments.Scratch,
    condition + ": a folder for temporary files (default: that of the output)");
  addPointOptions(command, arguments.Columns);
}

void addArrayFlags(CLI::App& command, bool& mapDuplicates, bool& neighbors,
  const std::string& duplicatesIn, const std::string& neighborsIn, const std::string& cell)
{
  command.add_flag("--map-duplicates", mapDuplicates,
    "Add the point array RepresentativePointId" + duplicatesIn +
      ": for each point the id of the vertex with its coordinates, -1 if it is not finite");
  command.add_flag("--neighbors", neighbors,
    "Add the cell array NeighborIds" + neighborsIn + ": for each corner the id of the " + cell +
      " opposite to it, -1 at the hull");
}

void RunArguments::setOptions(OutOfCoreRunOptions& options) const
{
  if (!this->Memory.empty())
  {
    options.MemoryLimit = *parseMemorySize(this->Memory);
  }
  options.Resume = this->Resume;
  options.Scratch = this->Scratch;
}

void RunArguments::refuseMisplaced() const
{
  const std::string option = !this->Memory.empty() ? "--memory"
    : this->Resume                                 ? "--resume"
    : !this->Scratch.empty()                       ? "--scratch"
                                                   : "";
  refuseIf(!option.empty() && !this->makesPieces(), option, "needs an output named .tipp");
}

PointOptions withThinningFile(const RunArguments& arguments)
{
  namespace fs = std::filesystem;
  const fs::path path(arguments.Output);
  const fs::path folder =
    arguments.Scratch.empty() ? path.parent_path() : fs::path(arguments.Scratch);
  PointOptions options = arguments.Columns;
  options.Thin.File = (folder / ("." + path.filename().string() + ".squares")).string();
  return options;
}

void reportLeftOut(std::int64_t points, std::int64_t thinnedOut)
{
  if (points > 0)
  {
    fmt::print(stderr,
      "tipp: {} points of LAS files are not used: they have other classes or returns, or are "
      "flagged as withheld, synthetic or overlap.\n",
      points);
  }
  if (thinnedOut > 0)
  {
    fmt::print(stderr, "tipp: {} points are left out by thinning.\n", thinnedOut);
  }
}

void reportRead(const ReadFigures& figures)
{
  if (figures.SkippedPoints == 0)
  {
    return;
  }
  std::string skipped;
  if (figures.SkippedFiles > 0)
  {
    skipped += fmt::format(", {} of {} files", figures.SkippedFiles, figures.Files);
  }
  if (figures.SkippedChunks > 0)
  {
    skipped += fmt::format(", {} of {} chunks", figures.SkippedChunks, figures.Chunks);
  }
  fmt::print(stderr, "tipp: not read, because not needed: {} of {} points{}.\n",
    figures.SkippedPoints, figures.Points, skipped);
}

void warnOfLongitudes(const LongitudeSpan& span)
{
  const std::string warning = span.warning();
  if (!warning.empty())
  {
    fmt::print(stderr, "tipp: warning: {}\n", warning);
  }
}

void reportTables(const std::vector<TableReport>& reports)
{
  constexpr std::size_t mostWarnings = 10;
  std::size_t warnings = 0;
  for (const TableReport& report : reports)
  {
    const bool isNew = &report == &reports.front() || report.Columns != reports.front().Columns;
    if (isNew && !report.IsObvious && !report.Columns.empty())
    {
      fmt::print("{}: {}\n", shownPath(report.Path), report.Columns);
    }
    for (const std::string& warning : report.Warnings)
    {
      if (warnings++ < mostWarnings)
      {
        fmt::print(stderr, "tipp: warning: {}: {}\n", shownPath(report.Path), warning);
      }
    }
  }
  if (warnings > mostWarnings)
  {
    fmt::print(stderr,
      "tipp: warning: {} more such warnings; 'tipp info' on each file shows them.\n",
      warnings - mostWarnings);
  }
}

void refuseIf(bool isMisplaced, const std::string& option, const std::string& problem)
{
  if (isMisplaced)
  {
    throw CLI::ValidationError(option, problem);
  }
}

} // namespace tipp
