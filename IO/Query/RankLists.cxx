// SPDX-License-Identifier: BSD-3-Clause
#include "Query/RankLists.h"

#include "Query/RankAnswer.h"
#include "Query/RankMesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>

namespace tipp
{
namespace
{

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
      rank == std::size_t(ranks.rank()) ? shares.Ranks.push_back(owner) : void();
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
    shares.Ranks[i] < 0 ? void() : asked[std::size_t(shares.Ranks[i])].push_back(ids[i]);
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
  missing != owners.end() ? mesh.refuseId(ids[std::size_t(missing - owners.begin())], ofPoints)
                          : void();
}

} // namespace

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
  mesh.isStored() ? void() : void(inMemory.emplace(*ranks, mesh));
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
      replies[rank].endList();
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
    result.endList();
  }
  return result;
}

} // namespace tipp
