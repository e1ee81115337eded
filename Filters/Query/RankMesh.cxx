// SPDX-License-Identifier: BSD-3-Clause
#include "Query/RankMesh.h"

#include "Arrays/Concatenated.h"
#include "Parallel/Sort.h"
#include "Partitioned/PieceFile.h"
#include "Partitioned/ReadPiece.h"
#include "Query/RankAnswer.h"
#include "Resident/ForPieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

namespace tipp
{

/// The ranks that have an id.
struct Holders
{
  std::int32_t First = -1; ///< the lowest; -1: none
  std::int32_t Count = 0;
};

/// Finds the ranks that have an id. The ids are distributed over the ranks in blocks, and each rank
/// knows who has the ids of its blocks. So the work for an id does not grow with the number of
/// ranks.
class IdDirectory
{
public:
  /// `own` are the ids that this rank has. Collective.
  IdDirectory(Communicator& ranks, const Ids& own)
  {
    std::vector<Ids> blocks(std::size_t(ranks.size()));
    for (const std::int64_t id : own)
    {
      blocks[rankFor(ranks, id)].push_back(id);
    }
    const std::vector<Ids> received = ranks.allToAll(blocks);
    std::vector<std::pair<std::int64_t, std::int32_t>> entries; // id, rank
    for (std::size_t rank = 0; rank < received.size(); ++rank)
    {
      for (const std::int64_t id : received[rank])
      {
        entries.emplace_back(id, std::int32_t(rank));
      }
    }
    sortUnique(entries);
    Ids ids;
    for (const auto& [id, rank] : entries)
    {
      if (ids.empty() || ids.back() != id)
      {
        ids.push_back(id);
        this->HoldersOf.push_back({ rank, 0 });
      }
      ++this->HoldersOf.back().Count;
    }
    this->Indices = GlobalIdMap(ids.data(), nullptr, ids.size());
  }

  /// Collective; each rank passes its own ids.
  std::vector<Holders> find(Communicator& ranks, const Ids& ids) const
  {
    std::vector<std::size_t> rankOf(ids.size());
    std::transform(ids.begin(), ids.end(), rankOf.begin(),
      [&ranks](std::int64_t id) { return rankFor(ranks, id); });
    return askRanks(ranks, rankOf, ids,
      [this](const Ids& received)
      {
        std::vector<Holders> holders;
        for (const std::int64_t id : received)
        {
          const std::int64_t index = this->Indices.find(id);
          holders.push_back(index < 0 ? Holders() : this->HoldersOf[std::size_t(index)]);
        }
        return holders;
      });
  }

private:
  /// The rank that knows who has an id.
  static std::size_t rankFor(const Communicator& ranks, std::int64_t id)
  {
    constexpr int bitsOfBlock = 10;
    return std::size_t((std::uint64_t(id) >> bitsOfBlock) % std::uint64_t(ranks.size()));
  }

