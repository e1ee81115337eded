// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/SensibleRange.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <stdexcept>

namespace tipp
{
namespace
{

constexpr const char* axisNames[] = { "x", "y", "z" };

/// Returns the box without limits along the other axes.
Box3 along(const std::vector<int>& axes, const Box3& box)
{
  Box3 part{ { -HUGE_VAL, -HUGE_VAL, -HUGE_VAL }, { HUGE_VAL, HUGE_VAL, HUGE_VAL } };
  for (const int axis : axes)
  {
    part.Min[std::size_t(axis)] = box.Min[std::size_t(axis)];
    part.Max[std::size_t(axis)] = box.Max[std::size_t(axis)];
  }
  return part;
}

/// Whether a range is much longer than the points' bounds. No range is too long for points on a
/// plane across the axis.
bool isLong(const Box3& range, const Box3& points, int axis)
{
  constexpr double most = 10;
  const double length = range.width(std::size_t(axis));
  const double extent = points.width(std::size_t(axis));
  return std::isfinite(length) && extent > 0 && length > most * extent;
}

} // namespace

std::string inWords(const Box3& box, const std::vector<int>& axes)
{
  std::ostringstream text;
  text.precision(10);
  for (std::size_t i = 0; i < axes.size(); ++i)
  {
    const auto axis = std::size_t(axes[i]);
    const char* const separator = i + 1 == axes.size() ? " and " : ", ";
    text << (i == 0 ? "" : separator) << axisNames[axis] << " from " << box.Min[axis] << " to "
         << box.Max[axis];
  }
  return text.str();
}

void requireSensible(const Box3& range, const Box3& points, const std::vector<int>& axes)
{
  const Box3 given = along(axes, range);
  const Box3 all = along(axes, points);
  if (given.isEmpty() || all.isEmpty())
  {
    return;
  }
  const auto tooLong =
    std::find_if(axes.begin(), axes.end(), [&](int axis) { return isLong(given, all, axis); });
  if (given.meets(all) && tooLong == axes.end())
  {
    return;
  }
  const std::string problem = given.meets(all)
    ? std::string("are more than ten times as long along ") + axisNames[*tooLong] + " as"
    : "do not meet";
  throw std::runtime_error("the bounds, " + inWords(given, axes) + ", " + problem +
    " those of the points, " + inWords(all, axes) +
    "; give bounds in the order xmin xmax ymin ymax" +
    (std::count(axes.begin(), axes.end(), 2) > 0 ? " zmin zmax." : "."));
}

} // namespace tipp
