// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed3D/DistributedTetrahedralization.h"

#include "Arrays/Concatenated.h"
#include "Distributed/DistributedTriangulation.h"
#include "Distributed/NeighborCells.h"
#include "Distributed3D/RankRun3.h"
#include "Parallel/ParallelFor.h"
#include "Triangulation3D/OrderCells.h"

#include <limits>
#include <memory>
#include <stdexcept>
#include <unordered_map>
#include <utility>

namespace tipp
{
namespace
{

/// The run of one rank; its member functions are the steps.
class DistributedRun3
{
public:
  DistributedRun3(Communicator& ranks, const RankPoints3& points,
    const TetrahedralizationOptions& options, DistributedTetrahedralization& result)
    : Ranks(ranks)
    , Input(points)
    , Options(options)
    , Result(result)
    , Threads(threadCount(options.Threads))
  {
    result.RowSize = points.RowSize;
  }

  void run()
  {
    const Stopwatch watch;
    this->FinitePoints =
      surveyRanks<3>(this->Ranks, this->Input, this->Result, this->Threads).finite();
    this->Figures.InputPoints = std::int64_t(this->Input.Points.size());
    this->shareOut();
    this->Figures.ExchangeSeconds = watch.seconds();
    this->Figures.OwnedPoints = std::int64_t(this->Result.Owned.size());
    const bool isDone = this->triangulatePartitions();
    if (!isDone)
    {
      this->triangulateOnFirst();
    }
    const Stopwatch collecting;
    this->collect();
    this->Figures.CollectSeconds = collecting.seconds();
    this->Figures.TotalSeconds = watch.seconds();
    const std::size_t cells = this->Result.cellCount();
    this->Figures.Triangles = this->Result.cellSize() == 3 ? 0 : std::int64_t(cells);
    setTotals(this->Ranks, cells, this->Figures, {}, this->Threads, this->Result);
  }

private:
  /// Returns a sample of all ranks' points; the same on all ranks.
  std::vector<Point3> sample()
  {
    constexpr std::int64_t wanted = 1 << 16;
    const auto step = std::size_t(std::max<std::int64_t>(1, this->Result.AllPoints / wanted));
    return concatenated(this->Ranks.allGather(sampleEvery(this->Input.Points, double(step))));
  }

  /// Divides space among the ranks, and sends each rank the points of its partitions.
  void shareOut()
  {
    // All ranks use the first rank's options, so that they choose the same partitions.
    const auto threads = this->Ranks.broadcast(this->Threads);
    this->Partitions = this->Ranks.broadcast(this->Options.Partitions);
    this->Groups = chooseGroups(this->FinitePoints, this->Ranks.size(), threads, this->Partitions);
    this->Tiling = std::make_unique<Tiling3>(this->sample(), this->Groups);
    this->Result.Owned = exchangePoints(this->Ranks, this->Input, *this->Tiling, this->Threads);
    this->Result.FirstIds = firstIndices(this->Ranks, std::int64_t(this->Result.Owned.size()));
    // Half of the indices are reserved for other ranks' points.
    if (this->Result.Owned.size() > std::size_t(std::numeric_limits<std::int32_t>::max() / 2))
    {
      throw std::length_error("a rank has more than 1,073,741,823 points; use more ranks.");
    }
  }

  std::int64_t firstOwn() const { return this->Result.FirstIds[std::size_t(this->Ranks.rank())]; }

