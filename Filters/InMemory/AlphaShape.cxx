// SPDX-License-Identifier: BSD-3-Clause
#include "InMemory/AlphaShape.h"

#include "Parallel/ParallelFor.h"
#include "Parallel/Sort.h"
#include "Predicates/Vectors.h"

#include <algorithm>
#include <array>
#include <bitset>

namespace tipp
{
namespace
{

double squaredCircumradius(const std::array<Point3, 2>& ends)
{
  const Point3 side = ends[1] - ends[0];
  return 0.25 * dot(side, side);
}

double squaredCircumradius(const std::array<Point3, 3>& corners)
{
  const auto& [a, b, c] = corners;
  const Point3 normal = cross(b - a, c - a);
  // r = |ab| |bc| |ca| / (4 area); the normal's length is twice the area.
  return dot(b - a, b - a) * dot(c - b, c - b) * dot(a - c, a - c) / (4 * dot(normal, normal));
}

double squaredCircumradius(const std::array<Point3, 4>& corners)
{
  const auto& [a, b, c, d] = corners;
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

/// The point ids of a cell, or of a face.
template <typename Id, std::size_t Corners>
using Cell = std::array<Id, Corners>;

template <std::size_t Corners, typename Id>
Cell<Id, Corners> cellAt(const Buffer<Id>& cells, std::size_t number)
{
  Cell<Id, Corners> cell;
  std::copy_n(cells.data() + Corners * number, Corners, cell.begin());
  return cell;
}

/// Calls visit(face) for the faces of a cell that have this number of corners; their ids ascend.
template <std::size_t Corners, typename Id, std::size_t CellCorners, typename Visit>
void forEachFace(Cell<Id, CellCorners> cell, const Visit& visit)
{
  std::sort(cell.begin(), cell.end());
  for (unsigned chosen = 0; chosen < 1U << CellCorners; ++chosen)
  {
    const std::bitset<CellCorners> isChosen(chosen);
    if (isChosen.count() == Corners)
    {
      Cell<Id, Corners> face;
      std::size_t size = 0;
      for (std::size_t i = 0; i < CellCorners; ++i)
      {
        if (isChosen[i])
        {
          face[size++] = cell[i];
        }
      }
      visit(face);
    }
  }
}

template <typename Id, std::size_t Corners>
bool isSmall(Cell<Id, Corners> cell, const PointAt& pointAt, double alpha)
{
  std::sort(cell.begin(), cell.end()); // the order affects rounding
  std::array<Point3, Corners> points;
  for (std::size_t i = 0; i < Corners; ++i)
  {
    double p[3];
    pointAt(PointId(cell[i]), p);
    points[i] = { p[0], p[1], p[2] };
  }
  return squaredCircumradius(points) <= alpha * alpha;
}

template <std::size_t Corners, typename Id>
std::vector<char> smallCells(const Buffer<Id>& cells, const PointAt& pointAt, double alpha)
{
  std::vector<char> areSmall(cells.size() / Corners);
  const std::int64_t count = std::int64_t(areSmall.size());
  forIndices(count,
    [&](std::int64_t i) {
      areSmall[std::size_t(i)] = isSmall(cellAt<Corners>(cells, std::size_t(i)), pointAt, alpha);
    });
  return areSmall;
}

/// Returns the small faces of the cells that are not small, sorted.
template <std::size_t Corners, std::size_t CellCorners, typename Id>
std::vector<Cell<Id, Corners>> smallFacesOfLarge(
  const Buffer<Id>& cells, const std::vector<char>& areSmall, const PointAt& pointAt, double alpha)
{
  std::vector<Cell<Id, Corners>> faces;
  for (std::size_t i = 0; i < areSmall.size(); ++i)
  {
    if (!areSmall[i])
    {
      forEachFace<Corners>(cellAt<CellCorners>(cells, i),
        [&](const Cell<Id, Corners>& face)
        {
          if (isSmall(face, pointAt, alpha))
          {
            faces.push_back(face);
          }
        });
    }
  }
  sortUnique(faces);
  return faces;
}

/// Removes from the sorted `faces` those that are faces of `cells`. All ids are below `points`.
template <std::size_t CellCorners, typename Id, std::size_t Corners>
void removeFacesOf(
  const Buffer<Id>& cells, std::size_t points, std::vector<Cell<Id, Corners>>& faces)
{
  std::vector<char> isCorner(points, 0); // most cells are far from all faces
  for (const auto& face : faces)
  {
    for (const Id id : face)
    {
      isCorner[std::size_t(id)] = 1;
    }
  }
  std::vector<char> isFound(faces.size(), 0);
  const auto find = [&](const Cell<Id, Corners>& face)
  {
    const auto at = std::lower_bound(faces.begin(), faces.end(), face);
    if (at != faces.end() && *at == face)
    {
      __atomic_store_n(&isFound[std::size_t(at - faces.begin())], 1, __ATOMIC_RELAXED);
    }
  };
  const std::int64_t count = faces.empty() ? 0 : std::int64_t(cells.size() / CellCorners);
  forIndices(count,
    [&](std::int64_t i)
    {
      const auto cell = cellAt<CellCorners>(cells, std::size_t(i));
      const auto shared = std::count_if(
        cell.begin(), cell.end(), [&](Id id) { return isCorner[std::size_t(id)] != 0; });
      if (std::size_t(shared) >= Corners)
      {
        forEachFace<Corners>(cell, find);
      }
    });
  std::size_t left = 0;
  for (std::size_t i = 0; i < faces.size(); ++i)
  {
    if (!isFound[i])
    {
      faces[left++] = faces[i];
    }
  }
  faces.resize(left);
}

template <typename Id, std::size_t Corners>
Buffer<Id> joined(const std::vector<Cell<Id, Corners>>& cells)
{
  Buffer<Id> ids(Corners * cells.size());
  std::copy(cells.begin(), cells.end(), ids.template as<Cell<Id, Corners>>());
  return ids;
}

} // namespace

template <std::size_t Corners, typename Id>
AlphaShape<Id> alphaShape(
  const Buffer<Id>& cells, const PointAt& pointAt, double alpha, std::vector<char> covered)
{
  const std::vector<char> areSmall = smallCells<Corners>(cells, pointAt, alpha);
  AlphaShape<Id> shape;
  Buffer<Id>& kept = Corners == 4 ? shape.Tetrahedra : shape.Triangles;
  kept = Buffer<Id>(Corners * std::size_t(std::count(areSmall.begin(), areSmall.end(), 1)));
  Id* out = kept.data();
  for (std::size_t i = 0; i < areSmall.size(); ++i)
  {
    out = areSmall[i] ? std::copy_n(&cells[Corners * i], Corners, out) : out;
  }
  auto lines = smallFacesOfLarge<2, Corners>(cells, areSmall, pointAt, alpha);
  removeFacesOf<Corners>(kept, covered.size(), lines);
  if constexpr (Corners == 4)
  {
    auto triangles = smallFacesOfLarge<3, 4>(cells, areSmall, pointAt, alpha);
    removeFacesOf<4>(kept, covered.size(), triangles);
    shape.Triangles = joined(triangles);
    removeFacesOf<3>(shape.Triangles, covered.size(), lines);
  }
  shape.Lines = joined(lines);
  for (const Buffer<Id>* of : { &shape.Tetrahedra, &shape.Triangles, &shape.Lines })
  {
    for (const Id point : *of)
    {
      covered[std::size_t(point)] = 1;
    }
  }
  shape.Vertices = Buffer<Id>(std::size_t(std::count(covered.begin(), covered.end(), 0)));
  out = shape.Vertices.data();
  for (std::size_t i = 0; i < covered.size(); ++i)
  {
    if (!covered[i])
    {
      *out++ = Id(i);
    }
  }
  return shape;
}

template AlphaShape<std::int32_t> alphaShape<3>(
  const Buffer<std::int32_t>&, const PointAt&, double, std::vector<char>);
template AlphaShape<std::int64_t> alphaShape<3>(
  const Buffer<std::int64_t>&, const PointAt&, double, std::vector<char>);
template AlphaShape<std::int32_t> alphaShape<4>(
  const Buffer<std::int32_t>&, const PointAt&, double, std::vector<char>);

} // namespace tipp
