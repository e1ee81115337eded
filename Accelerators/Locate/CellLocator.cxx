// SPDX-License-Identifier: BSD-3-Clause
#include "Locate/CellLocator.h"

#include "Predicates/ExactPredicates.h"
#include "Resample/BorderClaims.h"
#include "Resample/Claims.h"
#include "Resample/SampleBlock.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

bool contains(const Point2 (&corners)[3], Point2 p)
{
  const int first = orientation(corners[0], corners[1], p);
  const int second = orientation(corners[1], corners[2], p);
  if (first * second < 0)
  {
    return false;
  }
  const int third = orientation(corners[2], corners[0], p);
  const int sum = first + second + third;
  if (sum == 3 || sum == -3)
  {
    return true;
  }
  return first * third >= 0 && second * third >= 0 &&
    orientation(corners[0], corners[1], corners[2]) != 0;
}

bool contains(const Point3 (&corners)[4], const Point3& p)
{
  const auto& [a, b, c, d] = corners;
  const int side = orientation3(a, b, c, d);
  return side != 0 && side * orientation3(a, b, c, p) >= 0 &&
    side * orientation3(a, c, d, p) >= 0 && side * orientation3(a, d, b, p) >= 0 &&
    side * orientation3(b, d, c, p) >= 0;
}

/// The coordinates of a point in the mesh's dimension.
template <int D>
auto flattened(const SimplexMesh& mesh, const Point3& p)
{
  if constexpr (D == 2)
  {
    const double coordinates[3] = { p.x, p.y, p.z };
    return Point2{ coordinates[mesh.Axes[0]], coordinates[mesh.Axes[1]] };
  }
  else
  {
    return p;
  }
}

std::array<double, 2> arrayOf(Point2 p)
{
  return { p.x, p.y };
}
std::array<double, 3> arrayOf(const Point3& p)
{
  return { p.x, p.y, p.z };
}

template <typename Access, typename Point>
CellKey keyOfCell(const Access& access, std::int64_t cell, const Point& point)
{
  Point corners[Access::Corners];
  access.corners(cell, corners);
  return withRank(keyOf(access, cell), moveRank(corners, point));
}

/// Of the cells that hold a point the one that answers it. Keys are made only if there are several.
template <typename Access, typename Point>
class Choice
{
public:
  Choice(const Access& access, const std::int64_t* cellIds, const Point& point)
    : Cells(access)
    , CellIds(cellIds)
    , Of(point)
  {
  }

  void offer(std::int64_t cell)
  {
    Point corners[Access::Corners];
    this->Cells.corners(cell, corners);
    if (!contains(corners, this->Of))
    {
      return;
    }
    if (this->Cell >= 0)
    {
      this->IsRanked ? void() : this->rank(this->Cell);
      this->IsRanked = true;
      const auto before = std::make_pair(this->Best, this->Cell);
      this->rank(cell);
      if (before.first < this->Best)
      {
        std::tie(this->Best, this->Cell) = before;
        return;
      }
    }
    this->Cell = cell;
  }

  std::int64_t cell() const { return this->Cell; }

private:
  using Rank = std::pair<CellKey, std::int64_t>;

  void rank(std::int64_t cell)
  {
    this->Best = { keyOfCell(this->Cells, cell, this->Of),
      this->CellIds ? this->CellIds[cell] : cell };
  }

  const Access& Cells;
  const std::int64_t* CellIds;
  Point Of;
  std::int64_t Cell = -1;
  Rank Best{};
  bool IsRanked = false;
};

/// The weights of a cell's corners at a point. They are evaluated with the corners in lexicographic
/// order, so that they do not depend on their order in the cell.
template <typename Access, typename Point>
CellLocation weighed(const Access& access, std::int64_t cell, const Point& point)
{
  constexpr int D = Access::Dimension;
  CellLocation location;
  location.Cell = cell;
  Point corners[D + 1];
  access.corners(cell, corners);
  int order[D + 1];
  std::iota(order, order + D + 1, 0);
  for (int i = 1; i <= D; ++i)
  {
    for (int k = i; k > 0 && lexicographicLess(corners[order[k]], corners[order[k - 1]]); --k)
    {
      std::swap(order[k], order[k - 1]);
    }
  }
  const auto first = arrayOf(corners[order[0]]);
  double edges[D][D];
  double offset[D];
  for (int axis = 0; axis < D; ++axis)
  {
    for (int i = 0; i < D; ++i)
    {
      edges[i][axis] = arrayOf(corners[order[i + 1]])[std::size_t(axis)] - first[std::size_t(axis)];
    }
    offset[axis] = arrayOf(point)[std::size_t(axis)] - first[std::size_t(axis)];
  }
  double weights[D];
  ThinWeights<D>(edges).solve(offset, weights);
  location.Weights[order[0]] = 1;
  for (int i = 0; i < D; ++i)
  {
    location.Weights[order[i + 1]] = weights[i];
    location.Weights[order[0]] -= weights[i];
  }
  return location;
}