  /// Returns false, without a triangulation, if partitions do not pay or cannot be made.
  bool triangulatePartitions()
  {
    constexpr std::int64_t fewest = 32768;
    const bool isChosen = this->Partitions > 0;
    if (this->Tiling->size() == 1 || (this->FinitePoints < fewest && !isChosen))
    {
      return false;
    }
    PointBuckets3 buckets =
      bucketPoints({ this->Result.Owned.Positions.data(), this->Result.Owned.size() },
        *this->Tiling, this->Threads);
    std::vector<std::int64_t> ids;
    const PointBuckets3 initial =
      shareInitialPoints(this->Ranks, *this->Tiling, this->firstOwn(), buckets, ids);
    buckets.Regions = initial.Regions;
    const std::vector<Vertex3> artificial =
      makeArtificialPoints(initial, this->Groups.ArePartitionsSlabs);
    if (artificial.empty())
    {
      return false;
    }
    BoundaryCells<3> mesh =
      makeInitialMesh(*this->Tiling, initial, artificial, initial.Points.size());
    constexpr double most = 3; // fewer if there are few partitions to meet
    if (!isChosen && !partitionsPay(mesh, std::min(most, (1 + this->Tiling->size()) / 2.0)))
    {
      return false;
    }
    for (Vertex3& v : mesh.Vertices)
    {
      v.Id = v.isArtificial() ? v.Id : ids[std::size_t(v.Id)];
    }
    std::sort(ids.begin(), ids.end());
    this->InitialIds = std::move(ids);
    const PartitionOrder order(initial.areUsed(), mesh);
    const RankWork3 work{ *this->Tiling, order, artificial, this->Options, this->Threads };
    RankRun3 run(this->Ranks, work, buckets, this->firstOwn());
    run.Statistics = this->Figures;
    run.run(sendInitialMesh(mesh, order));
    this->Figures = run.Statistics;
    this->Inside = std::move(run.Inside);
    this->Kept = std::move(run.Kept);
    this->Duplicates = std::move(run.Duplicates);
    this->Result.Statistics.Partitions = this->Tiling->size();
    return this->hasCells();
  }

  /// Returns false, and discards the results, if all ranks together have no tetrahedra. Then the
  /// points are coplanar, or too few, and the kernel finds out which.
  bool hasCells()
  {
    const bool hasOwn = !this->Kept.empty() ||
      std::any_of(this->Inside.begin(), this->Inside.end(),
        [](const std::vector<CellIds>& part) { return !part.empty(); });
    if (isTrueOnAny(this->Ranks, hasOwn))
    {
      this->Result.Dimension = 3;
      return true;
    }
    this->Inside.clear();
    this->Duplicates.clear();
    return false;
  }

  /// Triangulates all points on the first rank. The points stay with their owners.
  void triangulateOnFirst()
  {
    const std::int64_t all = this->Result.FirstIds.back();
    if (all > std::numeric_limits<std::int32_t>::max())
    {
      throw std::length_error("more than 2,147,483,647 points whose partitions do not pay are not "
                              "supported in memory");
    }
    Buffer<Point3> own(this->Result.Owned.size());
    std::copy(
      this->Result.Owned.Positions.begin(), this->Result.Owned.Positions.end(), own.begin());
    const Buffer<Point3> points = gatherValues(this->Ranks, std::move(own));
    std::vector<std::vector<Duplicate>> duplicates(std::size_t(this->Ranks.size()));
    this->Figures.Partitions = 0;
    if (this->Ranks.isFirst())
    {
      const ProcessorWatch watch;
      for (const Duplicate& duplicate : this->triangulateAll(points))
      {
        duplicates[ownerOf(duplicate.Point, this->Result.FirstIds)].push_back(duplicate);
      }
      this->Figures.Partitions = 1;
      this->Figures.WorkerVertices = std::int64_t(points.size());
      this->Figures.ComputeSeconds += watch.seconds();
    }
    this->Duplicates = concatenated(this->Ranks.allToAll(duplicates));
    this->Result.Dimension = this->Ranks.broadcast(this->Result.Dimension);
    this->Result.Statistics.Partitions = 1;
  }

  /// Sets Kept to the cells of all points, and returns the duplicates.
  std::vector<Duplicate> triangulateAll(const Buffer<Point3>& points)
  {
    TetrahedralizationOptions options = this->Options;
    options.Partitions = 1;
    Tetrahedralization whole = tetrahedralize(points.data(), points.size(), options);
    Triangulation flat;
    if (whole.Dimension == 2)
    {
      flat = triangulateCoplanar(points.data(), points.size(), options, whole);
    }
    if (whole.Aborted || flat.Aborted)
    {
      throw RankFailure(this->Ranks.rank(), true, "The run was stopped.");
    }
    this->Result.Dimension = whole.Dimension;
    const Buffer<std::int32_t>& ids = whole.Dimension == 2 ? flat.Ids32 : whole.Ids;
    const std::size_t size = this->Result.cellSize();
    this->Kept.resize(ids.size() / size);
    for (std::size_t i = 0; i < this->Kept.size(); ++i)
    {
      // In triangles, the last corner is repeated.
      for (std::size_t k = 0; k < 4; ++k)
      {
        this->Kept[i][k] = ids[size * i + std::min(k, size - 1)];
      }
    }
    return std::move(whole.Duplicates);
  }

