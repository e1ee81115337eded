// SPDX-License-Identifier: BSD-3-Clause
#include "Duplicates/ResolveDuplicates.h"

#include "Files/IOError.h"
#include "Points/ElevationColumn.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace tipp
{
namespace
{

/// The points of one place, the representative first.
using Place = std::vector<std::int64_t>;

bool disagrees(const Place& place, const ValueColumn& column)
{
  const double first = column[place.front()];
  return std::any_of(place.begin(), place.end(),
    [&](std::int64_t point)
    {
      const double value = column[point];
      return !(value == first || (std::isnan(value) && std::isnan(first)));
    });
}

bool disagrees(const Place& place, const std::vector<ValueColumn>& columns, std::size_t elevation)
{
  return elevation < columns.size()
    ? disagrees(place, columns[elevation])
    : std::any_of(columns.begin(), columns.end(),
        [&](const ValueColumn& column) { return disagrees(place, column); });
}

/// The first of those with the least value times `sign`; NaN comes after all numbers.
std::int64_t findLeast(const Place& place, const ValueColumn& column, double sign)
{
  const auto valueOf = [&](std::int64_t point)
  {
    const double value = sign * column[point];
    return std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
  };
  return *std::min_element(place.begin(), place.end(),
    [&](std::int64_t a, std::int64_t b) { return valueOf(a) < valueOf(b); });
}

double meanOf(const Place& place, const ValueColumn& column)
{
  double sum = 0;
  std::int64_t count = 0;
  for (const std::int64_t point : place)
  {
    const double value = column[point];
    sum += std::isnan(value) ? 0 : value;
    count += std::isnan(value) ? 0 : 1;
  }
  return sum / double(count); // NaN if there is none
}

void resolve(const Place& place, const std::vector<ValueColumn>& columns, std::size_t elevation,
  DuplicateRule rule)
{
  if (rule == DuplicateRule::First)
  {
    return;
  }
  const std::int64_t chosen = rule == DuplicateRule::Mean
    ? place.front()
    : findLeast(place, columns[elevation], rule == DuplicateRule::Lowest ? 1 : -1);
  for (const ValueColumn& column : columns)
  {
    column[place.front()] =
      rule == DuplicateRule::Mean ? meanOf(place, column) : double(column[chosen]);
  }
}

} // namespace

void requireElevation(DuplicateRule rule, const std::vector<std::string>& columns)
{
  const bool isNeeded = rule == DuplicateRule::Lowest || rule == DuplicateRule::Highest;
  if (isNeeded && findElevation(columns) == columns.size())
  {
    throw IOError("The points have no column z or elevation, by which to choose the lowest or "
                  "highest of a place; use 'first' or 'mean'.");
  }
}

std::int64_t resolveDuplicates(std::vector<Duplicate> duplicates,
  const std::vector<ValueColumn>& columns, std::size_t elevation, DuplicateRule rule)
{
  std::sort(duplicates.begin(), duplicates.end(),
    [](const Duplicate& a, const Duplicate& b)
    { return std::tie(a.Representative, a.Point) < std::tie(b.Representative, b.Point); });
  std::int64_t disagreeing = 0;
  Place place;
  for (std::size_t i = 0; i < duplicates.size();)
  {
    const std::int64_t representative = duplicates[i].Representative;
    place.assign(1, representative);
    for (; i < duplicates.size() && duplicates[i].Representative == representative; ++i)
    {
      place.push_back(duplicates[i].Point);
    }
    disagreeing += disagrees(place, columns, elevation) ? 1 : 0;
    resolve(place, columns, elevation, rule);
  }
  return disagreeing;
}

std::int64_t resolveDuplicates(
  PointTable& points, std::vector<Duplicate> duplicates, DuplicateRule rule)
{
  std::vector<ValueColumn> columns;
  std::vector<std::string> names;
  for (PointTable::Column& column : points.Columns)
  {
    columns.push_back({ column.Values.data(), 1 });
    names.push_back(column.Name);
  }
  return resolveDuplicates(std::move(duplicates), columns, findElevation(names), rule);
}

} // namespace tipp