/// Empty for a hidden cell and one with a coordinate that is infinite or NaN.
template <typename Access>
auto boxOfCell(const Access& access, const SimplexMesh& mesh, std::int64_t cell)
{
  constexpr int D = Access::Dimension;
  Box<D> box = Box<D>::empty();
  bool isUsable = !mesh.Hidden || !mesh.Hidden[cell];
  for (int i = 0; i < Access::Corners; ++i)
  {
    double corner[D];
    access.coordinates(access.ids(cell)[i], corner);
    for (int axis = 0; axis < D; ++axis)
    {
      isUsable = isUsable && std::isfinite(corner[axis]);
      box.Low[axis] = std::min(box.Low[axis], corner[axis]);
      box.High[axis] = std::max(box.High[axis], corner[axis]);
    }
  }
  return isUsable ? box : Box<D>::empty();
}

/// The cells look for the points that they hold.
template <typename Access>
void locateByCells(const Access& access, const SimplexMesh& mesh, const std::int64_t* cellIds,
  const AskedPoints& points, int threads, const TakeLocation& take)
{
  constexpr int D = Access::Dimension;
  using Point = decltype(flattened<D>(mesh, points.at(0)));
  const auto at = [&](std::int64_t i) { return flattened<D>(mesh, points.at(i)); };
  const BoxTree<D> tree(
    points.Count, threads, [&](std::int64_t i) { return Box<D>::of(arrayOf(at(i))); });
  struct Found
  {
    std::int32_t Point;
    std::int64_t Cell;
  };
  std::vector<std::vector<Found>> found(static_cast<std::size_t>(threads));
  forChunks(mesh.Cells, 1 << 12, threads, {},
    [&](std::int64_t begin, std::int64_t end, int thread)
    {
      for (std::int64_t cell = begin; cell < end; ++cell)
      {
        const Box<D> box = boxOfCell(access, mesh, cell);
        const auto offer = [&](std::int32_t i)
        {
          if (box.holds(arrayOf(at(i))))
          {
            found[std::size_t(thread)].push_back({ i, cell });
          }
        };
        box.isEmpty() ? void() : tree.search(box, offer);
      }
    });
  std::vector<Choice<Access, Point>> choices;
  choices.reserve(std::size_t(points.Count));
  for (std::int64_t i = 0; i < points.Count; ++i)
  {
    choices.emplace_back(access, cellIds, at(i));
  }
  for (const std::vector<Found>& part : found)
  {
    for (const Found& f : part)
    {
      choices[std::size_t(f.Point)].offer(f.Cell);
    }
  }
  for (std::int64_t i = 0; i < points.Count; ++i)
  {
    const std::int64_t cell = choices[std::size_t(i)].cell();
    cell >= 0 ? take(points.index(i), weighed(access, cell, at(i))) : void();
  }
}

} // namespace

CellLocator::CellLocator(const SimplexMesh& mesh, const std::int64_t* cellIds, int threads)
  : Mesh(mesh)
  , CellIds(cellIds)
{
  withAccess(mesh,
    [&](const auto& access)
    {
      this->Tree = BoxTree<std::decay_t<decltype(access)>::Dimension>(
        mesh.Cells, threads, [&](std::int64_t cell) { return boxOfCell(access, mesh, cell); });
    });
}

template <typename Access, typename Point>
std::int64_t CellLocator::find(const Access& access, const Point& point) const
{
  constexpr int D = Access::Dimension;
  const Box<D> box = Box<D>::of(arrayOf(point));
  if (box.isEmpty())
  {
    return -1;
  }
  Choice<Access, Point> choice(access, this->CellIds, point);
  std::get<BoxTree<D>>(this->Tree).search(box, [&](std::int32_t cell) { choice.offer(cell); });
  return choice.cell();
}