  GlobalIdMap Indices;
  std::vector<Holders> HoldersOf;
};

namespace
{

/// The ghost flag of a point of this rank's part, which owns only points that are not shared.
enum Sharing : std::uint8_t
{
  NotShared,   ///< no other rank has cells there
  FirstShared, ///< this rank is the lowest of those that have cells there
  LaterShared
};

/// A cell with global ids.
struct CellCopy
{
  std::int64_t Id;
  std::int64_t Corners;
  std::array<std::int64_t, 4> Points;
  std::array<Point3, 4> Position;
};

/// A piece of these cells. `owned` are the ids of its own points, ascending.
MeshPart partOfCells(const std::vector<CellCopy>& cells, const Ids& owned)
{
  Ids points;
  for (const CellCopy& cell : cells)
  {
    points.insert(points.end(), cell.Points.begin(), cell.Points.begin() + cell.Corners);
  }
  sortUnique(points);
  Piece piece;
  piece.CellSize = cells.empty() ? 3 : int(cells[0].Corners);
  piece.WideIds = true;
  piece.Points = std::int64_t(points.size());
  piece.Cells = piece.OwnedCells = std::int64_t(cells.size());
  piece.Coordinates = Buffer<char>(points.size() * sizeof(Point3));
  piece.PointIds = Buffer<char>(points.size() * sizeof(std::int64_t));
  piece.PointGhosts = Buffer<char>(points.size());
  piece.CellIds = Buffer<char>(cells.size() * sizeof(std::int64_t));
  piece.Connectivity =
    Buffer<char>(cells.size() * std::size_t(piece.CellSize) * sizeof(std::int64_t));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    piece.PointIds.as<std::int64_t>()[i] = points[i];
    piece.PointGhosts[i] = std::binary_search(owned.begin(), owned.end(), points[i]) ? 0 : 1;
  }
  auto* corner = piece.Connectivity.as<std::int64_t>();
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
  {
    piece.CellIds.as<std::int64_t>()[cell] = cells[cell].Id;
    for (std::size_t i = 0; i < std::size_t(piece.CellSize); ++i)
    {
      const auto at = std::lower_bound(points.begin(), points.end(), cells[cell].Points[i]);
      *corner = at - points.begin();
      piece.Coordinates.as<Point3>()[*corner++] = cells[cell].Position[i];
    }
  }
  return partOf(std::move(piece));
}

/// This rank's cells at those of `points` that its part has, each once.
std::vector<CellCopy> copiesAt(const ResidentPiece& piece, const Ids& points)
{
  const PartTopology& topology = *piece.Topology;
  std::vector<std::int32_t> cells;
  for (const std::int64_t id : points)
  {
    const std::int64_t point = topology.findPoint(id);
    if (point >= 0)
    {
      cells.insert(cells.end(), topology.cellsAt(point).begin(), topology.cellsAt(point).end());
    }
  }
  sortUnique(cells);
  std::vector<CellCopy> copies;
  for (const std::int32_t cell : cells)
  {
    CellCopy copy{ piece.Part->cellId(cell), topology.corners(), {}, {} };
    for (int i = 0; i < topology.corners(); ++i)
    {
      copy.Points[std::size_t(i)] = piece.Part->pointId(topology.corner(cell, i));
      copy.Position[std::size_t(i)] = positionOf(*piece.Part, topology.corner(cell, i));
    }
    copies.push_back(copy);
  }
  return copies;
}

/// The Sharing of each point of this rank's part. Only points in the box of another rank's part,
/// and points that are not finite, can be shared.
std::vector<std::uint8_t> sharingOf(
  Communicator& ranks, const ResidentMesh& mesh, const ResidentPiece& piece)
{
  std::vector<Box3> boxes = ranks.allGather(mesh.mesh().Domain);
  boxes.erase(boxes.begin() + ranks.rank());
  const MeshPart& part = *piece.Part;
  const auto hasCells = [&piece](std::int64_t point)
  { return !piece.Topology->cellsAt(point).empty(); };
  const auto mayBeShared = [&](std::int64_t point)
  {
    Point3 at = positionOf(part, point);
    at.z = part.Mesh.Dimension == 3 ? at.z : 0; // as in the bounds of triangles
    return !std::isfinite(at.x + at.y + at.z) ||
      std::any_of(boxes.begin(), boxes.end(),
        [&](const Box3& box) { return contains(box, at, part.Mesh.Dimension); });
  };
  Ids points; // local indices
  Ids ids;
  Ids withCells;
  for (std::int64_t point = 0; point < part.Mesh.PointCount; ++point)
  {
    if (mayBeShared(point))
    {
      points.push_back(point);
      ids.push_back(part.pointId(point));
      if (hasCells(point))
      {
        withCells.push_back(ids.back());
      }
    }
  }
  const std::vector<Holders> holders = IdDirectory(ranks, withCells).find(ranks, ids);
  std::vector<std::uint8_t> result(std::size_t(part.Mesh.PointCount), NotShared);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const bool isShared = holders[i].Count > (hasCells(points[i]) ? 1 : 0);
    const bool isFirst = holders[i].First == ranks.rank();
    result[std::size_t(points[i])] = !isShared ? NotShared : isFirst ? FirstShared : LaterShared;
  }
  return result;
}

