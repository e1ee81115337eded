// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/PointArguments.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <string>
#include <vector>

namespace tipp
{
namespace
{

std::string checkClass(const std::string& text)
{
  int number = -1;
  const char* const end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, number);
  return parsed.ec == std::errc() && parsed.ptr == end && number >= 0 && number <= 255
    ? ""
    : "'" + text + "' is not a class; give numbers from 0 to 255, as 2,9";
}

} // namespace

void addPointOptions(CLI::App& command, PointOptions& options)
{
  command.add_option("--x", options.X, "Column of x: a name, or a number from 0");
  command.add_option("--y", options.Y, "Column of y: a name, or a number from 0");
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
      "Of LAS files the points of these classes, as 2,9; without: all")
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
      "Of LAS files the first, the last or all returns of a pulse; without: all")
    ->check(CLI::IsMember({ "first", "last", "all" }));
  command
    .add_option_function<std::vector<std::string>>(
      "--keep",
      [&options](const std::vector<std::string>& flags)
      {
        for (const std::string& flag : flags)
        {
          options.Las.KeepWithheld = options.Las.KeepWithheld || flag == "withheld";
          options.Las.KeepSynthetic = options.Las.KeepSynthetic || flag == "synthetic";
          options.Las.KeepOverlap = options.Las.KeepOverlap || flag == "overlap";
        }
      },
      "Of LAS files also points with these flags: withheld, synthetic, overlap")
    ->delimiter(',')
    ->allow_extra_args(false)
    ->check(CLI::IsMember({ "withheld", "synthetic", "overlap" }));
}

void reportLeftOut(std::int64_t points)
{
  if (points > 0)
  {
    fmt::print(stderr,
      "tipp: {} points of LAS files are not used: of other classes or returns, or flagged as "
      "withheld, synthetic or overlap.\n",
      points);
  }
}

} // namespace tipp
