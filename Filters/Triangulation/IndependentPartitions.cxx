// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/IndependentPartitions.h"

#include <algorithm>
#include <numeric>

namespace tipp
{

IndependentPartitions::IndependentPartitions(SeamMesh& mesh, std::vector<PartitionIndex> unfinished)
  : Mesh(mesh)
  , Unfinished(std::move(unfinished))
  , LabelIsActive(mesh.labelEnd(), 0)
  , ActiveReach(static_cast<std::size_t>(mesh.partitions()))
{
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

PartitionIndex IndependentPartitions::activateNext()
{
  for (auto it = this->Unfinished.begin(); it != this->Unfinished.end(); ++it)
  {
    const PartitionIndex partition = *it;
    if (this->isIndependentOfActive(partition))
    {
      this->activate(partition);
      this->Unfinished.erase(it);
      return partition;
    }
  }
  return -1;
}

/// How many other unfinished partitions each unfinished one conflicts with.
std::vector<std::size_t> IndependentPartitions::countConflicts()
{
  std::vector<std::vector<std::uint32_t>> sharers(this->Mesh.labelEnd()); // by place in Unfinished
  for (std::uint32_t i = 0; i < this->Unfinished.size(); ++i)
  {
    for (const std::uint32_t label : this->Mesh.reach(this->Unfinished[i]))
    {
      sharers[label].push_back(i);
    }
  }
  std::vector<std::size_t> conflicts(this->Unfinished.size(), 0);
  std::vector<std::uint32_t> seenBy(this->Unfinished.size(), ~0U);
  for (std::uint32_t i = 0; i < this->Unfinished.size(); ++i)
  {
    seenBy[i] = i;
    for (const std::uint32_t label : this->Mesh.reach(this->Unfinished[i]))
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
  const std::vector<std::size_t> conflicts = this->countConflicts();
  std::vector<std::size_t> order(this->Unfinished.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
    [&conflicts](std::size_t a, std::size_t b) { return conflicts[a] < conflicts[b]; });

  std::vector<PartitionIndex> stage;
  std::vector<char> isChosen(this->Unfinished.size(), 0);
  for (const std::size_t i : order)
  {
    if (this->isIndependentOfActive(this->Unfinished[i]))
    {
      this->activate(this->Unfinished[i]);
      stage.push_back(this->Unfinished[i]);
      isChosen[i] = 1;
    }
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < this->Unfinished.size(); ++i)
  {
    if (!isChosen[i])
    {
      this->Unfinished[kept++] = this->Unfinished[i];
    }
  }
  this->Unfinished.resize(kept);
  return stage;
}

} // namespace tipp
