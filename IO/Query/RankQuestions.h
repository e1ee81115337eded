// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRankQuestions_h
#define tippRankQuestions_h

#include "Arrays/SortUnique.h"
#include "Query/ForPieces.h"
#include "Query/IdDirectory.h"
#include "Query/RankAnswer.h"
#include "Query/RankAround.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

namespace tipp
{

using Ids = std::vector<std::int64_t>;

/// The lists with indices [begin, end).
inline IdLists listsOf(const IdLists& lists, std::size_t begin, std::size_t end)
{
  IdLists result;
  result.Ids.assign(lists.Ids.begin() + lists.Starts[begin], lists.Ids.begin() + lists.Starts[end]);
  result.Starts.clear();
  for (std::size_t i = begin; i <= end; ++i)
  {
    result.Starts.push_back(lists.Starts[i] - lists.Starts[begin]);
  }
  return result;
}

/// A rank's lists for the ids that it was sent.
struct ListReply
{
  std::vector<char> Known; ///< per id: whether the rank has it
  IdLists Lists;

  /// Sets the lists from those of the known ids, in the same order. Unknown ids get empty lists.
  void setLists(IdLists ofKnown)
  {
    std::size_t next = 0;
    this->Lists.Starts.assign(1, 0);
    for (const char isKnown : this->Known)
    {
      next += isKnown ? 1 : 0;
      this->Lists.Starts.push_back(ofKnown.Starts[next]);
    }
    this->Lists.Ids = std::move(ofKnown.Ids);
  }

  /// The lists of the ids with indices [begin, end).
  ListReply part(std::size_t begin, std::size_t end) const
  {
    if (begin == end)
    {
      return {};
    }
    return { { this->Known.begin() + std::ptrdiff_t(begin),
               this->Known.begin() + std::ptrdiff_t(end) },
      listsOf(this->Lists, begin, end) };
  }
};

template <typename Archive>
void serialize(Archive& archive, ListReply& reply)
{
  archive(reply.Known, reply.Lists.Starts, reply.Lists.Ids);
}

inline Ids without(const Ids& ids, const Ids& others)
{
  Ids result;
  std::set_difference(
    ids.begin(), ids.end(), others.begin(), others.end(), std::back_inserter(result));
  return result;
}

inline Ids listOf(const IdLists& lists, std::size_t i)
{
  return { lists.Ids.begin() + lists.Starts[i], lists.Ids.begin() + lists.Starts[i + 1] };
}

/// Appends list i of `from` to `lists`.
inline void append(IdLists& lists, const IdLists& from, std::size_t i)
{
  lists.Ids.insert(
    lists.Ids.end(), from.Ids.begin() + from.Starts[i], from.Ids.begin() + from.Starts[i + 1]);
  lists.Starts.push_back(std::int64_t(lists.Ids.size()));
}

inline void append(IdLists& lists, const Ids& list)
{
  lists.Ids.insert(lists.Ids.end(), list.begin(), list.end());
  lists.Starts.push_back(std::int64_t(lists.Ids.size()));
}

/// The cells at a point (a global id); none if the part does not have the point.
inline PartTopology::Cells cellsAtId(const PartTopology& topology, std::int64_t id)
{
  const std::int64_t index = topology.findPoint(id);
  return index >= 0 ? topology.cellsAt(index) : PartTopology::Cells{ nullptr, nullptr };
}

inline bool contains(const Bounds& box, const Point3& p)
{
  return box[0] <= p.x && p.x <= box[1] && box[2] <= p.y && p.y <= box[3] && box[4] <= p.z &&
    p.z <= box[5];
}

/// Requests lists of ids from all ranks. All functions except isStored() and mesh() are collective,
/// and throw IOError for an id that no rank has.
class RankQuestions
{
public:
  RankQuestions(Communicator& ranks, const ResidentMesh& mesh)
    : Ranks(ranks)
    , Mesh(mesh)
  {
    requireIdsOnRanks(ranks, mesh);
  }

