// SPDX-License-Identifier: BSD-3-Clause
#include "InMemory/AlphaShape.h"

#include "Arrays/SortUnique.h"

#include <algorithm>
#include <utility>

namespace tipp
{

namespace
{

template <typename Id>
using Edge = std::pair<Id, Id>; // point ids, the lower first

template <typename Id>
Edge<Id> edgeOf(const Id* triangle, int i)
{
  return std::minmax({ triangle[i], triangle[(i + 1) % 3] });
}

double squaredDistance(const double a[3], const double b[3])
{
  return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
    (a[2] - b[2]) * (a[2] - b[2]);
}

double squaredCircumradius(const double a[3], const double b[3], const double c[3])
{
  const double ab[3] = { b[0] - a[0], b[1] - a[1], b[2] - a[2] };
  const double ac[3] = { c[0] - a[0], c[1] - a[1], c[2] - a[2] };
  const double normal[3] = { ab[1] * ac[2] - ab[2] * ac[1], ab[2] * ac[0] - ab[0] * ac[2],
    ab[0] * ac[1] - ab[1] * ac[0] };
  const double squaredNormal =
    normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
  // r = |ab| |bc| |ca| / (4 area); the normal's length is twice the area.
  return squaredDistance(a, b) * squaredDistance(b, c) * squaredDistance(c, a) /
    (4 * squaredNormal);
}

template <typename Id>
bool isSmall(const Id* triangle, const PointAt& pointAt, double alpha)
{
  double p[3][3];
  for (int i = 0; i < 3; ++i)
  {
    pointAt(PointId(triangle[i]), p[i]);
  }
  return squaredCircumradius(p[0], p[1], p[2]) <= alpha * alpha;
}

template <typename Id>
bool isShort(Edge<Id> edge, const PointAt& pointAt, double alpha)
{
  double p[2][3];
  pointAt(PointId(edge.first), p[0]);
  pointAt(PointId(edge.second), p[1]);
  return 0.25 * squaredDistance(p[0], p[1]) <= alpha * alpha;
}

template <typename Id>
std::vector<char> smallTriangles(const Buffer<Id>& triangles, const PointAt& pointAt, double alpha)
{
  std::vector<char> kept(triangles.size() / 3);
  const std::int64_t count = std::int64_t(kept.size());
#pragma omp parallel for
  for (std::int64_t t = 0; t < count; ++t)
  {
    kept[t] = isSmall(triangles.data() + 3 * t, pointAt, alpha);
  }
  return kept;
}

template <typename Id>
std::vector<Edge<Id>> shortEdgesOfDropped(
  const Buffer<Id>& triangles, const std::vector<char>& kept, const PointAt& pointAt, double alpha)
{
  std::vector<Edge<Id>> edges;
  for (std::size_t t = 0; t < kept.size(); ++t)
  {
    for (int i = 0; i < 3 && !kept[t]; ++i)
    {
      const Edge<Id> edge = edgeOf(triangles.data() + 3 * t, i);
      if (isShort(edge, pointAt, alpha))
      {
        edges.push_back(edge);
      }
    }
  }
  sortUnique(edges);
  return edges;
}

/// Selects the groups of `size` ids, ids(0), ids(1) and so on, whose mark is `wanted`, in order.
template <typename Ids, typename Id>
void select(const Ids& ids, std::size_t size, const std::vector<char>& marks, char wanted,
  Buffer<Id>& selected)
{
  selected = Buffer<Id>(size * std::size_t(std::count(marks.begin(), marks.end(), wanted)));
  Id* out = selected.data();
  for (std::size_t i = 0; i < marks.size(); ++i)
  {
    for (std::size_t k = 0; k < size && marks[i] == wanted; ++k)
    {
      *out++ = ids(size * i + k);
    }
  }
}

/// Returns the edges that belong to no kept triangle, in their order.
template <typename Id>
Buffer<Id> linesOutside(const std::vector<Edge<Id>>& edges, const Buffer<Id>& keptTriangles)
{
  std::vector<char> inside(edges.size(), 0);
  const std::int64_t count = edges.empty() ? 0 : std::int64_t(keptTriangles.size() / 3);
#pragma omp parallel for
  for (std::int64_t t = 0; t < count; ++t)
  {
    for (int i = 0; i < 3; ++i)
    {
      const Edge<Id> edge = edgeOf(keptTriangles.data() + 3 * t, i);
      const auto at = std::lower_bound(edges.begin(), edges.end(), edge);
      if (at != edges.end() && *at == edge)
      {
        char& mark = inside[std::size_t(at - edges.begin())];
#pragma omp atomic write
        mark = 1;
      }
    }
  }
  Buffer<Id> lines;
  select([&](std::size_t i) { return i % 2 == 0 ? edges[i / 2].first : edges[i / 2].second; }, 2,
    inside, 0, lines);
  return lines;
}

} // namespace

std::vector<char> coveredPoints(const Triangulation& triangulation, std::int64_t points)
{
  std::vector<char> covered(std::size_t(points), 0);
  for (const Duplicate& duplicate : triangulation.Duplicates)
  {
    covered[std::size_t(duplicate.Point)] = 1;
  }
  for (const PointId rejected : triangulation.Rejected)
  {
    covered[std::size_t(rejected)] = 1;
  }
  return covered;
}

template <typename Id>
AlphaShape<Id> alphaShape(
  const Buffer<Id>& triangles, const PointAt& pointAt, double alpha, std::vector<char> covered)
{
  const std::vector<char> kept = smallTriangles(triangles, pointAt, alpha);
  AlphaShape<Id> shape;
  select([&](std::size_t i) { return triangles[i]; }, 3, kept, 1, shape.Triangles);
  shape.Lines = linesOutside(shortEdgesOfDropped(triangles, kept, pointAt, alpha), shape.Triangles);
  for (const Buffer<Id>* cells : { &shape.Triangles, &shape.Lines })
  {
    for (Id point : *cells)
    {
      covered[std::size_t(point)] = 1;
    }
  }
  select([](std::size_t i) { return Id(i); }, 1, covered, 0, shape.Vertices);
  return shape;
}

template AlphaShape<std::int32_t> alphaShape(
  const Buffer<std::int32_t>&, const PointAt&, double, std::vector<char>);
template AlphaShape<std::int64_t> alphaShape(
  const Buffer<std::int64_t>&, const PointAt&, double, std::vector<char>);

} // namespace tipp
