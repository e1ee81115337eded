// SPDX-License-Identifier: BSD-3-Clause
#include "Query/Around.h"
#include "Query/LocalRing.h"
#include "Query/RankQuestions.h"

#include <algorithm>
#include <mutex>
#include <numeric>
#include <tuple>
#include <utility>

namespace tipp
{
namespace
{

/// The lists of ids as local(ids, pieces) returns them for a mesh in this process, or the part of a
/// stored mesh that this rank has. inMemory(questions) returns them for parts in the memory of
/// several ranks.
template <typename Local, typename InMemory>
IdLists listsOf(const ResidentMesh& mesh, const Ids& ids, bool ofPoints, Communicator* ranks,
  const Local& local, const InMemory& inMemory)
{
  if (!areSeveral(ranks))
  {
    return local(ids, mesh.piecesOfIds(ids, ofPoints));
  }
  const RankQuestions questions(*ranks, mesh);
  return mesh.isStored() ? questions.askOwners(ids, ofPoints, local) : inMemory(questions);
}

} // namespace

IdLists starsOf(
  const ResidentMesh& mesh, const std::vector<std::int64_t>& points, Communicator* ranks)
{
  const auto local = [&mesh](const Ids& own, const std::vector<std::int32_t>& pieces)
  {
    std::vector<Ids> lists(own.size());
    const PieceGroups groups = groupByPiece(pieces, mesh.mesh().Pieces.size());
    forPieces(mesh, groups, topologyNeeded(),
      [&](const ResidentPiece& piece, std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t i = begin; i < end; ++i)
        {
          const auto item = std::size_t(groups.Items[std::size_t(i)]);
          for (const std::int32_t cell :
            piece.Topology->cellsAt(indexOf(mesh, *piece.Topology, own[item], true)))
          {
            lists[item].push_back(piece.Part->cellId(cell));
          }
          sortUnique(lists[item]);
        }
      });
    IdLists result;
    std::for_each(lists.begin(), lists.end(), [&result](const Ids& list) { result.add(list); });
    return result;
  };
  return listsOf(mesh, points, true, ranks, local,
    [&points](const RankQuestions& questions) { return questions.stars(points); });
}

