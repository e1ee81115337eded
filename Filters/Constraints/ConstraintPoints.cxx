// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/ConstraintPoints.h"

#include "Constraints/SegmentTree.h"
#include "Parallel/ParallelFor.h"
#include "Predicates/ExactPredicates.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace tipp
{

PositionIndex::PositionIndex(std::vector<Point2> points)
  : Points(std::move(points))
{
  if (this->Points.size() >= Nobody / 4)
  {
    throw std::length_error("There are too many constraints; give fewer.");
  }
  std::size_t slots = 16;
  while (slots < 4 * this->Points.size()) // few points are compared with one that is not there
  {
    slots *= 2;
  }
  this->Slots.assign(slots, std::uint32_t(Nobody));
  this->Marks.assign(slots / 2, 0);
  for (std::size_t i = 0; i < this->Points.size(); ++i)
  {
    const Point2 p = this->Points[i];
    if (!isFinite(p))
    {
      continue;
    }
    const std::uint64_t hash = hashOf(p);
    this->Marks[hash >> 35 & (this->Marks.size() - 1)] |= std::uint8_t(1U << (hash >> 32 & 7));
    std::size_t slot = hash & (slots - 1);
    while (this->Slots[slot] != Nobody && !(this->Points[this->Slots[slot]] == p))
    {
      slot = (slot + 1) & (slots - 1);
    }
    if (this->Slots[slot] == Nobody)
    {
      this->Slots[slot] = std::uint32_t(i);
    }
  }
}

std::uint64_t PositionIndex::hashOf(Point2 position)
{
  // Zeros of both signs are equal.
  const double xy[2] = { position.x + 0.0, position.y + 0.0 };
  std::uint64_t bits[2];
  std::memcpy(bits, xy, sizeof bits);
  std::uint64_t hash = bits[0] * 0x9e3779b97f4a7c15U + bits[1];
  hash ^= hash >> 32;
  hash *= 0xd6e8feb86659fd93U;
  return hash ^ hash >> 32;
}

std::int64_t PositionIndex::find(Point2 position) const
{
  const std::uint64_t hash = hashOf(position);
  if ((this->Marks[hash >> 35 & (this->Marks.size() - 1)] >> (hash >> 32 & 7) & 1) == 0)
  {
    return -1;
  }
  const std::size_t last = this->Slots.size() - 1;
  for (std::size_t slot = hash & last; this->Slots[slot] != Nobody; slot = (slot + 1) & last)
  {
    if (this->Points[this->Slots[slot]] == position)
    {
      return this->Slots[slot];
    }
  }
  return -1;
}

MatchedPositions matchPositions(PointsView points, PointsView others)
{
  std::vector<Point2> positions;
  others.forEach(0, others.size(), [&](std::size_t, Point2 p) { positions.push_back(p); });
  const PositionIndex index(positions);
  constexpr PointId none = -1;
  MatchedPositions result;
  result.Ids.assign(others.size(), none);
  points.forEach(0, points.size(),
    [&](std::size_t i, Point2 p)
    {
      const std::int64_t found = index.find(p);
      if (found >= 0 && result.Ids[std::size_t(found)] == none)
      {
        result.Ids[std::size_t(found)] = PointId(i);
      }
    });
  for (std::size_t i = 0; i < others.size(); ++i)
  {
    const std::int64_t first = index.find(positions[i]);
    PointId& id = result.Ids[first < 0 ? i : std::size_t(first)];
    if (id == none)
    {
      id = PointId(points.size() + result.New.size());
      result.New.push_back(i);
    }
    result.Ids[i] = id;
  }
  return result;
}

namespace
{

constexpr std::int64_t NoTriangle = std::numeric_limits<std::int64_t>::max();

std::array<double, 3> weightsOf(const std::array<Point2, 3>& corners, Point2 p)
{
  std::array<double, 3> weights{};
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Point2 a = corners[(i + 1) % 3];
    const Point2 b = corners[(i + 2) % 3];
    weights[i] = std::fabs((a.x - p.x) * (b.y - p.y) - (a.y - p.y) * (b.x - p.x));
    sum += weights[i];
  }
  for (double& weight : weights)
  {
    weight = sum > 0 ? weight / sum : 1.0 / 3;
  }
  return weights;
}

template <typename Id>
std::vector<SurfacePosition> locate(
  PointsView surface, const Buffer<Id>& ids, PointsView all, int threads)
{
  const std::size_t given = surface.size();
  std::vector<SegmentTree::Item> items;
  for (std::size_t i = given; i < all.size(); ++i)
  {
    if (isFinite(all[i]))
    {
      items.push_back({ all[i], all[i], std::int64_t(i - given) });
    }
  }
  const SegmentTree tree(std::move(items));
  const auto cornersOf = [&](std::int64_t t)
  {
    const Id* const corners = ids.data() + 3 * t;
    return std::array<Point2, 3>{ surface[std::size_t(corners[0])],
      surface[std::size_t(corners[1])], surface[std::size_t(corners[2])] };
  };
  std::vector<std::vector<std::int64_t>> firstOf(
    std::size_t(threads), std::vector<std::int64_t>(all.size() - given, NoTriangle));
  constexpr std::int64_t chunk = 4096;
  forChunks(std::int64_t(ids.size() / 3), chunk, threads, {},
    [&](std::int64_t begin, std::int64_t end, int thread)
    {
      for (std::int64_t t = begin; t < end; ++t)
      {
        const std::array<Point2, 3> p = cornersOf(t);
        const Box2 box{ std::min({ p[0].x, p[1].x, p[2].x }), std::min({ p[0].y, p[1].y, p[2].y }),
          std::max({ p[0].x, p[1].x, p[2].x }), std::max({ p[0].y, p[1].y, p[2].y }) };
        tree.visitNear(box,
          [&](const SegmentTree::Item& item)
          {
            std::int64_t& first = firstOf[std::size_t(thread)][std::size_t(item.Id)];
            if (t < first && orientation(p[0], p[1], item.A) >= 0 &&
              orientation(p[1], p[2], item.A) >= 0 && orientation(p[2], p[0], item.A) >= 0)
            {
              first = t;
            }
            return true;
          });
      }
    });
  std::vector<SurfacePosition> positions(all.size() - given);
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    std::int64_t first = NoTriangle;
    for (const std::vector<std::int64_t>& its : firstOf)
    {
      first = std::min(first, its[i]);
    }
    if (first != NoTriangle)
    {
      const Id* const corners = ids.data() + 3 * first;
      positions[i] = { { PointId(corners[0]), PointId(corners[1]), PointId(corners[2]) },
        weightsOf(cornersOf(first), all[given + i]) };
    }
  }
  return positions;
}

} // namespace

