// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation3D/AlphaShape3.h"

#include "Arrays/SortUnique.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace tipp
{
namespace
{

using Facet = std::array<std::int32_t, 3>; ///< point ids, ascending
using Edge = std::array<std::int32_t, 2>;  ///< point ids, ascending

Point3 cross(const Point3& u, const Point3& v)
{
  return { u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x };
}

double dot(const Point3& u, const Point3& v)
{
  return u.x * v.x + u.y * v.y + u.z * v.z;
}

double squaredCircumradius(const Point3& a, const Point3& b, const Point3& c, const Point3& d)
{
  const Point3 u = b - a;
  const Point3 v = c - a;
  const Point3 w = d - a;
  const Point3 vw = cross(v, w);
  const Point3 wu = cross(w, u);
  const Point3 uv = cross(u, v);
  const double uu = dot(u, u);
  const double vv = dot(v, v);
  const double ww = dot(w, w);
  const Point3 n = { uu * vw.x + vv * wu.x + ww * uv.x, uu * vw.y + vv * wu.y + ww * uv.y,
    uu * vw.z + vv * wu.z + ww * uv.z };
  const double volume = 2 * dot(u, vw);
  return dot(n, n) / (volume * volume);
}

double squaredCircumradius(const Point3& a, const Point3& b, const Point3& c)
{
  const Point3 normal = cross(b - a, c - a);
  // r = |ab| |bc| |ca| / (4 area); the normal's length is twice the area.
  return dot(b - a, b - a) * dot(c - b, c - b) * dot(a - c, a - c) / (4 * dot(normal, normal));
}

/// Returns the facet opposite to corner i of a tetrahedron, ids ascending.
Facet facetOf(const std::int32_t* cell, std::size_t i)
{
  Facet facet = { cell[(i + 1) % 4], cell[(i + 2) % 4], cell[(i + 3) % 4] };
  std::sort(facet.begin(), facet.end());
  return facet;
}

std::array<Edge, 6> edgesOf(const std::int32_t* cell)
{
  const auto edge = [cell](std::size_t i, std::size_t j) {
    return Edge{ std::min(cell[i], cell[j]), std::max(cell[i], cell[j]) };
  };
  return { edge(0, 1), edge(0, 2), edge(0, 3), edge(1, 2), edge(1, 3), edge(2, 3) };
}

/// Returns the cells that are not in `others`; both lists are sorted.
template <typename Cell>
std::vector<Cell> without(const std::vector<Cell>& cells, const std::vector<Cell>& others)
{
  std::vector<Cell> left;
  std::set_difference(
    cells.begin(), cells.end(), others.begin(), others.end(), std::back_inserter(left));
  return left;
}

template <typename Cell>
std::vector<std::int32_t> joined(const std::vector<Cell>& cells)
{
  std::vector<std::int32_t> ids;
  ids.reserve(cells.size() * std::tuple_size<Cell>::value);
  for (const Cell& cell : cells)
  {
    ids.insert(ids.end(), cell.begin(), cell.end());
  }
  return ids;
}

/// Facets and edges of large cells that are themselves small, and the facets and edges of kept
/// cells that may equal them: those at a point of a large cell.
struct Faces
{
  std::vector<Facet> Facets;
  std::vector<Edge> Edges;
  std::vector<Facet> KeptFacets;
  std::vector<Edge> KeptEdges;
};

Faces facesOf(const Tetrahedralization& mesh, const std::vector<char>& kept, const Point3* points,
  std::size_t count, double square)
{
  std::vector<char> atLarge(count, 0);
  Faces faces;
  const auto at = [points](std::int32_t id) { return points[std::size_t(id)]; };
  for (std::size_t t = 0; t < kept.size(); ++t)
  {
    const std::int32_t* const cell = &mesh.Ids[4 * t];
    for (std::size_t i = 0; i < 4 && kept[t] == 0; ++i)
    {
      atLarge[std::size_t(cell[i])] = 1;
      const Facet f = facetOf(cell, i);
      if (squaredCircumradius(at(f[0]), at(f[1]), at(f[2])) <= square)
      {
        faces.Facets.push_back(f);
      }
    }
    if (kept[t] == 0)
    {
      for (const Edge& e : edgesOf(cell))
      {
        const Point3 side = at(e[1]) - at(e[0]);
        if (0.25 * dot(side, side) <= square)
        {
          faces.Edges.push_back(e);
        }
      }
    }
  }
  const auto isAtLarge = [&](std::int32_t id) { return atLarge[std::size_t(id)] != 0; };
  for (std::size_t t = 0; t < kept.size(); ++t)
  {
    const std::int32_t* const cell = &mesh.Ids[4 * t];
    if (kept[t] == 0 || std::none_of(cell, cell + 4, isAtLarge))
    {
      continue;
    }
    for (std::size_t i = 0; i < 4; ++i)
    {
      faces.KeptFacets.push_back(facetOf(cell, i));
    }
    const auto edges = edgesOf(cell);
    faces.KeptEdges.insert(faces.KeptEdges.end(), edges.begin(), edges.end());
  }
  return faces;
}

} // namespace

AlphaShape3 alphaShape(
  const Tetrahedralization& mesh, const Point3* points, std::size_t count, double alpha)
{
  const double square = alpha * alpha;
  std::vector<char> kept(mesh.cellCount());
  const auto cells = std::int64_t(kept.size());
#pragma omp parallel for
  for (std::int64_t t = 0; t < cells; ++t)
  {
    const std::int32_t* const cell = &mesh.Ids[4 * std::size_t(t)];
    kept[std::size_t(t)] = squaredCircumradius(points[cell[0]], points[cell[1]], points[cell[2]],
                             points[cell[3]]) <= square
      ? 1
      : 0;
  }
  AlphaShape3 shape;
  shape.Tetrahedra =
    Buffer<std::int32_t>(4 * std::size_t(std::count(kept.begin(), kept.end(), char(1))));
  std::int32_t* out = shape.Tetrahedra.data();
  for (std::size_t t = 0; t < kept.size(); ++t)
  {
    out = kept[t] != 0 ? std::copy_n(&mesh.Ids[4 * t], 4, out) : out;
  }
  Faces faces = facesOf(mesh, kept, points, count, square);
  sortUnique(faces.Facets);
  sortUnique(faces.KeptFacets);
  const std::vector<Facet> triangles = without(faces.Facets, faces.KeptFacets);
  for (const Facet& f : triangles)
  {
    faces.KeptEdges.insert(
      faces.KeptEdges.end(), { Edge{ f[0], f[1] }, Edge{ f[0], f[2] }, Edge{ f[1], f[2] } });
  }
  sortUnique(faces.Edges);
  sortUnique(faces.KeptEdges);
  shape.Triangles = joined(triangles);
  shape.Lines = joined(without(faces.Edges, faces.KeptEdges));
  std::vector<char> covered(count, 0);
  const auto cover = [&](std::int64_t id) { covered[std::size_t(id)] = 1; };
  std::for_each(shape.Tetrahedra.begin(), shape.Tetrahedra.end(), cover);
  std::for_each(shape.Triangles.begin(), shape.Triangles.end(), cover);
  std::for_each(shape.Lines.begin(), shape.Lines.end(), cover);
  std::for_each(mesh.Rejected.begin(), mesh.Rejected.end(), cover);
  for (const Duplicate& duplicate : mesh.Duplicates)
  {
    cover(duplicate.Point);
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    if (covered[i] == 0)
    {
      shape.Vertices.push_back(std::int32_t(i));
    }
  }
  return shape;
}

Buffer<std::int64_t> neighborIds(const Tetrahedralization& mesh, std::size_t points)
{
  const std::size_t cells = mesh.cellCount();
  Buffer<std::int64_t> neighbors(4 * cells);
  // Sort facets by their lowest id. A facet is 4 * tetrahedron + i, where corner i is opposite to
  // it.
  std::vector<std::size_t> ends(points + 1, 0);
  for (std::size_t slot = 0; slot < 4 * cells; ++slot)
  {
    ++ends[std::size_t(facetOf(&mesh.Ids[slot / 4 * 4], slot % 4)[0]) + 1];
  }
  for (std::size_t i = 0; i < points; ++i)
  {
    ends[i + 1] += ends[i];
  }
  Buffer<std::size_t> slots(4 * cells);
  for (std::size_t slot = 0; slot < 4 * cells; ++slot)
  {
    slots[ends[std::size_t(facetOf(&mesh.Ids[slot / 4 * 4], slot % 4)[0])]++] = slot;
  }
  const auto count = std::int64_t(points);
#pragma omp parallel for schedule(dynamic, 4096)
  for (std::int64_t point = 0; point < count; ++point)
  {
    std::vector<std::pair<Facet, std::size_t>> own;
    const auto p = std::size_t(point);
    for (std::size_t i = p == 0 ? 0 : ends[p - 1]; i < ends[p]; ++i)
    {
      own.emplace_back(facetOf(&mesh.Ids[slots[i] / 4 * 4], slots[i] % 4), slots[i]);
      neighbors[slots[i]] = -1;
    }
    std::sort(own.begin(), own.end());
    for (std::size_t i = 0; i + 1 < own.size(); ++i)
    {
      if (own[i].first == own[i + 1].first)
      {
        neighbors[own[i].second] = std::int64_t(own[i + 1].second / 4);
        neighbors[own[i + 1].second] = std::int64_t(own[i].second / 4);
      }
    }
  }
  return neighbors;
}

Buffer<std::int64_t> representativeIds(const Tetrahedralization& mesh, std::size_t points)
{
  Buffer<std::int64_t> ids(points);
  for (std::size_t i = 0; i < points; ++i)
  {
    ids[i] = std::int64_t(i);
  }
  for (const Duplicate& duplicate : mesh.Duplicates)
  {
    ids[std::size_t(duplicate.Point)] = duplicate.Representative;
  }
  for (const PointId rejected : mesh.Rejected)
  {
    ids[std::size_t(rejected)] = -1;
  }
  return ids;
}

} // namespace tipp
