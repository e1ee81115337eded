// SPDX-License-Identifier: BSD-3-Clause
#include "Query/Queries.h"

#include "Arrays/IndexMap.h"
#include "Query/RankMesh.h"
#include "Resident/ForPieces.h"

#include <algorithm>
#include <iterator>
#include <mutex>
#include <numeric>
#include <tuple>
#include <utility>

namespace tipp
{
namespace
{

/// A point that a ring has reached, and whose cells have not been visited yet. Point is a global
/// id, Seed an index.
struct Reached
{
  std::int64_t Seed;
  std::int64_t Point;
  Point3 Position;

  bool operator<(const Reached& other) const
  {
    return std::tie(this->Seed, this->Point) < std::tie(other.Seed, other.Point);
  }
};

/// Sorts items roughly by their keys, which are not negative. There must be at least one item.
void sortRoughly(std::int64_t* items, const std::int64_t* keys, std::int64_t count)
{
  constexpr std::int64_t buckets = 4096;
  const std::int64_t range = *std::max_element(keys, keys + count) + 1;
  const auto bucketOf = [range](std::int64_t key) { return std::size_t(key * buckets / range); };
  const GroupedItems<std::int64_t> sorted(std::size_t(buckets), 1,
    [&](const auto& visit)
    {
      for (std::int64_t i = 0; i < count; ++i)
      {
        visit(bucketOf(keys[i]), items[i]);
      }
    });
  std::copy_n(sorted.data(), count, items);
}

/// Computes the ring of one seed within one piece.
class LocalRing
{
public:
  explicit LocalRing(const ResidentPiece& piece)
    : Part(*piece.Part)
    , Topology(*piece.Topology)
  {
  }

  /// Visits the cells at the points `first`, at the points of these cells, and so on, k times.
  /// Returns false if this reaches a point of another piece. `first` and the results are local
  /// indices.
  bool grow(const Ids& first, int k, bool wantsCells)
  {
    this->Points.clear();
    this->Cells.clear();
    this->KnownPoints.clear();
    this->KnownCells.clear();
    for (const std::int64_t point : first)
    {
      this->addPoint(point);
    }
    std::size_t begin = 0;
    for (int step = 0; step < k && begin < this->Points.size(); ++step)
    {
      const std::size_t end = this->Points.size();
      const bool wantsPoints = !wantsCells || step + 1 < k; // the last points are not visited
      for (; begin < end; ++begin)
      {
        const std::int64_t point = this->Points[begin];
        if (!this->Part.owns(point))
        {
          return false;
        }
        this->visit(point, wantsCells, wantsPoints);
      }
    }
    return true;
  }

  Ids Points; ///< in the order in which they were reached
  Ids Cells;  ///< in the order in which they were reached; empty if not wanted

private:
  void visit(std::int64_t point, bool wantsCells, bool wantsPoints)
  {
    for (const std::int32_t cell : this->Topology.cellsAt(point))
    {
      if (wantsCells)
      {
        if (!this->KnownCells.insert(cell).IsNew)
        {
          continue;
        }
        this->Cells.push_back(cell);
      }
      for (int i = 0; wantsPoints && i < this->Topology.corners(); ++i)
      {
        this->addPoint(this->Topology.corner(cell, i));
      }
    }
  }

  void addPoint(std::int64_t point)
  {
    if (this->KnownPoints.insert(point).IsNew)
    {
      this->Points.push_back(point);
    }
  }

  const MeshPart& Part;
  const PartTopology& Topology;
  IndexMap KnownPoints;
  IndexMap KnownCells;
};

/// Computes the rings of many seeds, which are points or cells, as lists of points or cells. A ring
/// that stays in the piece of its seed is computed there. All others grow together, step by step,
/// and each step visits one piece after the other.
class RingGrowth
{
public:
  RingGrowth(const ResidentMesh& mesh, const Ids& seeds, bool fromPoints, bool toCells)
    : Mesh(mesh)
    , Seeds(seeds)
    , FromPoints(fromPoints)
    , ToCells(toCells)
    , PointLists(seeds.size())
    , CellLists(seeds.size())
  {
  }