/// This rank's part, which does not own shared points. Throws IOError if ids are missing, or the
/// parts differ in their type of cells.
ResidentPiece ownPiece(Communicator& ranks, const ResidentMesh& mesh)
{
  requireIds(&ranks, mesh);
  ResidentPiece piece = *mesh.pieces().get(0, topologyNeeded());
  ResidentMesh::OtherParts& others = mesh.otherParts();
  if (isTrueOnAny(ranks, others.Controller != ranks.controller()))
  {
    others = {};
    const RankParts all(&ranks, mesh, {}); // throws if the parts differ in their type of cells
    others.Sharing = sharingOf(ranks, mesh, piece);
    others.Controller = ranks.controller();
  }
  MeshPart part = *piece.Part;
  part.Ghosts = others.Sharing.data();
  piece.Part = std::make_shared<const MeshPart>(part);
  return piece;
}

/// Which rank answers which ids.
struct Shares
{
  std::vector<std::int32_t> Ranks;  ///< the rank that answers each of this rank's ids; -1: none
  std::vector<Ids> Received;        ///< by rank: its ids that this rank answers, in order
  std::vector<std::int32_t> Pieces; ///< the piece of each received id
};

/// For a stored mesh, each rank answers the ids that its pieces own.
Shares sharesOf(Communicator& ranks, const ResidentMesh& mesh, const Ids& ids, bool ofPoints)
{
  const std::vector<Ids> asked = ranks.allGather(ids);
  const auto [first, end] = piecesOfRank(&ranks, mesh);
  std::vector<double> pieces; // infinite if no rank has the id
  for (const std::int32_t piece : mesh.piecesOfIds(concatenated(asked), ofPoints, first, end))
  {
    pieces.push_back(piece < 0 ? HUGE_VAL : piece);
  }
  ranks.minimum(pieces);
  Shares shares{ {}, std::vector<Ids>(asked.size()), {} };
  auto next = pieces.begin();
  for (std::size_t rank = 0; rank < asked.size(); ++rank)
  {
    for (const std::int64_t id : asked[rank])
    {
      const double piece = *next++;
      const int owner =
        std::isfinite(piece) ? int(rankOfPiece(ranks, mesh, std::int64_t(piece))) : -1;
      if (owner == ranks.rank())
      {
        shares.Received[rank].push_back(id);
        shares.Pieces.push_back(std::int32_t(piece));
      }
      if (rank == std::size_t(ranks.rank()))
      {
        shares.Ranks.push_back(owner);
      }
    }
  }
  return shares;
}

/// For a mesh in memory, the lowest rank whose part has an id answers it.
Shares sharesOf(Communicator& ranks, const RankMesh& mesh, const Ids& ids, bool ofPoints)
{
  Shares shares;
  shares.Ranks = mesh.firstRanksOf(ids, ofPoints);
  std::vector<Ids> asked(std::size_t(ranks.size()));
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    if (!(shares.Ranks[i] < 0))
    {
      asked[std::size_t(shares.Ranks[i])].push_back(ids[i]);
    }
  }
  shares.Received = ranks.allToAll(asked);
  const Ids received = concatenated(shares.Received);
  shares.Pieces =
    ofPoints ? mesh.piecesAround(received) : std::vector<std::int32_t>(received.size(), 0);
  return shares;
}

/// Throws IOError if an owner is -1.
void refuseMissing(
  const ResidentMesh& mesh, const Ids& ids, bool ofPoints, const std::vector<std::int32_t>& owners)
{
  const auto missing = std::find(owners.begin(), owners.end(), -1);
  if (missing != owners.end())
  {
    mesh.refuseId(ids[std::size_t(missing - owners.begin())], ofPoints);
  }
}

} // namespace

RankMesh::RankMesh(Communicator& ranks, const ResidentMesh& part)
  : ResidentMesh(part, ownPiece(ranks, part))
  , Ranks(ranks)
  , Part(part)
{
}

std::vector<std::int32_t> RankMesh::piecesAround(
  const Ids& points, const std::vector<Point3>&) const
{
  const ResidentPiece& own = this->InMemory[0];
  std::vector<std::int32_t> pieces(points.size(), 0);
  Ids missing;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const std::int64_t index = own.Topology->findPoint(points[i]);
    if (index < 0 || !own.Part->owns(index))
    {
      const auto owner = this->Owners.find(points[i]);
      pieces[i] = owner != this->Owners.end() ? owner->second : -1;
      if (pieces[i] < 0)
      {
        missing.push_back(points[i]);
      }
    }
  }
  const std::int32_t added = this->addCellsAt(sortedUnique(std::move(missing)));
  std::replace(pieces.begin(), pieces.end(), -1, added);
  return pieces;
}