  /// Returns a list for each id. Every rank calls answer(ids), which returns a ListReply, for the
  /// ids of all ranks. The result is the list of the first rank that has the id or, if `united`,
  /// the union of all ranks' lists, ascending.
  template <typename Answer>
  IdLists ask(const Ids& ids, bool ofPoints, bool united, const Answer& answer) const
  {
    const std::vector<ListReply> replies =
      this->repliesTo(std::vector<Ids>(std::size_t(this->Ranks.size()), ids), answer);
    IdLists result;
    std::size_t size = 0;
    for (const ListReply& reply : replies)
    {
      size += reply.Lists.Ids.size();
    }
    result.Ids.reserve(size);
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      bool isKnown = false;
      for (const ListReply& reply : replies)
      {
        if (reply.Known[i] && (united || !isKnown))
        {
          result.Ids.insert(result.Ids.end(), reply.Lists.Ids.begin() + reply.Lists.Starts[i],
            reply.Lists.Ids.begin() + reply.Lists.Starts[i + 1]);
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
      result.Starts.push_back(std::int64_t(result.Ids.size()));
    }
    return result;
  }

  /// As ask() for parts in memory, but only the first rank that has an id is asked.
  template <typename Answer>
  IdLists askFirst(const Ids& ids, bool ofPoints, const Answer& answer) const
  {
    const std::vector<std::int32_t> first = this->firstRanksOf(ids, ofPoints);
    std::vector<Ids> asked(std::size_t(this->Ranks.size()));
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      first[i] < 0 ? this->Mesh.refuseId(ids[i], ofPoints) : void();
      asked[std::size_t(first[i])].push_back(ids[i]);
    }
    const std::vector<ListReply> replies = this->repliesTo(asked, answer);
    IdLists result;
    result.Starts.reserve(ids.size() + 1);
    std::size_t size = 0;
    for (const ListReply& reply : replies)
    {
      size += reply.Lists.Ids.size();
    }
    result.Ids.reserve(size);
    std::vector<std::size_t> next(asked.size(), 0);
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      const ListReply& reply = replies[std::size_t(first[i])];
      const std::size_t at = next[std::size_t(first[i])]++;
      reply.Known.at(at) ? append(result, reply.Lists, at) : this->Mesh.refuseId(ids[i], ofPoints);
    }
    return result;
  }

  /// For stored meshes: lists that work(ids, pieces) returns on the ranks that have the pieces of
  /// these ids.
  template <typename Work>
  IdLists askOwners(const Ids& ids, bool ofPoints, const Work& work) const
  {
    const std::int64_t count = ofPoints ? this->Mesh.mesh().Points : this->Mesh.mesh().Cells;
    for (const std::int64_t id : ids)
    {
      id < 0 || id >= count ? this->Mesh.refuseId(id, ofPoints) : void();
    }
    const auto [first, end] = piecesOfRank(this->Ranks, this->Mesh);
    return this->ask(ids, ofPoints, false,
      [&, firstPiece = first, endPiece = end](const Ids& asked)
      {
        const std::vector<std::int32_t> pieces =
          this->Mesh.findIds(asked, ofPoints, firstPiece, endPiece);
        Ids own;
        std::vector<std::int32_t> piecesOfOwn;
        ListReply reply;
        for (std::size_t i = 0; i < asked.size(); ++i)
        {
          reply.Known.push_back(char(pieces[i] >= 0));
          if (pieces[i] >= 0)
          {
            own.push_back(asked[i]);
            piecesOfOwn.push_back(pieces[i]);
          }
        }
        reply.setLists(own.empty() ? IdLists() : work(own, piecesOfOwn));
        return reply;
      });
  }

  /// For parts in memory: the results of ringsWithin() in the part of the first rank that has the
  /// seed.
  IdLists ringsWithinParts(const Ids& seeds, int k, bool ofPoints) const
  {
    const std::vector<std::uint8_t>& shared = this->sharedPoints();
    return this->askFirst(seeds, ofPoints,
      [&](const Ids& asked)
      {
        const ResidentPieces::Lease piece = this->Mesh.pieces().get(0, topologyNeeded());
        Ids own;
        Ids indices;
        ListReply reply;
        for (const std::int64_t id : asked)
        {
          const std::int64_t index =
            ofPoints ? piece->Topology->findPoint(id) : piece->Topology->findCell(id);
          reply.Known.push_back(char(index >= 0));
          if (index >= 0)
          {
            own.push_back(id);
            indices.push_back(index);
          }
        }
        reply.setLists(own.empty()
            ? IdLists()
            : ringsWithin(this->Mesh, own, indices, ofPoints, k, shared.data()));
        return reply;
      });
  }

