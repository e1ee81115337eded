// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/NodeOrder.h"

#include "Parallel/CountingSort.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Poll.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <utility>

namespace tipp
{
namespace
{

/// The nodes that share an edge with each node.
class NodeGraph
{
public:
  NodeGraph(std::size_t nodes, TrianglesView triangles)
    : Neighbours(nodes, 1,
        [triangles](const auto& visit)
        {
          for (std::size_t t = 0; t < triangles.size(); ++t)
          {
            for (int corner = 0; corner < 3; ++corner)
            {
              const auto node = std::size_t(triangles.id(t, corner));
              visit(node, std::int32_t(triangles.id(t, (corner + 1) % 3)));
              visit(node, std::int32_t(triangles.id(t, (corner + 2) % 3)));
            }
          }
        })
    , Degrees(nodes)
  {
    // Those across inner edges are there twice.
    forIndices(std::int64_t(nodes),
      [this](std::int64_t node)
      {
        std::int32_t* const begin = this->Neighbours.begin(std::size_t(node));
        std::int32_t* const end = this->Neighbours.end(std::size_t(node));
        std::sort(begin, end);
        this->Degrees[std::size_t(node)] = std::int32_t(std::unique(begin, end) - begin);
      });
  }

  std::size_t size() const { return this->Degrees.size(); }

  ///@{
  /// The node's neighbours, ascending.
  const std::int32_t* begin(std::int64_t node) const
  {
    return this->Neighbours.begin(std::size_t(node));
  }
  const std::int32_t* end(std::int64_t node) const
  {
    return this->begin(node) + this->Degrees[std::size_t(node)];
  }
  ///@}

  /// Whether `a` has fewer neighbours than `b`, or as many and a lower index.
  bool isBefore(std::int64_t a, std::int64_t b) const
  {
    return std::make_pair(this->Degrees[std::size_t(a)], a) <
      std::make_pair(this->Degrees[std::size_t(b)], b);
  }

private:
  GroupedItems<std::int32_t> Neighbours;
  std::vector<std::int32_t> Degrees;
};

/// Traverses a graph breadth first.
class Traversal
{
public:
  explicit Traversal(const NodeGraph& graph)
    : Graph(graph)
    , Seen(graph.size(), 0)
  {
  }

  /// Visits the component of `start`: Nodes are in the order of Cuthill and McKee. Marks them as
  /// seen by a pass of this number, which must be higher than those before.
  void run(std::int64_t start, std::int32_t pass)
  {
    this->Nodes.assign(1, start);
    this->Seen[std::size_t(start)] = pass;
    this->Levels = 0;
    this->LastLevel = 0;
    std::size_t levelEnd = 1;
    for (std::size_t at = 0; at < this->Nodes.size(); ++at)
    {
      if (at == levelEnd)
      {
        this->LastLevel = at;
        levelEnd = this->Nodes.size();
        ++this->Levels;
      }
      pollAt(std::int64_t(at));
      this->addNeighbours(this->Nodes[at], pass);
    }
  }

  /// The node with the fewest neighbours among those farthest from the start; of several the
  /// lowest.
  std::int64_t farthest() const
  {
    return *std::min_element(this->Nodes.begin() + std::ptrdiff_t(this->LastLevel),
      this->Nodes.end(),
      [this](std::int64_t a, std::int64_t b) { return this->Graph.isBefore(a, b); });
  }

  bool hasSeen(std::int64_t node) const { return this->Seen[std::size_t(node)] != 0; }

  const NodeGraph& Graph;
  std::vector<std::int64_t> Nodes; ///< of the last run
  std::int64_t Levels = 0;         ///< the greatest distance from the start, in edges

private:
  void addNeighbours(std::int64_t node, std::int32_t pass)
  {
    const std::size_t begin = this->Nodes.size();
    for (const std::int32_t* next = this->Graph.begin(node); next != this->Graph.end(node); ++next)
    {
      const std::int64_t other = *next;
      if (this->Seen[std::size_t(other)] != pass)
      {
        this->Seen[std::size_t(other)] = pass;
        this->Nodes.push_back(other);
      }
    }
    std::sort(this->Nodes.begin() + std::ptrdiff_t(begin), this->Nodes.end(),
      [this](std::int64_t a, std::int64_t b) { return this->Graph.isBefore(a, b); });
  }

