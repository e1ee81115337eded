// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/SurfaceValues.h"

#include "Parallel/ParallelFor.h"

#include <cmath>
#include <utility>

namespace tipp
{

SurfaceTriangle::SurfaceTriangle(const std::array<Point2, 3>& corners)
{
  std::sort(this->Order.begin(), this->Order.end(),
    [&](std::size_t a, std::size_t b) { return lexicographicLess(corners[a], corners[b]); });
  this->Corners = { corners[this->Order[0]], corners[this->Order[1]], corners[this->Order[2]] };
}

bool SurfaceTriangle::isBefore(const SurfaceTriangle& other) const
{
  return std::lexicographical_compare(this->Corners.begin(), this->Corners.end(),
    other.Corners.begin(), other.Corners.end(),
    [](Point2 a, Point2 b) { return lexicographicLess(a, b); });
}

std::array<double, 3> SurfaceTriangle::weightsAt(Point2 p) const
{
  std::array<double, 3> weights{};
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Point2 a = this->Corners[(i + 1) % 3];
    const Point2 b = this->Corners[(i + 2) % 3];
    weights[i] = std::fabs((a.x - p.x) * (b.y - p.y) - (a.y - p.y) * (b.x - p.x));
    sum += weights[i];
  }
  for (double& weight : weights)
  {
    weight = sum > 0 ? weight / sum : 1.0 / 3;
  }
  return weights;
}

namespace
{

std::vector<SegmentTree::Item> itemsOf(const std::vector<Point2>& positions)
{
  std::vector<SegmentTree::Item> items;
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    if (isFinite(positions[i]))
    {
      items.push_back({ positions[i], positions[i], std::int64_t(i) });
    }
  }
  return items;
}

constexpr std::int64_t NoTriangle = -1;

/// The triangle that gives each position its value, or NoTriangle.
template <typename Id>
std::vector<std::int64_t> findAnswers(
  const std::vector<Point2>& positions, PointsView points, const Buffer<Id>& ids, int threads)
{
  const SurfacePositions wanted(positions);
  const auto choose = [&](std::int64_t triangle, std::int64_t& chosen)
  {
    const bool isFirst = triangle != NoTriangle &&
      (chosen == NoTriangle ||
        SurfaceTriangle(cornersOf(points, ids.data(), std::size_t(triangle)))
          .isBefore(SurfaceTriangle(cornersOf(points, ids.data(), std::size_t(chosen)))));
    chosen = isFirst ? triangle : chosen;
  };
  std::vector<std::vector<std::int64_t>> answers(
    std::size_t(threads), std::vector<std::int64_t>(positions.size(), NoTriangle));
  constexpr std::int64_t chunk = 4096;
  forChunks(std::int64_t(ids.size() / 3), chunk, threads, {},
    [&](std::int64_t begin, std::int64_t end, int thread)
    {
      for (std::int64_t t = begin; t < end; ++t)
      {
        wanted.visitInside(cornersOf(points, ids.data(), std::size_t(t)),
          [&](std::size_t i, Point2) { choose(t, answers[std::size_t(thread)][i]); });
      }
    });
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    for (const std::vector<std::int64_t>& others : answers)
    {
      choose(others[i], answers.front()[i]);
    }
  }
  return std::move(answers.front());
}

template <typename Id>
std::vector<std::vector<double>> evaluate(const std::vector<Point2>& positions, PointsView points,
  const Buffer<Id>& ids, const std::vector<const double*>& columns, int threads)
{
  const std::vector<std::int64_t> answers = findAnswers(positions, points, ids, threads);
  std::vector<std::vector<double>> values(
    columns.size(), std::vector<double>(positions.size(), std::nan("")));
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    if (answers[i] == NoTriangle)
    {
      continue;
    }
    const SurfaceTriangle triangle(cornersOf(points, ids.data(), std::size_t(answers[i])));
    for (std::size_t c = 0; c < columns.size(); ++c)
    {
      values[c][i] = triangle.valueAt(positions[i],
        [&](std::size_t corner) { return columns[c][ids[3 * std::size_t(answers[i]) + corner]]; });
    }
  }
  return values;
}

} // namespace

SurfacePositions::SurfacePositions(const std::vector<Point2>& positions)
  : Tree(itemsOf(positions))
{
}

void interpolateTuples(const std::vector<CrossingPoint>& crossings, std::size_t points, Scalar type,
  std::size_t components, void* values)
{
  appendTuples(crossings, points, type, components, values,
    [](const CrossingPoint& crossing, const auto& valueAt)
    {
      return valueAt(crossing.A) * (1 - crossing.Fraction) +
        valueAt(crossing.B) * crossing.Fraction;
    });
}

bool SurfacePositions::meets(const Box2& box) const
{
  bool isMet = false;
  this->Tree.visitNear(box,
    [&isMet](const SegmentTree::Item&)
    {
      isMet = true;
      return false;
    });
  return isMet;
}

std::vector<std::vector<double>> valuesOnSurface(const std::vector<Point2>& positions,
  PointsView points, const Triangulation& triangles, const std::vector<const double*>& columns,
  int threads)
{
  return triangles.Ids64.empty()
    ? evaluate(positions, points, triangles.Ids32, columns, threadCount(threads))
    : evaluate(positions, points, triangles.Ids64, columns, threadCount(threads));
}

} // namespace tipp
