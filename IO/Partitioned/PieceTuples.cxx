// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/PieceTuples.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace tipp
{

void copyPiecePoint(const PieceArray& array, const double* row, const PointRowLayout& rows,
  bool isGhost, std::int64_t representative, char* to)
{
  const std::int64_t id = rows.id(row);
  switch (array.Role)
  {
    case PieceRole::Points:
    {
      const double xyz[3] = { row[0], row[1], rows.Z < 0 ? 0 : row[rows.Z] };
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
      const int word = rows.Attributes[std::size_t(array.Attribute)];
      const void* const from = word < 0 ? static_cast<const void*>(&representative) : row + word;
      std::memcpy(to, from, 8);
    }
  }
}

void fillPieceCells(const PieceArray& array, std::int64_t first, std::size_t count, char* to)
{
  constexpr int vtkTriangle = 5;
  if (array.Role == PieceRole::Types)
  {
    std::memset(to, vtkTriangle, count);
    return;
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto end = std::int32_t(3 * (first + std::int64_t(i) + 1));
    std::memcpy(to + 4 * i, &end, 4);
  }
}

void extendBounds(Bounds& bounds, const double* row, const PointRowLayout& rows)
{
  const double xyz[3] = { row[0], row[1], rows.Z < 0 ? 0 : row[rows.Z] };
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
