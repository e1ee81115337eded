// SPDX-License-Identifier: BSD-3-Clause
#include "Output/TriangulationWarnings.h"

namespace tipp
{

std::vector<std::string> warningsOf(
  const Triangulation& triangulation, std::int64_t points, bool longEdgesLeftOut)
{
  std::vector<std::string> warnings;
  const auto rejected = std::int64_t(triangulation.Rejected.size());
  if (rejected > 0)
  {
    warnings.push_back(std::to_string(rejected) + " of " + std::to_string(points) +
      " points have a NaN or infinite coordinate and are in no triangle; the first is point " +
      std::to_string(triangulation.Rejected.front()) + ".");
  }
  if (triangulation.triangleCount() == 0)
  {
    const std::int64_t distinct = points - std::int64_t(triangulation.Duplicates.size()) - rejected;
    warnings.push_back("No triangles: of " + std::to_string(points) + " points, " +
      std::to_string(distinct) + " are finite and distinct" +
      (distinct < 3          ? ", and it takes three."
          : longEdgesLeftOut ? ", and all triangles have edges that are too long, or all points "
                               "are on one line."
                             : ", and all are on one line."));
  }
  return warnings;
}

std::vector<std::string> warningsOf(const OutOfCoreStatistics& statistics)
{
  std::vector<std::string> warnings;
  if (statistics.Rejected > 0)
  {
    warnings.push_back(std::to_string(statistics.Rejected) + " of " +
      std::to_string(statistics.Points) +
      " points have a NaN or infinite coordinate and are left out.");
  }
  if (statistics.Triangles == 0)
  {
    warnings.emplace_back(
      "No triangles: there are fewer than three distinct points, or all are on one line.");
  }
  return warnings;
}

} // namespace tipp