namespace
{

/// A point that a ring has reached, and whose cells have not been visited yet. Point is a global
/// id, Seed an index.
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

/// The numbers of `indices`, roughly in the order of the indices. What lies near in memory is then
/// visited together. There must be at least one index.
std::vector<std::int64_t> orderedBy(const std::vector<std::int64_t>& indices)
{
  constexpr std::int64_t buckets = 4096;
  const std::int64_t count = *std::max_element(indices.begin(), indices.end()) + 1;
  const auto bucketOf = [count](std::int64_t index)
  { return std::size_t(index * buckets / count); };
  std::vector<std::int64_t> next(std::size_t(buckets) + 1, 0);
  for (const std::int64_t index : indices)
  {
    ++next[bucketOf(index) + 1];
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<std::int64_t> order(indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i)
  {
    order[std::size_t(next[bucketOf(indices[i])]++)] = std::int64_t(i);
  }
  return order;
}

/// Computes the rings of many seeds. A ring that stays in the piece of its seed is computed there.
/// All others grow together, step by step, and each step visits one piece after the other.
class RingGrowth
{
public:
  RingGrowth(const ResidentMesh& mesh, const std::vector<std::int64_t>& seeds, bool ofPoints)
    : Mesh(mesh)
    , Seeds(seeds)
    , OfPoints(ofPoints)
    , PointLists(seeds.size())
    , CellLists(seeds.size())
  {
  }

  /// The ids that are reached in k steps, without the seeds.
  IdLists grown(int k, const std::vector<std::int32_t>& pieces)
  {
    this->start(k, groupByPiece(pieces, this->Mesh.mesh().Pieces.size()), nullptr);
    for (int step = 0; step < k && !this->Front.empty(); ++step)
    {
      this->grow();
    }
    std::vector<std::vector<std::int64_t>>& lists =
      this->OfPoints ? this->PointLists : this->CellLists;
    for (const std::int64_t item : this->Left)
    {
      std::vector<std::int64_t>& list = lists[std::size_t(item)];
      sortUnique(list);
      list.erase(std::remove(list.begin(), list.end(), this->Seeds[std::size_t(item)]), list.end());
      this->Done.push_back({ { { 0, std::int64_t(list.size()) }, list }, { item } });
    }
    return this->joined();
  }

  /// The same for a part of a mesh in memory, as far as the rings can be computed without the other
  /// parts. `indices` are the local indices of the seeds, at least one. shared[i] is not 0 if other
  /// parts, too, have cells at point i (a local index). If a ring needs the cells of other parts,
  /// its list is only { -1 }.
  IdLists grownWithin(int k, const std::vector<std::int64_t>& indices, const std::uint8_t* shared)
  {
    this->Indices = indices.data();
    // For a single step, finding the cells takes longer than their order saves.
    const bool byCell = this->OfPoints && k > 1;
    this->start(k,
      { { { 0, 0, std::int64_t(indices.size()) } },
        orderedBy(byCell ? this->firstCells(indices) : indices) },
      shared);
    for (const std::int64_t item : this->Left)
    {
      this->Done.push_back({ { { 0, 1 }, { -1 } }, { item } });
    }
    return this->joined();
  }

private:
  /// The first cell at each point (a local index; 0 if there is none). Cells that are near in space
  /// are mostly near in memory, too; points are often in any order.
  std::vector<std::int64_t> firstCells(const std::vector<std::int64_t>& indices) const
  {
    const ResidentPieces::Lease piece = this->Mesh.pieces().get(0, topologyNeeded());
    std::vector<std::int64_t> cells(indices.size());
    std::transform(indices.begin(), indices.end(), cells.begin(),
      [&piece](std::int64_t point)
      {
        const PartTopology::Cells at = piece->Topology->cellsAt(point);
        return at.empty() ? 0 : *at.begin();
      });
    return cells;
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
    std::vector<std::int64_t> Items;
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

  void start(int k, const PieceGroups& groups, const std::uint8_t* shared)
  {
    std::vector<Reached> first;
    forPieces(this->Mesh, groups, topologyNeeded(),
      [&](const ResidentPiece& piece, std::int64_t begin, std::int64_t end)
      {
        LocalRing ring(piece, shared);
        std::vector<Reached> reached;
        std::vector<std::int64_t> left;
        Finished done;
        std::vector<std::int64_t> corners;
        constexpr std::int64_t batch = 16;
        std::int64_t indices[batch];
        for (std::int64_t i = begin; i < end; ++i)
        {
          const std::int64_t at = (i - begin) % batch;
          at == 0 ? this->findIndices(piece, groups, i, std::min(i + batch, end), indices) : void();
          const std::int64_t item = groups.Items[std::size_t(i)];
          corners.assign(1, indices[at]);
          if (!this->OfPoints)
          {
            corners.clear();
            for (int corner = 0; corner < piece.Topology->corners(); ++corner)
            {
              corners.push_back(piece.Topology->corner(indices[at], corner));
            }
          }
          if (ring.grow(corners, k, !this->OfPoints))
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
        this->Left.insert(this->Left.end(), left.begin(), left.end());
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
      indices[i - begin] = this->Indices
        ? this->Indices[item]
        : indexOf(this->Mesh, *piece.Topology, this->Seeds[item], this->OfPoints);
    }
    this->OfPoints ? piece.Topology->prefetch(indices, end - begin) : void();
  }

  void take(const MeshPart& part, const LocalRing& ring, std::int64_t item, Finished& done) const
  {
    const std::int64_t seed = this->Seeds[std::size_t(item)];
    Ids& ids = done.Lists.Ids;
    const auto begin = std::ptrdiff_t(ids.size());
    for (const std::int64_t index : this->OfPoints ? ring.Points : ring.Cells)
    {
      const std::int64_t id = this->OfPoints ? part.pointId(index) : part.cellId(index);
      id != seed ? ids.push_back(id) : void();
    }
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

  const ResidentMesh& Mesh;
  const std::vector<std::int64_t>& Seeds;
  const bool OfPoints;
  const std::int64_t* Indices = nullptr; ///< local indices of the seeds, if they are known
  std::mutex Mutex;
  std::vector<Reached> Front;
  std::vector<Finished> Done;
  /// Items with rings that leave their pieces. Only these have lists below.
  std::vector<std::int64_t> Left;
  std::vector<std::vector<std::int64_t>> PointLists; ///< lists per seed, ascending
  std::vector<std::vector<std::int64_t>> CellLists;  ///< lists per seed, with repetitions
};

/// As ringsInMemory(), for rings that need the cells of several ranks. All grow together, step by
/// step.
IdLists ringsAcrossRanks(const RankQuestions& questions, const Ids& seeds, int k, bool ofPoints)
{
  struct Ring
  {
    Ids Points; ///< found so far, ascending
    Ids Cells;  ///< found so far, ascending
    Ids Front;  ///< newly found points; within a step, newly found cells
  };
  std::vector<Ring> rings(seeds.size());
  const IdLists corners = ofPoints ? IdLists() : questions.corners(seeds);
  for (std::size_t i = 0; i < seeds.size(); ++i)
  {
    rings[i].Points = ofPoints ? Ids{ seeds[i] } : sortedUnique(corners.list(i));
    rings[i].Front = rings[i].Points;
  }
  // Replaces each front by the ids that listsOfFront() has for it and that the ring does not know.
  const auto advance = [&rings](const auto& listsOfFront, Ids Ring::*known)
  {
    Ids front;
    for (const Ring& ring : rings)
    {
      front.insert(front.end(), ring.Front.begin(), ring.Front.end());
    }
    sortUnique(front);
    const ListsById lists(front, listsOfFront(front));
    for (Ring& ring : rings)
    {
      Ids next;
      for (const std::int64_t id : ring.Front)
      {
        const Ids list = lists.of(id);
        next.insert(next.end(), list.begin(), list.end());
      }
      ring.Front = without(sortedUnique(std::move(next)), ring.*known);
      (ring.*known).insert((ring.*known).end(), ring.Front.begin(), ring.Front.end());
      std::sort((ring.*known).begin(), (ring.*known).end());
    }
  };
  const auto hasFront = [](const Ring& ring) { return !ring.Front.empty(); };
  for (int step = 0; step < k && questions.any(std::any_of(rings.begin(), rings.end(), hasFront));
       ++step)
  {
    advance([&](const Ids& points) { return questions.stars(points); }, &Ring::Cells);
    advance([&](const Ids& cells) { return questions.corners(cells); }, &Ring::Points);
  }
  IdLists result;
  for (std::size_t i = 0; i < rings.size(); ++i)
  {
    result.add(without(ofPoints ? rings[i].Points : rings[i].Cells, { seeds[i] }));
  }
  return result;
}

/// For parts in memory: the ids that are reached in k steps from each seed, without the seed.
IdLists ringsInMemory(
  const RankQuestions& questions, const ResidentMesh& part, const Ids& seeds, int k, bool ofPoints)
{
  const std::vector<std::uint8_t>& shared = questions.sharedPoints();
  IdLists within = questions.askFirst(seeds, ofPoints,
    [&](const Ids& own, const Ids& indices)
    { return RingGrowth(part, own, ofPoints).grownWithin(k, indices, shared.data()); });
  const auto leaves = [&within](std::size_t i)
  {
    return within.Starts[i] < within.Starts[i + 1] &&
      within.Ids[std::size_t(within.Starts[i])] == -1;
  };
  Ids others;
  for (std::size_t i = 0; i < seeds.size(); ++i)
  {
    leaves(i) ? others.push_back(seeds[i]) : void();
  }
  const IdLists across = ringsAcrossRanks(questions, others, k, ofPoints);
  if (others.empty())
  {
    return within;
  }
  IdLists result;
  result.Ids.reserve(within.Ids.size() + across.Ids.size());
  std::size_t next = 0;
  for (std::size_t i = 0; i < seeds.size(); ++i)
  {
    leaves(i) ? result.append(across, next++) : result.append(within, i);
    result.endList();
  }
  return result;
}

IdLists ringsOf(
  const ResidentMesh& mesh, const Ids& seeds, int k, bool ofPoints, Communicator* ranks)
{
  return listsOf(
    mesh, seeds, ofPoints, ranks,
    [&](const Ids& own, const std::vector<std::int32_t>& pieces)
    { return RingGrowth(mesh, own, ofPoints).grown(k, pieces); },
    [&](const RankQuestions& questions)
    { return ringsInMemory(questions, mesh, seeds, k, ofPoints); });
}

} // namespace

IdLists ringsOfPoints(
  const ResidentMesh& mesh, const std::vector<std::int64_t>& points, int k, Communicator* ranks)
{
  return ringsOf(mesh, points, k, true, ranks);
}

IdLists ringsOfCells(
  const ResidentMesh& mesh, const std::vector<std::int64_t>& cells, int k, Communicator* ranks)
{
  return ringsOf(mesh, cells, k, false, ranks);
}

} // namespace tipp
