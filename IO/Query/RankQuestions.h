// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRankQuestions_h
#define tippRankQuestions_h

#include "Arrays/SortUnique.h"
#include "Partitioned/PieceFile.h"
#include "Query/Around.h"
#include "Query/ForPieces.h"
#include "Query/RankAnswer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace tipp
{

using Ids = std::vector<std::int64_t>;

/// A rank's lists for the ids that it was sent.
struct ListReply
{
  std::vector<char> Known; ///< per id: whether the rank has it
  IdLists Lists;           ///< per id; empty if it is unknown
};

template <typename Archive>
void serialize(Archive& archive, ListReply& reply)
{
  archive(reply.Known, reply.Lists);
}

inline Ids without(const Ids& ids, const Ids& others)
{
  Ids result;
  std::set_difference(
    ids.begin(), ids.end(), others.begin(), others.end(), std::back_inserter(result));
  return result;
}

/// Lists that are found by id.
class ListsById
{
public:
  /// `ids` are ascending.
  ListsById(const Ids& ids, IdLists lists)
    : Sorted(ids)
    , Lists(std::move(lists))
  {
  }
  Ids of(std::int64_t id) const
  {
    const auto found = std::lower_bound(this->Sorted.begin(), this->Sorted.end(), id);
    return this->Lists.list(std::size_t(found - this->Sorted.begin()));
  }

private:
  const Ids& Sorted;
  const IdLists Lists;
};

/// Finds the rank that has an id, for a mesh whose parts are in the memory of several ranks. The
/// ids are distributed over the ranks in blocks, and each rank knows who has the ids of its blocks.
/// So the work for an id does not grow with the number of ranks.
class IdDirectory
{
public:
  /// `ids` are those that this rank has. Collective.
  IdDirectory(Communicator& ranks, const std::vector<std::int64_t>& ids)
  {
    std::vector<std::pair<std::int64_t, std::int64_t>> entries; // id, rank
    const std::vector<std::vector<std::int64_t>> received = ranks.allToAll(inBlocks(ranks, ids));
    for (std::size_t rank = 0; rank < received.size(); ++rank)
    {
      for (const std::int64_t id : received[rank])
      {
        entries.emplace_back(id, std::int64_t(rank));
      }
    }
    std::sort(entries.begin(), entries.end());
    const auto hasSameId = [](const auto& a, const auto& b) { return a.first == b.first; };
    entries.erase(std::unique(entries.begin(), entries.end(), hasSameId), entries.end());
    std::vector<std::int64_t> sorted;
    std::vector<std::int64_t> owners;
    for (const auto& [id, rank] : entries)
    {
      sorted.push_back(id);
      owners.push_back(rank);
    }
    this->Owners = GlobalIdMap(sorted.data(), owners.data(), sorted.size());
  }

  /// For each id, the lowest rank that has it, or -1. Collective; each rank passes its own ids.
  std::vector<std::int32_t> ranksOf(Communicator& ranks, const std::vector<std::int64_t>& ids) const
  {
    std::vector<std::vector<std::int32_t>> replies;
    for (const std::vector<std::int64_t>& asked : ranks.allToAll(inBlocks(ranks, ids)))
    {
      replies.emplace_back(asked.size());
      std::transform(asked.begin(), asked.end(), replies.back().begin(),
        [this](std::int64_t id) { return std::int32_t(this->Owners.find(id)); });
    }
    replies = ranks.allToAll(replies);
    std::vector<std::int32_t> result;
    result.reserve(ids.size());
    std::vector<std::size_t> next(replies.size(), 0);
    for (const std::int64_t id : ids)
    {
      const std::size_t rank = rankFor(ranks, id);
      result.push_back(replies[rank].at(next[rank]++));
    }
    return result;
  }

private:
  /// The rank that knows who has an id.
  static std::size_t rankFor(const Communicator& ranks, std::int64_t id)
  {
    constexpr int bitsOfBlock = 10;
    return std::size_t((std::uint64_t(id) >> bitsOfBlock) % std::uint64_t(ranks.size()));
  }

  static std::vector<std::vector<std::int64_t>> inBlocks(
    const Communicator& ranks, const std::vector<std::int64_t>& ids)
  {
    std::vector<std::vector<std::int64_t>> result(std::size_t(ranks.size()));
    for (const std::int64_t id : ids)
    {
      result[rankFor(ranks, id)].push_back(id);
    }
    return result;
  }

  GlobalIdMap Owners;
};

/// Requests lists of ids from several ranks. All functions are collective, and throw IOError for an
/// id that no rank has.
class RankQuestions
{
public:
  RankQuestions(Communicator& ranks, const ResidentMesh& mesh)
    : Ranks(ranks)
    , Mesh(mesh)
  {
    requireIds(&ranks, mesh);
  }

  /// For stored meshes: lists that work(ids, pieces) returns on the ranks that have the pieces of
  /// these ids.
  template <typename Work>
  IdLists askOwners(const Ids& ids, bool ofPoints, const Work& work) const
  {
    const auto find = [&](const Ids& asked)
    {
      const auto [first, end] = piecesOfRank(&this->Ranks, this->Mesh);
      return this->Mesh.findIds(asked, ofPoints, first, end);
    };
    return this->joined(ids, ofPoints, {}, false, this->repliesTo(this->toAll(ids), find, work));
  }

  /// For parts in memory: lists that work(ids, indices) returns on the first rank that has each of
  /// these ids. Indices are local.
  template <typename Work>
  IdLists askFirst(const Ids& ids, bool ofPoints, const Work& work) const
  {
    const std::vector<std::int32_t> first = this->firstRanksOf(ids, ofPoints);
    std::vector<Ids> asked(std::size_t(this->Ranks.size()));
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      first[i] < 0 ? this->Mesh.refuseId(ids[i], ofPoints) : void();
      asked[std::size_t(first[i])].push_back(ids[i]);
    }
    const auto find = [&](const Ids& received) { return this->indicesOf(received, ofPoints); };
    return this->joined(ids, ofPoints, first, false, this->repliesTo(asked, find, work));
  }

  /// For parts in memory: the cells at each point, ascending.
  IdLists stars(const Ids& points) const
  {
    const auto find = [&](const Ids& received) { return this->indicesOf(received, true); };
    const auto work = [this](const Ids&, const Ids& indices)
    {
      const ResidentPieces::Lease piece = this->Mesh.pieces().get(0, topologyNeeded());
      IdLists lists;
      for (const std::int64_t index : indices)
      {
        for (const std::int32_t cell : piece->Topology->cellsAt(index))
        {
          lists.Ids.push_back(piece->Part->cellId(cell));
        }
        lists.endList();
      }
      return lists;
    };
    return this->joined(points, true, {}, true, this->repliesTo(this->toAll(points), find, work));
  }

  /// For parts in memory: the points of each cell, in the cell's order.
  IdLists corners(const Ids& cells) const
  {
    return this->askFirst(cells, false,
      [this](const Ids&, const Ids& indices)
      {
        const ResidentPieces::Lease piece = this->Mesh.pieces().get(0, topologyNeeded());
        IdLists lists;
        for (const std::int64_t index : indices)
        {
          for (int i = 0; i < piece->Topology->corners(); ++i)
          {
            lists.Ids.push_back(piece->Part->pointId(piece->Topology->corner(index, i)));
          }
          lists.endList();
        }
        return lists;
      });
  }

  /// Whether `isSo` is true on any rank.
  bool any(bool isSo) const
  {
    std::vector<std::int64_t> count = { isSo ? 1 : 0 };
    this->Ranks.sum(count);
    return count[0] > 0;
  }

  /// For each point of this rank's part (by local index), whether cells of other ranks have it,
  /// too. Kept in the mesh for the next query.
  const std::vector<std::uint8_t>& sharedPoints() const
  {
    ResidentMesh::OtherParts& others = this->otherParts();
    if (!this->any(!others.HavePoint))
    {
      return *others.HavePoint;
    }
    const ResidentPieces::Lease piece = this->Mesh.pieces().get(0, topologyNeeded());
    const std::vector<Ids> points = this->pointsInBoxes(*piece->Part);
    std::vector<Ids> asked(points.size());
    for (std::size_t rank = 0; rank < points.size(); ++rank)
    {
      std::transform(points[rank].begin(), points[rank].end(), std::back_inserter(asked[rank]),
        [&piece](std::int64_t point) { return piece->Part->pointId(point); });
    }
    std::vector<std::vector<char>> replies;
    for (const Ids& ids : this->Ranks.allToAll(asked))
    {
      replies.emplace_back();
      for (const std::int64_t id : ids)
      {
        const std::int64_t index = piece->Topology->findPoint(id);
        replies.back().push_back(char(index >= 0 && !piece->Topology->cellsAt(index).empty()));
      }
    }
    replies = this->Ranks.allToAll(replies);
    std::vector<std::uint8_t> shared(std::size_t(piece->Part->Mesh.PointCount), 0);
    for (std::size_t rank = 0; rank < points.size(); ++rank)
    {
      for (std::size_t i = 0; i < points[rank].size(); ++i)
      {
        shared[std::size_t(points[rank][i])] |= std::uint8_t(replies[rank].at(i));
      }
    }
    return others.HavePoint.emplace(std::move(shared));
  }

private:
  std::vector<Ids> toAll(const Ids& ids) const
  {
    return std::vector<Ids>(std::size_t(this->Ranks.size()), ids);
  }

  /// For parts in memory: local indices of ids; -1 if this rank's part does not have the id.
  Ids indicesOf(const Ids& ids, bool ofPoints) const
  {
    const ResidentPieces::Lease piece = this->Mesh.pieces().get(0, topologyNeeded());
    Ids indices;
    for (const std::int64_t id : ids)
    {
      indices.push_back(ofPoints ? piece->Topology->findPoint(id) : piece->Topology->findCell(id));
    }
    return indices;
  }

  /// The reply of each rank for the ids that this rank asks of it. Each rank calls find(ids), which
  /// returns a negative number for each id that it does not have, and work(ids, found) for the
  /// others.
  template <typename Find, typename Work>
  std::vector<ListReply> repliesTo(
    const std::vector<Ids>& ids, const Find& find, const Work& work) const
  {
    Ids all;
    std::vector<std::size_t> ends;
    for (const Ids& asked : this->Ranks.allToAll(ids))
    {
      all.insert(all.end(), asked.begin(), asked.end());
      ends.push_back(all.size());
    }
    auto found = all.empty() ? decltype(find(all))() : find(all);
    Ids known;
    auto foundKnown = decltype(found)();
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      if (found[i] >= 0)
      {
        known.push_back(all[i]);
        foundKnown.push_back(found[i]);
      }
    }
    const IdLists lists = known.empty() ? IdLists() : work(known, foundKnown);
    std::vector<ListReply> replies(ends.size());
    std::size_t i = 0;
    std::size_t next = 0;
    for (std::size_t rank = 0; rank < replies.size(); ++rank)
    {
      ListReply& reply = replies[rank];
      for (; i < ends[rank]; ++i)
      {
        reply.Known.push_back(char(found[i] >= 0));
        found[i] >= 0 ? reply.Lists.append(lists, next++) : void();
        reply.Lists.endList();
      }
    }
    return this->Ranks.allToAll(replies);
  }

  /// The list of each id: that of the first rank that has the id or, if `united`, the union of all
  /// ranks' lists, ascending. If `only` is not empty, only the rank only[i] was asked for id i.
  IdLists joined(const Ids& ids, bool ofPoints, const std::vector<std::int32_t>& only, bool united,
    const std::vector<ListReply>& replies) const
  {
    IdLists result;
    result.Ids.reserve(std::accumulate(replies.begin(), replies.end(), std::size_t(0),
      [](std::size_t sum, const ListReply& reply) { return sum + reply.Lists.Ids.size(); }));
    result.Starts.reserve(ids.size() + 1);
    std::vector<std::size_t> next(replies.size(), 0);
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      bool isKnown = false;
      const std::size_t begin = only.empty() ? 0 : std::size_t(only[i]);
      const std::size_t end = only.empty() ? replies.size() : begin + 1;
      for (std::size_t rank = begin; rank < end; ++rank)
      {
        const std::size_t at = next[rank]++;
        if (replies[rank].Known.at(at) && (united || !isKnown))
        {
          result.append(replies[rank].Lists, at);
          isKnown = true;
        }
      }
      isKnown ? void() : this->Mesh.refuseId(ids[i], ofPoints);
      if (united)
      {
        const auto first = result.Ids.begin() + result.Starts.back();
        std::sort(first, result.Ids.end());
        result.Ids.erase(std::unique(first, result.Ids.end()), result.Ids.end());
      }
      result.endList();
    }
    return result;
  }

  /// What is known about the other ranks' parts; forgotten if the ranks have changed.
  ResidentMesh::OtherParts& otherParts() const
  {
    ResidentMesh::OtherParts& others = this->Mesh.otherParts();
    if (this->any(others.Of != this->Ranks.controller()))
    {
      others = {};
      others.Of = this->Ranks.controller();
    }
    return others;
  }

  /// The lowest rank that has each id, or -1.
  std::vector<std::int32_t> firstRanksOf(const Ids& ids, bool ofPoints) const
  {
    ResidentMesh::OtherParts& others = this->otherParts();
    std::shared_ptr<const IdDirectory>& directory = ofPoints ? others.Points : others.Cells;
    if (this->any(!directory))
    {
      const ResidentPieces::Lease piece = this->Mesh.pieces().get(0, topologyNeeded());
      const MeshPart& part = *piece->Part;
      Ids own(std::size_t(ofPoints ? part.Mesh.PointCount : part.Mesh.Cells));
      for (std::size_t i = 0; i < own.size(); ++i)
      {
        own[i] = ofPoints ? part.pointId(std::int64_t(i)) : part.cellId(std::int64_t(i));
      }
      directory = std::make_shared<const IdDirectory>(this->Ranks, own);
    }
    return directory->ranksOf(this->Ranks, ids);
  }

  /// For each other rank, the points (local indices) in the bounding box of its part, and those
  /// that are not finite. Only these can be points of its part, too.
  std::vector<Ids> pointsInBoxes(const MeshPart& part) const
  {
    const std::vector<Bounds> boxes = this->Ranks.allGather(this->Mesh.mesh().Domain);
    std::vector<Ids> points(boxes.size());
    for (std::int64_t i = 0; i < part.Mesh.PointCount; ++i)
    {
      Point3 at = positionOf(part, i);
      at.z = part.Mesh.Dimension == 3 ? at.z : 0;
      const bool isFinite = std::isfinite(at.x) && std::isfinite(at.y) && std::isfinite(at.z);
      for (std::size_t rank = 0; rank < boxes.size(); ++rank)
      {
        const bool mayHave = rank != std::size_t(this->Ranks.rank()) &&
          (!isFinite || holds(boxes[rank], at, part.Mesh.Dimension));
        mayHave ? points[rank].push_back(i) : void();
      }
    }
    return points;
  }

  Communicator& Ranks;
  const ResidentMesh& Mesh;
};

} // namespace tipp

#endif
