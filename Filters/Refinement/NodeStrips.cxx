// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/NodeStrips.h"

#include "Parallel/Poll.h"
#include "Refinement/TrianglePart.h"

#include <algorithm>
#include <limits>

namespace tipp
{

namespace
{
constexpr std::size_t slice = 1 << 16; ///< triangles or nodes between checks of the memory
}

std::size_t stripsFor(std::size_t triangles, const PagedMemory* memory)
{
  constexpr std::size_t bytes = 150;                  // of a triangle with what finds it
  constexpr std::size_t least = std::size_t(1) << 14; // triangles of a strip
  return memory ? triangles / std::max<std::size_t>(least, memory->limit() / 4 / bytes) + 1 : 1;
}

NodeStrips::NodeStrips(
  const NodesView& nodes, TrianglesView triangles, std::size_t count, PagedMemory* memory)
  : Nodes(nodes)
  , Triangles(triangles)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  this->chooseCuts(count);
  this->Ranges.assign(this->Cuts.size() + 1, { infinity, -infinity });
  if (this->Cuts.empty())
  {
    this->Ranges[0] = { -infinity, infinity };
    return;
  }
  this->groupTriangles(memory);
}

/// Cuts between equal numbers of some nodes.
void NodeStrips::chooseCuts(std::size_t count)
{
  constexpr std::size_t most = 1 << 16;
  const std::size_t step = this->Nodes.size() / most + 1;
  std::vector<double> sample;
  for (std::size_t node = 0; node < this->Nodes.size(); node += step)
  {
    sample.push_back(this->Nodes[node].y);
  }
  std::sort(sample.begin(), sample.end());
  for (std::size_t i = 1; i < count && !sample.empty(); ++i)
  {
    const double cut = sample[sample.size() * i / count];
    if (cut > sample.front() && (this->Cuts.empty() || cut > this->Cuts.back()))
    {
      this->Cuts.push_back(cut);
    }
  }
}

/// A node on a cut belongs to the upper strip.
std::size_t NodeStrips::stripOf(double y) const
{
  return std::size_t(
    std::upper_bound(this->Cuts.begin(), this->Cuts.end(), y) - this->Cuts.begin());
}

/// Calls visit(strip, lowest y, highest y) for the strips of a triangle's corners, each once.
template <typename Visit>
void NodeStrips::forStripsOf(std::size_t triangle, const Visit& visit) const
{
  std::array<double, 3> y{};
  for (int corner = 0; corner < 3; ++corner)
  {
    y[std::size_t(corner)] = this->Nodes[std::size_t(this->Triangles.id(triangle, corner))].y;
  }
  std::sort(y.begin(), y.end());
  std::size_t last = this->size();
  for (const double at : y)
  {
    const std::size_t strip = this->stripOf(at);
    if (strip != last)
    {
      visit(strip, y[0], y[2]);
      last = strip;
    }
  }
}

void NodeStrips::groupTriangles(PagedMemory* memory)
{
  const auto forAll = [this](const auto& visit)
  {
    for (std::size_t t = 0; t < this->Triangles.size(); ++t)
    {
      if (t % slice == 0)
      {
        poll();
        keepMemoryLimits();
      }
      this->forStripsOf(
        t, [&](std::size_t strip, double low, double high) { visit(t, strip, low, high); });
    }
  };
  this->Begins.assign(this->Ranges.size() + 1, 0);
  forAll(
    [this](std::size_t, std::size_t strip, double low, double high)
    {
      ++this->Begins[strip + 1];
      std::array<double, 2>& range = this->Ranges[strip];
      range = { std::min(range[0], low), std::max(range[1], high) };
    });
  for (std::size_t strip = 0; strip < this->Ranges.size(); ++strip)
  {
    this->Begins[strip + 1] += this->Begins[strip];
  }
  this->Grouped = bufferIn<std::int32_t>(memory, this->Begins.back());
  std::vector<std::size_t> ends(this->Begins.begin(), this->Begins.end() - 1);
  forAll([&](std::size_t t, std::size_t strip, double, double)
    { this->Grouped[ends[strip]++] = std::int32_t(t); });
}

MeshPart NodeStrips::part(std::size_t strip) const
{
  if (this->Cuts.empty())
  {
    return partOfTriangles(this->Nodes, this->Triangles);
  }
  return partOfTriangles(this->Nodes, this->Triangles, this->Grouped.data() + this->Begins[strip],
    this->Begins[strip + 1] - this->Begins[strip],
    [this, strip](std::int64_t node)
    { return this->stripOf(this->Nodes[std::size_t(node)].y) == strip; });
}

} // namespace tipp
