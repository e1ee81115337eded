// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/GroupMesh.h"

#include <algorithm>
#include <numeric>
#include <utility>

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

/// When most of them are, so that it costs no more than to enter them did.
void GroupMesh::Batch::dropGone()
{
  if (this->Groups.size() == 0 || 2 * this->Alive > this->Groups.size())
  {
    return;
  }
  std::vector<std::uint32_t> left;
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t& place : this->Places)
  {
    if (place != Gone)
    {
      left.push_back(place);
      triangles.push_back(this->Triangles[place]);
      place = std::uint32_t(left.size() - 1);
    }
  }
  SeamGroups groups;
  groups.copyWithoutTriangles(this->Groups, left);
  this->Groups = std::move(groups);
  this->Triangles = std::move(triangles);
}

bool GroupMesh::isLive(const SeamGroups& groups, std::size_t g) const
{
  const auto met = groups.met(g);
  return std::any_of(
    met.begin(), met.end(), [this](PartitionIndex p) { return !this->isFinished(p); });
}

GroupMesh::Final GroupMesh::add(SeamGroups added)
{
  const auto groups = std::make_shared<const SeamGroups>(std::move(added));
  Final final{ groups, {} };
  std::vector<std::uint32_t> live;
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t g = 0; g < groups->size(); ++g)
  {
    if (this->isLive(*groups, g))
    {
      live.push_back(g);
      triangles.push_back(std::uint32_t(groups->triangles(g).size()));
    }
    else
    {
      final.Indices.push_back(g);
    }
  }
  this->enter(*groups, live, std::move(triangles));
  return final;
}

void GroupMesh::add(const LiveGroups& groups)
{
  std::vector<std::uint32_t> live;
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t g = 0; g < groups.Groups.size(); ++g)
  {
    if (this->isLive(groups.Groups, g))
    {
      live.push_back(g);
      triangles.push_back(groups.Triangles.at(g));
    }
  }
  this->enter(groups.Groups, live, std::move(triangles));
}

void GroupMesh::enter(const SeamGroups& groups, const std::vector<std::uint32_t>& live,
  std::vector<std::uint32_t> triangles)
{
  const auto batch = std::make_shared<Batch>();
  batch->Groups.copyWithoutTriangles(groups, live);
  batch->Triangles = std::move(triangles);
  batch->Alive = live.size();
  batch->Places.resize(live.size());
  std::iota(batch->Places.begin(), batch->Places.end(), 0U);
  for (std::uint32_t g = 0; g < live.size(); ++g)
  {
    this->Live += batch->Triangles[g];
    for (const PartitionIndex p : batch->Groups.met(g))
    {
      ++this->Meeting[std::size_t(p)];
      if (!this->isFinished(p))
      {
        Membership& members = this->Members[std::size_t(p)];
        members.References.push_back({ batch, g });
        members.ReachIsCurrent = false;
      }
    }
  }
}

void GroupMesh::finish(PartitionIndex partition)
{
  const Membership members = std::move(this->Members[std::size_t(partition)]);
  this->Members[std::size_t(partition)] = Membership();
  for (const Reference& reference : members.References)
  {
    if (reference.isAlive())
    {
      Batch& batch = *reference.Of;
      std::uint32_t& place = batch.Places[reference.Group];
      this->Live -= batch.Triangles[place];
      for (const PartitionIndex p : batch.Groups.met(place))
      {
        --this->Meeting[std::size_t(p)];
      }
      place = Gone;
      --batch.Alive;
    }
  }
  for (const Reference& reference : members.References)
  {
    reference.Of->dropGone();
  }
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
      count += reference.Of->Groups.vertices(reference.place()).size();
    }
  }
  vertices.clear();
  vertices.reserve(count);
  for (const Reference& reference : references)
  {
    if (reference.isAlive())
    {
      const auto added = reference.Of->Groups.vertices(reference.place());
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
    for (const std::uint32_t label : reference.Of->Groups.labels(reference.place()))
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

GroupMesh::LiveGroups GroupMesh::liveGroups() const
{
  LiveGroups all;
  for (std::size_t p = 0; p < this->Members.size(); ++p)
  {
    for (const Reference& reference : this->Members[p].References)
    {
      if (!reference.isAlive())
      {
        continue;
      }
      const SeamGroups& groups = reference.Of->Groups;
      const auto met = groups.met(reference.place());
      const PartitionIndex* const first = std::find_if(
        met.begin(), met.end(), [this](PartitionIndex q) { return !this->isFinished(q); });
      if (first != met.end() && std::size_t(*first) == p)
      {
        all.Groups.append(groups, reference.place());
        all.Triangles.push_back(reference.Of->Triangles[reference.place()]);
      }
    }
  }
  return all;
}

} // namespace tipp
