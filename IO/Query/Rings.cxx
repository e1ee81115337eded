// SPDX-License-Identifier: BSD-3-Clause
#include "Query/Around.h"
#include "Query/ForPieces.h"

#include <algorithm>
#include <mutex>
#include <tuple>
#include <utility>

namespace tipp
{
namespace
{

/// Puts lists made by several threads together.
IdLists joined(const std::vector<std::vector<std::int64_t>>& lists)
{
  IdLists result;
  for (const std::vector<std::int64_t>& list : lists)
  {
    result.Ids.insert(result.Ids.end(), list.begin(), list.end());
    result.Starts.push_back(std::int64_t(result.Ids.size()));
  }
  return result;
}

void sortUnique(std::vector<std::int64_t>& ids)
{
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

} // namespace

IdLists starsOf(const ResidentMesh& mesh, const std::vector<std::int64_t>& points)
{
  std::vector<std::vector<std::int64_t>> lists(points.size());
  const PieceGroups groups = groupsOf(mesh, points, true);
  forPieces(mesh, groups, topologyNeeded(),
    [&](const ResidentPiece& piece, std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t i = begin; i < end; ++i)
      {
        const auto item = std::size_t(groups.Items[std::size_t(i)]);
        for (const std::int32_t cell :
          piece.Topology->cellsAt(indexOf(mesh, *piece.Topology, points[item], true)))
        {
          lists[item].push_back(piece.Part->cellId(cell));
        }
        sortUnique(lists[item]);
      }
    });
  return joined(lists);
}

namespace
{

/// A point that a ring has reached, and from there its cells are yet to be visited.
struct Reached
{
  std::int64_t Seed;
  std::int64_t Point;
  Point3 At;

  bool operator<(const Reached& other) const
  {
    return std::tie(this->Seed, this->Point) < std::tie(other.Seed, other.Point);
  }
};

/// Grows rings around many seeds at once, step by step, each step piece by piece.
class RingGrowth
{
public:
  RingGrowth(const ResidentMesh& mesh, std::size_t seeds)
    : Mesh(mesh)
    , PointLists(seeds)
    , CellLists(seeds)
  {
  }

  /// The corners of each cell are reached.
  void startAtCells(const std::vector<std::int64_t>& cells)
  {
    this->start(cells, false,
      [](const PartTopology& topology, std::int64_t cell, const auto& reach)
      {
        for (int i = 0; i < topology.corners(); ++i)
        {
          reach(topology.corner(cell, i));
        }
      });
  }
  void startAtPoints(const std::vector<std::int64_t>& points)
  {
    this->start(points, true,
      [](const PartTopology&, std::int64_t point, const auto& reach) { reach(point); });
  }

  /// Visits the cells at the points that the last step has reached.
  void grow()
  {
    std::vector<Point3> positions;
    positions.reserve(this->Front.size());
    for (const Reached& r : this->Front)
    {
      positions.push_back(r.At);
    }
    std::vector<Reached> next;
    const PieceGroups groups =
      groupByPiece(this->Mesh.piecesOf(positions.data(), std::int64_t(positions.size())),
        this->Mesh.mesh().Pieces.size());
    forPieces(this->Mesh, groups, topologyNeeded(),
      [&](const ResidentPiece& piece, std::int64_t begin, std::int64_t end)
      {
        std::vector<Reached> reached;
        std::vector<std::pair<std::int64_t, std::int64_t>> cells; // seed, id
        for (std::int64_t i = begin; i < end; ++i)
        {
          const Reached& from = this->Front[std::size_t(groups.Items[std::size_t(i)])];
          this->visit(piece, from, reached, cells);
        }
        const std::lock_guard<std::mutex> lock(this->Mutex);
        next.insert(next.end(), reached.begin(), reached.end());
        for (const auto& [seed, cell] : cells)
        {
          this->CellLists[std::size_t(seed)].push_back(cell);
        }
      });
    this->take(std::move(next));
  }