  /// For parts in memory: the cells at each point, ascending.
  IdLists stars(const Ids& points) const
  {
    return this->ask(points, true, true,
      [this](const Ids& asked)
      {
        const ResidentPieces::Lease piece = this->Mesh.pieces().get(0, topologyNeeded());
        ListReply reply;
        for (const std::int64_t id : asked)
        {
          Ids list;
          const std::int64_t index = piece->Topology->findPoint(id);
          if (index >= 0)
          {
            for (const std::int32_t cell : piece->Topology->cellsAt(index))
            {
              list.push_back(piece->Part->cellId(cell));
            }
          }
          reply.Known.push_back(char(index >= 0));
          append(reply.Lists, list);
        }
        return reply;
      });
  }

  /// For parts in memory: the points of each cell, in the cell's order.
  IdLists corners(const Ids& cells) const
  {
    return this->askFirst(cells, false,
      [this](const Ids& asked)
      {
        const ResidentPieces::Lease piece = this->Mesh.pieces().get(0, topologyNeeded());
        ListReply reply;
        for (const std::int64_t id : asked)
        {
          Ids list;
          const std::int64_t index = piece->Topology->findCell(id);
          for (int i = 0; i < piece->Topology->corners() && index >= 0; ++i)
          {
            list.push_back(piece->Part->pointId(piece->Topology->corner(index, i)));
          }
          reply.Known.push_back(char(index >= 0));
          append(reply.Lists, list);
        }
        return reply;
      });
  }

  bool isStored() const { return this->Mesh.isStored(); }
  const ResidentMesh& mesh() const { return this->Mesh; }
  /// Whether `isSo` is true on any rank.
  bool any(bool isSo) const
  {
    std::vector<std::int64_t> count = { isSo ? 1 : 0 };
    this->Ranks.sum(count);
    return count[0] > 0;
  }

private:
  /// The reply of each rank for the ids that this rank asks of it.
  template <typename Answer>
  std::vector<ListReply> repliesTo(const std::vector<Ids>& ids, const Answer& answer) const
  {
    Ids all;
    std::vector<std::size_t> starts = { 0 };
    for (const Ids& asked : this->Ranks.allToAll(ids))
    {
      all.insert(all.end(), asked.begin(), asked.end());
      starts.push_back(all.size());
    }
    ListReply reply = all.empty() ? ListReply() : answer(all);
    std::vector<ListReply> replies;
    if (starts.size() == 2)
    {
      replies.push_back(std::move(reply));
      return replies;
    }
    for (std::size_t rank = 0; rank + 1 < starts.size(); ++rank)
    {
      replies.push_back(reply.part(starts[rank], starts[rank + 1]));
    }
    const auto own = std::size_t(this->Ranks.rank());
    ListReply mine = std::exchange(replies[own], ListReply());
    replies = this->Ranks.allToAll(replies);
    replies[own] = std::move(mine);
    return replies;
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

  /// The lowest rank that has each id, or -1. For a single rank always 0.
  std::vector<std::int32_t> firstRanksOf(const Ids& ids, bool ofPoints) const
  {
    if (this->Ranks.size() == 1)
    {
      return std::vector<std::int32_t>(ids.size(), 0);
    }
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
      std::transform(ids.begin(), ids.end(), std::back_inserter(replies.back()),
        [&piece](std::int64_t id) { return !cellsAtId(*piece->Topology, id).empty(); });
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

  /// For each other rank, the points (local indices) in the bounding box of its part. Only these
  /// can be points of its part, too.
  std::vector<Ids> pointsInBoxes(const MeshPart& part) const
  {
    const std::vector<Bounds> boxes = this->Ranks.allGather(this->Mesh.mesh().Domain);
    std::vector<Ids> points(boxes.size());
    for (std::int64_t i = 0; i < part.Mesh.PointCount; ++i)
    {
      const Point3 at = positionOf(part, i);
      for (std::size_t rank = 0; rank < boxes.size(); ++rank)
      {
        rank != std::size_t(this->Ranks.rank()) && contains(boxes[rank], at)
          ? points[rank].push_back(i)
          : void();
      }
    }
    return points;
  }

  Communicator& Ranks;
  const ResidentMesh& Mesh;
};

} // namespace tipp

#endif
