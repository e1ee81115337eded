// SPDX-License-Identifier: BSD-3-Clause
#include "Comparison.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace tipp
{
namespace test
{
namespace
{

std::string tell(const Coordinates& xy, const Triangle& triangle)
{
  std::ostringstream text;
  text << std::setprecision(17);
  for (const std::int64_t id : triangle)
  {
    text << " " << id << " (" << xy[std::size_t(2 * id)] << ", " << xy[std::size_t(2 * id + 1)]
         << ")";
  }
  return text.str();
}

/// Fails with the first triangle of `these` that is not in `those`; `what` describes it.
testing::AssertionResult allIn(
  const Coordinates& xy, const Triangles& these, const Triangles& those, const std::string& what)
{
  Triangles surplus;
  std::set_difference(
    these.begin(), these.end(), those.begin(), those.end(), std::back_inserter(surplus));
  if (surplus.empty())
  {
    return testing::AssertionSuccess();
  }
  return testing::AssertionFailure()
    << surplus.size() << " of " << these.size() << " triangles are " << what << ", first"
    << tell(xy, surplus.front());
}

/// Computes what Reference::Representative should be from the result; -2 for a point that is
/// reported twice.
Ids account(const Triangulation& result, std::size_t count)
{
  Ids stands(count, -3);
  for (const PointId id : result.Rejected)
  {
    std::int64_t& stand = stands.at(std::size_t(id));
    stand = stand == -3 ? -1 : -2;
  }
  for (const Duplicate& duplicate : result.Duplicates)
  {
    std::int64_t& stand = stands.at(std::size_t(duplicate.Point));
    stand = stand == -3 ? duplicate.Representative : -2;
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    stands[i] = stands[i] == -3 ? std::int64_t(i) : stands[i];
  }
  return stands;
}

bool ascending(const Triangulation& result)
{
  return std::is_sorted(result.Rejected.begin(), result.Rejected.end()) &&
    std::is_sorted(result.Duplicates.begin(), result.Duplicates.end(),
      [](const Duplicate& a, const Duplicate& b) { return a.Point < b.Point; });
}

} // namespace

PointsView view(const Coordinates& xy)
{
  return PointsView(xy.data(), xy.size() / 2, 2);
}

Triangles trianglesOf(const Triangulation& result)
{
  const auto id = [&](std::size_t i)
  { return result.Ids32.empty() ? result.Ids64[i] : std::int64_t(result.Ids32[i]); };
  Triangles triangles;
  triangles.reserve(result.triangleCount());
  for (std::size_t i = 0; i < 3 * result.triangleCount(); i += 3)
  {
    triangles.push_back(canonical(id(i), id(i + 1), id(i + 2)));
  }
  return sorted(std::move(triangles));
}

testing::AssertionResult sameTriangles(
  const Coordinates& xy, const Triangles& actual, const Triangles& expected)
{
  const auto missing = allIn(xy, expected, actual, "missing");
  if (!missing)
  {
    return missing;
  }
  const auto extra = allIn(xy, actual, expected, "wrong");
  if (!extra || actual.size() == expected.size())
  {
    return extra;
  }
  const auto twice = std::adjacent_find(actual.begin(), actual.end());
  return testing::AssertionFailure() << "a triangle occurs twice:" << tell(xy, *twice);
}

testing::AssertionResult matches(
  const Coordinates& xy, const Triangulation& result, const Reference& expected)
{
  if (result.Aborted)
  {
    return testing::AssertionFailure() << "the run says that it was aborted";
  }
  const Ids stands = account(result, xy.size() / 2);
  const auto wrong =
    std::mismatch(stands.begin(), stands.end(), expected.Representative.begin()).first;
  if (wrong != stands.end())
  {
    const auto id = wrong - stands.begin();
    return testing::AssertionFailure()
      << "point " << id << " is said to be represented by " << *wrong << ", should be by "
      << expected.Representative[std::size_t(id)] << " (-1 rejected, -2 reported twice)";
  }
  if (!ascending(result))
  {
    return testing::AssertionFailure() << "duplicates or rejected points do not ascend";
  }
  return sameTriangles(xy, trianglesOf(result), expected.Mesh);
}

std::string describe(const TriangulationOptions& options)
{
  return std::to_string(options.Threads) + " threads, " +
    (options.Columns == 0 ? std::string("automatic")
                          : std::to_string(options.Columns) + "x" + std::to_string(options.Rows)) +
    " partitions, " + (options.Order == Schedule::Stages ? "stages" : "dynamic");
}

} // namespace test
} // namespace tipp
