// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/Hull.h"

#include "Triangulation/Dimension.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace tipp
{
namespace
{

/// Artificial points, which are on the sides of a box, in groups of neighbours with boxes of their
/// own.
template <int D>
class ArtificialGroups
{
public:
  explicit ArtificialGroups(const std::vector<VertexOf<Point<D>>>& artificial)
  {
    for (const VertexOf<Point<D>>& z : artificial)
    {
      this->Bounds.extend(z.Position);
    }
    std::array<std::vector<Point<D>>, std::size_t(2 * D)> sides;
    for (const VertexOf<Point<D>>& z : artificial)
    {
      sides[this->sideOf(z.Position)].push_back(z.Position);
    }
    for (const std::vector<Point<D>>& side : sides)
    {
      this->addGroups(side);
    }
  }

  /// Whether the cell is in conflict with one of the points.
  bool areInConflict(const std::array<Point<D>, D + 1>& corners) const
  {
    const typename Dimension<D>::Ball ball = ballOf<D>(corners);
    const Box<D> reach = ball.bounds();
    bool isFarFromSides = true;
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      isFarFromSides = isFarFromSides && this->Bounds.Min[axis] < reach.Min[axis] &&
        reach.Max[axis] < this->Bounds.Max[axis];
    }
    const auto isInConflict = [&](const Point<D>& p)
    { return ball.meets(Box<D>::of(p)) && Dimension<D>::isInConflict(corners, p); };
    return !isFarFromSides &&
      std::any_of(this->Groups.begin(), this->Groups.end(),
        [&](const Group& group)
        {
          return ball.meets(group.Bounds) &&
            std::any_of(group.Points.begin(), group.Points.end(), isInConflict);
        });
  }

private:
  struct Group
  {
    Box<D> Bounds = Box<D>::empty();
    std::vector<Point<D>> Points;
  };

  /// Returns the first side that the point is on.
  std::size_t sideOf(const Point<D>& p) const
  {
    std::size_t side = 0;
    while (side + 1 < std::size_t(2 * D) &&
      p[side / 2] != (side % 2 == 0 ? this->Bounds.Min : this->Bounds.Max)[side / 2])
    {
      ++side;
    }
    return side;
  }

  void addGroups(const std::vector<Point<D>>& side)
  {
    constexpr std::size_t most = 16;
    for (std::size_t i = 0; i < side.size(); ++i)
    {
      if (i % most == 0)
      {
        this->Groups.emplace_back();
      }
      this->Groups.back().Points.push_back(side[i]);
      this->Groups.back().Bounds.extend(side[i]);
    }
  }

  Box<D> Bounds = Box<D>::empty();
  std::vector<Group> Groups;
};

/// Returns the cells of the hull repair, by indices into `vertices`.
template <int D>
auto cellsAtHull(const std::vector<VertexOf<Point<D>>>& vertices,
  const std::vector<VertexOf<Point<D>>>& artificial)
{
  const ArtificialGroups<D> groups(artificial);
  typename Dimension<D>::Kernel kernel;
  Dimension<D>::triangulate(kernel, positionsOf(vertices));
  std::vector<std::array<std::uint32_t, D + 1>> cells;
  kernel.forEach(
    [&](auto cell)
    {
      if (!kernel.isInfinite(cell) && groups.areInConflict(cornersOf<D>(kernel, cell)))
      {
        cells.push_back(pointIndicesOf(kernel, cell));
      }
    });
  return cells;
}

} // namespace

template <int D>
void repairHull(std::vector<VertexOf<Point<D>>> vertices,
  const std::vector<VertexOf<Point<D>>>& artificial, FinalCellConsumer<D>& final)
{
  keepUnique(vertices);
  // There may be many vertices, so the kernel is freed before the consumer needs memory.
  for (const std::array<std::uint32_t, D + 1>& corners : cellsAtHull<D>(vertices, artificial))
  {
    BoundaryCell<D> cell;
    std::transform(corners.begin(), corners.end(), cell.begin(),
      [&vertices](std::uint32_t corner) { return vertices[corner]; });
    final.add(cell);
  }
}

template void repairHull(std::vector<VertexOf<Point2>> vertices,
  const std::vector<VertexOf<Point2>>& artificial, FinalCellConsumer<2>& final);
template void repairHull(std::vector<VertexOf<Point3>> vertices,
  const std::vector<VertexOf<Point3>>& artificial, FinalCellConsumer<3>& final);

} // namespace tipp