  /// Replaces duplicates by their representatives in this rank's tetrahedra. A tetrahedron with
  /// vertices from other partitions may have duplicates as corners, but only initial points.
  /// Collective.
  void useRepresentatives()
  {
    std::vector<Duplicate> initial;
    for (const Duplicate& duplicate : this->Duplicates)
    {
      if (std::binary_search(this->InitialIds.begin(), this->InitialIds.end(), duplicate.Point))
      {
        initial.push_back(duplicate);
      }
    }
    std::unordered_map<std::int64_t, std::int64_t> representatives;
    for (const Duplicate& duplicate : concatenated(this->Ranks.allGather(initial)))
    {
      representatives.emplace(duplicate.Point, duplicate.Representative);
    }
    if (representatives.empty())
    {
      return;
    }
    const auto replaced = [&](std::int64_t id)
    {
      const auto found = representatives.find(id);
      return found == representatives.end() ? id : found->second;
    };
    const std::int64_t first = this->firstOwn();
    for (std::vector<CellIds>& part : this->Inside)
    {
      for (CellIds& cell : part)
      {
        std::transform(cell.begin(), cell.end(), cell.begin(),
          [&](std::int32_t index) { return std::int32_t(replaced(first + index) - first); });
      }
    }
    for (IdCell<4>& cell : this->Kept)
    {
      std::transform(cell.begin(), cell.end(), cell.begin(), replaced);
    }
  }

  /// Sends each cell to its owner, and fetches the points that this rank's cells need.
  void collect()
  {
    this->useRepresentatives();
    DistributedTetrahedralization& mine = this->Result;
    const std::int64_t first = this->firstOwn();
    const std::vector<IdCell<4>> cells =
      sendToOwners(this->Ranks, std::exchange(this->Kept, {}), mine.FirstIds);
    mine.GhostIds = ghostIds(cells, first, first + std::int64_t(mine.Owned.size()));
    const auto indexOf = localIndices(first, mine.Owned.size(), mine.GhostIds);
    std::vector<CellIds> local(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      std::transform(cells[i].begin(), cells[i].end(), local[i].begin(),
        [&indexOf](std::int64_t id) { return std::int32_t(indexOf(id)); });
    }
    this->Inside.push_back(std::move(local));
    preferLowestGlobalIds(mine.Owned, first, this->Duplicates);
    mine.Duplicates = std::move(this->Duplicates);
    mine.Ghosts = fetchPoints(this->Ranks, mine.GhostIds, mine.FirstIds, mine.Owned, mine.RowSize);
    this->Ranks.flush(); // other ranks wait for these messages
    mine.Ids = mine.cellSize() == 3
      ? orderTriangles(this->Inside.back())
      : orderCells(std::move(this->Inside), mine.Owned.size() + mine.Ghosts.size(), this->Threads);
    mine.divideBy(this->Input.Points.factor());
  }

