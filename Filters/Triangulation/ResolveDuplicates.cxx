// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/ResolveDuplicates.h"

#include "Files/IOError.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace tipp
{
namespace
{

/// Coincident points, the representative first.
using Group = std::vector<std::int64_t>;

bool disagrees(const Group& group, const ValueColumn& column)
{
  const double first = column[group.front()];
  return std::any_of(group.begin(), group.end(),
    [&](std::int64_t point)
    {
      const double value = column[point];
      return !(value == first || (std::isnan(value) && std::isnan(first)));
    });
}

bool disagrees(const Group& group, const std::vector<ValueColumn>& columns, std::size_t elevation)
{
  return elevation < columns.size()
    ? disagrees(group, columns[elevation])
    : std::any_of(columns.begin(), columns.end(),
        [&](const ValueColumn& column) { return disagrees(group, column); });
}

/// Returns the first point with the least value times `sign`; values that are not finite compare
/// greater than all others.
std::int64_t findLeast(const Group& group, const ValueColumn& column, double sign)
{
  const auto valueOf = [&](std::int64_t point)
  {
    const double value = sign * column[point];
    return std::isfinite(value) ? value : std::numeric_limits<double>::infinity();
  };
  return *std::min_element(group.begin(), group.end(),
    [&](std::int64_t a, std::int64_t b) { return valueOf(a) < valueOf(b); });
}

double meanOf(const Group& group, const ValueColumn& column)
{
  double sum = 0;
  std::int64_t count = 0;
  for (const std::int64_t point : group)
  {
    const double value = column[point];
    sum += std::isfinite(value) ? value : 0;
    count += std::isfinite(value) ? 1 : 0;
  }
  return sum / double(count); // NaN if there is none
}

void resolve(const Group& group, const std::vector<ValueColumn>& columns, std::size_t elevation,
  DuplicateRule rule)
{
  if (rule == DuplicateRule::First)
  {
    return;
  }
  const std::int64_t chosen = rule == DuplicateRule::Mean
    ? group.front()
    : findLeast(group, columns[elevation], rule == DuplicateRule::Lowest ? 1 : -1);
  for (const ValueColumn& column : columns)
  {
    column[group.front()] =
      rule == DuplicateRule::Mean ? meanOf(group, column) : double(column[chosen]);
  }
}

} // namespace

void requireElevation(DuplicateRule rule, const std::vector<std::string>& columns)
{
  const bool isNeeded = rule == DuplicateRule::Lowest || rule == DuplicateRule::Highest;
  if (isNeeded && findRankColumn(columns) == columns.size())
  {
    throw IOError("The points have no column z, elevation or depth, nor a single other one, by "
                  "which to choose the lowest or highest of coincident points; use 'first' or "
                  "'mean'.");
  }
}

std::int64_t resolveDuplicates(std::vector<Duplicate> duplicates,
  const std::vector<ValueColumn>& columns, std::size_t elevation, DuplicateRule rule)
{
  std::sort(duplicates.begin(), duplicates.end(),
    [](const Duplicate& a, const Duplicate& b)
    { return std::tie(a.Representative, a.Point) < std::tie(b.Representative, b.Point); });
  std::int64_t disagreeing = 0;
  Group group;
  for (std::size_t i = 0; i < duplicates.size();)
  {
    const std::int64_t representative = duplicates[i].Representative;
    group.assign(1, representative);
    for (; i < duplicates.size() && duplicates[i].Representative == representative; ++i)
    {
      group.push_back(duplicates[i].Point);
    }
    disagreeing += disagrees(group, columns, elevation) ? 1 : 0;
    resolve(group, columns, elevation, rule);
  }
  return disagreeing;
}

std::int64_t resolveDuplicates(
  PointTable& points, std::vector<Duplicate> duplicates, DuplicateRule rule)
{
  std::vector<ValueColumn> columns;
  for (PointTable::Column& column : points.Columns)
  {
    columns.push_back({ column.Values.data(), 1 });
  }
  return resolveDuplicates(std::move(duplicates), columns, findRankColumn(points.names()), rule);
}

} // namespace tipp
