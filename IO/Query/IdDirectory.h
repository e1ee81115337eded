// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippIdDirectory_h
#define tippIdDirectory_h

#include "Partitioned/PieceFile.h"
#include "Ranks/Communicator.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace tipp
{

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

} // namespace tipp

#endif
