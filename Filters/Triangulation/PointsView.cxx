// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/PointsView.h"

#include "Kernel/DelaunayKernel3.h"
#include "Kernel/Pairs.h"
#include "Parallel/ParallelFor.h"
#include "Predicates/ExactPredicates.h"
#include "Predicates/ExactPredicates3.h"
#include "Triangulation/Duplicate.h"

namespace tipp
{
namespace
{

struct Extent3
{
  Box3 Bounds;
  bool AllFinite;
};

/// Returns the extent of points in space, without a special use of the processor.
Extent3 extentOf(const Point3* points, std::size_t count)
{
  Extent3 extent{ Box3::empty(), true };
  for (std::size_t i = 0; i < count; ++i)
  {
    extent.Bounds.extend(points[i]);
    extent.AllFinite = extent.AllFinite && isFinite(points[i]);
  }
  return extent;
}

/// Extends a survey by points, the first of which has the index `first`.
template <int D>
void addPoints(
  PointSurveyOf<D>& survey, std::size_t first, const Point<D>* points, std::size_t count)
{
  const auto extent = extentOf(points, count);
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

/// Returns a power of two that scales coordinates whose largest magnitude is `largest` to about 1;
/// 1 if `largest` is 0 or between 2^-`moderate` and 2^`moderate`.
double moderateFactor(double largest, int moderate)
{
  constexpr int largestShift = 1000;
  return largest == 0 || std::abs(std::ilogb(largest)) <= moderate
    ? 1
    : std::ldexp(1.0, std::clamp(-std::ilogb(largest), -largestShift, largestShift));
}

template <int D>
bool isExactTimes(const Point<D>& p, double factor)
{
  bool isExact = true;
  for (std::size_t k = 0; k < D; ++k)
  {
    isExact = isExact && p[k] * factor / factor == p[k];
  }
  return isExact;
}

///@{
/// Returns whether p lies outside of the flat through the points of a simplex.
bool isIndependent(const std::vector<Point2>& simplex, Point2 p)
{
  return simplex.empty() ||
    (simplex.size() == 1 ? !(p == simplex[0]) : orientation(simplex[0], simplex[1], p) != 0);
}
bool isIndependent(const std::vector<Point3>& simplex, const Point3& p)
{
  const auto& s = simplex;
  return s.empty() || (s.size() == 1 && !(p == s[0])) ||
    (s.size() == 2 && !areCollinear(s[0], s[1], p)) ||
    (s.size() == 3 && orientation3(s[0], s[1], s[2], p) != 0);
}
///@}

} // namespace

template <int D>
PointSurveyOf<D> surveyPoints(const PointsViewOf<D>& points, int threads)
{
  std::vector<PointSurveyOf<D>> parts(static_cast<std::size_t>(threads));
  parallelFor(threads, threads,
    [&](std::int64_t part)
    {
      const auto [begin, end] = evenShare(points.size(), int(part), threads);
      PointSurveyOf<D>& survey = parts[std::size_t(part)];
      points.forBlocks(begin, end,
        [&survey](std::size_t first, const Point<D>* block, std::size_t count)
        { addPoints(survey, first, block, count); });
    });
  PointSurveyOf<D> all;
  for (const PointSurveyOf<D>& part : parts)
  {
    all.Bounds.extend(part.Bounds);
    all.Rejected.insert(all.Rejected.end(), part.Rejected.begin(), part.Rejected.end());
  }
  return all;
}

template <int D>
std::vector<Point<D>> sampleEvery(const PointsViewOf<D>& points, double step)
{
  const auto index = [step](std::size_t i)
  { return static_cast<std::size_t>((double(i) + 0.5) * step); };
  std::vector<Point<D>> sample;
  sample.reserve(std::size_t(double(points.size()) / step) + 1);
  for (std::size_t i = 0; index(i) < points.size(); ++i)
  {
    const Point<D> p = points[index(i)];
    if (isFinite(p))
    {
      sample.push_back(p);
    }
  }
  return sample;
}

template <int D>
PointsViewOf<D> withModerateMagnitude(const PointsViewOf<D>& points, const Box<D>& bounds)
{
  // Determinants have degree four in the coordinates of the plane, and rounding errors are 53 bits
  // smaller. In space they have degree five, and their filters square them.
  constexpr int moderate = D == 2 ? 200 : 24;
  const double factor = bounds.isEmpty() ? 1 : moderateFactor(bounds.largest(), moderate);
  for (std::size_t i = 0; factor != 1 && i < points.size(); ++i)
  {
    const Point<D> p = points[i];
    if (isFinite(p) && !isExactTimes<D>(p, factor))
    {
      return points;
    }
  }
  return points.scaled(factor);
}

template <int D>
void DimensionTest<D>::add(const Point<D>& p)
{
  if (!this->isFull() && isFinite(p) && isIndependent(this->Simplex, p))
  {
    this->Simplex.push_back(p);
  }
}

bool areCollinear(const PointsView& points)
{
  DimensionTest<2> test;
  for (std::size_t i = 0; i < points.size() && !test.isFull(); ++i)
  {
    test.add(points[i]);
  }
  return !test.isFull();
}

std::vector<Duplicate> sortOutDuplicates(const PointsView& points)
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

template PointSurveyOf<2> surveyPoints(const PointsViewOf<2>& points, int threads);
template std::vector<Point<2>> sampleEvery(const PointsViewOf<2>& points, double step);
template PointsViewOf<2> withModerateMagnitude(const PointsViewOf<2>& points, const Box<2>& bounds);
template class DimensionTest<2>;
template PointSurveyOf<3> surveyPoints(const PointsViewOf<3>& points, int threads);
template std::vector<Point<3>> sampleEvery(const PointsViewOf<3>& points, double step);
template PointsViewOf<3> withModerateMagnitude(const PointsViewOf<3>& points, const Box<3>& bounds);
template class DimensionTest<3>;

} // namespace tipp
