// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/ModelBoundaries.h"

#include "Files/MemoryLimits.h"
#include "Parallel/Poll.h"
#include "Predicates/ExactPredicates.h"
#include "Query/Queries.h"
#include "Refinement/TrianglePart.h"
#include "Resident/ResidentMesh.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <tuple>
#include <utility>

namespace tipp
{
namespace
{

/// Whether p lies on the closed segment ab.
bool isOn(Point2 p, Point2 a, Point2 b)
{
  return orientation(a, b, p) == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) &&
    std::min(a.y, b.y) <= p.y && p.y <= std::max(a.y, b.y);
}

/// Whether p lies in an odd number of rings, or on one.
bool isInside(Point2 p, const std::vector<std::vector<Point2>>& rings)
{
  bool isIn = false;
  for (const std::vector<Point2>& ring : rings)
  {
    for (std::size_t i = 0; i < ring.size(); ++i)
    {
      const Point2 a = ring[i];
      const Point2 b = ring[(i + 1) % ring.size()];
      if (isOn(p, a, b))
      {
        return true;
      }
      // The edge crosses the ray from p to the east.
      if ((a.y > p.y) != (b.y > p.y) && (orientation(a, b, p) > 0) == (b.y > a.y))
      {
        isIn = !isIn;
      }
    }
  }
  return isIn;
}

using Nodes = std::vector<std::int64_t>;

/// Whether a loop with the mesh on its left is an outer border. At its lowest node such a loop
/// turns left, whenever it passes the node. A loop around a hole turns right there, at least once:
/// it passes on the outside of the hole.
bool isOuter(const NodesView& nodes, const Nodes& loop)
{
  const auto at = [&nodes](std::int64_t node) { return nodes[std::size_t(node)]; };
  const auto isLower = [&at](std::int64_t a, std::int64_t b)
  {
    const Point2 p = at(a);
    const Point2 q = at(b);
    return std::tie(p.x, p.y) < std::tie(q.x, q.y);
  };
  const std::int64_t lowest = *std::min_element(loop.begin(), loop.end(), isLower);
  for (std::size_t i = 0; i < loop.size(); ++i)
  {
    const std::int64_t before = loop[(i + loop.size() - 1) % loop.size()];
    const std::int64_t after = loop[(i + 1) % loop.size()];
    if (loop[i] == lowest && orientation(at(before), at(lowest), at(after)) < 0)
    {
      return false;
    }
  }
  return true;
}

/// Divides an outer border into open boundaries and mainland.
class OuterBorder
{
public:
  OuterBorder(const Nodes& loop, const OpenNodes& isOpen)
    : Loop(loop)
  {
    for (const std::int64_t node : loop)
    {
      this->IsOpen.push_back(isOpen(node) ? 1 : 0);
    }
  }

  void addTo(ModelBoundaries& boundaries, std::int64_t mainland)
  {
    const std::size_t size = this->Loop.size();
    boundaries.LoneOpenNodes += this->dropLoneNodes();
    const auto land = std::find(this->IsOpen.begin(), this->IsOpen.end(), 0);
    if (land == this->IsOpen.end())
    {
      boundaries.Lists.Open.push_back(this->Loop);
      return;
    }
    std::size_t begin = this->firstRun();
    if (begin == size)
    {
      Nodes closed = this->Loop;
      closed.push_back(closed.front());
      boundaries.Lists.Land.push_back({ mainland, std::move(closed) });
      return;
    }
    for (std::size_t done = 0; done < size;)
    {
      // From the first node of an open run to its last one, and from there to the next run.
      const std::size_t last = this->lengthOfRun(begin) - 1;
      boundaries.Lists.Open.push_back(this->nodes(begin, last));
      const std::size_t next = last + 1 + this->lengthOfRun(begin + last + 1);
      boundaries.Lists.Land.push_back({ mainland, this->nodes(begin + last, next - last) });
      begin += next;
      done += next;
    }
  }

private:
  bool isOpenAt(std::size_t i) const { return this->IsOpen[i % this->IsOpen.size()] != 0; }

  /// Nodes without an open neighbour become mainland. Returns their number.
  std::int64_t dropLoneNodes()
  {
    const std::size_t size = this->Loop.size();
    std::int64_t dropped = 0;
    std::vector<char> kept = this->IsOpen;
    for (std::size_t i = 0; i < size; ++i)
    {
      if (this->isOpenAt(i) && !this->isOpenAt(i + size - 1) && !this->isOpenAt(i + 1))
      {
        kept[i] = 0;
        ++dropped;
      }
    }
    this->IsOpen = std::move(kept);
    return dropped;
  }

