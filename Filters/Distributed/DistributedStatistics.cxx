// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/DistributedStatistics.h"

#include "Distributed/RankRun.h"

#include <algorithm>

namespace tipp
{
template <typename Archive>
void serialize(Archive& archive, MasterStatistics& master)
{
  archive(master.Area, master.Rank, master.GroupSize, master.LargestMesh, master.Seconds,
    master.PathSeconds, master.Stages);
}

namespace
{

std::string nameOf(MessageKind kind)
{
  const std::map<MessageKind, std::string> names = { { MessageKind::AllToAll, "all to all" },
    { MessageKind::Gather, "gather" }, { MessageKind::Broadcast, "broadcast" },
    { MessageKind::Sum, "sum" }, { PartitionDoneMessage, "partition done" },
    { TaskMessage, "task" } };
  const auto name = names.find(kind);
  return name != names.end() ? name->second : "other";
}

struct SentByKind
{
  MessageKind Kind;
  Communicator::Traffic Sent;
};

/// What a rank tells the others.
struct OfOneRank
{
  RankStatistics Own;
  std::vector<MasterStatistics> Masters;
  std::vector<SentByKind> Traffic;
};

template <typename Archive>
void serialize(Archive& archive, OfOneRank& one)
{
  archive(one.Own, one.Masters, one.Traffic);
}

} // namespace

DistributedStatistics gatherStatistics(
  Communicator& ranks, const RankStatistics& own, const std::vector<MasterStatistics>& masters)
{
  OfOneRank mine{ own, masters, {} };
  for (const auto& [kind, sent] : ranks.traffic())
  {
    mine.Traffic.push_back({ kind, sent });
  }
  DistributedStatistics statistics;
  std::map<MessageKind, Communicator::Traffic> traffic;
  for (const OfOneRank& one : ranks.allGather(mine))
  {
    statistics.Ranks.push_back(one.Own);
    statistics.Masters.insert(statistics.Masters.end(), one.Masters.begin(), one.Masters.end());
    for (const SentByKind& of : one.Traffic)
    {
      traffic[of.Kind].Messages += of.Sent.Messages;
      traffic[of.Kind].Bytes += of.Sent.Bytes;
    }
    statistics.Seconds = std::max(statistics.Seconds, one.Own.TotalSeconds);
  }
  for (const auto& [kind, sum] : traffic)
  {
    statistics.Traffic.push_back({ nameOf(kind), sum.Messages, sum.Bytes });
  }
  std::sort(statistics.Masters.begin(), statistics.Masters.end(),
    [](const MasterStatistics& a, const MasterStatistics& b) { return a.Area < b.Area; });
  return statistics;
}

} // namespace tipp
