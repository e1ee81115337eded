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
  this->Vertices.clear();
  this->Triangles.clear();
  this->SetOf.clear();
  this->Sets.clear();
}

void SeamTriangles::add(const Tiling& tiling, const Corners& corners, const Circumdisk& disk)
{
  this->Found.clear();
  tiling.visitMet(disk, [this](PartitionIndex partition) { this->Found.push_back(partition); });
  this->add(corners, this->Found.data(), this->Found.data() + this->Found.size());
}

void SeamTriangles::add(
  const Corners& corners, const PartitionIndex* metBegin, const PartitionIndex* metEnd)
{
  this->Triangles.push_back(corners);
  this->SetOf.push_back(this->Sets.number(metBegin, metEnd));
}

void SeamTriangles::appendTriangles(const SeamTriangles& others)
{
  for (std::size_t i = 0; i < others.size(); ++i)
  {
    this->add(others.Triangles[i], others.metBegin(i), others.metEnd(i));
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
  for (std::size_t i = 0; i < added.size(); ++i)
  {
    const SeamTriangle triangle = added[i];
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
