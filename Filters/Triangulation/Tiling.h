// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTiling_h
#define tippTiling_h

#include "Predicates/Circumdisk.h"
#include "Predicates/Point2.h"
#include "vtkTIPPFiltersModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

using PartitionIndex = std::int32_t;

/// The partitions' boxes: a domain cut in two repeatedly. Every point belongs to exactly one
/// partition (a point on a cut to the upper one); the boxes are closed and share their borders.
class VTKTIPPFILTERS_EXPORT Tiling
{
public:
  /// Equal boxes, `columns` x `rows`. Throws std::length_error beyond MostPartitions.
  static Tiling grid(const Box2& domain, int columns, int rows);

  /// About `count` boxes that contain equally many of the sample's points.
  static Tiling balanced(const Box2& domain, std::vector<Point2> sample, int count);

  /// Replaces each box by the boxes of a tiling of it; `inner` is indexed by box.
  Tiling refined(const std::vector<Tiling>& inner) const;

  ///@{
  /// Serialisation, for messages.
  std::vector<char> save() const;
  static Tiling load(const std::vector<char>& bytes);
  ///@}

  PartitionIndex size() const { return static_cast<PartitionIndex>(this->Boxes.size()); }
  const Box2& box(PartitionIndex i) const { return this->Boxes[static_cast<std::size_t>(i)]; }
  const Box2& domain() const { return this->Domain; }

  /// Computes the partition of each of `count` points; for many points PartitionFinder is faster.
  void locate(const Point2* points, std::size_t count, std::uint32_t* partitions) const;

  PartitionIndex locate(Point2 p) const
  {
    std::uint32_t partition;
    this->locate(&p, 1, &partition);
    return static_cast<PartitionIndex>(partition);
  }

  /// Calls visit(partition) for every box that the closed disk meets.
  template <typename Visit>
  void visitMet(const Circumdisk& disk, Visit&& visit) const
  {
    this->visitNear(disk.bounds(),
      [&](PartitionIndex p)
      {
        if (disk.meets(this->box(p)))
        {
          visit(p);
        }
      });
  }

  /// Calls visit(partition) for every box that meets the bounds, and perhaps for some others.
  template <typename Visit>
  void visitNear(const Box2& bounds, Visit&& visit) const
  {
    const double low[2] = { bounds.xmin, bounds.ymin };
    const double high[2] = { bounds.xmax, bounds.ymax };
    std::array<std::int32_t, MaximumDepth> pending;
    std::size_t size = 0;
    pending[size++] = 0;
    while (size > 0)
    {
      const Node* node = &this->node(pending[--size]);
      while (!node->isBox())
      {
        const bool below = low[node->Axis] <= node->At;
        const bool above = high[node->Axis] >= node->At;
        if (below && above)
        {
          pending[size++] = node->Child[1];
        }
        node = &this->node(node->Child[!below]);
      }
      visit(node->Partition);
    }
  }

private:
  friend class PartitionFinder;

  /// A cut or a box. A box is its own child, so that a search may take more steps than needed.
  struct Node
  {
    double At;
    std::int32_t Axis;
    std::int32_t Child[2]; ///< below the cut, and from it on
    PartitionIndex Partition;

    bool isBox() const { return this->Partition >= 0; }
  };
  // Every cut halves the number of boxes, which fits into 31 bits.
  static constexpr std::size_t MaximumDepth = 64;

  /// The partition of a point that is known to be below the node `from`.
  PartitionIndex locate(Point2 p, std::int32_t from) const
  {
    const double coordinates[2] = { p.x, p.y };
    const Node* at = &this->node(from);
    while (!at->isBox())
    {
      at = &this->node(at->Child[coordinates[at->Axis] >= at->At]);
    }
    return at->Partition;
  }

  std::int32_t cutGrid(const Box2& box, int columns, int rows, std::size_t depth);
  std::int32_t cutSample(const Box2& box, Point2* begin, Point2* end, int count, std::size_t depth);
  std::int32_t addBox(const Box2& box, std::size_t depth);
  std::int32_t addCut(int axis, double at);
  template <typename MakeBox>
  std::int32_t addTree(
    const Tiling& tree, std::int32_t from, std::size_t depth, const MakeBox& makeBox);
  std::int32_t placeBox(const Box2& box, PartitionIndex partition, std::size_t depth);
  const Node& node(std::int32_t i) const { return this->Nodes[static_cast<std::size_t>(i)]; }

  Box2 Domain{};
  std::size_t Depth = 0;   ///< maximum number of cuts from the root to a box
  std::vector<Node> Nodes; ///< the first is the root
  std::vector<Box2> Boxes;
};

} // namespace tipp

#endif
