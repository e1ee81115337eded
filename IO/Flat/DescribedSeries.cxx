// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/DescribedSeries.h"

#include "Series/VariableNames.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tipp
{

void describeTimes(MeshSeries& series, const MeshDescription& description)
{
  series.TimeUnits = description.TimeUnits;
  series.Calendar = description.Calendar;
  series.Crs = description.Crs;
}

void addVariables(
  MeshSeries& series, const DescribedArray& array, const MeshDescription& description)
{
  const ArrayDescription described = description.arrayOf(array.Name, array.OnCells);
  for (int i = 0; i < array.Components; ++i)
  {
    SeriesVariable variable;
    variable.Name = freeName(series.Variables, described.nameOf(array.Name, i, array.Components));
    variable.LongName = described.LongName;
    variable.StandardName = described.StandardName;
    variable.Units = described.Units;
    variable.Type = array.Type;
    variable.OnCells = array.OnCells;
    variable.Varies = array.Varies;
    variable.Mark = described.Missing.value_or(variable.Mark);
    series.Variables.push_back(std::move(variable));
  }
}

void removeMarks(const SeriesVariable& variable, std::vector<double>& values)
{
  if (!std::isnan(variable.Mark))
  {
    std::replace(
      values.begin(), values.end(), variable.Mark, std::numeric_limits<double>::quiet_NaN());
  }
}

} // namespace tipp
