// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRegions_h
#define tippRegions_h

#include "Triangulation/PointBuckets.h"
#include "Triangulation/Tiling.h"

#include <utility>
#include <vector>

namespace tipp
{

/// The region of each partition: the bounding box of its points. The lemmas only require that a
/// region contains its partition's points; smaller regions meet fewer triangles.
class Regions
{
public:
  /// Computes the regions. The tiling must outlive this object.
  template <typename Id>
  Regions(const Tiling& tiling, const PointBuckets<Id>& buckets, int threads);

  /// Takes known boxes. `used` has one entry for each partition: 0 if it has no points.
  Regions(const Tiling& tiling, std::vector<Box2> boxes, std::vector<char> used)
    : Tiles(tiling)
    , Boxes(std::move(boxes))
    , Used(std::move(used))
  {
  }

  PartitionIndex size() const { return static_cast<PartitionIndex>(this->Boxes.size()); }
  const Box2& operator[](PartitionIndex p) const { return this->Boxes[std::size_t(p)]; }

  /// By partition: not 0 if it has points, and so a region.
  const std::vector<char>& areUsed() const { return this->Used; }

  /// Calls visit(partition) for every region that the closed disk meets.
  template <typename Visit>
  void visitMet(const Circumdisk& disk, Visit&& visit) const
  {
    this->Tiles.visitNear(disk.bounds(),
      [&](PartitionIndex p)
      {
        if (this->Used[std::size_t(p)] && disk.meets((*this)[p]))
        {
          visit(p);
        }
      });
  }

private:
  const Tiling& Tiles;
  std::vector<Box2> Boxes;
  std::vector<char> Used;
};

extern template Regions::Regions(const Tiling&, const PointBuckets<std::int32_t>&, int);
extern template Regions::Regions(const Tiling&, const PointBuckets<std::int64_t>&, int);

} // namespace tipp

#endif
