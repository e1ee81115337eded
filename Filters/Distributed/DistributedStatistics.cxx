// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/DistributedStatistics.h"

#include "Distributed/MessageKinds.h"

#include <algorithm>

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

void write(const MasterStatistics& master, ByteWriter& writer)
{
  writer.value(master.Area);
  writer.value(master.Rank);
  writer.value(master.GroupSize);
  writer.value(master.LargestMesh);
  writer.value(master.Seconds);
  writer.value(master.PathSeconds);
  writer.array(master.Stages);
}

MasterStatistics readMaster(ByteReader& reader)
{
  MasterStatistics master;
  master.Area = reader.value<std::int32_t>();
  master.Rank = reader.value<std::int32_t>();
  master.GroupSize = reader.value<std::int32_t>();
  master.LargestMesh = reader.value<std::int64_t>();
  master.Seconds = reader.value<double>();
  master.PathSeconds = reader.value<double>();
  reader.array(master.Stages);
  return master;
}

} // namespace

DistributedStatistics gatherStatistics(
  Communicator& ranks, const RankStatistics& own, const std::vector<MasterStatistics>& masters)
{
  ByteWriter writer;
  writer.value(own);
  writer.value(std::uint64_t(masters.size()));
  for (const MasterStatistics& master : masters)
  {
    write(master, writer);
  }
  writer.value(std::uint64_t(ranks.traffic().size()));
  for (const auto& [kind, traffic] : ranks.traffic())
  {
    writer.value(kind);
    writer.value(traffic);
  }
  ByteWriter all;
  for (const Bytes& part : ranks.gather(writer.take()))
  {
    all.array(part.data(), part.size());
  }
  const Bytes everything = ranks.broadcast(all.take());
  DistributedStatistics statistics;
  std::map<MessageKind, Communicator::Traffic> traffic;
  ByteReader parts(everything);
  while (parts.left() > 0)
  {
    const std::vector<char> part = parts.array<char>();
    ByteReader reader(part.data(), part.size());
    statistics.Ranks.push_back(reader.value<RankStatistics>());
    for (std::uint64_t n = reader.value<std::uint64_t>(); n > 0; --n)
    {
      statistics.Masters.push_back(readMaster(reader));
    }
    for (std::uint64_t n = reader.value<std::uint64_t>(); n > 0; --n)
    {
      Communicator::Traffic& sum = traffic[reader.value<MessageKind>()];
      const auto sent = reader.value<Communicator::Traffic>();
      sum.Messages += sent.Messages;
      sum.Bytes += sent.Bytes;
    }
    statistics.Seconds = std::max(statistics.Seconds, statistics.Ranks.back().TotalSeconds);
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
