// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRegions_h
#define tippRegions_h

#include "Kernel/Pairs.h"
#include "Parallel/ParallelFor.h"
#include "Triangulation/PointBuckets.h"
#include "Triangulation/Tiling.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace tipp
{

/// The region of each partition: a box that contains its points, by default their bounding box. The
/// lemmas require no more; smaller regions meet fewer cells.
template <int D>
class RegionsOf
{
public:
  /// Takes known boxes, each of which lies in that of the partition in `tree`. `used` has one entry
  /// for each partition: 0 if it has no points. The tree must outlive this object.
  RegionsOf(const CutTree<D>& tree, std::vector<Box<D>> boxes, std::vector<char> used)
    : Tree(tree)
    , Boxes(std::move(boxes))
    , Used(std::move(used))
  {
  }

  /// In the plane: the bounding boxes of the partitions' points.
  template <typename Id>
  RegionsOf(const Tiling& tiling, const PointBuckets<Id>& buckets, int threads)
    : Tree(tiling)
    , Boxes(std::size_t(tiling.size()))
    , Used(std::size_t(tiling.size()), 0)
  {
    parallelFor(tiling.size(), threads,
      [&](std::int64_t i)
      {
        const auto p = static_cast<PartitionIndex>(i);
        this->Boxes[std::size_t(i)] = extentOf(buckets.points(p), buckets.count(p)).Bounds;
        this->Used[std::size_t(i)] = buckets.count(p) > 0;
      });
  }

  /// In the plane: the tiling's boxes.
  RegionsOf(const Tiling& tiling) // NOLINT(google-explicit-constructor)
    : RegionsOf(tiling, tiling.boxes(), std::vector<char>(std::size_t(tiling.size()), 1))
  {
  }

  PartitionIndex size() const { return static_cast<PartitionIndex>(this->Boxes.size()); }
  const Box<D>& operator[](PartitionIndex p) const { return this->Boxes[std::size_t(p)]; }

  /// By partition: not 0 if it has points, and so a region.
  const std::vector<char>& areUsed() const { return this->Used; }

  /// Calls visit(partition) for every region that a closed disk or ball meets.
  template <typename Ball, typename Visit>
  void visitMet(const Ball& ball, Visit&& visit) const
  {
    this->Tree.visitNear(ball.bounds(),
      [&](PartitionIndex p)
      {
        if (this->Used[std::size_t(p)] && ball.meets((*this)[p]))
        {
          visit(p);
        }
      });
  }

private:
  const CutTree<D>& Tree;
  std::vector<Box<D>> Boxes;
  std::vector<char> Used;
};

using Regions = RegionsOf<2>;

} // namespace tipp

#endif
