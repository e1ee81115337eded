// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointTable_h
#define tippPointTable_h

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <vector>

namespace tipp
{

/// Points read from a file: x and y interleaved, and the other numeric columns by name.
struct PointTable
{
  /// A named column of numbers.
  struct Column
  {
    std::string Name;
    std::vector<double> Values; ///< one per point
  };

  std::vector<double> XY; ///< x and y of each point, interleaved
  std::vector<Column> Columns;
  std::int64_t LeftOut = 0;    ///< points that the options rejected
  std::int64_t ThinnedOut = 0; ///< points that thinning removed
  std::string Crs;             ///< the coordinate reference system: see PointStream::crs()

  std::size_t size() const { return this->XY.size() / 2; }
  /// The names of Columns.
  std::vector<std::string> names() const
  {
    std::vector<std::string> names;
    std::transform(this->Columns.begin(), this->Columns.end(), std::back_inserter(names),
      [](const Column& column) { return column.Name; });
    return names;
  }
};

/// Returns the index of the elevation column, which is named z, Z or elevation; the number of
/// columns if there is none.
inline std::size_t findElevation(const std::vector<std::string>& columns)
{
  for (const char* const name : { "z", "Z", "elevation" })
  {
    const auto found = std::find(columns.begin(), columns.end(), name);
    if (found != columns.end())
    {
      return std::size_t(found - columns.begin());
    }
  }
  return columns.size();
}

/// Returns the index of the column that decides which points are lowest and highest: the elevation,
/// else the depth, else the only column. Returns the number of columns if there is none.
inline std::size_t findRankColumn(const std::vector<std::string>& columns)
{
  const std::size_t elevation = findElevation(columns);
  if (elevation < columns.size() || columns.size() == 1)
  {
    return elevation < columns.size() ? elevation : 0;
  }
  return std::size_t(std::find(columns.begin(), columns.end(), "depth") - columns.begin());
}

/// The number of values that are NaN or infinite.
inline std::int64_t countMissing(const std::vector<double>& values)
{
  return std::count_if(
    values.begin(), values.end(), [](double value) { return !std::isfinite(value); });
}

} // namespace tipp

#endif
