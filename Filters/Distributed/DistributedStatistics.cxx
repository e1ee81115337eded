// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/DistributedStatistics.h"

#include "Engine/RankEngine.h"

#include <algorithm>
#include <map>

namespace tipp
{
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

/// What a rank reports to the others for the statistics.
struct StatisticsOfRank
{
  RankStatistics Own;
  std::vector<MasterStatistics> Masters;
  std::vector<SentByKind> Traffic;
};

template <typename Archive>
void serialize(Archive& archive, StatisticsOfRank& one)
{
  archive(one.Own, one.Masters, one.Traffic);
}

} // namespace

void gatherStatistics(Communicator& ranks, RankStatistics own,
  const std::vector<MasterStatistics>& masters, int threads, DistributedStatistics& statistics)
{
  own.SendSeconds = ranks.sendingSeconds();
  StatisticsOfRank mine{ own, masters, {} };
  for (const auto& [kind, sent] : ranks.traffic())
  {
    mine.Traffic.push_back({ kind, sent });
  }
  statistics.ThreadsPerRank = threads;
  std::map<MessageKind, Communicator::Traffic> traffic;
  for (const StatisticsOfRank& one : ranks.allGather(mine))
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
}

} // namespace tipp