  /// The beginning of the open run that has the loop's first node, or else of the next one; the
  /// loop's size if there is none. There must be a node that is not open.
  std::size_t firstRun() const
  {
    const std::size_t size = this->Loop.size();
    if (this->isOpenAt(0))
    {
      std::size_t begin = size;
      while (this->isOpenAt(begin - 1))
      {
        --begin;
      }
      return begin % size;
    }
    return std::size_t(
      std::find(this->IsOpen.begin(), this->IsOpen.end(), 1) - this->IsOpen.begin());
  }

  /// The number of nodes from `begin` on that are all open or all not.
  std::size_t lengthOfRun(std::size_t begin) const
  {
    std::size_t length = 1;
    while (this->isOpenAt(begin + length) == this->isOpenAt(begin))
    {
      ++length;
    }
    return length;
  }

  /// The nodes from `begin` to `begin` + `edges`.
  Nodes nodes(std::size_t begin, std::size_t edges) const
  {
    Nodes list;
    for (std::size_t i = begin; i <= begin + edges; ++i)
    {
      list.push_back(this->Loop[i % this->Loop.size()]);
    }
    return list;
  }

  const Nodes& Loop;
  std::vector<char> IsOpen; ///< per node of the loop
};

std::int64_t countRepeated(Nodes nodes)
{
  std::sort(nodes.begin(), nodes.end());
  std::int64_t repeated = 0;
  for (std::size_t i = 1; i < nodes.size(); ++i)
  {
    const bool isFirstRepetition = i == 1 || nodes[i - 2] != nodes[i];
    repeated += nodes[i] == nodes[i - 1] && isFirstRepetition ? 1 : 0;
  }
  return repeated;
}

} // namespace

OpenNodes nodesInside(const NodesView& nodes, std::vector<std::vector<Point2>> rings)
{
  return [nodes, rings = std::move(rings)](std::int64_t node)
  { return isInside(nodes[std::size_t(node)], rings); };
}

OpenNodes nodesDeeperThan(const double* depths, double depth)
{
  return [depths, depth](std::int64_t node) { return depths[node] > depth; };
}

namespace
{

/// The triangles at the ends of segments, and so at all nodes of the border.
MeshPart partAtSegments(const NodesView& nodes, TrianglesView triangles,
  const std::vector<std::array<std::int64_t, 2>>& segments)
{
  std::vector<bool> isEnd(nodes.size(), false);
  for (const auto& [a, b] : segments)
  {
    isEnd[std::size_t(a)] = isEnd[std::size_t(b)] = true;
  }
  std::vector<std::int32_t> chosen;
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    constexpr std::size_t often = 1 << 16;
    if (t % often == 0)
    {
      poll();
      keepMemoryLimits();
    }
    if (isEnd[std::size_t(triangles.id(t, 0))] || isEnd[std::size_t(triangles.id(t, 1))] ||
      isEnd[std::size_t(triangles.id(t, 2))])
    {
      chosen.push_back(std::int32_t(t));
    }
  }
  return partOfTriangles(nodes, triangles, chosen.data(), chosen.size(),
    [&isEnd](std::int64_t node) { return isEnd[std::size_t(node)]; });
}

} // namespace

ModelBoundaries findModelBoundaries(const NodesView& nodes, TrianglesView triangles,
  const OpenNodes& isOpen, const LandKinds& kinds,
  const std::vector<std::array<std::int64_t, 2>>& segments)
{
  const ResidentMesh mesh(segments.empty() ? partOfTriangles(nodes, triangles)
                                           : partAtSegments(nodes, triangles, segments));
  const BoundaryLoops loops = boundaryOf(mesh);
  ModelBoundaries boundaries;
  std::vector<AdcircBoundaries::LandBoundary> islands;
  for (std::size_t i = 0; i + 1 < loops.Points.Starts.size(); ++i)
  {
    // A loop starts with its lowest edge, so with its lowest node.
    Nodes loop(loops.Points.Ids.begin() + loops.Points.Starts[i],
      loops.Points.Ids.begin() + loops.Points.Starts[i + 1]);
    if (isOuter(nodes, loop))
    {
      ++boundaries.OuterLoops;
      OuterBorder(loop, isOpen).addTo(boundaries, kinds.Mainland);
    }
    else
    {
      ++boundaries.Islands;
      islands.push_back({ kinds.Island, std::move(loop) });
    }
  }
  std::move(islands.begin(), islands.end(), std::back_inserter(boundaries.Lists.Land));
  boundaries.TouchingNodes = countRepeated(loops.Points.Ids);
  return boundaries;
}

} // namespace tipp
