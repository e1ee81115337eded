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
void GroupMesh::dropGone(Batch& batch)
{
  if (batch.Groups.size() == 0 || 2 * batch.Alive > batch.Groups.size())
  {
    return;
  }
  this->Held -= batch.held();
  std::vector<std::uint32_t> left;
  std::vector<std::uint32_t> triangles;
  std::vector<VertexFile::Part> spilled;
  for (std::uint32_t& place : batch.Places)
  {
    if (place != Gone)
    {
      left.push_back(place);
      triangles.push_back(batch.Triangles[place]);
      if (!batch.Spilled.empty())
      {
        spilled.push_back(batch.Spilled[place]);
      }
      place = std::uint32_t(left.size() - 1);
    }
  }
  SeamGroups groups;
  groups.copyWithoutTriangles(batch.Groups, left);
  batch.Groups = std::move(groups);
  batch.Triangles = std::move(triangles);
  batch.Spilled = std::move(spilled);
  this->Held += batch.held();
}

void GroupMesh::spillTo(VertexFile& file, std::uint64_t most)
{
  this->File = &file;
  this->MostHeld = most;
  for (const Membership& members : this->Members)
  {
    for (const Reference& reference : members.References)
    {
      this->spillIfTooMuch(*reference.Of);
    }
  }
}

/// Not small ones: that would take time, and hardly give memory.
void GroupMesh::spillIfTooMuch(Batch& batch)
{
  constexpr std::uint64_t smallPart = 16;
  if (!this->File || this->Held <= this->MostHeld || batch.held() <= this->MostHeld / smallPart)
  {
    return;
  }
  this->Held -= batch.held();
  for (std::size_t g = 0; g < batch.Groups.size(); ++g)
  {
    const auto vertices = batch.Groups.vertices(g);
    batch.Spilled.push_back(this->File->put(vertices.begin(), vertices.size()));
  }
  std::vector<PlainVertex>().swap(batch.Groups.Vertices);
  for (SeamGroups::Group& group : batch.Groups.Groups)
  {
    group.VertexEnd = 0;
  }
}

std::size_t GroupMesh::vertexCount(const Batch& batch, std::uint32_t place) const
{
  return batch.Spilled.empty() ? batch.Groups.vertices(place).size()
                               : std::size_t(batch.Spilled[place].Count);
}

void GroupMesh::addVertices(
  const Batch& batch, std::uint32_t place, std::vector<PlainVertex>& vertices) const
{
  if (!batch.Spilled.empty())
  {
    this->File->get(batch.Spilled[place], vertices);
    return;
  }
  const auto added = batch.Groups.vertices(place);
  vertices.insert(vertices.end(), added.begin(), added.end());
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

void GroupMesh::enter(const SeamGroups& groups, const std::vector<std::uint32_t>& live,
  std::vector<std::uint32_t> triangles)
{
  const auto batch = std::make_shared<Batch>();
  batch->Groups.copyWithoutTriangles(groups, live);
  batch->Triangles = std::move(triangles);
  batch->Alive = live.size();
  batch->Places.resize(live.size());
  std::iota(batch->Places.begin(), batch->Places.end(), 0U);
  this->Held += batch->held();
  this->spillIfTooMuch(*batch);
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
      if (!batch.Spilled.empty())
      {
        this->File->free(batch.Spilled[place]);
      }
      place = Gone;
      --batch.Alive;
    }
  }
  for (const Reference& reference : members.References)
  {
    this->dropGone(*reference.Of);
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
      count += this->vertexCount(*reference.Of, reference.place());
    }
  }
  vertices.clear();
  vertices.reserve(count);
  for (const Reference& reference : references)
  {
    if (reference.isAlive())
    {
      this->addVertices(*reference.Of, reference.place(), vertices);
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

/// Every group that is not final, once.
void GroupMesh::visitLive(const std::function<void(const Batch&, std::uint32_t)>& visit) const
{
  for (std::size_t p = 0; p < this->Members.size(); ++p)
  {
    for (const Reference& reference : this->Members[p].References)
    {
      if (!reference.isAlive())
      {
        continue;
      }
      const auto met = reference.Of->Groups.met(reference.place());
      const PartitionIndex* const first = std::find_if(
        met.begin(), met.end(), [this](PartitionIndex q) { return !this->isFinished(q); });
      if (first != met.end() && std::size_t(*first) == p)
      {
        visit(*reference.Of, reference.place());
      }
    }
  }
}

void GroupMesh::visitVertices(PartitionIndex begin, PartitionIndex end,
  const std::function<void(const PlainVertex&)>& visit) const
{
  std::vector<PlainVertex> vertices;
  this->visitLive(
    [&](const Batch& batch, std::uint32_t place)
    {
      const auto met = batch.Groups.met(place);
      if (std::any_of(
            met.begin(), met.end(), [&](PartitionIndex p) { return begin <= p && p < end; }))
      {
        vertices.clear();
        this->addVertices(batch, place, vertices);
        std::for_each(vertices.begin(), vertices.end(), visit);
      }
    });
}

/// As SeamGroups writes them, but with no more vertices in memory than those of one group.
void GroupMesh::save(ByteWriter& writer) const
{
  SeamGroups groups;
  std::vector<std::uint32_t> triangles;
  std::uint64_t count = 0;
  this->visitLive(
    [&](const Batch& batch, std::uint32_t place)
    {
      const auto met = batch.Groups.met(place);
      const auto labels = batch.Groups.labels(place);
      groups.Met.insert(groups.Met.end(), met.begin(), met.end());
      groups.Labels.insert(groups.Labels.end(), labels.begin(), labels.end());
      count += this->vertexCount(batch, place);
      groups.Groups.push_back(
        { std::uint32_t(groups.Met.size()), std::uint32_t(groups.Labels.size()),
          std::uint32_t(count), 0, batch.Groups.Groups[place].HasArtificial });
      triangles.push_back(batch.Triangles[place]);
    });
  writer.array(groups.Groups);
  writer.array(groups.Met);
  writer.array(groups.Labels);
  writer.value(count);
  std::vector<PlainVertex> vertices;
  this->visitLive(
    [&](const Batch& batch, std::uint32_t place)
    {
      vertices.clear();
      this->addVertices(batch, place, vertices);
      writer.raw(vertices.data(), vertices.size() * sizeof(PlainVertex));
    });
  writer.array(groups.Triangles);
  writer.array(triangles);
}

void GroupMesh::restore(ByteReader& reader)
{
  const SeamGroups groups = SeamGroups::read(reader);
  const auto counts = reader.array<std::uint32_t>();
  std::vector<std::uint32_t> live;
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t g = 0; g < groups.size(); ++g)
  {
    if (this->isLive(groups, g))
    {
      live.push_back(g);
      triangles.push_back(counts.at(g));
    }
  }
  this->enter(groups, live, std::move(triangles));
}

} // namespace tipp
