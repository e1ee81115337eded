// SPDX-License-Identifier: BSD-3-Clause
#include "Query/PartTopology.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace tipp
{
namespace
{

/// A map from global ids to local indices; none if the ids are the indices.
std::optional<GlobalIdMap> mapOf(const std::int64_t* ids, std::int64_t count)
{
  if (!ids)
  {
    return std::nullopt;
  }
  const auto size = std::size_t(count);
  if (std::is_sorted(ids, ids + size))
  {
    return GlobalIdMap(ids, nullptr, size);
  }
  std::vector<std::int64_t> order(size);
  std::iota(order.begin(), order.end(), std::int64_t(0));
  std::sort(order.begin(), order.end(), [ids](auto a, auto b) { return ids[a] < ids[b]; });
  std::vector<std::int64_t> sorted(size);
  std::transform(order.begin(), order.end(), sorted.begin(), [ids](auto i) { return ids[i]; });
  return GlobalIdMap(sorted.data(), order.data(), size);
}

} // namespace

PartTopology::PartTopology(const MeshPart& part)
  : Ids(part.Mesh.Ids)
  , Wide(part.Mesh.Wide)
  , Corners(part.Mesh.Dimension + 1)
  , Points(part.Mesh.PointCount)
  , AllCells(part.Mesh.Cells)
  , Starts(std::size_t(part.Mesh.PointCount) + 1, 0)
  , PointMap(mapOf(part.PointIds, part.Mesh.PointCount))
  , CellMap(mapOf(part.CellIds, part.Mesh.Cells))
{
  if (this->AllCells > std::numeric_limits<std::int32_t>::max())
  {
    throw std::length_error("More than 2147483647 cells in one piece; partition the mesh first.");
  }
  const auto forCorners = [&](const auto& work)
  {
    for (std::int64_t cell = 0; cell < this->AllCells; ++cell)
    {
      for (int i = 0; i < this->Corners && !part.isHidden(cell); ++i)
      {
        const std::int64_t point = this->corner(cell, i);
        bool isRepeated = false;
        for (int k = 0; k < i; ++k)
        {
          isRepeated = isRepeated || this->corner(cell, k) == point;
        }
        isRepeated ? void() : work(std::size_t(point), cell);
      }
    }
  };
  forCorners([&](std::size_t point, std::int64_t) { ++this->Starts[point + 1]; });
  std::partial_sum(this->Starts.begin(), this->Starts.end(), this->Starts.begin());
  this->AtPoints.resize(std::size_t(this->Starts.back()));
  std::vector<std::int64_t> next(this->Starts.begin(), this->Starts.end() - 1);
  forCorners([&](std::size_t point, std::int64_t cell)
    { this->AtPoints[std::size_t(next[point]++)] = std::int32_t(cell); });
}

} // namespace tipp
