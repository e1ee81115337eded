// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/GroupMesh.h"

#include <algorithm>

namespace tipp
{

GroupMesh::GroupMesh(PartitionIndex partitions, const std::vector<PartitionIndex>& withPoints)
  : Members(static_cast<std::size_t>(partitions))
  , Finished(static_cast<std::size_t>(partitions), 1)
  , Meeting(static_cast<std::size_t>(partitions), 0)
  , LabelSeen(4 * static_cast<std::size_t>(partitions), 0)
{
  for (const PartitionIndex p : withPoints)
  {
    this->Finished[std::size_t(p)] = 0;
  }
}

GroupMesh::Final GroupMesh::add(SeamGroups added)
{
  const auto piece = std::make_shared<Piece>();
  piece->Groups = std::make_shared<const SeamGroups>(std::move(added));
  const SeamGroups& groups = *piece->Groups;
  piece->Alive.assign(groups.size(), 0);
  Final final{ piece->Groups, {} };
  for (std::uint32_t g = 0; g < groups.size(); ++g)
  {
    for (const PartitionIndex p : groups.met(g))
    {
      if (!this->Finished[std::size_t(p)])
      {
        Membership& members = this->Members[std::size_t(p)];
        members.References.push_back({ piece, g });
        members.ReachIsCurrent = false;
        piece->Alive[g] = 1;
      }
    }
    if (piece->Alive[g])
    {
      this->Live += groups.triangles(g).size();
      for (const PartitionIndex p : groups.met(g))
      {
        ++this->Meeting[std::size_t(p)];
      }
    }
    else
    {
      final.Indices.push_back(g);
    }
  }
  return final;
}

void GroupMesh::finish(PartitionIndex partition)
{
  Membership& members = this->Members[std::size_t(partition)];
  for (const Reference& reference : members.References)
  {
    if (reference.isAlive())
    {
      reference.Of->Alive[reference.Group] = 0;
      this->Live -= reference.Of->Groups->triangles(reference.Group).size();
      for (const PartitionIndex p : reference.Of->Groups->met(reference.Group))
      {
        --this->Meeting[std::size_t(p)];
      }
    }
  }
  members = Membership();
  this->Finished[std::size_t(partition)] = 1;
}

void GroupMesh::gather(PartitionIndex partition, std::vector<PlainVertex>& vertices) const
{
  const std::vector<Reference>& references = this->Members[std::size_t(partition)].References;
  std::size_t count = 0;
  for (const Reference& reference : references)
  {
    if (reference.isAlive())
    {
      count += reference.Of->Groups->vertices(reference.Group).size();
    }
  }
  vertices.clear();
  vertices.reserve(count);
  for (const Reference& reference : references)
  {
    if (reference.isAlive())
    {
      const auto added = reference.Of->Groups->vertices(reference.Group);
      vertices.insert(vertices.end(), added.begin(), added.end());
    }
  }
}

const std::vector<std::uint32_t>& GroupMesh::reach(PartitionIndex partition)
{
  Membership& members = this->Members[std::size_t(partition)];
  if (members.ReachIsCurrent)
  {
    return members.Reach;
  }
  members.ReachIsCurrent = true;
  members.Reach.clear();
  ++this->Epoch;
  members.References.erase(std::remove_if(members.References.begin(), members.References.end(),
                             [](const Reference& reference) { return !reference.isAlive(); }),
    members.References.end());
  for (const Reference& reference : members.References)
  {
    for (const std::uint32_t label : reference.Of->Groups->labels(reference.Group))
    {
      if (this->LabelSeen[label] != this->Epoch)
      {
        this->LabelSeen[label] = this->Epoch;
        members.Reach.push_back(label);
      }
    }
  }
  return members.Reach;
}

SeamGroups GroupMesh::liveGroups() const
{
  SeamGroups all;
  for (std::size_t p = 0; p < this->Members.size(); ++p)
  {
    for (const Reference& reference : this->Members[p].References)
    {
      const SeamGroups& groups = *reference.Of->Groups;
      const auto met = groups.met(reference.Group);
      const PartitionIndex* const first = std::find_if(
        met.begin(), met.end(), [this](PartitionIndex q) { return !this->isFinished(q); });
      if (reference.isAlive() && first != met.end() && std::size_t(*first) == p)
      {
        all.append(groups, reference.Group);
      }
    }
  }
  return all;
}

} // namespace tipp