double SurfacePosition::valueOf(const std::vector<double>& values) const
{
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    // A corner without weight may be one without value.
    if (this->Weights[i] > 0)
    {
      sum += this->Weights[i] * values[std::size_t(this->Corners[i])];
    }
  }
  return this->Corners[0] < 0 ? std::nan("") : sum;
}

void interpolateTuples(const std::vector<CrossingPoint>& crossings, std::size_t points, Scalar type,
  std::size_t components, void* values)
{
  withScalar(type,
    [&](auto kind)
    {
      using Value = decltype(kind);
      auto* const tuples = static_cast<Value*>(values);
      Value* to = tuples + points * components;
      for (const CrossingPoint& crossing : crossings)
      {
        const Value* const a = tuples + std::size_t(crossing.A) * components;
        const Value* const b = tuples + std::size_t(crossing.B) * components;
        for (std::size_t c = 0; c < components; ++c)
        {
          const double value =
            double(a[c]) * (1 - crossing.Fraction) + double(b[c]) * crossing.Fraction;
          // as VTK rounds
          *to++ = toScalar<Value>(
            std::is_integral_v<Value> ? std::trunc(value + std::copysign(0.5, value)) : value);
        }
      }
    });
}

std::vector<SurfacePosition> locateOnSurface(
  PointsView surface, const Triangulation& triangles, PointsView all, int threads)
{
  return triangles.Ids64.empty() ? locate(surface, triangles.Ids32, all, threadCount(threads))
                                 : locate(surface, triangles.Ids64, all, threadCount(threads));
}

} // namespace tipp