  std::size_t LastLevel = 0;      ///< index in Nodes of the first node of the last level
  std::vector<std::int32_t> Seen; ///< the last pass that visited each node; 0: none
};

/// Leaves the component of `node` in Cuthill and McKee's order in `traversal.Nodes`, from a
/// pseudo-peripheral node.
void traverseFromPeriphery(Traversal& traversal, std::int64_t node)
{
  // Each component is new, so that passes may begin with 1 in each.
  std::int32_t pass = 1;
  traversal.run(node, pass);
  const auto fewest = std::min_element(traversal.Nodes.begin(), traversal.Nodes.end(),
    [&](std::int64_t a, std::int64_t b) { return traversal.Graph.isBefore(a, b); });
  traversal.run(*fewest, ++pass);
  std::int64_t start = *fewest;
  for (std::int64_t levels = -1; traversal.Levels > levels;)
  {
    levels = traversal.Levels;
    const std::int64_t next = traversal.farthest();
    traversal.run(next, ++pass);
    if (traversal.Levels <= levels)
    {
      traversal.run(start, ++pass); // no farther away: the start before is kept
      break;
    }
    start = next;
  }
}

} // namespace

std::vector<std::int64_t> reverseCuthillMcKee(std::size_t nodes, TrianglesView triangles)
{
  if (nodes > std::size_t(std::numeric_limits<std::int32_t>::max()))
  {
    throw std::length_error("Too many nodes to be ordered.");
  }
  const NodeGraph graph(nodes, triangles);
  Traversal traversal(graph);
  std::vector<std::int64_t> order;
  order.reserve(nodes);
  for (std::size_t node = 0; node < nodes; ++node)
  {
    if (!traversal.hasSeen(std::int64_t(node)))
    {
      traverseFromPeriphery(traversal, std::int64_t(node));
      order.insert(order.end(), traversal.Nodes.begin(), traversal.Nodes.end());
    }
  }
  std::reverse(order.begin(), order.end());
  return order;
}

std::vector<std::int64_t> inverseOrder(const std::vector<std::int64_t>& order)
{
  std::vector<std::int64_t> inverse(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    inverse[std::size_t(order[i])] = std::int64_t(i);
  }
  return inverse;
}

namespace
{

/// The largest difference of indexOf(id) along an edge.
template <typename IndexOf>
std::int64_t widestEdge(TrianglesView triangles, const IndexOf& indexOf)
{
  std::int64_t widest = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      const std::int64_t a = indexOf(triangles.id(t, corner));
      const std::int64_t b = indexOf(triangles.id(t, (corner + 1) % 3));
      widest = std::max(widest, std::abs(a - b));
    }
  }
  return widest;
}

} // namespace

std::int64_t bandwidthOf(TrianglesView triangles)
{
  return widestEdge(triangles, [](std::int64_t id) { return id; });
}

std::int64_t bandwidthOf(TrianglesView triangles, const std::vector<std::int64_t>& order)
{
  const std::vector<std::int64_t> newIndex = inverseOrder(order);
  return widestEdge(triangles, [&](std::int64_t id) { return newIndex[std::size_t(id)]; });
}

void applyNodeOrder(
  const std::vector<std::int64_t>& order, PointTable& points, Buffer<std::int32_t>& triangles)
{
  std::vector<double> xy(points.XY.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    xy[2 * i] = points.XY[2 * std::size_t(order[i])];
    xy[2 * i + 1] = points.XY[2 * std::size_t(order[i]) + 1];
  }
  points.XY = std::move(xy);
  for (PointTable::Column& column : points.Columns)
  {
    std::vector<double> values(column.Values.size());
    std::transform(order.begin(), order.end(), values.begin(),
      [&column](std::int64_t node) { return column.Values[std::size_t(node)]; });
    column.Values = std::move(values);
  }
  const std::vector<std::int64_t> newIndex = inverseOrder(order);
  for (std::int32_t& id : triangles)
  {
    id = std::int32_t(newIndex[std::size_t(id)]);
  }
}

} // namespace tipp
