// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/SeamMesh.h"

#include <algorithm>

namespace tipp
{

SeamVertex makeSeamVertex(const Tiling& tiling, PartitionIndex partition, Point2 p, std::int64_t id)
{
  const Box2& box = tiling.box(partition);
  const std::uint32_t right = p.x - box.xmin > box.xmax - p.x;
  const std::uint32_t upper = p.y - box.ymin > box.ymax - p.y;
  return { p, id, 4 * static_cast<std::uint32_t>(partition) + 2 * upper + right };
}

void SeamTriangles::clear()
{
  this->Triangles.clear();
  this->Met.clear();
  this->MetEnds.clear();
}

void SeamTriangles::add(const Tiling& tiling, const SeamTriangle& triangle, const Circumdisk& disk)
{
  this->Triangles.push_back(triangle);
  tiling.visitMet(disk, [this](PartitionIndex partition) { this->Met.push_back(partition); });
  this->MetEnds.push_back(this->Met.size());
}

void SeamTriangles::append(const SeamTriangles& others)
{
  const std::size_t offset = this->Met.size();
  this->Triangles.insert(this->Triangles.end(), others.Triangles.begin(), others.Triangles.end());
  this->Met.insert(this->Met.end(), others.Met.begin(), others.Met.end());
  for (const std::size_t end : others.MetEnds)
  {
    this->MetEnds.push_back(offset + end);
  }
}

SeamMesh::SeamMesh(PartitionIndex partitions)
  : Members(static_cast<std::size_t>(partitions))
  , Finished(static_cast<std::size_t>(partitions), 0)
  , LabelSeen(4 * static_cast<std::size_t>(partitions), 0)
{
}

void SeamMesh::gather(PartitionIndex partition, std::vector<SeamTriangle>& triangles) const
{
  triangles.clear();
  for (const Entry& entry : this->Members[std::size_t(partition)].Entries)
  {
    if (this->Alive[entry.Slot])
    {
      triangles.push_back(this->Pool[entry.Slot]);
    }
  }
}

std::uint32_t SeamMesh::allocate(const SeamTriangle& triangle)
{
  ++this->Live;
  if (!this->FreeSlots.empty())
  {
    const std::uint32_t slot = this->FreeSlots.back();
    this->FreeSlots.pop_back();
    this->Pool[slot] = triangle;
    this->Alive[slot] = 1;
    return slot;
  }
  this->Pool.push_back(triangle);
  this->Alive.push_back(1);
  this->References.push_back(0);
  return static_cast<std::uint32_t>(this->Pool.size() - 1);
}

void SeamMesh::add(const SeamTriangles& added, std::vector<SeamTriangle>& final)
{
  for (std::size_t i = 0; i < added.Triangles.size(); ++i)
  {
    const SeamTriangle& triangle = added.Triangles[i];
    const auto unfinished = [this](PartitionIndex p) { return !this->isFinished(p); };
    if (std::none_of(added.metBegin(i), added.metEnd(i), unfinished))
    {
      final.push_back(triangle);
      continue;
    }
    const Entry entry{ this->allocate(triangle),
      { triangle[0].Label, triangle[1].Label, triangle[2].Label } };
    for (const PartitionIndex* p = added.metBegin(i); p != added.metEnd(i); ++p)
    {
      if (unfinished(*p))
      {
        Membership& members = this->Members[std::size_t(*p)];
        members.Entries.push_back(entry);
        members.ReachIsCurrent = false;
        ++this->References[entry.Slot];
      }
    }
  }
}

void SeamMesh::finish(PartitionIndex partition)
{
  Membership& members = this->Members[std::size_t(partition)];
  for (const Entry& entry : members.Entries)
  {
    this->Live -= this->Alive[entry.Slot];
    this->Alive[entry.Slot] = 0;
    this->release(entry.Slot);
  }
  members = Membership();
  this->Finished[std::size_t(partition)] = 1;
}

void SeamMesh::release(std::uint32_t slot)
{
  if (--this->References[slot] == 0)
  {
    this->FreeSlots.push_back(slot);
  }
}

const std::vector<std::uint32_t>& SeamMesh::reach(PartitionIndex partition)
{
  Membership& members = this->Members[std::size_t(partition)];
  if (members.ReachIsCurrent)
  {
    return members.Reach;
  }
  members.ReachIsCurrent = true;
  members.Reach.clear();
  ++this->Epoch;
  std::size_t kept = 0;
  for (const Entry entry : members.Entries)
  {
    if (!this->Alive[entry.Slot])
    {
      this->release(entry.Slot);
      continue;
    }
    members.Entries[kept++] = entry;
    for (const std::uint32_t label : entry.Labels)
    {
      if (this->LabelSeen[label] != this->Epoch)
      {
        this->LabelSeen[label] = this->Epoch;
        members.Reach.push_back(label);
      }
    }
  }
  members.Entries.resize(kept);
  return members.Reach;
}

} // namespace tipp
