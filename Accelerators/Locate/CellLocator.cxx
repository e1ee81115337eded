// SPDX-License-Identifier: BSD-3-Clause
#include "Locate/CellLocator.h"

#include "Locate/CellChoice.h"
#include "Locate/PointGrid.h"

#include <type_traits>

namespace tipp
{
namespace
{

/// Searches from the cells: each cell finds the points that it contains.
template <typename Access>
void locateByCells(const Access& access, const SimplexMesh& mesh, const std::int64_t* cellIds,
  const AskedPoints& points, int threads, const TakeLocations& take)
{
  constexpr int D = Access::Dimension;
  const auto at = [&](std::int64_t i) { return access.flattened(points.at(i)); };
  const BoxTree<D> tree(points.Count, threads, [&](std::int64_t i) { return Box<D>::of(at(i)); });
  // Most cells contain no point; a grid detects this from the positions of their corners. That does
  // not pay off if the mesh has fewer cells than points.
  const bool usesGrid = mesh.Cells >= mesh.PointCount;
  const PointGrid<D> grid(usesGrid ? points.Count : 0, threads, at);
  std::vector<typename PointGrid<D>::Position> positions(
    usesGrid ? std::size_t(mesh.PointCount) : 0);
  forIndices(
    std::int64_t(positions.size()),
    [&](std::int64_t i) { positions[std::size_t(i)] = grid.position(access.coordinates(i)); },
    threads, 1 << 14);
  struct PointInCell
  {
    std::int32_t Point;
    std::int64_t Cell;
  };
  std::vector<std::vector<PointInCell>> found(static_cast<std::size_t>(threads));
  forChunks(mesh.Cells, 1 << 12, threads, {},
    [&](std::int64_t begin, std::int64_t end, int thread)
    {
      for (std::int64_t cell = begin; cell < end; ++cell)
      {
        if (usesGrid && !grid.template mayHold<Access::Corners>(positions, access.ids(cell)))
        {
          continue;
        }
        const Box<D> box = boxOfCell(access, mesh, cell);
        const auto offer = [&](std::int32_t i)
        {
          if (box.contains(at(i)))
          {
            found[std::size_t(thread)].push_back({ i, cell });
          }
        };
        if (!box.isEmpty())
        {
          tree.search(box, offer);
        }
      }
    });
  std::vector<Choice<Access>> choices;
  choices.reserve(std::size_t(points.Count));
  for (std::int64_t i = 0; i < points.Count; ++i)
  {
    choices.emplace_back(access, cellIds, at(i));
  }
  for (const std::vector<PointInCell>& part : found)
  {
    for (const PointInCell& f : part)
    {
      choices[std::size_t(f.Point)].offer(f.Cell);
    }
  }
  Locations locations(take);
  for (std::int64_t i = 0; i < points.Count; ++i)
  {
    const std::int64_t cell = choices[std::size_t(i)].cell();
    if (cell >= 0)
    {
      locations.add(points.index(i), weighed(access, cell, at(i)));
    }
  }
  locations.flush();
}

} // namespace

CellLocator::CellLocator(const SimplexMesh& mesh, const std::int64_t* cellIds, int threads)
  : Mesh(mesh)
  , CellIds(cellIds)
  , Threads(threads)
  , Walk(mesh, threads)
{
  if (!this->Walk.isUsable())
  {
    if (mesh.Dimension == 2)
    {
      this->tree<2>();
    }
    else
    {
      this->tree<3>();
    }
  }
}

template <int D>
const BoxTree<D>& CellLocator::tree() const
{
  std::call_once(this->Making,
    [this]
    {
      withAccess(this->Mesh,
        [this](const auto& access)
        {
          this->Tree = BoxTree<std::decay_t<decltype(access)>::Dimension>(this->Mesh.Cells,
            this->Threads, [&](std::int64_t cell) { return boxOfCell(access, this->Mesh, cell); });
        });
    });
  return std::get<BoxTree<D>>(this->Tree);
}
template const BoxTree<2>& CellLocator::tree() const;
template const BoxTree<3>& CellLocator::tree() const;

/// Successive points are near each other: they share one search for the cells around all of them.
template <typename Access>
void CellLocator::findInOrder(const Access& access, const AskedPoints& points,
  const std::int32_t* order, std::int64_t count, const TakeLocations& take) const
{
  constexpr int D = Access::Dimension;
  constexpr int mostShared = 64;
  constexpr int fewCells = 64;
  const BoxTree<D>& tree = this->tree<D>();
  typename BoxTree<D>::Gathered gathered;
  Locations locations(take);
  const auto at = [&](std::int64_t i) { return access.flattened(points.at(order[i])); };
  const auto choose = [&](std::int64_t i, const auto& search)
  {
    const auto point = at(i);
    Choice<Access> choice(access, this->CellIds, point);
    search(Box<D>::of(point), [&](std::int32_t cell) { choice.offer(cell); });
    const std::int64_t cell = choice.cell();
    if (cell >= 0)
    {
      locations.add(points.index(order[i]), weighed(access, cell, point));
    }
  };
  std::int64_t shared = mostShared / 4;
  int alone = 0; // how many of the next points to search one by one, since they are far apart
  for (std::int64_t begin = 0; begin < count;)
  {
    shared = alone > 0 ? 1 : shared;
    alone -= alone > 0 ? 1 : 0;
    const std::int64_t end = std::min(begin + shared, count);
    Box<D> region = Box<D>::empty();
    for (std::int64_t i = begin; i < end; ++i)
    {
      region.extend(at(i));
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
  locations.flush();
}

/// Whether the points, in their order, are near enough to each other for short walks.
template <typename Access>
bool CellLocator::areNear(const Access& access, const AskedPoints& points) const
{
  constexpr std::int64_t samples = 64;
  constexpr std::int64_t length = 16;
  constexpr std::int64_t fewSteps = 6;
  if (points.Count < samples * length)
  {
    return true;
  }
  std::int64_t walks = 0;
  std::int64_t steps = 0;
  for (std::int64_t sample = 0; sample < samples; ++sample)
  {
    CellWalk::Position at;
    const std::int64_t first = (points.Count - length) * sample / samples;
    for (std::int64_t i = first; i < first + length; ++i)
    {
      const Point2 point = access.flattened(points.at(i));
      if (isFinite(point))
      {
        const bool isFirst = at.Cell < 0;
        this->Walk.walk(access, point, at);
        walks += isFirst ? 0 : 1;
        at.Steps = isFirst ? 0 : at.Steps;
      }
    }
    steps += at.Steps;
  }
  return steps <= fewSteps * walks;
}

/// Locates the points by walks; returns the indices of those that it cannot locate.
template <typename Access>
std::vector<std::int64_t> CellLocator::walkAll(
  const Access& access, const AskedPoints& points, int threads, const TakeLocations& take) const
{
  const auto pointOf = [&](std::int64_t i) { return access.flattened(points.at(i)); };
  const bool inOrder = this->areNear(access, points);
  const std::vector<std::int32_t> order =
    inOrder ? std::vector<std::int32_t>() : nearOrder<2>(points.Count, threads, pointOf);
  std::vector<std::vector<std::int64_t>> left(static_cast<std::size_t>(threads));
  forChunks(inOrder ? points.Count : std::int64_t(order.size()), 1 << 14, threads, {},
    [&](std::int64_t begin, std::int64_t end, int thread)
    {
      Locations locations(take);
      CellWalk::Position at;
      for (std::int64_t i = begin; i < end; ++i)
      {
        const std::int64_t item = inOrder ? i : order[std::size_t(i)];
        const Point2 point = pointOf(item);
        const auto outcome =
          isFinite(point) ? this->Walk.walk(access, point, at) : CellWalk::Outcome::Outside;
        if (outcome == CellWalk::Outcome::Found)
        {
          locations.add(points.index(item), weighed(access, at.Cell, point));
        }
        else if (outcome == CellWalk::Outcome::Unknown)
        {
          left[std::size_t(thread)].push_back(points.index(item));
        }
      }
      locations.flush();
    });
  for (std::size_t thread = 1; thread < left.size(); ++thread)
  {
    left[0].insert(left[0].end(), left[thread].begin(), left[thread].end());
  }
  return left[0];
}

template <typename Access>
void CellLocator::locateAll(
  const Access& access, const AskedPoints& points, int threads, const TakeLocations& take) const
{
  constexpr int D = Access::Dimension;
  AskedPoints rest = points;
  std::vector<std::int64_t> left;
  if constexpr (D == 2)
  {
    if (this->Walk.isUsable())
    {
      left = this->walkAll(access, points, threads, take);
      rest = { points.Points, left.data(), std::int64_t(left.size()) };
      constexpr std::int64_t cellsPerPoint = 8;
      constexpr int mostPasses = 3;
      if (rest.Count == 0)
      {
        return;
      }
      if (rest.Count < this->Mesh.Cells / cellsPerPoint && this->Passes++ < mostPasses)
      {
        locateByCells(access, this->Mesh, this->CellIds, rest, threads, take);
        return;
      }
    }
  }
  const std::vector<std::int32_t> order =
    nearOrder<D>(rest.Count, threads, [&](std::int64_t i) { return access.flattened(rest.at(i)); });
  forChunks(std::int64_t(order.size()), 1 << 12, threads, {},
    [&](std::int64_t begin, std::int64_t end, int)
    { this->findInOrder(access, rest, order.data() + begin, end - begin, take); });
}

void locatePoints(const SimplexMesh& mesh, const std::int64_t* cellIds, const CellLocator* locator,
  const AskedPoints& points, int threads, const TakeLocations& take)
{
  withAccess(mesh,
    [&](const auto& access)
    {
      locator ? locator->locateAll(access, points, threads, take)
              : locateByCells(access, mesh, cellIds, points, threads, take);
    });
}

CellKey keyAt(const SimplexMesh& mesh, std::int64_t cell, const Point3& point)
{
  CellKey key = noCellKey;
  withAccess(
    mesh, [&](const auto& access) { key = keyOfCell(access, cell, access.flattened(point)); });
  return key;
}

} // namespace tipp