bool RankMesh::isTrueOnAnyRank(bool condition) const
{
  return isTrueOnAny(this->Ranks, condition);
}

/// Adds a piece that owns these points, which are ascending, with the cells of all ranks there.
/// Returns its number.
std::int32_t RankMesh::addCellsAt(const Ids& points) const
{
  std::vector<std::vector<CellCopy>> replies;
  for (const Ids& asked :
    this->Ranks.allToAll(std::vector<Ids>(std::size_t(this->Ranks.size()), points)))
  {
    replies.push_back(copiesAt(this->InMemory[0], asked));
  }
  const std::vector<CellCopy> cells = concatenated(this->Ranks.allToAll(replies));
  const std::int32_t piece = this->addPiece(partOfCells(cells, points));
  for (const std::int64_t point : points)
  {
    this->Owners.emplace(point, piece);
  }
  return piece;
}

std::size_t RankMesh::addFirstShared() const
{
  const MeshPart& part = *this->InMemory[0].Part;
  Ids points;
  for (std::int64_t point = 0; point < part.Mesh.PointCount; ++point)
  {
    if (part.Ghosts[point] == FirstShared)
    {
      points.push_back(part.pointId(point));
    }
  }
  return std::size_t(this->addCellsAt(sortedUnique(std::move(points)))) + 1;
}

std::vector<std::int32_t> RankMesh::firstRanksOf(const Ids& ids, bool ofPoints) const
{
  ResidentMesh::OtherParts& others = this->Part.otherParts();
  std::shared_ptr<const IdDirectory>& directory = ofPoints ? others.Points : others.Cells;
  if (isTrueOnAny(this->Ranks, !directory))
  {
    const MeshPart& part = *this->InMemory[0].Part;
    Ids own(std::size_t(ofPoints ? part.Mesh.PointCount : part.Mesh.Cells));
    for (std::size_t i = 0; i < own.size(); ++i)
    {
      own[i] = ofPoints ? part.pointId(std::int64_t(i)) : part.cellId(std::int64_t(i));
    }
    directory = std::make_shared<const IdDirectory>(this->Ranks, own);
  }
  std::vector<std::int32_t> result;
  for (const Holders& holders : directory->find(this->Ranks, ids))
  {
    result.push_back(holders.First);
  }
  return result;
}

IdLists listsOf(const ResidentMesh& mesh, const Ids& ids, bool ofPoints, Communicator* ranks,
  const ListWork& work)
{
  if (!areSeveral(ranks))
  {
    const std::vector<std::int32_t> pieces =
      mesh.piecesOfIds(ids, ofPoints, 0, mesh.mesh().Pieces.size());
    refuseMissing(mesh, ids, ofPoints, pieces);
    return work(mesh, ids, pieces);
  }
  std::optional<RankMesh> inMemory;
  if (!mesh.isStored())
  {
    inMemory.emplace(*ranks, mesh);
  }
  const Shares shares =
    inMemory ? sharesOf(*ranks, *inMemory, ids, ofPoints) : sharesOf(*ranks, mesh, ids, ofPoints);
  refuseMissing(mesh, ids, ofPoints, shares.Ranks);
  const IdLists lists =
    work(inMemory ? *inMemory : mesh, concatenated(shares.Received), shares.Pieces);
  std::vector<IdLists> replies(shares.Received.size());
  std::size_t next = 0;
  for (std::size_t rank = 0; rank < replies.size(); ++rank)
  {
    for (std::size_t i = 0; i < shares.Received[rank].size(); ++i)
    {
      replies[rank].append(lists, next++);
    }
  }
  replies = ranks->allToAll(replies);
  IdLists result;
  result.Ids.reserve(std::accumulate(replies.begin(), replies.end(), std::size_t(0),
    [](std::size_t sum, const IdLists& reply) { return sum + reply.Ids.size(); }));
  result.Starts.reserve(ids.size() + 1);
  std::vector<std::size_t> nextOf(replies.size(), 0);
  for (const std::int32_t rank : shares.Ranks)
  {
    result.append(replies[std::size_t(rank)], nextOf[std::size_t(rank)]++);
  }
  return result;
}

} // namespace tipp
