// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/Insertion/KeepInside.h"

#include "Arrays/FindNeighbors.h"
#include "Constraints/Insertion/TriangulateConstrained.h"
#include "Constraints/SurfaceValues.h"
#include "Predicates/ExactPredicates.h"
#include "Triangulation/TriangleSink.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace tipp
{
namespace
{

/// For each corner of a triangle, the triangle across the opposite edge, or -1.
template <typename Id>
std::vector<std::int64_t> neighborsOf(const Buffer<Id>& ids)
{
  std::vector<std::int64_t> neighbors(ids.size());
  findNeighbors(ids.data(), ids.size() / 3, neighbors.data());
  return neighbors;
}

/// The ends of the edge opposite to a corner, directed with the triangle on the left.
template <typename Id>
std::array<PointId, 2> edgeOpposite(const Buffer<Id>& ids, std::size_t corner)
{
  const std::size_t first = corner / 3 * 3;
  return { PointId(ids[first + (corner + 1) % 3]), PointId(ids[first + (corner + 2) % 3]) };
}

/// Goes from the triangles in `front` to their neighbours, and on from those for which
/// enter(corner, neighbour) is true. The neighbour is across the edge opposite to the corner.
template <typename Enter>
void spread(
  std::vector<std::size_t> front, const std::vector<std::int64_t>& neighbors, const Enter& enter)
{
  while (!front.empty())
  {
    const std::size_t triangle = front.back();
    front.pop_back();
    for (std::size_t c = 3 * triangle; c < 3 * triangle + 3; ++c)
    {
      if (neighbors[c] >= 0 && enter(c, std::size_t(neighbors[c])))
      {
        front.push_back(std::size_t(neighbors[c]));
      }
    }
  }
}

/// For each triangle, the sum of crossed(a, b) over the edges that a path from outside to the
/// triangle crosses. Edges are directed with the triangle that the path enters on the left. The
/// triangles must fill a convex hull.
template <typename Id, typename Crossed>
std::vector<int> sumsFromOutside(
  const Buffer<Id>& ids, const std::vector<std::int64_t>& neighbors, const Crossed& crossed)
{
  std::vector<int> result(ids.size() / 3, 0);
  std::vector<char> isKnown(result.size(), 0);
  const auto across = [&](std::size_t corner)
  {
    const auto [a, b] = edgeOpposite(ids, corner);
    return crossed(a, b);
  };
  const auto hull = std::find_if(
    neighbors.begin(), neighbors.end(), [](std::int64_t neighbor) { return neighbor < 0; });
  if (hull != neighbors.end()) // all other triangles are reached from here
  {
    const auto corner = std::size_t(hull - neighbors.begin());
    isKnown[corner / 3] = 1;
    result[corner / 3] = across(corner);
    spread({ corner / 3 }, neighbors,
      [&](std::size_t from, std::size_t to)
      {
        const bool isNew = !isKnown[to];
        isKnown[to] = 1;
        result[to] = isNew ? result[from / 3] - across(from) : result[to];
        return isNew;
      });
  }
  return result;
}

/// For each triangle, whether it can be reached from a seed without crossing a constraint.
template <typename Id>
std::vector<char> reachedFrom(PointsView points, const Buffer<Id>& ids,
  const std::vector<std::int64_t>& neighbors, const std::vector<IdSegment>& segments,
  const std::vector<Point2>& seeds)
{
  const ConstraintEdges edges(segments);
  std::vector<char> isReached(ids.size() / 3, 0);
  std::vector<std::size_t> front;
  const SurfacePositions wanted(seeds);
  std::vector<char> isFound(seeds.size(), 0);
  for (std::size_t t = 0; t < isReached.size(); ++t)
  {
    wanted.visitInside(cornersOf(points, ids.data(), t),
      [&](std::size_t seed, Point2)
      {
        isFound[seed] = 1;
        isReached[t] = 1;
        front.push_back(t);
      });
  }
  const auto lost = std::find(isFound.begin(), isFound.end(), 0);
  if (lost != isFound.end())
  {
    const Point2 seed = seeds[std::size_t(lost - isFound.begin())];
    std::ostringstream text;
    text << "the hole at (" << seed.x << ", " << seed.y << ") is in no triangle.";
    throw std::invalid_argument(text.str());
  }
  spread(std::move(front), neighbors,
    [&](std::size_t from, std::size_t to)
    {
      const auto [a, b] = edgeOpposite(ids, from);
      const bool isNew = !isReached[to] && !edges.contains(a, b);
      isReached[to] = char(isReached[to] || isNew);
      return isNew;
    });
  return isReached;
}

template <typename Id>
std::int64_t keepInside(
  PointsView points, Buffer<Id>& ids, const std::vector<IdSegment>& edges, const Cuts& cuts)
{
  // Computes everything before triangles are removed, because then paths from outside would be
  // interrupted.
  const std::vector<std::int64_t> neighbors = neighborsOf(ids);
  std::vector<char> isRemoved(ids.size() / 3, 0);
  if (!cuts.Holes.empty())
  {
    isRemoved = reachedFrom(points, ids, neighbors, edges, cuts.Holes);
  }
  const auto removeLess = [&](const std::vector<int>& sums, int least)
  {
    for (std::size_t t = 0; t < sums.size(); ++t)
    {
      isRemoved[t] = char(isRemoved[t] || sums[t] < least);
    }
  };
  if (!cuts.Boundary.empty())
  {
    const ConstraintEdges boundary(cuts.Boundary);
    std::vector<int> sums =
      sumsFromOutside(ids, neighbors, [&](PointId a, PointId b) { return boundary.count(a, b); });
    std::transform(sums.begin(), sums.end(), sums.begin(), [](int sum) { return sum & 1; });
    removeLess(sums, 1);
  }
  std::int64_t inverted = 0;
  if (!cuts.Polygons.empty())
  {
    const ConstraintEdges polygons(cuts.Polygons);
    const std::vector<int> windings =
      sumsFromOutside(ids, neighbors, [&](PointId a, PointId b) { return polygons.balance(a, b); });
    const bool onlyHoles =
      std::none_of(windings.begin(), windings.end(), [](int winding) { return winding > 0; });
    inverted = onlyHoles
      ? 0
      : std::count_if(windings.begin(), windings.end(), [](int winding) { return winding < 0; });
    removeLess(windings, onlyHoles ? 0 : 1);
  }
  ids.truncate(
    3 * keepTriangles(ids.data(), ids.size() / 3, [&](std::size_t t) { return !isRemoved[t]; }));
  return inverted;
}

template <typename Id>
std::vector<PositionPair> edgesAround(PointsView points, const Buffer<Id>& ids,
  const std::vector<IdSegment>& segments, const std::vector<Point2>& seeds)
{
  const std::vector<std::int64_t> neighbors = neighborsOf(ids);
  const std::vector<char> isRemoved = reachedFrom(points, ids, neighbors, segments, seeds);
  std::vector<PositionPair> edges;
  for (std::size_t c = 0; c < ids.size(); ++c)
  {
    if (isRemoved[c / 3] && (neighbors[c] < 0 || !isRemoved[std::size_t(neighbors[c])]))
    {
      const auto [a, b] = edgeOpposite(ids, c);
      edges.push_back({ points[std::size_t(a)], points[std::size_t(b)] });
    }
  }
  return edges;
}

} // namespace

std::int64_t keepInside(PointsView points, Triangulation& triangulation,
  const std::vector<IdSegment>& edges, const Cuts& cuts)
{
  if (cuts.Polygons.empty() && cuts.Boundary.empty() && cuts.Holes.empty())
  {
    return 0;
  }
  const std::int64_t inverted = triangulation.Ids64.empty()
    ? keepInside(points, triangulation.Ids32, edges, cuts)
    : keepInside(points, triangulation.Ids64, edges, cuts);
  triangulation.Blocks.clear();
  return inverted;
}

std::vector<PositionPair> edgesAroundHoles(const std::vector<Point2>& hull,
  const std::vector<PositionPair>& segments, const std::vector<Point2>& seeds, int threads)
{
  // The holes depend only on the constraints and the hull, so their points are enough.
  std::vector<Point2> points = hull;
  std::vector<Constraint> constraints;
  for (const auto& [a, b] : segments)
  {
    constraints.push_back({ PointId(points.size()), PointId(points.size() + 1) });
    points.insert(points.end(), { a, b });
  }
  const PointsView view(points);
  TriangulationOptions options;
  options.Threads = threads;
  const ConstrainedTriangulation all =
    triangulateConstrained(view, constraints, CrossingRule::Refuse, options);
  return all.Mesh.Ids64.empty()
    ? edgesAround(view, all.Mesh.Ids32, all.Constraints.Segments, seeds)
    : edgesAround(view, all.Mesh.Ids64, all.Constraints.Segments, seeds);
}

void HullOfPoints::add(Point2 p)
{
  if (isFinite(p) && !this->isInside(p))
  {
    this->Points.push_back(p);
    if (this->Points.size() >= this->Most)
    {
      this->reduce();
      this->Most = std::max(this->Most, 2 * this->Points.size());
    }
  }
}

std::vector<Point2> HullOfPoints::corners()
{
  this->reduce();
  return this->Points;
}

bool HullOfPoints::isInside(Point2 p) const
{
  const std::size_t corners = this->Inner.size();
  for (std::size_t i = 0; i < corners; ++i)
  {
    if (orientation(this->Inner[i], this->Inner[i + 1 < corners ? i + 1 : 0], p) <= 0)
    {
      return false;
    }
  }
  return corners > 2;
}

/// Andrew's monotone chain algorithm.
void HullOfPoints::reduce()
{
  std::vector<Point2>& points = this->Points;
  std::sort(
    points.begin(), points.end(), [](Point2 a, Point2 b) { return lexicographicLess(a, b); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  std::vector<Point2> hull;
  const auto extend = [&hull](std::size_t fixed, Point2 p)
  {
    while (hull.size() > fixed && orientation(hull[hull.size() - 2], hull.back(), p) <= 0)
    {
      hull.pop_back();
    }
    hull.push_back(p);
  };
  std::for_each(points.begin(), points.end(), [&](Point2 p) { extend(1, p); });
  const std::size_t upper = hull.size();
  if (points.size() > 1)
  {
    std::for_each(points.rbegin() + 1, points.rend(), [&](Point2 p) { extend(upper, p); });
    hull.pop_back(); // equals the first corner
  }
  points = std::move(hull);
  constexpr std::size_t few = 8;
  this->Inner.clear();
  for (std::size_t i = 0; i < few && points.size() > 2; ++i)
  {
    const Point2 corner = points[points.size() * i / few];
    if (this->Inner.empty() || !(this->Inner.back() == corner))
    {
      this->Inner.push_back(corner);
    }
  }
}

} // namespace tipp
