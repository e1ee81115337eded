// SPDX-License-Identifier: BSD-3-Clause
#include "InMemory/TriangulateMerged.h"

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

/// A hash grid: lists of kept points by the hash of their cell. Cells are at least twice as wide as
/// the distance, so the points close to a position are in the cells within half a cell's width of
/// it.
class HashGrid
{
public:
  HashGrid(std::size_t capacity, double distance, double largestCoordinate)
    : Distance(distance)
    // Wide enough that cell indices are below 2^41, where `slack` exceeds the rounding errors.
    , Cell(std::max(
        { 2 * distance, std::ldexp(largestCoordinate, -40), std::numeric_limits<double>::min() }))
    , Coordinates(2 * capacity)
    , Next(capacity)
  {
    std::size_t slots = 1;
    while (slots < capacity)
    {
      slots *= 2;
    }
    this->First.assign(slots, -1);
  }

  /// Returns the id of the first kept point within the distance, or -1.
  PointId find(Point2 p) const
  {
    constexpr double slack = 1.0 / 1024;
    constexpr double reach = 0.5 + slack;
    PointId found = -1;
    const std::int64_t left = this->index(p.x, -reach);
    const std::int64_t right = this->index(p.x, reach);
    const std::int64_t bottom = this->index(p.y, -reach);
    const std::int64_t top = this->index(p.y, reach);
    for (std::int64_t column = left; column <= right; ++column)
    {
      for (std::int64_t row = bottom; row <= top; ++row)
      {
        for (PointId k = this->First[this->slot(column, row)]; k >= 0; k = this->Next[k])
        {
          if ((found < 0 || k < found) && this->isClose(k, p))
          {
            found = k;
          }
        }
      }
    }
    return found;
  }

  void keep(Point2 p)
  {
    const std::size_t at = this->slot(this->index(p.x), this->index(p.y));
    this->Coordinates[2 * this->Size] = p.x;
    this->Coordinates[2 * this->Size + 1] = p.y;
    this->Next[this->Size] = this->First[at];
    this->First[at] = PointId(this->Size++);
  }

  Buffer<double> takeCoordinates()
  {
    this->Coordinates.truncate(2 * this->Size);
    return std::move(this->Coordinates);
  }

private:
  std::int64_t index(double coordinate, double cellsAway = 0) const
  {
    return std::int64_t(std::floor(coordinate / this->Cell + cellsAway));
  }

  std::size_t slot(std::int64_t column, std::int64_t row) const
  {
    std::uint64_t hash = std::uint64_t(column) * 0x9e3779b97f4a7c15u;
    hash = (hash ^ (hash >> 32) ^ std::uint64_t(row)) * 0xff51afd7ed558ccdu;
    return (hash ^ (hash >> 33)) & (this->First.size() - 1);
  }

  bool isClose(PointId k, Point2 p) const
  {
    return std::hypot(p.x - this->Coordinates[2 * k], p.y - this->Coordinates[2 * k + 1]) <=
      this->Distance;
  }

  double Distance;
  double Cell;
  std::vector<PointId> First;
  Buffer<double> Coordinates;
  Buffer<PointId> Next;
  std::size_t Size = 0;
};

} // namespace

MergedPoints mergeClosePoints(
  PointsView points, double distance, const std::function<bool(double)>& progress)
{
  constexpr std::size_t reportEvery = 1 << 16;
  const std::size_t count = points.size();
  MergedPoints merged;
  merged.Ids = Buffer<PointId>(count);
  HashGrid grid(count, distance, largestCoordinate(points));
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
    const PointId close = grid.find(p);
    if (close >= 0)
    {
      merged.Duplicates.push_back({ PointId(i), merged.Ids[close] });
      continue;
    }
    grid.keep(p);
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
