// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/SeamGroups.h"

#include <algorithm>
#include <stdexcept>

namespace tipp
{
namespace
{

constexpr std::uint64_t Golden = 0x9e3779b97f4a7c15U;
constexpr std::uint32_t Empty = ~0U;

std::size_t tableSize(std::size_t entries)
{
  std::size_t size = 64;
  while (size < 2 * entries)
  {
    size *= 2;
  }
  return size;
}

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
  SeamGroups groups;
  this->addTriangles(seams, groups);
  return groups;
}

void SeamGrouping::findGroups(const SeamTriangles& seams, PartitionIndex finished)
{
  const std::size_t count = seams.Triangles.size();
  this->Met.clear();
  this->MetEnds.clear();
  this->GroupOf.resize(count);
  this->Samples.clear();
  const std::size_t size = tableSize(count);
  this->Table.assign(size, Empty);
  const auto begin = [this](std::size_t t) { return t == 0 ? 0 : this->MetEnds[t - 1]; };
  const auto same = [&](std::size_t a, std::size_t b)
  {
    return this->MetEnds[a] - begin(a) == this->MetEnds[b] - begin(b) &&
      std::equal(this->Met.begin() + begin(a), this->Met.begin() + this->MetEnds[a],
        this->Met.begin() + begin(b));
  };
  for (std::size_t t = 0; t < count; ++t)
  {
    std::uint64_t hash = 0;
    for (const PartitionIndex* p = seams.metBegin(t); p != seams.metEnd(t); ++p)
    {
      if (*p != finished)
      {
        this->Met.push_back(*p);
        hash = (hash ^ std::uint64_t(*p + 1)) * Golden;
      }
    }
    this->MetEnds.push_back(static_cast<std::uint32_t>(this->Met.size()));
    std::size_t at = (hash >> 32) & (size - 1);
    while (this->Table[at] != Empty && !same(t, this->Samples[this->Table[at]]))
    {
      at = (at + 1) & (size - 1);
    }
    if (this->Table[at] == Empty)
    {
      this->Table[at] = static_cast<std::uint32_t>(this->Samples.size());
      this->Samples.push_back(static_cast<std::uint32_t>(t));
    }
    this->GroupOf[t] = this->Table[at];
  }
}

void SeamGrouping::addTriangles(const SeamTriangles& seams, SeamGroups& groups)
{
  const std::size_t count = seams.Triangles.size();
  std::vector<std::uint32_t> places(this->Samples.size() + 1, 0);
  for (const std::uint32_t g : this->GroupOf)
  {
    ++places[g + 1];
  }
  for (std::size_t g = 0; g < this->Samples.size(); ++g)
  {
    places[g + 1] += places[g];
  }
  const std::vector<std::uint32_t> begins = places;
  this->Order.resize(count);
  for (std::size_t t = 0; t < count; ++t)
  {
    this->Order[places[this->GroupOf[t]]++] = static_cast<std::uint32_t>(t);
  }
  this->Slots.resize(std::max(this->Slots.size(), tableSize(2 * count)));
  groups.Triangles.reserve(count);
  for (std::size_t g = 0; g < this->Samples.size(); ++g)
  {
    const std::size_t sample = this->Samples[g];
    groups.Met.insert(groups.Met.end(),
      this->Met.begin() + (sample == 0 ? 0 : this->MetEnds[sample - 1]),
      this->Met.begin() + this->MetEnds[sample]);
    const std::size_t firstVertex = groups.Vertices.size();
    const std::size_t firstLabel = groups.Labels.size();
    std::uint32_t artificial = 0;
    ++this->Stamp;
    for (std::uint32_t i = begins[g]; i < begins[g + 1]; ++i)
    {
      SeamGroups::Corners corners;
      for (std::size_t k = 0; k < 3; ++k)
      {
        const SeamVertex& v = seams.Triangles[this->Order[i]][k];
        artificial |= v.isArtificial();
        corners[k] = this->placeOf(v, firstVertex, groups);
      }
      groups.Triangles.push_back(corners);
    }
    std::sort(groups.Labels.begin() + std::ptrdiff_t(firstLabel), groups.Labels.end());
    groups.Labels.erase(
      std::unique(groups.Labels.begin() + std::ptrdiff_t(firstLabel), groups.Labels.end()),
      groups.Labels.end());
    groups.Groups.push_back({ static_cast<std::uint32_t>(groups.Met.size()),
      static_cast<std::uint32_t>(groups.Labels.size()),
      static_cast<std::uint32_t>(groups.Vertices.size()),
      static_cast<std::uint32_t>(groups.Triangles.size()), artificial });
  }
}

/// Its place among the group's vertices, where it is put when it comes first.
std::uint32_t SeamGrouping::placeOf(
  const SeamVertex& v, std::size_t firstVertex, SeamGroups& groups)
{
  const std::size_t mask = this->Slots.size() - 1;
  std::size_t at = ((std::uint64_t(v.Id) * Golden) >> 32) & mask;
  while (this->Slots[at].Stamp == this->Stamp && this->Slots[at].Id != v.Id)
  {
    at = (at + 1) & mask;
  }
  if (this->Slots[at].Stamp != this->Stamp)
  {
    const std::size_t place = groups.Vertices.size() - firstVertex;
    this->Slots[at] = { v.Id, this->Stamp, static_cast<std::uint32_t>(place) };
    groups.Vertices.push_back({ v.Place, v.Id });
    groups.Labels.push_back(v.Label);
  }
  return this->Slots[at].Place;
}

} // namespace tipp
