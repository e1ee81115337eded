// SPDX-License-Identifier: BSD-3-Clause
#include "AlphaShape/AlphaShape.h"

#include "vtkMath.h"
#include "vtkPoints.h"

#include <algorithm>
#include <utility>

namespace tipp
{

namespace
{

template <typename Id>
using Edge = std::pair<Id, Id>; // the lower id first

template <typename Id>
Edge<Id> edgeOf(const Id* triangle, int i)
{
  return std::minmax({ triangle[i], triangle[(i + 1) % 3] });
}

double squaredCircumradius(const double a[3], const double b[3], const double c[3])
{
  double ab[3];
  double ac[3];
  double normal[3];
  vtkMath::Subtract(b, a, ab);
  vtkMath::Subtract(c, a, ac);
  vtkMath::Cross(ab, ac, normal);
  // r = |ab| |bc| |ca| / (4 area), and the normal is twice the area long.
  return vtkMath::Distance2BetweenPoints(a, b) * vtkMath::Distance2BetweenPoints(b, c) *
         vtkMath::Distance2BetweenPoints(c, a) / (4 * vtkMath::Dot(normal, normal));
}

template <typename Id>
bool isSmall(const Id* triangle, vtkPoints* points, double alpha)
{
  double p[3][3];
  for (int i = 0; i < 3; ++i)
  {
    points->GetPoint(vtkIdType(triangle[i]), p[i]);
  }
  return squaredCircumradius(p[0], p[1], p[2]) <= alpha * alpha;
}

template <typename Id>
bool isShort(Edge<Id> edge, vtkPoints* points, double alpha)
{
  double p[2][3];
  points->GetPoint(vtkIdType(edge.first), p[0]);
  points->GetPoint(vtkIdType(edge.second), p[1]);
  return 0.25 * vtkMath::Distance2BetweenPoints(p[0], p[1]) <= alpha * alpha;
}

template <typename Id>
std::vector<char> smallTriangles(const Buffer<Id>& triangles, vtkPoints* points, double alpha)
{
  std::vector<char> kept(triangles.size() / 3);
  const std::int64_t count = std::int64_t(kept.size());
#pragma omp parallel for
  for (std::int64_t t = 0; t < count; ++t)
  {
    kept[t] = isSmall(triangles.data() + 3 * t, points, alpha);
  }
  return kept;
}

template <typename Id>
std::vector<Edge<Id>> shortEdgesOfDropped(const Buffer<Id>& triangles,
  const std::vector<char>& kept,
  vtkPoints* points,
  double alpha)
{
  std::vector<Edge<Id>> edges;
  for (std::size_t t = 0; t < kept.size(); ++t)
  {
    for (int i = 0; i < 3 && !kept[t]; ++i)
    {
      const Edge<Id> edge = edgeOf(triangles.data() + 3 * t, i);
      if (isShort(edge, points, alpha))
      {
        edges.push_back(edge);
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// The edges, in order, that no kept triangle has.
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
  Buffer<Id> lines(2 * std::size_t(std::count(inside.begin(), inside.end(), 0)));
  std::size_t at = 0;
  for (std::size_t e = 0; e < edges.size(); ++e)
  {
    if (!inside[e])
    {
      lines[at++] = edges[e].first;
      lines[at++] = edges[e].second;
    }
  }
  return lines;
}

template <typename Id>
Buffer<Id> compacted(const Buffer<Id>& triangles, const std::vector<char>& kept)
{
  Buffer<Id> result(3 * std::size_t(std::count(kept.begin(), kept.end(), 1)));
  std::size_t at = 0;
  for (std::size_t t = 0; t < kept.size(); ++t)
  {
    if (kept[t])
    {
      std::copy_n(triangles.data() + 3 * t, 3, result.data() + at);
      at += 3;
    }
  }
  return result;
}

template <typename Id>
Buffer<Id> uncovered(const std::vector<char>& covered)
{
  Buffer<Id> result(std::size_t(std::count(covered.begin(), covered.end(), 0)));
  std::size_t at = 0;
  for (std::size_t p = 0; p < covered.size(); ++p)
  {
    if (!covered[p])
    {
      result[at++] = Id(p);
    }
  }
  return result;
}

} // namespace

template <typename Id>
AlphaShape<Id> alphaShape(const Buffer<Id>& triangles,
  vtkPoints* points,
  double alpha,
  std::vector<char> covered)
{
  const std::vector<char> kept = smallTriangles(triangles, points, alpha);
  AlphaShape<Id> shape;
  shape.Triangles = compacted(triangles, kept);
  shape.Lines = linesOutside(shortEdgesOfDropped(triangles, kept, points, alpha), shape.Triangles);
  for (const Buffer<Id>* cells : { &shape.Triangles, &shape.Lines })
  {
    for (Id point : *cells)
    {
      covered[std::size_t(point)] = 1;
    }
  }
  shape.Vertices = uncovered<Id>(covered);
  return shape;
}

template AlphaShape<std::int32_t> alphaShape(const Buffer<std::int32_t>&,
  vtkPoints*,
  double,
  std::vector<char>);
template AlphaShape<std::int64_t> alphaShape(const Buffer<std::int64_t>&,
  vtkPoints*,
  double,
  std::vector<char>);

} // namespace tipp
