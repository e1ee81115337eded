// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation3D/MergeClosePoints3.h"

#include "Triangulation3D/Tiling3.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace tipp
{
namespace
{

/// A hash table of the kept points by grid cell. Cells are at least twice as wide as the distance,
/// so all points close to a position are in the cells within half a cell's width of it.
class HashGrid3
{
public:
  HashGrid3(std::size_t capacity, double distance, double largestCoordinate)
    : Distance(distance)
    // Cells are so wide that cell indices are below 2^41; there `reach` exceeds half a cell by more
    // than the rounding errors.
    , Cell(std::max(
        { 2 * distance, std::ldexp(largestCoordinate, -40), std::numeric_limits<double>::min() }))
  {
    std::size_t slots = 1;
    while (slots < capacity)
    {
      slots *= 2;
    }
    this->First.assign(slots, -1);
  }

  /// Returns the index of the first kept point within the distance, or -1.
  PointId find(const Point3& p) const
  {
    constexpr double reach = 0.5 + 1.0 / 1024;
    const std::array<double, 3> at = { p.x, p.y, p.z };
    PointId found = -1;
    for (unsigned corner = 0; corner < 8; ++corner)
    {
      std::array<std::int64_t, 3> cell;
      bool isOther = true; // other than the cells of previous corners
      for (std::size_t k = 0; k < 3; ++k)
      {
        const bool isHigh = (corner >> k & 1) != 0;
        cell[k] = this->index(at[k], isHigh ? reach : -reach);
        isOther = isOther && !(isHigh && cell[k] == this->index(at[k], -reach));
      }
      for (PointId i = isOther ? this->First[this->slot(cell)] : -1; i >= 0;
           i = this->Next[std::size_t(i)])
      {
        if ((found < 0 || i < found) && this->isClose(i, p))
        {
          found = i;
        }
      }
    }
    return found;
  }

  void keep(const Point3& p)
  {
    const std::size_t at =
      this->slot({ this->index(p.x, 0), this->index(p.y, 0), this->index(p.z, 0) });
    this->Next.push_back(std::exchange(this->First[at], PointId(this->Kept.size())));
    this->Kept.push_back(p);
  }

  const std::vector<Point3>& kept() const { return this->Kept; }

private:
  std::int64_t index(double coordinate, double cellsAway) const
  {
    return std::int64_t(std::floor(coordinate / this->Cell + cellsAway));
  }

  std::size_t slot(const std::array<std::int64_t, 3>& cell) const
  {
    std::uint64_t hash = 0;
    for (const std::int64_t index : cell)
    {
      hash = (hash ^ std::uint64_t(index)) * 0x9e3779b97f4a7c15U;
      hash ^= hash >> 32;
    }
    return hash & (this->First.size() - 1);
  }

  bool isClose(PointId i, const Point3& p) const
  {
    const Point3 d = p - this->Kept[std::size_t(i)];
    return std::hypot(d.x, d.y, d.z) <= this->Distance;
  }

  double Distance;
  double Cell;
  std::vector<PointId> First;
  std::vector<PointId> Next;
  std::vector<Point3> Kept;
};

} // namespace

Tetrahedralization tetrahedralizeMerged(const Point3* points, std::size_t count, double distance,
  const TetrahedralizationOptions& options)
{
  double largest = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    if (isFinite(points[i]))
    {
      largest = std::max(
        { largest, std::fabs(points[i].x), std::fabs(points[i].y), std::fabs(points[i].z) });
    }
  }
  HashGrid3 grid(count, distance, largest);
  std::vector<std::int32_t> ids; // original ids of the kept points, ascending
  std::vector<Duplicate> duplicates;
  std::vector<PointId> rejected;
  for (std::size_t i = 0; i < count; ++i)
  {
    const PointId close = isFinite(points[i]) ? grid.find(points[i]) : -1;
    if (!isFinite(points[i]))
    {
      rejected.push_back(PointId(i));
    }
    else if (close >= 0)
    {
      duplicates.push_back({ PointId(i), ids[std::size_t(close)] });
    }
    else
    {
      grid.keep(points[i]);
      ids.push_back(std::int32_t(i));
    }
  }
  Tetrahedralization mesh = tetrahedralize(grid.kept().data(), grid.kept().size(), options);
  // The ids keep their order, so the tetrahedra do, too.
  for (std::int32_t& id : mesh.Ids)
  {
    id = ids[std::size_t(id)];
  }
  mesh.Duplicates = std::move(duplicates);
  mesh.Rejected = std::move(rejected);
  return mesh;
}

} // namespace tipp
