// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/KeepInside.h"

#include "Constraints/Constraint.h"
#include "Meshes/MeshFiles.h"
#include "Predicates/ExactPredicates.h"
#include "Triangulation/TriangleSink.h"

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <stdexcept>

namespace tipp
{
namespace
{

template <typename Id, typename IsKept>
void keepTriangles(Buffer<Id>& ids, const IsKept& isKept)
{
  ids.truncate(3 * tipp::keepTriangles(ids.data(), ids.size() / 3, isKept));
}

/// For each corner of a triangle the triangle opposite to it, or -1.
template <typename Id>
std::vector<std::int64_t> neighborsOf(const Buffer<Id>& ids)
{
  std::vector<std::int64_t> neighbors(ids.size());
  findNeighbors(ids.data(), ids.size() / 3, neighbors.data());
  return neighbors;
}

/// How often the polygons go round each triangle: counter-clockwise ones count 1, others -1. By the
/// other rule all count 1, so that odd numbers are inside.
template <typename Id>
std::vector<int> windings(const Buffer<Id>& ids, const ConstraintEdges& edges, InsideRule rule)
{
  const auto crossed = [&](PointId a, PointId b)
  { return rule == InsideRule::Winding ? edges.balance(a, b) : edges.count(a, b); };
  const std::vector<std::int64_t> neighbors = neighborsOf(ids);
  const auto from = [&](std::size_t corner) { return PointId(ids[corner]); };
  std::vector<int> result(ids.size() / 3, 0);
  std::vector<char> isKnown(result.size(), 0);
  std::vector<std::size_t> front;
  const auto enter = [&](std::size_t triangle, int winding)
  {
    if (!isKnown[triangle])
    {
      isKnown[triangle] = 1;
      result[triangle] = winding;
      front.push_back(triangle);
    }
  };
  // The edge opposite to a corner goes from the next corner to the one after.
  const auto nextCorner = [](std::size_t c) { return c % 3 == 2 ? c - 2 : c + 1; };
  for (std::size_t c = 0; c < ids.size(); ++c)
  {
    if (neighbors[c] < 0)
    {
      const std::size_t a = nextCorner(c);
      enter(c / 3, crossed(from(a), from(nextCorner(a))));
      break; // all others are reached from there
    }
  }
  while (!front.empty())
  {
    const std::size_t triangle = front.back();
    front.pop_back();
    for (std::size_t c = 3 * triangle; c < 3 * triangle + 3; ++c)
    {
      if (neighbors[c] >= 0)
      {
        const std::size_t a = nextCorner(c);
        enter(std::size_t(neighbors[c]), result[triangle] - crossed(from(a), from(nextCorner(a))));
      }
    }
  }
  return result;
}

template <typename Id>
void keepWound(Buffer<Id>& ids, const std::vector<ConstraintPiece>& polygonEdges, InsideRule rule)
{
  const std::vector<int> windings = tipp::windings(ids, ConstraintEdges(polygonEdges), rule);
  if (rule == InsideRule::EvenOdd)
  {
    keepTriangles(ids, [&](std::size_t t) { return windings[t] % 2 != 0; });
    return;
  }
  const bool onlyHoles =
    std::none_of(windings.begin(), windings.end(), [](int winding) { return winding > 0; });
  const int least = onlyHoles ? 0 : 1;
  keepTriangles(ids, [&](std::size_t t) { return windings[t] >= least; });
}

/// A triangle that holds the point, or their number.
template <typename Id>
std::size_t findTriangle(PointsView points, const Buffer<Id>& ids, Point2 p)
{
  const std::size_t triangles = ids.size() / 3;
  for (std::size_t t = 0; t < triangles; ++t)
  {
    const Point2 a = points[std::size_t(ids[3 * t])];
    const Point2 b = points[std::size_t(ids[3 * t + 1])];
    const Point2 c = points[std::size_t(ids[3 * t + 2])];
    const bool isInBox = std::min({ a.x, b.x, c.x }) <= p.x && p.x <= std::max({ a.x, b.x, c.x }) &&
      std::min({ a.y, b.y, c.y }) <= p.y && p.y <= std::max({ a.y, b.y, c.y });
    if (isInBox && orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 &&
      orientation(c, a, p) >= 0)
    {
      return t;
    }
  }
  return triangles;
}

template <typename Id>
void removeFrom(PointsView points, Buffer<Id>& ids, const std::vector<ConstraintPiece>& pieces,
  const std::vector<Point2>& seeds)
{
  const ConstraintEdges edges(pieces);
  const std::vector<std::int64_t> neighbors = neighborsOf(ids);
  std::vector<char> isRemoved(ids.size() / 3, 0);
  for (const Point2& seed : seeds)
  {
    const std::size_t first = findTriangle(points, ids, seed);
    if (first == isRemoved.size())
    {
      std::ostringstream text;
      text << "the hole at (" << seed.x << ", " << seed.y << ") is in no triangle.";
      throw std::invalid_argument(text.str());
    }
    std::vector<std::size_t> front{ first };
    isRemoved[first] = 1;
    while (!front.empty())
    {
      const std::size_t triangle = front.back();
      front.pop_back();
      for (std::size_t i = 0; i < 3; ++i)
      {
        const auto next = neighbors[3 * triangle + i];
        const PointId a = PointId(ids[3 * triangle + (i + 1) % 3]);
        const PointId b = PointId(ids[3 * triangle + (i + 2) % 3]);
        if (next >= 0 && !isRemoved[std::size_t(next)] && !edges.contains(a, b))
        {
          isRemoved[std::size_t(next)] = 1;
          front.push_back(std::size_t(next));
        }
      }
    }
  }
  keepTriangles(ids, [&](std::size_t t) { return !isRemoved[t]; });
}

} // namespace

void keepInside(
  Triangulation& triangulation, const std::vector<ConstraintPiece>& polygonEdges, InsideRule rule)
{
  triangulation.Ids64.empty() ? keepWound(triangulation.Ids32, polygonEdges, rule)
                              : keepWound(triangulation.Ids64, polygonEdges, rule);
  triangulation.Blocks.clear();
}

void removeHoles(PointsView points, Triangulation& triangulation,
  const std::vector<ConstraintPiece>& edges, const std::vector<Point2>& seeds)
{
  triangulation.Ids64.empty() ? removeFrom(points, triangulation.Ids32, edges, seeds)
                              : removeFrom(points, triangulation.Ids64, edges, seeds);
  triangulation.Blocks.clear();
}

} // namespace tipp
