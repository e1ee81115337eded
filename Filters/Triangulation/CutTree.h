// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCutTree_h
#define tippCutTree_h

#include "Engine/PartitionIndex.h"
#include "Predicates/Geometry.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// A tree of cuts across axes, which divides the plane (D = 2) or space (D = 3) into partitions.
/// Every point belongs to exactly one of them: a point on a cut to the upper one. Their boxes are
/// closed and share their borders.
template <int D>
class CutTree
{
public:
  PartitionIndex size() const { return this->Count; }

  /// The partition of a point.
  PartitionIndex locate(const Point<D>& p) const { return this->locate(p, 0); }

  /// Calls visit(partition) for every box that meets the bounds, and perhaps for some others, in
  /// the order of the tree.
  template <typename Visit>
  void visitNear(const Box<D>& bounds, Visit&& visit) const
  {
    std::array<std::int32_t, MaximumDepth> pending;
    std::size_t size = 0;
    pending[size++] = 0;
    while (size > 0)
    {
      const Node* node = &this->node(pending[--size]);
      while (!node->isBox())
      {
        const auto axis = std::size_t(node->Axis);
        const bool below = bounds.Min[axis] <= node->Coordinate;
        const bool above = bounds.Max[axis] >= node->Coordinate;
        if (below && above)
        {
          pending[size++] = node->Child[1];
        }
        node = &this->node(node->Child[!below]);
      }
      visit(node->Partition);
    }
  }

protected:
  /// A cut or a box.
  struct Node
  {
    double Coordinate;
    std::int32_t Axis;
    std::int32_t Child[2]; ///< nodes below the cut and above it; for a box, itself
    PartitionIndex Partition;

    bool isBox() const { return this->Partition >= 0; }
  };
  // Every cut halves the number of boxes, which fits into 31 bits.
  static constexpr std::size_t MaximumDepth = 64;

  /// The partition of a point that is known to be below the node `from`.
  PartitionIndex locate(const Point<D>& p, std::int32_t from) const
  {
    const Node* at = &this->node(from);
    while (!at->isBox())
    {
      at = &this->node(at->Child[p[std::size_t(at->Axis)] >= at->Coordinate]);
    }
    return at->Partition;
  }

  std::int32_t addLeaf(PartitionIndex partition)
  {
    const auto node = static_cast<std::int32_t>(this->Nodes.size());
    this->Nodes.push_back({ 0, 0, { node, node }, partition });
    this->Count = std::max(this->Count, partition + 1);
    return node;
  }

  /// Adds a cut, then the subtrees that first() and second() add below it. Returns the cut's node.
  template <typename MakeFirst, typename MakeSecond>
  std::int32_t addCut(int axis, double at, const MakeFirst& makeFirst, const MakeSecond& makeSecond)
  {
    const auto cut = static_cast<std::int32_t>(this->Nodes.size());
    this->Nodes.push_back({ at, axis, { 0, 0 }, -1 });
    const std::int32_t first = makeFirst();
    const std::int32_t second = makeSecond();
    this->Nodes[std::size_t(cut)].Child[0] = first;
    this->Nodes[std::size_t(cut)].Child[1] = second;
    return cut;
  }

  const Node& node(std::int32_t i) const { return this->Nodes[static_cast<std::size_t>(i)]; }

  std::vector<Node> Nodes; ///< the first is the root
  PartitionIndex Count = 0;
};

} // namespace tipp

#endif
