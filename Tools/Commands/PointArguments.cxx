// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/PointArguments.h"

#include "Files/TextFile.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

std::optional<std::uint64_t> parseMemorySize(const std::string& text)
{
  std::uint64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  const std::string unit(stop, end);
  const std::size_t power = std::string("KMG").find(unit);
  const bool known = unit.empty() || (unit.size() == 1 && power != std::string::npos);
  if (error != std::errc() || !known || number == 0)
  {
    return std::nullopt;
  }
  const unsigned shift = unit.empty() ? 0 : 10 * (unsigned(power) + 1);
  return number <= (~std::uint64_t(0) >> shift) ? std::make_optional(number << shift)
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

namespace
{

std::string checkClass(const std::string& text)
{
  return LasSelection::parseClass(text)
    ? ""
    : "'" + text + "' is not a class; give numbers from 0 to 255, such as 2,9";
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
      "Also read points with these flags from LAS files: withheld, synthetic, overlap")
    ->delimiter(',')
    ->allow_extra_args(false)
    ->check(CLI::IsMember({ "withheld", "synthetic", "overlap" }));
  command
    .add_option_function<std::string>(
      "--thin", [&options](const std::string& text) { options.Thin = *parseThinning(text); },
      "Keep one point in each square with this side, such as 0.5:min: the lowest (min), the "
      "highest (max), or the nearest to the middle (nearest)")
    ->check(checkThinning);
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

void addThreadsOption(CLI::App& command, int& threads)
{
  command.add_option("--threads", threads, "Number of threads; 0: OpenMP's default")
    ->check(CLI::Range(0, 4096))
    ->capture_default_str();
}

void addResumeOptions(
  CLI::App& command, const std::string& condition, bool& resume, std::string& scratch)
{
  command.add_flag(
    "--resume", resume, condition + ": resume a run that was killed, interrupted or failed");
  command.add_option("--scratch", scratch,
    condition + ": a folder for temporary files (default: that of the output)");
}

void setThinningFile(PointOptions& options, const std::string& scratch, const std::string& output)
{
  namespace fs = std::filesystem;
  const fs::path path(output);
  const fs::path folder = scratch.empty() ? path.parent_path() : fs::path(scratch);
  options.Thin.File = (folder / ("." + path.filename().string() + ".squares")).string();
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

std::string describeDuplicates(std::int64_t duplicates, std::int64_t disagreeing)
{
  const std::string positions = disagreeing == 0
    ? ""
    : fmt::format(
        ", {} location{} with different elevations", disagreeing, disagreeing == 1 ? "" : "s");
  return fmt::format("{} duplicates{}", duplicates, positions);
}

void refuseIf(bool isMisplaced, const std::string& option, const std::string& problem)
{
  if (isMisplaced)
  {
    throw CLI::ValidationError(option, problem);
  }
}

} // namespace tipp
