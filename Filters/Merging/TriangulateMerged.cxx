// SPDX-License-Identifier: BSD-3-Clause
#include "Merging/TriangulateMerged.h"

#include "Parallel/Stopwatch.h"

#include <algorithm>
#include <limits>

namespace tipp
{

namespace
{

template <typename From, typename To>
Buffer<To> renumbered(const Buffer<From>& ids, const Buffer<PointId>& originals)
{
  Buffer<To> result(ids.size());
  const std::int64_t count = std::int64_t(ids.size());
#pragma omp parallel for
  for (std::int64_t i = 0; i < count; ++i)
  {
    result[i] = To(originals[std::size_t(ids[i])]);
  }
  return result;
}

void renumber(Triangulation& result, const Buffer<PointId>& originals)
{
  if (!result.Ids64.empty())
  {
    result.Ids64 = renumbered<std::int64_t, std::int64_t>(result.Ids64, originals);
  }
  else if (originals[originals.size() - 1] <= std::numeric_limits<std::int32_t>::max())
  {
    result.Ids32 = renumbered<std::int32_t, std::int32_t>(result.Ids32, originals);
  }
  else
  {
    result.Ids64 = renumbered<std::int32_t, std::int64_t>(result.Ids32, originals);
    result.Ids32 = {};
  }
}

} // namespace

Triangulation triangulateMerged(
  PointsView points, double distance, const TriangulationOptions& options)
{
  constexpr double mergingShare = 0.2; // fraction of the reported progress
  TriangulationOptions scaled = options;
  std::function<bool(double)> mergingProgress;
  if (options.Progress)
  {
    const auto& report = options.Progress;
    mergingProgress = [&report](double f) { return report(mergingShare * f); };
    scaled.Progress = [&report](double f) { return report(mergingShare + (1 - mergingShare) * f); };
  }
  const Stopwatch watch;
  MergedPoints merged = mergeClosePoints(points, distance, mergingProgress);
  Triangulation result;
  if (merged.Aborted)
  {
    result.Aborted = true;
    return result;
  }
  const double mergingSeconds = watch.seconds();
  result = triangulate(PointsView(merged.Coordinates.data(), merged.Ids.size(), 2), scaled);
  if (result.triangleCount() > 0)
  {
    renumber(result, merged.Ids);
  }
  auto& phases = result.Statistics.Phases;
  phases.insert(phases.begin(), { "merging", mergingSeconds });
  result.Duplicates = std::move(merged.Duplicates);
  result.Rejected = std::move(merged.Rejected);
  return result;
}

} // namespace tipp