  /// The ids that are reached in k steps, ascending, without the seeds.
  IdLists grown(int k, const std::vector<std::int32_t>& pieces)
  {
    this->start(k, pieces);
    for (int step = 0; step < k && this->Mesh.isTrueOnAnyRank(!this->Front.empty()); ++step)
    {
      this->grow();
    }
    for (const std::int64_t item : this->NotVisited)
    {
      Finished done;
      const Ids& list = (this->ToCells ? this->CellLists : this->PointLists)[std::size_t(item)];
      std::copy_if(list.begin(), list.end(), std::back_inserter(done.Lists.Ids),
        [this, item](std::int64_t id) { return this->isListed(id, item); });
      this->finish(item, 0, done);
      this->Done.push_back(std::move(done));
    }
    return this->joined();
  }

private:
  /// Visits the cells at the points that the last step has reached.
  void grow()
  {
    Ids points;
    std::vector<Point3> positions;
    for (const Reached& r : this->Front)
    {
      points.push_back(r.Point);
      positions.push_back(r.Position);
    }
    std::vector<Reached> next;
    const PieceGroups groups = groupByPiece(this->Mesh.piecesAround(points, positions));
    forPieces(this->Mesh, groups, topologyNeeded(),
      [&](const ResidentPiece& piece, std::int64_t begin, std::int64_t end)
      {
        std::vector<Reached> reached;
        std::vector<std::pair<std::int64_t, std::int64_t>> cells; // seed, global id
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

  /// The lists of some items that are complete.
  struct Finished
  {
    IdLists Lists;
    Ids Items;
  };

  IdLists joined() const
  {
    IdLists result;
    result.Starts.assign(this->Seeds.size() + 1, 0);
    const auto forLists = [this](const auto& work)
    {
      forChunks(std::int64_t(this->Done.size()), 1, threadCount(this->Mesh.options().Threads), {},
        [&](std::int64_t part, std::int64_t, int)
        {
          const auto& [lists, items] = this->Done[std::size_t(part)];
          for (std::size_t i = 0; i < items.size(); ++i)
          {
            const std::int64_t begin = lists.Starts[i];
            work(std::size_t(items[i]), lists.Ids.data() + begin, lists.Starts[i + 1] - begin);
          }
        });
    };
    forLists([&](std::size_t item, const std::int64_t*, std::int64_t count)
      { result.Starts[item + 1] = count; });
    std::partial_sum(result.Starts.begin(), result.Starts.end(), result.Starts.begin());
    result.Ids.resize(std::size_t(result.Starts.back()));
    forLists([&](std::size_t item, const std::int64_t* ids, std::int64_t count)
      { std::copy_n(ids, count, result.Ids.begin() + result.Starts[item]); });
    return result;
  }

  /// Finds the local indices of the seeds of a mesh in memory, and sorts the seeds roughly as they
  /// lie in memory. What lies near is then visited together.
  void sortSeeds(int k, PieceGroups& groups)
  {
    this->Indices.resize(this->Seeds.size());
    Ids keys(groups.Items.size());
    // Cells that are near in space are mostly near in memory, too; points are often in any order.
    // For a single step, finding the cells takes longer than their order saves.
    const bool byCell = this->FromPoints && k > 1;
    forPieces(this->Mesh, groups, topologyNeeded(),
      [&](const ResidentPiece& piece, std::int64_t begin, std::int64_t end)
      {
        for (auto i = std::size_t(begin); i < std::size_t(end); ++i)
        {
          const auto item = std::size_t(groups.Items[i]);
          const std::int64_t index =
            indexOf(this->Mesh, *piece.Topology, this->Seeds[item], this->FromPoints);
          this->Indices[item] = keys[i] = index;
          if (byCell)
          {
            const PartTopology::Cells cells = piece.Topology->cellsAt(index);
            keys[i] = cells.empty() ? 0 : *cells.begin();
          }
        }
      });
    for (const PieceGroups::Group& group : groups.Groups)
    {
      sortRoughly(
        groups.Items.data() + group.Begin, keys.data() + group.Begin, group.End - group.Begin);
    }
  }

  void start(int k, const std::vector<std::int32_t>& pieces)
  {
    PieceGroups groups = groupByPiece(pieces);
    if (!this->Mesh.isStored())
    {
      this->sortSeeds(k, groups);
    }
    std::vector<Reached> first;
    forPieces(this->Mesh, groups, topologyNeeded(),
      [&](const ResidentPiece& piece, std::int64_t begin, std::int64_t end)
      {
        LocalRing ring(piece);
        std::vector<Reached> reached;
        Ids left;
        Finished done;
        Ids corners;
        constexpr std::int64_t batch = 16;
        std::int64_t indices[batch];
        for (std::int64_t i = begin; i < end; ++i)
        {
          const std::int64_t at = (i - begin) % batch;
          if (at == 0)
          {
            this->findIndices(piece, groups, i, std::min(i + batch, end), indices);
          }
          const std::int64_t item = groups.Items[std::size_t(i)];
          corners.assign(1, indices[at]);
          if (!this->FromPoints)
          {
            corners.clear();
            for (int corner = 0; corner < piece.Topology->corners(); ++corner)
            {
              corners.push_back(piece.Topology->corner(indices[at], corner));
            }
          }
          if (ring.grow(corners, k, this->ToCells))
          {
            this->take(*piece.Part, ring, item, done);
            continue;
          }
          left.push_back(item); // for grow()
          for (const std::int64_t point : corners)
          {
            reached.push_back({ item, piece.Part->pointId(point), positionOf(*piece.Part, point) });
          }
        }
        const std::lock_guard<std::mutex> lock(this->Mutex);
        first.insert(first.end(), reached.begin(), reached.end());
        this->NotVisited.insert(this->NotVisited.end(), left.begin(), left.end());
        this->Done.push_back(std::move(done));
      });
    this->take(std::move(first));
  }

  /// Finds the local indices of the seeds of items [begin, end), and prefetches the cells there.
  void findIndices(const ResidentPiece& piece, const PieceGroups& groups, std::int64_t begin,
    std::int64_t end, std::int64_t* indices) const
  {
    for (std::int64_t i = begin; i < end; ++i)
    {
      const auto item = std::size_t(groups.Items[std::size_t(i)]);
      indices[i - begin] = this->Indices.empty()
        ? indexOf(this->Mesh, *piece.Topology, this->Seeds[item], this->FromPoints)
        : this->Indices[item];
    }
    if (this->FromPoints)
    {
      piece.Topology->prefetch(indices, end - begin);
    }
  }

  void take(const MeshPart& part, const LocalRing& ring, std::int64_t item, Finished& done) const
  {
    Ids& ids = done.Lists.Ids;
    const auto begin = std::ptrdiff_t(ids.size());
    for (const std::int64_t index : this->ToCells ? ring.Cells : ring.Points)
    {
      const std::int64_t id = this->ToCells ? part.cellId(index) : part.pointId(index);
      if (this->isListed(id, item))
      {
        ids.push_back(id);
      }
    }
    this->finish(item, begin, done);
  }

  /// Whether an id that an item reaches is in its list: the seed is not.
  bool isListed(std::int64_t id, std::int64_t item) const
  {
    return this->FromPoints == this->ToCells || id != this->Seeds[std::size_t(item)];
  }

  /// The ids from `begin` on become the list of an item: ascending, each once.
  void finish(std::int64_t item, std::ptrdiff_t begin, Finished& done) const
  {
    Ids& ids = done.Lists.Ids;
    std::sort(ids.begin() + begin, ids.end());
    // Parts that a cell was divided into have the same id.
    ids.erase(std::unique(ids.begin() + begin, ids.end()), ids.end());
    done.Lists.endList();
    done.Items.push_back(item);
  }

  static void visit(const ResidentPiece& piece, const Reached& from, std::vector<Reached>& reached,
    std::vector<std::pair<std::int64_t, std::int64_t>>& cells)
  {
    const PartTopology& topology = *piece.Topology;
    const MeshPart& part = *piece.Part;
    const std::int64_t point = topology.findPoint(from.Point);
    if (point < 0)
    {
      return; // no cell has this point
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

  /// The new points become the front.
  void take(std::vector<Reached> reached)
  {
    std::sort(reached.begin(), reached.end());
    this->Front.clear();
    for (std::size_t i = 0; i < reached.size(); ++i)
    {
      const Reached& r = reached[i];
      const Ids& known = this->PointLists[std::size_t(r.Seed)];
      const bool isRepeated = i > 0 && !(reached[i - 1] < r);
      if (!isRepeated && !std::binary_search(known.begin(), known.end(), r.Point))
      {
        this->Front.push_back(r);
      }
    }
    for (std::size_t i = 0; i < this->Front.size();)
    {
      const std::int64_t seed = this->Front[i].Seed;
      Ids& known = this->PointLists[std::size_t(seed)];
      const auto middle = std::ptrdiff_t(known.size());
      for (; i < this->Front.size() && this->Front[i].Seed == seed; ++i)
      {
        known.push_back(this->Front[i].Point);
      }
      std::inplace_merge(known.begin(), known.begin() + middle, known.end());
    }
  }

  const ResidentMesh& Mesh;
  const Ids& Seeds;
  const bool FromPoints; ///< seeds are points; false: cells
  const bool ToCells;    ///< lists are of cells; false: of points
  Ids Indices;           ///< of the seeds of a mesh in memory: their local indices
  std::mutex Mutex;
  std::vector<Reached> Front;
  std::vector<Finished> Done;
  /// Items with rings that leave their pieces. Only these have lists below.
  Ids NotVisited;
  std::vector<Ids> PointLists; ///< lists per seed, ascending
  std::vector<Ids> CellLists;  ///< lists per seed, with repetitions
};

IdLists ringsOf(const ResidentMesh& mesh, const Ids& seeds, int k, bool fromPoints, bool toCells,
  Communicator* ranks)
{
  return listsOf(mesh, seeds, fromPoints, ranks,
    [=](const ResidentMesh& own, const Ids& ids, const std::vector<std::int32_t>& pieces)
    { return RingGrowth(own, ids, fromPoints, toCells).grown(k, pieces); });
}

} // namespace

IdLists starsOf(const ResidentMesh& mesh, const Ids& points, Communicator* ranks)
{
  return ringsOf(mesh, points, 1, true, true, ranks);
}

IdLists ringsOfPoints(const ResidentMesh& mesh, const Ids& points, int k, Communicator* ranks)
{
  return ringsOf(mesh, points, k, true, false, ranks);
}

IdLists ringsOfCells(const ResidentMesh& mesh, const Ids& cells, int k, Communicator* ranks)
{
  return ringsOf(mesh, cells, k, false, true, ranks);
}

} // namespace tipp
