// SPDX-License-Identifier: BSD-3-Clause
#include "Series/NetcdfTime.h"

#include "Files/IOError.h"
#include "Files/TextFile.h"
#include "Series/CheckTimes.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <numeric>
#include <optional>
#include <utility>

namespace tipp
{
namespace
{

/// How surely a variable has the times; 0: it has not.
int timeRank(const NetcdfVariable& variable)
{
  if (variable.Dimensions.size() != 1 || !variable.Type)
  {
    return 0;
  }
  const bool hasOrigin = variable.text("units").find(" since ") != std::string::npos;
  const bool isNamed = lowerCase(variable.Name) == "time";
  return variable.text("standard_name") == "time" || variable.text("axis") == "T"
    ? (hasOrigin ? 5 : 4)
    : isNamed ? (hasOrigin ? 3 : 2)
              : (hasOrigin ? 1 : 0);
}

/// ADCIRC adds the name of a variable after an exclamation mark.
std::string unitsOf(const NetcdfVariable& variable)
{
  std::string units = variable.text("units");
  units.erase(std::min(units.find('!'), units.size()));
  units.erase(units.find_last_not_of(" \t\n\r") + 1);
  return units;
}

/// FVCOM's times are 32-bit floats, in which neighbouring steps may be equal; two variables of
/// integers have the exact ones, in days and milliseconds.
bool readFvcomTimes(NetcdfFile& file, NetcdfTime& time)
{
  const NetcdfVariable* const days = file.content().find("Itime");
  const NetcdfVariable* const milliseconds = file.content().find("Itime2");
  const std::vector<int> dimensions{ time.Dimension };
  if (!days || !milliseconds || days->Dimensions != dimensions ||
    milliseconds->Dimensions != dimensions || unitsOf(*days).find("days since ") != 0)
  {
    return false;
  }
  constexpr double perDay = 86400000;
  time.Values = file.read(*days);
  const std::vector<double> parts = file.read(*milliseconds);
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    time.Values[i] += parts[i] / perDay;
  }
  time.Units = unitsOf(*days);
  return true;
}

/// The days from a fixed one to a date from the year 0 on, by the Gregorian calendar, with or
/// without leap days (as in Hinnant, chrono-Compatible Low-Level Date Algorithms).
std::int64_t daysOf(std::int64_t year, std::int64_t month, std::int64_t day, bool hasLeapDays)
{
  constexpr std::int64_t period = 400; // years; it keeps the numerators below positive
  const std::int64_t y = period + (month <= 2 ? year - 1 : year);
  const std::int64_t dayOfYear = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  const std::int64_t leapDays = y / 4 - y / 100 + y / 400;
  return 365 * y + (hasLeapDays ? leapDays : 0) + dayOfYear;
}

int daysOfMonth(int year, int month, bool hasLeapDays)
{
  constexpr int february = 2;
  constexpr int july = 7;
  const bool isLeapYear = hasLeapDays && year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
  return month == february ? (isLeapYear ? 29 : 28) : 30 + (month + (month > july ? 1 : 0)) % 2;
}

/// Reads "2000-01-31_12:30:00" as seconds of its calendar; nothing if it is not so.
std::optional<double> secondsOf(const std::string& text, bool hasLeapDays)
{
  int year = 0;
  int month = 0;
  int day = 0;
  int hour = 0;
  int minute = 0;
  double second = 0;
  constexpr int parts = 6;
  if (std::sscanf(text.c_str(), "%5d-%2d-%2d%*1[_ T]%2d:%2d:%lf", &year, &month, &day, &hour,
        &minute, &second) != parts ||
    year < 0 || month < 1 || month > 12 || day < 1 || day > daysOfMonth(year, month, hasLeapDays) ||
    hour < 0 || hour > 24 || minute < 0 || minute > 59 || !(second >= 0 && second < 61))
  {
    return std::nullopt;
  }
  const std::int64_t days = daysOf(year, month, day, hasLeapDays);
  return double(days * 86400 + hour * 3600 + minute * 60) + second;
}

/// The times of MPAS: the text "xtime", a date a step. They become seconds since the first one.
bool readMpasTimes(NetcdfFile& file, NetcdfTime& time)
{
  const NetcdfContent& content = file.content();
  const NetcdfVariable* const dates = content.find("xtime");
  if (!dates || !dates->IsText || dates->Dimensions.size() != 2 ||
    content.size(dates->Dimensions[0]) == 0 || content.size(dates->Dimensions[1]) == 0)
  {
    return false;
  }
  std::string calendar;
  for (const NetcdfAttribute& attribute : content.Attributes)
  {
    calendar = attribute.Name == "config_calendar_type" ? attribute.Text : calendar;
  }
  const bool hasLeapDays = calendar.find("noleap") == std::string::npos;
  if (hasLeapDays && !calendar.empty() && calendar.find("gregorian") == std::string::npos)
  {
    throw IOError(file.path(),
      "has dates of the calendar '" + shownText(calendar) +
        "'; only those of gregorian and gregorian_noleap are read.");
  }
  const std::string text = file.readText(*dates);
  const auto length = std::size_t(content.size(dates->Dimensions[1]));
  std::vector<double> values;
  for (std::size_t at = 0; at + length <= text.size(); at += length)
  {
    const std::optional<double> value = secondsOf(text.substr(at, length), hasLeapDays);
    if (!value)
    {
      time.UnreadDate = text.substr(at, length);
      return false;
    }
    values.push_back(*value);
  }
  const double origin = values.front();
  std::transform(values.begin(), values.end(), values.begin(),
    [origin](double value) { return value - origin; });
  constexpr std::size_t dateLength = 19; // with a year of four digits
  std::string first = text.substr(0, text.find('-') + dateLength - 4);
  std::replace(first.begin(), first.end(), '_', ' ');
  time.Dimension = dates->Dimensions[0];
  time.Values = std::move(values);
  time.Units = "seconds since " + first;
  // The standard calendar of CF is Julian before 1582.
  time.Calendar = hasLeapDays ? "proleptic_gregorian" : "noleap";
  return true;
}

/// The dimension that is called time; -1 if there is none.
int dimensionOfTime(const NetcdfContent& content)
{
  for (std::size_t i = 0; i < content.Dimensions.size(); ++i)
  {
    const std::string name = lowerCase(content.Dimensions[i].Name);
    if (name == "time" || name == "times")
    {
      return int(i);
    }
  }
  return -1;
}

} // namespace

NetcdfTime readNetcdfTime(NetcdfFile& file)
{
  const NetcdfContent& content = file.content();
  const NetcdfVariable* best = nullptr;
  for (const NetcdfVariable& variable : content.Variables)
  {
    best = timeRank(variable) > (best ? timeRank(*best) : 0) ? &variable : best;
  }
  NetcdfTime time;
  if ((!best || unitsOf(*best).find(" since ") == std::string::npos) && readMpasTimes(file, time))
  {
    checkTimes(file.path(), time.Values);
    return time;
  }
  if (!best)
  {
    time.Dimension = dimensionOfTime(content);
    time.AreNumbers = time.Dimension >= 0;
    time.Values.resize(time.AreNumbers ? std::size_t(content.size(time.Dimension)) : 0);
    std::iota(time.Values.begin(), time.Values.end(), 0);
    return time;
  }
  time.Dimension = best->Dimensions[0];
  time.Calendar = best->text("calendar");
  if (!readFvcomTimes(file, time))
  {
    time.Values = file.read(*best);
    time.Units = unitsOf(*best);
  }
  checkTimes(file.path(), time.Values);
  return time;
}

} // namespace tipp