/// Points that lie near each other, one after the other: they share the search for cells around
/// them all.
template <typename Access>
void CellLocator::findInOrder(const Access& access, const AskedPoints& points,
  const std::int32_t* order, std::int64_t count, const TakeLocation& take) const
{
  constexpr int D = Access::Dimension;
  constexpr int mostShared = 64;
  constexpr int fewCells = 64;
  const auto& tree = std::get<BoxTree<D>>(this->Tree);
  typename BoxTree<D>::Gathered gathered;
  const auto pointAt = [&](std::int64_t i)
  { return flattened<D>(this->Mesh, points.at(order[i])); };
  const auto choose = [&](std::int64_t i, const auto& search)
  {
    const auto point = pointAt(i);
    Choice<Access, std::decay_t<decltype(point)>> choice(access, this->CellIds, point);
    search(Box<D>::of(arrayOf(point)), [&](std::int32_t cell) { choice.offer(cell); });
    const std::int64_t cell = choice.cell();
    cell >= 0 ? take(points.index(order[i]), weighed(access, cell, point)) : void();
  };
  std::int64_t shared = mostShared / 4;
  int alone = 0; // so many points do without: they are far apart
  for (std::int64_t begin = 0; begin < count;)
  {
    shared = alone > 0 ? 1 : shared;
    alone -= alone > 0 ? 1 : 0;
    const std::int64_t end = std::min(begin + shared, count);
    Box<D> region = Box<D>::empty();
    for (std::int64_t i = begin; i < end; ++i)
    {
      region.extend(Box<D>::of(arrayOf(pointAt(i))));
    }
    const bool isGathered = shared > 1 && tree.gather(region, gathered);
    if (shared > 1 && !isGathered)
    {
      shared /= 2;
      alone = shared == 1 ? mostShared : 0;
      continue;
    }
    for (std::int64_t i = begin; i < end; ++i)
    {
      choose(i,
        [&](const Box<D>& box, const auto& offer)
        { isGathered ? tree.search(gathered, box, offer) : tree.search(box, offer); });
    }
    begin = end;
    shared = !isGathered || gathered.Count < fewCells
      ? std::min<std::int64_t>(2 * shared, mostShared)
      : shared;
  }
}

CellLocation CellLocator::locate(const Point3& point) const
{
  CellLocation location;
  withAccess(this->Mesh,
    [&](const auto& access)
    {
      const auto p = flattened<std::decay_t<decltype(access)>::Dimension>(this->Mesh, point);
      const std::int64_t cell = this->find(access, p);
      location = cell >= 0 ? weighed(access, cell, p) : location;
    });
  return location;
}

void locatePoints(const SimplexMesh& mesh, const std::int64_t* cellIds, const CellLocator* locator,
  const AskedPoints& points, int threads, const TakeLocation& take)
{
  withAccess(mesh,
    [&](const auto& access)
    {
      if (!locator)
      {
        locateByCells(access, mesh, cellIds, points, threads, take);
        return;
      }
      constexpr int D = std::decay_t<decltype(access)>::Dimension;
      // Successive points find what they need in the processor's cache.
      const auto boxOf = [&](std::int64_t i)
      { return Box<D>::of(arrayOf(flattened<D>(mesh, points.at(i)))); };
      const std::vector<std::int32_t> order =
        mortonOrder(points.Count, threads, boundsOf<D>(points.Count, threads, boxOf), boxOf);
      forChunks(std::int64_t(order.size()), 1 << 12, threads, {},
        [&](std::int64_t begin, std::int64_t end, int)
        { locator->findInOrder(access, points, order.data() + begin, end - begin, take); });
    });
}

CellKey keyAt(const SimplexMesh& mesh, std::int64_t cell, const Point3& point)
{
  CellKey key = noCellKey;
  withAccess(mesh,
    [&](const auto& access)
    {
      constexpr int D = std::decay_t<decltype(access)>::Dimension;
      key = keyOfCell(access, cell, flattened<D>(mesh, point));
    });
  return key;
}

} // namespace tipp
