// SPDX-License-Identifier: BSD-3-Clause
#include "Series/NetcdfTime.h"

#include "Files/TextFile.h"
#include "Series/CheckTimes.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>

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
