// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/PointRows.h"

#include <algorithm>
#include <cmath>

namespace tipp
{

std::uint64_t hashTriangle(std::int64_t a, std::int64_t b, std::int64_t c)
{
  const auto mix = [](std::uint64_t x) // the finaliser of splitmix64
  {
    x += 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31);
  };
  // A sum over directed edges is independent of which corner comes first.
  const auto edge = [&](std::int64_t from, std::int64_t to)
  { return mix(mix(std::uint64_t(from)) + std::uint64_t(to)); };
  return mix(edge(a, b) + edge(b, c) + edge(c, a));
}

std::uint64_t sumTriangles(
  const TriangleRange& triangles, const double* rows, const PointRowLayout& layout)
{
  const auto id = [&](std::int32_t point)
  { return layout.id(rows + std::size_t(point) * layout.Words); };
  std::uint64_t sum = 0;
  const std::int32_t* corner = triangles.Begin;
  for (std::size_t t = 0; t < triangles.Triangles; ++t, corner += 3)
  {
    sum += hashTriangle(id(corner[0]), id(corner[1]), id(corner[2]));
  }
  return sum;
}

void copyPoint(const PieceArray& array, const double* row, const PointRowLayout& layout,
  bool isGhost, std::int64_t representative, char* to)
{
  const std::int64_t id = layout.id(row);
  switch (array.Role)
  {
    case PieceRole::Points:
    {
      const double xyz[3] = { row[0], row[1], layout.Z < 0 ? 0 : row[layout.Z] };
      std::memcpy(to, xyz, sizeof(xyz));
      break;
    }
    case PieceRole::PointIds:
      std::memcpy(to, &id, sizeof(id));
      break;
    case PieceRole::PointGhosts:
      *to = isGhost ? 1 : 0;
      break;
    default:
    {
      const int word = layout.Attributes[std::size_t(array.Attribute)];
      const void* const from = word < 0 ? static_cast<const void*>(&representative) : row + word;
      std::memcpy(to, from, 8);
    }
  }
}

void extendBounds(Bounds& bounds, const double* row, const PointRowLayout& layout)
{
  const double xyz[3] = { row[0], row[1], layout.Z < 0 ? 0 : row[layout.Z] };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (std::isfinite(xyz[axis])) // a z coordinate may be NaN or infinite
    {
      bounds[2 * axis] = std::min(bounds[2 * axis], xyz[axis]);
      bounds[2 * axis + 1] = std::max(bounds[2 * axis + 1], xyz[axis]);
    }
  }
}

} // namespace tipp