  Communicator& Ranks;
  RankPoints3 Input;
  const TetrahedralizationOptions& Options;
  DistributedTetrahedralization& Result;
  const int Threads;
  std::int64_t FinitePoints = 0; ///< of all ranks
  int Partitions = 0;            ///< as requested; 0: chosen automatically
  PartitionGroups Groups;
  std::unique_ptr<Tiling3> Tiling;
  std::vector<std::int64_t> InitialIds;     ///< internal ids of all initial points; ascending
  std::vector<std::vector<CellIds>> Inside; ///< tetrahedra by indices of this rank's points
  std::vector<IdCell<4>> Kept;              ///< the other final tetrahedra, by internal ids
  std::vector<Duplicate> Duplicates;        ///< of this rank's points, by internal ids
  RankStatistics Figures;
};

/// Returns all ranks' cells on the first rank, sorted. Corners are given by idOf(local index).
template <typename IdOf>
Buffer<std::int32_t> gatherCells(Communicator& ranks, const DistributedTetrahedralization& mine,
  std::int64_t points, const IdOf& idOf, int threads)
{
  if (points > std::numeric_limits<std::int32_t>::max())
  {
    throw std::length_error("more than 2,147,483,647 points in space are not supported on one "
                            "rank.");
  }
  const auto convert = [&](std::int32_t index) { return std::int32_t(idOf(index)); };
  if (mine.cellSize() == 3)
  {
    Buffer<std::int32_t> ids(mine.Ids.size());
    std::transform(mine.Ids.begin(), mine.Ids.end(), ids.begin(), convert);
    ids = gatherValues(ranks, std::move(ids));
    orderTriangles(ids);
    return ids;
  }
  // All ranks sort their cells, and the first one merges them.
  std::vector<std::vector<CellIds>> cells(1);
  cells[0].reserve(mine.cellCount());
  std::transform(mine.Ids.as<CellIds>(), mine.Ids.as<CellIds>() + mine.cellCount(),
    std::back_inserter(cells[0]),
    [&](const CellIds& cell) -> CellIds {
      return { convert(cell[0]), convert(cell[1]), convert(cell[2]), convert(cell[3]) };
    });
  return mergeCells(
    ranks.gather(Bytes(orderCells(std::move(cells), std::size_t(points), threads))));
}

/// Returns a rank's cells by internal ids. In triangles, the last corner is repeated.
std::vector<IdCell<4>> cellsByIds(const DistributedTetrahedralization& mine, int rank)
{
  const auto idOf = internalIds(mine, rank);
  const std::size_t size = mine.cellSize();
  std::vector<IdCell<4>> cells(mine.cellCount());
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    for (std::size_t k = 0; k < 4; ++k)
    {
      cells[i][k] = idOf(mine.Ids[size * i + std::min(k, size - 1)]);
    }
  }
  return cells;
}

} // namespace

DistributedTetrahedralization tetrahedralizeDistributed(
  Communicator& ranks, const RankPoints3& points, const TetrahedralizationOptions& options)
{
  return runTogether<DistributedRun3, DistributedTetrahedralization>(ranks, points, options);
}

GhostTetrahedra fetchGhosts(Communicator& ranks, const DistributedTetrahedralization& mine)
{
  return fetchGhosts<Point3>(ranks, mine, cellsByIds(mine, ranks.rank()));
}

Buffer<std::int64_t> neighborIds(
  Communicator& ranks, const DistributedTetrahedralization& mine, const GhostTetrahedra& ghosts)
{
  return neighborIdsOf(ranks, mine, cellsByIds(mine, ranks.rank()), ghosts, mine.cellSize());
}

DistributedTetrahedralization gatherOnFirst(
  Communicator& ranks, DistributedTetrahedralization mine, int threads)
{
  mine.Ids =
    gatherCells(ranks, mine, mine.FirstIds.back(), internalIds(mine, ranks.rank()), threads);
  gatherPoints(ranks, mine);
  mine.FirstCell = ranks.isFirst() ? 0 : mine.AllCells;
  return mine;
}

Tetrahedralization gatherTetrahedra(Communicator& ranks, const DistributedTetrahedralization& mine,
  int threads, Triangulation& triangles)
{
  Tetrahedralization all;
  all.Dimension = mine.Dimension;
  Buffer<std::int32_t> ids = gatherCells(ranks, mine, mine.AllPoints, globalIds(mine), threads);
  gatherDuplicatesAndRejected(ranks, mine, all);
  if (mine.Dimension == 2)
  {
    triangles.Ids32 = std::move(ids);
    triangles.Duplicates = all.Duplicates;
    triangles.Rejected = all.Rejected;
  }
  else
  {
    all.Ids = std::move(ids);
  }
  return all;
}

} // namespace tipp
