// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/SeamGroups.h"

#include <algorithm>
#include <stdexcept>

namespace tipp
{
namespace
{

constexpr std::uint32_t Empty = ~0U;

} // namespace

void SeamGroups::append(const SeamGroups& others, std::size_t g)
{
  const auto add = [](auto& to, const auto& range)
  { to.insert(to.end(), range.begin(), range.end()); };
  add(this->Met, others.met(g));
  add(this->Labels, others.labels(g));
  add(this->Vertices, others.vertices(g));
  this->Groups.push_back(
    { static_cast<std::uint32_t>(this->Met.size()), static_cast<std::uint32_t>(this->Labels.size()),
      static_cast<std::uint32_t>(this->Vertices.size()),
      static_cast<std::uint32_t>(this->Triangles.size()), others.Groups[g].HasArtificial });
}

void SeamGroups::copyWithoutTriangles(
  const SeamGroups& others, const std::vector<std::uint32_t>& which)
{
  std::size_t met = 0;
  std::size_t labels = 0;
  std::size_t vertices = 0;
  for (const std::uint32_t g : which)
  {
    met += others.met(g).size();
    labels += others.labels(g).size();
    vertices += others.vertices(g).size();
  }
  this->Groups.reserve(which.size());
  this->Met.reserve(met);
  this->Labels.reserve(labels);
  this->Vertices.reserve(vertices);
  for (const std::uint32_t g : which)
  {
    this->append(others, g);
  }
}

void SeamGroups::write(ByteWriter& writer) const
{
  writer.array(this->Groups);
  writer.array(this->Met);
  writer.array(this->Labels);
  writer.array(this->Vertices);
  writer.array(this->Triangles);
}

SeamGroups SeamGroups::read(ByteReader& reader)
{
  SeamGroups groups;
  reader.array(groups.Groups);
  reader.array(groups.Met);
  reader.array(groups.Labels);
  reader.array(groups.Vertices);
  reader.array(groups.Triangles);
  groups.check();
  return groups;
}

void SeamGroups::check() const
{
  Group last{};
  for (const Group& group : this->Groups)
  {
    const std::uint32_t vertices = group.VertexEnd - last.VertexEnd;
    bool good = group.MetEnd >= last.MetEnd && group.MetEnd <= this->Met.size() &&
      group.LabelEnd >= last.LabelEnd && group.LabelEnd <= this->Labels.size() &&
      group.VertexEnd >= last.VertexEnd && group.VertexEnd <= this->Vertices.size() &&
      group.TriangleEnd >= last.TriangleEnd && group.TriangleEnd <= this->Triangles.size();
    for (std::uint32_t t = last.TriangleEnd; good && t < group.TriangleEnd; ++t)
    {
      const Corners& corners = this->Triangles[t];
      good = corners[0] < vertices && corners[1] < vertices && corners[2] < vertices;
    }
    if (!good)
    {
      throw std::runtime_error("Boundary triangles from another rank are damaged.");
    }
    last = group;
  }
}

SeamGroups SeamGrouping::group(const SeamTriangles& seams, PartitionIndex finished)
{
  this->findGroups(seams, finished);
  this->orderByGroup();
  SeamGroups groups;
  this->reserve(seams, groups);
  for (std::uint32_t g = 0; g < this->Met.size(); ++g)
  {
    this->addGroup(seams, g, groups);
  }
  return groups;
}

/// In the order of their first triangles.
void SeamGrouping::findGroups(const SeamTriangles& seams, PartitionIndex finished)
{
  this->Met.clear();
  std::vector<std::uint32_t> groupOfSet(seams.Sets.size(), Empty);
  std::vector<PartitionIndex> met;
  this->GroupOf.resize(seams.size());
  for (std::size_t t = 0; t < seams.size(); ++t)
  {
    std::uint32_t& group = groupOfSet[seams.SetOf[t]];
    if (group == Empty)
    {
      met.assign(seams.metBegin(t), seams.metEnd(t));
      met.erase(std::remove(met.begin(), met.end(), finished), met.end());
      group = this->Met.number(met.data(), met.data() + met.size());
    }
    this->GroupOf[t] = group;
  }
}

void SeamGrouping::orderByGroup()
{
  this->Begins.assign(this->Met.size() + 1, 0);
  for (const std::uint32_t g : this->GroupOf)
  {
    ++this->Begins[g + 1];
  }
  for (std::size_t g = 0; g < this->Met.size(); ++g)
  {
    this->Begins[g + 1] += this->Begins[g];
  }
  std::vector<std::uint32_t> places = this->Begins;
  this->Order.resize(this->GroupOf.size());
  for (std::size_t t = 0; t < this->GroupOf.size(); ++t)
  {
    this->Order[places[this->GroupOf[t]]++] = static_cast<std::uint32_t>(t);
  }
}

/// Just the memory that the groups need, since they may live long.
void SeamGrouping::reserve(const SeamTriangles& seams, SeamGroups& groups)
{
  std::size_t vertices = 0;
  this->Slots.assign(seams.Vertices.size(), {});
  for (std::uint32_t g = 0; g < this->Met.size(); ++g)
  {
    for (std::uint32_t i = this->Begins[g]; i < this->Begins[g + 1]; ++i)
    {
      for (const std::uint32_t corner : seams.Triangles[this->Order[i]])
      {
        vertices += this->Slots[corner].Group != g;
        this->Slots[corner].Group = g;
      }
    }
  }
  groups.Vertices.reserve(vertices);
  groups.Triangles.reserve(seams.size());
  this->Slots.assign(seams.Vertices.size(), {});
}

void SeamGrouping::addGroup(const SeamTriangles& seams, std::uint32_t g, SeamGroups& groups)
{
  groups.Met.insert(groups.Met.end(), this->Met.begin(g), this->Met.end(g));
  const std::size_t firstVertex = groups.Vertices.size();
  std::uint32_t artificial = 0;
  this->Labels.clear();
  for (std::uint32_t i = this->Begins[g]; i < this->Begins[g + 1]; ++i)
  {
    SeamGroups::Corners corners{};
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::uint32_t place = seams.Triangles[this->Order[i]][k];
      Slot& slot = this->Slots[place];
      if (slot.Group != g)
      {
        const SeamVertex& v = seams.Vertices[place];
        slot = { g, static_cast<std::uint32_t>(groups.Vertices.size() - firstVertex) };
        groups.Vertices.push_back({ v.Place, v.Id });
        this->Labels.push_back(v.Label);
        artificial |= v.isArtificial();
      }
      corners[k] = slot.Place;
    }
    groups.Triangles.push_back(corners);
  }
  std::sort(this->Labels.begin(), this->Labels.end());
  groups.Labels.insert(groups.Labels.end(), this->Labels.begin(),
    std::unique(this->Labels.begin(), this->Labels.end()));
  groups.Groups.push_back({ static_cast<std::uint32_t>(groups.Met.size()),
    static_cast<std::uint32_t>(groups.Labels.size()),
    static_cast<std::uint32_t>(groups.Vertices.size()),
    static_cast<std::uint32_t>(groups.Triangles.size()), artificial });
}

} // namespace tipp
