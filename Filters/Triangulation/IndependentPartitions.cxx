// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/IndependentPartitions.h"

#include <algorithm>
#include <numeric>

namespace tipp
{

MeshReach::MeshReach(PartitionIndex partitions, const SeamTriangles& mesh)
  : Labels(static_cast<std::size_t>(partitions))
{
  for (std::size_t i = 0; i < mesh.size(); ++i)
  {
    for (const PartitionIndex* p = mesh.metBegin(i); p != mesh.metEnd(i); ++p)
    {
      for (const SeamVertex& v : mesh[i])
      {
        this->Labels[std::size_t(*p)].push_back(v.Label);
      }
    }
  }
  for (std::vector<std::uint32_t>& labels : this->Labels)
  {
    std::sort(labels.begin(), labels.end());
    labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  }
}

IndependentPartitions::IndependentPartitions(ReachSource& mesh,
  const std::vector<PartitionIndex>& unfinished, const std::vector<std::int32_t>& homes)
  : Mesh(mesh)
  , Unfinished(1)
  , Left(unfinished.size())
  , LabelIsActive(mesh.labelEnd(), 0)
  , ActiveReach(static_cast<std::size_t>(mesh.partitions()))
{
  for (const PartitionIndex p : unfinished)
  {
    const std::size_t home = homes.empty() ? 0 : std::size_t(homes[std::size_t(p)]);
    this->Unfinished.resize(std::max(this->Unfinished.size(), home + 1));
    this->Unfinished[home].push_back(p);
  }
}

bool IndependentPartitions::isIndependentOfActive(PartitionIndex partition)
{
  const std::vector<std::uint32_t>& reach = this->Mesh.reach(partition);
  return std::none_of(reach.begin(), reach.end(),
    [this](std::uint32_t label) { return this->LabelIsActive[label] != 0; });
}

void IndependentPartitions::activate(PartitionIndex partition)
{
  this->ActiveReach[std::size_t(partition)] = this->Mesh.reach(partition);
  for (const std::uint32_t label : this->ActiveReach[std::size_t(partition)])
  {
    this->LabelIsActive[label] = 1;
  }
}

void IndependentPartitions::deactivate(PartitionIndex partition)
{
  for (const std::uint32_t label : this->ActiveReach[std::size_t(partition)])
  {
    this->LabelIsActive[label] = 0;
  }
  this->ActiveReach[std::size_t(partition)].clear();
}

PartitionIndex IndependentPartitions::activateNext(std::int32_t home)
{
  if (std::size_t(home) >= this->Unfinished.size())
  {
    return -1;
  }
  std::vector<PartitionIndex>& unfinished = this->Unfinished[std::size_t(home)];
  for (auto it = unfinished.begin(); it != unfinished.end(); ++it)
  {
    const PartitionIndex partition = *it;
    if (this->isIndependentOfActive(partition))
    {
      this->activate(partition);
      unfinished.erase(it);
      --this->Left;
      return partition;
    }
  }
  return -1;
}

/// How many others of these partitions each of them conflicts with.
std::vector<std::size_t> IndependentPartitions::countConflicts(
  const std::vector<PartitionIndex>& partitions)
{
  std::vector<std::vector<std::uint32_t>> sharers(this->Mesh.labelEnd()); // by place in partitions
  for (std::uint32_t i = 0; i < partitions.size(); ++i)
  {
    for (const std::uint32_t label : this->Mesh.reach(partitions[i]))
    {
      sharers[label].push_back(i);
    }
  }
  std::vector<std::size_t> conflicts(partitions.size(), 0);
  std::vector<std::uint32_t> seenBy(partitions.size(), ~0U);
  for (std::uint32_t i = 0; i < partitions.size(); ++i)
  {
    seenBy[i] = i;
    for (const std::uint32_t label : this->Mesh.reach(partitions[i]))
    {
      for (const std::uint32_t other : sharers[label])
      {
        conflicts[i] += seenBy[other] != i;
        seenBy[other] = i;
      }
    }
  }
  return conflicts;
}

std::vector<PartitionIndex> IndependentPartitions::nextStage()
{
  std::vector<PartitionIndex> unfinished;
  for (const std::vector<PartitionIndex>& ofHome : this->Unfinished)
  {
    unfinished.insert(unfinished.end(), ofHome.begin(), ofHome.end());
  }
  const std::vector<std::size_t> conflicts = this->countConflicts(unfinished);
  std::vector<std::size_t> order(unfinished.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
    [&conflicts](std::size_t a, std::size_t b) { return conflicts[a] < conflicts[b]; });

  std::vector<PartitionIndex> stage;
  std::vector<char> isChosen(static_cast<std::size_t>(this->Mesh.partitions()), 0);
  for (const std::size_t i : order)
  {
    if (this->isIndependentOfActive(unfinished[i]))
    {
      this->activate(unfinished[i]);
      stage.push_back(unfinished[i]);
      isChosen[std::size_t(unfinished[i])] = 1;
    }
  }
  for (std::vector<PartitionIndex>& ofHome : this->Unfinished)
  {
    ofHome.erase(std::remove_if(ofHome.begin(), ofHome.end(),
                   [&isChosen](PartitionIndex p) { return isChosen[std::size_t(p)] != 0; }),
      ofHome.end());
  }
  this->Left -= stage.size();
  return stage;
}

} // namespace tipp
