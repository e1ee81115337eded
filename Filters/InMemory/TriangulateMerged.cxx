// SPDX-License-Identifier: BSD-3-Clause
#include "InMemory/TriangulateMerged.h"

#include "InMemory/HashGrid.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Stopwatch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tipp
{

namespace
{

double largestCoordinate(PointsView points)
{
  double largest = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Point2 p = points[i];
    if (isFinite(p))
    {
      largest = std::max({ largest, std::fabs(p.x), std::fabs(p.y) });
    }
  }
  return largest;
}

} // namespace

MergedPoints mergeClosePoints(
  PointsView points, double distance, const std::function<bool(double)>& progress)
{
  constexpr std::size_t reportEvery = 1 << 16;
  const std::size_t count = points.size();
  MergedPoints merged;
  merged.Ids = Buffer<PointId>(count);
  HashGrid<2> grid(count, distance, largestCoordinate(points));
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    if (i % reportEvery == 0 && progress && !progress(double(i) / double(count)))
    {
      merged.Aborted = true;
      break;
    }
    const Point2 p = points[i];
    if (!isFinite(p))
    {
      merged.Rejected.push_back(PointId(i));
      continue;
    }
    const PointId close = grid.find({ p.x, p.y });
    if (close >= 0)
    {
      merged.Duplicates.push_back({ PointId(i), merged.Ids[close] });
      continue;
    }
    grid.keep({ p.x, p.y });
    merged.Ids[kept++] = PointId(i);
  }
  merged.Coordinates = grid.takeCoordinates();
  merged.Ids.truncate(kept);
  return merged;
}

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
  scaled.Progress = partOf(options.Progress, mergingShare, 1);
  const Stopwatch watch;
  MergedPoints merged =
    mergeClosePoints(points, distance, partOf(options.Progress, 0, mergingShare));
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
