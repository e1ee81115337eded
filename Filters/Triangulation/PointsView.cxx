// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/PointsView.h"

#include "Kernel/Pairs.h"
#include "Parallel/ParallelFor.h"
#include "Predicates/ExactPredicates.h"
#include "Triangulation/Duplicate.h"

namespace tipp
{
namespace
{

/// Extends a survey by points, the first of which has the index `first`.
void addPoints(PointSurvey& survey, std::size_t first, const Point2* points, std::size_t count)
{
  const Extent extent = extentOf(points, count);
  if (!extent.AllFinite && count > 1)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      addPoints(survey, first + i, points + i, 1);
    }
  }
  else if (!extent.AllFinite)
  {
    survey.Rejected.push_back(static_cast<std::int64_t>(first));
  }
  else
  {
    survey.Bounds.extend(extent.Bounds);
  }
}

} // namespace

PointSurvey surveyPoints(PointsView points, int threads)
{
  std::vector<PointSurvey> parts(static_cast<std::size_t>(threads));
  parallelFor(threads, threads,
    [&](std::int64_t part)
    {
      const auto [begin, end] = evenShare(points.size(), int(part), threads);
      PointSurvey& survey = parts[std::size_t(part)];
      points.forBlocks(begin, end,
        [&survey](std::size_t first, const Point2* block, std::size_t count)
        { addPoints(survey, first, block, count); });
    });
  PointSurvey all;
  for (const PointSurvey& part : parts)
  {
    all.Bounds.extend(part.Bounds);
    all.Rejected.insert(all.Rejected.end(), part.Rejected.begin(), part.Rejected.end());
  }
  return all;
}

std::vector<Point2> samplePoints(PointsView points, std::size_t count)
{
  std::vector<Point2> sample;
  sample.reserve(count);
  const double step = std::max(1.0, double(points.size()) / double(count));
  const std::size_t samples = std::min(count, points.size());
  for (std::size_t i = 0; i < samples; ++i)
  {
    const Point2 p = points[static_cast<std::size_t>((double(i) + 0.5) * step)];
    if (isFinite(p))
    {
      sample.push_back(p);
    }
  }
  return sample;
}

double moderateFactor(double largest, int moderate)
{
  constexpr int largestShift = 1000;
  return largest == 0 || std::abs(std::ilogb(largest)) <= moderate
    ? 1
    : std::ldexp(1.0, std::clamp(-std::ilogb(largest), -largestShift, largestShift));
}

PointsView withModerateMagnitude(PointsView points, const Box2& bounds)
{
  // Determinants have degree four in the coordinates, and rounding errors are 53 bits smaller.
  constexpr int moderate = 200;
  const double factor = moderateFactor(bounds.largest(), moderate);
  for (std::size_t i = 0; factor != 1 && i < points.size(); ++i)
  {
    const Point2 p = points[i];
    if (isFinite(p) && !(isExactTimes(p.x, factor) && isExactTimes(p.y, factor)))
    {
      return points;
    }
  }
  return points.scaled(factor);
}

bool CollinearityTest::add(Point2 p)
{
  if (!this->Holds || !isFinite(p) || (this->Found > 0 && p == this->Line[0]))
  {
    return this->Holds;
  }
  if (this->Found < 2)
  {
    this->Line[this->Found++] = p;
  }
  else
  {
    this->Holds = orientation(this->Line[0], this->Line[1], p) == 0;
  }
  return this->Holds;
}

bool areCollinear(PointsView points)
{
  CollinearityTest test;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (!test.add(points[i]))
    {
      return false;
    }
  }
  return true;
}

std::vector<Duplicate> sortOutDuplicates(PointsView points)
{
  std::vector<PointId> order;
  order.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (isFinite(points[i]))
    {
      order.push_back(static_cast<PointId>(i));
    }
  }
  const auto at = [&points](PointId id) { return points[static_cast<std::size_t>(id)]; };
  std::sort(order.begin(), order.end(),
    [&at](PointId a, PointId b)
    {
      const Point2 p = at(a);
      const Point2 q = at(b);
      return p == q ? a < b : lexicographicLess(p, q);
    });
  std::vector<Duplicate> duplicates;
  PointId first = 0; // the lowest of the coincident points
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    if (i == 0 || !(at(order[i]) == at(order[i - 1])))
    {
      first = order[i];
    }
    else
    {
      duplicates.push_back({ order[i], first });
    }
  }
  std::sort(duplicates.begin(), duplicates.end());
  return duplicates;
}

} // namespace tipp