  /// What was reached, without the seeds.
  IdLists points(const std::vector<std::int64_t>& seeds)
  {
    return without(seeds, this->PointLists);
  }
  IdLists cells(const std::vector<std::int64_t>& seeds) { return without(seeds, this->CellLists); }

private:
  template <typename Corners>
  void start(const std::vector<std::int64_t>& ids, bool ofPoints, const Corners& corners)
  {
    const PieceGroups groups = groupsOf(this->Mesh, ids, ofPoints);
    std::vector<Reached> first;
    forPieces(this->Mesh, groups, topologyNeeded(),
      [&](const ResidentPiece& piece, std::int64_t begin, std::int64_t end)
      {
        std::vector<Reached> reached;
        for (std::int64_t i = begin; i < end; ++i)
        {
          const std::int64_t item = groups.Items[std::size_t(i)];
          corners(*piece.Topology,
            indexOf(this->Mesh, *piece.Topology, ids[std::size_t(item)], ofPoints),
            [&](std::int64_t point) {
              reached.push_back(
                { item, piece.Part->pointId(point), positionOf(*piece.Part, point) });
            });
        }
        const std::lock_guard<std::mutex> lock(this->Mutex);
        first.insert(first.end(), reached.begin(), reached.end());
      });
    this->take(std::move(first));
  }

  static void visit(const ResidentPiece& piece, const Reached& from, std::vector<Reached>& reached,
    std::vector<std::pair<std::int64_t, std::int64_t>>& cells)
  {
    const PartTopology& topology = *piece.Topology;
    const MeshPart& part = *piece.Part;
    const std::int64_t point = topology.findPoint(from.Point);
    if (point < 0)
    {
      return; // no cell has it
    }
    const std::size_t first = reached.size();
    for (const std::int32_t cell : topology.cellsAt(point))
    {
      cells.emplace_back(from.Seed, part.cellId(cell));
      for (int i = 0; i < topology.corners(); ++i)
      {
        const std::int64_t corner = topology.corner(cell, i);
        reached.push_back({ from.Seed, part.pointId(corner), positionOf(part, corner) });
      }
    }
    std::sort(reached.begin() + std::ptrdiff_t(first), reached.end());
    reached.erase(std::unique(reached.begin() + std::ptrdiff_t(first), reached.end(),
                    [](const Reached& a, const Reached& b) { return a.Point == b.Point; }),
      reached.end());
  }

  /// The points that are new become the front.
  void take(std::vector<Reached> reached)
  {
    std::sort(reached.begin(), reached.end());
    this->Front.clear();
    for (std::size_t i = 0; i < reached.size(); ++i)
    {
      const Reached& r = reached[i];
      const std::vector<std::int64_t>& known = this->PointLists[std::size_t(r.Seed)];
      const bool isRepeated = i > 0 && !(reached[i - 1] < r);
      if (!isRepeated && !std::binary_search(known.begin(), known.end(), r.Point))
      {
        this->Front.push_back(r);
      }
    }
    for (std::size_t i = 0; i < this->Front.size();)
    {
      std::vector<std::int64_t>& known = this->PointLists[std::size_t(this->Front[i].Seed)];
      const std::int64_t seed = this->Front[i].Seed;
      const auto middle = std::ptrdiff_t(known.size());
      for (; i < this->Front.size() && this->Front[i].Seed == seed; ++i)
      {
        known.push_back(this->Front[i].Point);
      }
      std::inplace_merge(known.begin(), known.begin() + middle, known.end());
    }
  }

  static IdLists without(
    const std::vector<std::int64_t>& seeds, std::vector<std::vector<std::int64_t>>& lists)
  {
    for (std::size_t i = 0; i < seeds.size(); ++i)
    {
      sortUnique(lists[i]);
      lists[i].erase(std::remove(lists[i].begin(), lists[i].end(), seeds[i]), lists[i].end());
    }
    return joined(lists);
  }

  const ResidentMesh& Mesh;
  std::mutex Mutex;
  std::vector<Reached> Front;
  std::vector<std::vector<std::int64_t>> PointLists; ///< of each seed, ascending
  std::vector<std::vector<std::int64_t>> CellLists;  ///< of each seed, with repetitions
};

} // namespace

IdLists ringsOfPoints(const ResidentMesh& mesh, const std::vector<std::int64_t>& points, int k)
{
  RingGrowth growth(mesh, points.size());
  growth.startAtPoints(points);
  for (int step = 0; step < k; ++step)
  {
    growth.grow();
  }
  return growth.points(points);
}

IdLists ringsOfCells(const ResidentMesh& mesh, const std::vector<std::int64_t>& cells, int k)
{
  RingGrowth growth(mesh, cells.size());
  growth.startAtCells(cells);
  for (int step = 0; step < k; ++step)
  {
    growth.grow();
  }
  return growth.cells(cells);
}

} // namespace tipp
